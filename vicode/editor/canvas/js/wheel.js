// Wheel events: a mouse wheel zooms at the pointer, two fingers on a touchpad pan, Ctrl or a pinch always zooms.

const STREAM_MS = 200;

export class Wheel {
  constructor(canvas) {
    this.canvas = canvas;
    this.isPad = false;
    this.lastTime = 0;
    canvas.stage.addEventListener("wheel", (event) => this.#turn(event), { passive: false });
  }

  #turn(event) {
    event.preventDefault();
    const { viewport } = this.canvas;
    if (event.ctrlKey || event.metaKey) {
      viewport.zoomAt(viewport.toLocal(event), Math.exp(-clamp(event.deltaY, 60) * 0.01));
    } else if (this.#comesFromPad(event)) {
      const [dx, dy] = event.shiftKey && !event.deltaX ? [event.deltaY, 0] : [event.deltaX, event.deltaY];
      viewport.panBy(-dx, -dy);
    } else {
      const turn = event.deltaMode === 0 ? event.deltaY : event.deltaY * 33;
      viewport.zoomAt(viewport.toLocal(event), Math.exp(-clamp(turn, 240) * 0.0015));
    }
  }

  /** Heuristic: a mouse sends large, vertical integer steps. Events in quick succession come from the same device. */
  #comesFromPad(event) {
    const fresh = event.timeStamp - this.lastTime > STREAM_MS;
    this.lastTime = event.timeStamp;
    const mouse = event.deltaMode !== 0 || (event.deltaX === 0 && Math.abs(event.deltaY) >= 40 && Number.isInteger(event.deltaY));
    if (fresh) this.isPad = !mouse;
    return this.isPad;
  }
}

const clamp = (value, max) => Math.max(-max, Math.min(max, value));
