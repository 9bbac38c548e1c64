// Touch: two fingers pan and pinch, a long press opens the menu.

const HOLD_MS = 500;

export class Touch {
  constructor(canvas, onHold) {
    this.canvas = canvas;
    this.onHold = onHold;
    this.fingers = new Map();
    this.span = null;
    this.timer = 0;
  }

  isPinching() {
    return this.span !== null;
  }

  /** Handles a touch; returns whether it is the second finger. */
  down(event) {
    this.canvas.stage.classList.toggle("touch", event.pointerType === "touch");
    if (event.pointerType !== "touch") return false;
    this.fingers.set(event.pointerId, this.canvas.viewport.toLocal(event));
    this.cancelHold();
    if (this.fingers.size === 1) this.timer = setTimeout(() => this.#hold(event), HOLD_MS);
    if (this.fingers.size !== 2) return false;
    this.span = this.#measure();
    return true;
  }

  move(event) {
    if (this.fingers.has(event.pointerId)) this.fingers.set(event.pointerId, this.canvas.viewport.toLocal(event));
  }

  /** Cancels the long press after a movement or release. */
  cancelHold() {
    clearTimeout(this.timer);
  }

  /** Handles a release; returns whether it belongs to a two-finger gesture. */
  up(event) {
    this.cancelHold();
    this.fingers.delete(event.pointerId);
    if (!this.span) return false;
    if (!this.fingers.size) this.span = null;
    return true;
  }

  pinch() {
    if (!this.span || this.fingers.size < 2) return;
    const now = this.#measure();
    const { viewport } = this.canvas;
    viewport.panBy(now.x - this.span.x, now.y - this.span.y);
    viewport.zoomAt(now, now.length / this.span.length);
    this.span = now;
  }

  clear() {
    this.cancelHold();
    this.fingers.clear();
    this.span = null;
  }

  /** Lifting the finger clicks what is under it then, which may be the menu that has just opened. */
  #hold(event) {
    const stop = () => {
      document.removeEventListener("click", swallow, true);
      document.removeEventListener("pointerdown", stop, true);
    };
    const swallow = (click) => {
      // A click by a key has no detail.
      if (!click.detail) return;
      click.preventDefault();
      click.stopPropagation();
      stop();
    };
    document.addEventListener("click", swallow, true);
    document.addEventListener("pointerdown", stop, true);
    this.onHold(event);
  }

  #measure() {
    const [a, b] = [...this.fingers.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, length: Math.max(1, Math.hypot(a.x - b.x, a.y - b.y)) };
  }
}
