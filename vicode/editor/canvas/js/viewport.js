// Which part of the plane is seen: screen = world * k + (x, y). Moving it never touches the scene.
const MIN_ZOOM = 0.02;
const MAX_ZOOM = 4;
const REST_MS = 200;
// From this width on things are drawn larger than life, or they would be lost on a wall of pixels.
const WIDE = 1900;
// So much is left free at each side: the buttons lie to the right, words and the switch at the top.
const CLEAR = { left: 40, right: 64, top: 56, bottom: 32 };

export class Viewport {
  constructor(stage, frame) {
    this.stage = stage;
    this.frame = frame;
    this.k = 1;
    this.x = 0;
    this.y = 0;
    this.width = 0;
    this.height = 0;
    this.isIdle = true;
    this.onChange = () => {};
    this.onIdle = () => {};
  }

  /** Takes the room there is; false while the element is hidden. */
  measure() {
    this.width = this.stage.clientWidth;
    this.height = this.stage.clientHeight;
    return this.width > 0 && this.height > 0;
  }

  toLocal(event) {
    const box = this.stage.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  toWorld(point) {
    return { x: (point.x - this.x) / this.k, y: (point.y - this.y) / this.k };
  }

  toScreen(point) {
    return { x: point.x * this.k + this.x, y: point.y * this.k + this.y };
  }

  /** What is seen, in world units. */
  visibleRect() {
    return { x: -this.x / this.k, y: -this.y / this.k, w: this.width / this.k, h: this.height / this.k };
  }

  middle() {
    return this.toWorld({ x: this.width / 2, y: this.height / 2 });
  }

  set({ x = this.x, y = this.y, k = this.k }) {
    this.k = Math.min(MAX_ZOOM, Math.max(MIN_ZOOM, k));
    this.x = x;
    this.y = y;
    this.isIdle = false;
    this.frame.schedule("view", () => this.onChange());
    this.frame.debounce("view", REST_MS, () => {
      this.isIdle = true;
      this.onIdle();
    });
  }

  panBy(dx, dy) {
    this.set({ x: this.x + dx, y: this.y + dy });
  }

  /** Zooms so that the world point under a screen point stays there. */
  zoomAt(point, factor) {
    const k = Math.min(MAX_ZOOM, Math.max(MIN_ZOOM, this.k * factor));
    const ratio = k / this.k;
    this.set({ k, x: point.x - (point.x - this.x) * ratio, y: point.y - (point.y - this.y) * ratio });
  }

  zoomBy(factor) {
    this.zoomAt({ x: this.width / 2, y: this.height / 2 }, factor);
  }

  centreOn(x, y, k = this.k) {
    this.set({ k, x: this.width / 2 - x * k, y: this.height / 2 - y * k });
  }

  /** Shows a whole rectangle, clear of the controls in the corners; larger than life only where there is much more room. */
  fit(rect) {
    const side = (wish, room) => Math.min(wish, room / 10);
    const [left, right] = [side(CLEAR.left, this.width), side(CLEAR.right, this.width)];
    const [top, bottom] = [side(CLEAR.top, this.height), side(CLEAR.bottom, this.height)];
    const [w, h] = [this.width - left - right, this.height - top - bottom];
    const k = Math.max(MIN_ZOOM, Math.min(Math.max(1, this.width / WIDE), w / rect.w, h / rect.h));
    this.set({ k, x: left + w / 2 - (rect.x + rect.w / 2) * k, y: top + h / 2 - (rect.y + rect.h / 2) * k });
  }

  /** Pans as little as needed to bring a rectangle into sight. */
  reveal(rect, margin = 40) {
    const seen = this.visibleRect();
    const by = margin / this.k;
    const push = (low, high, from, to) => (low - by < from ? low - by - from : high + by > to ? high + by - to : 0);
    const dx = push(rect.x, rect.x + rect.w, seen.x, seen.x + seen.w);
    const dy = push(rect.y, rect.y + rect.h, seen.y, seen.y + seen.h);
    if (dx || dy) this.panBy(-dx * this.k, -dy * this.k);
  }
}
