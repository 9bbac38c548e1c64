// The visible part of the plane: screen = world * k + (x, y). Moving it does not change the scene.
const MIN_ZOOM = 0.02;
const MAX_ZOOM = 4;
const REST_MS = 200;
// From this width on, fitting may zoom beyond 100%.
const WIDE = 1900;
// Margins for the controls: the buttons are at the right, messages and the view switch at the top.
const MARGINS = { left: 40, right: 64, top: 56, bottom: 32 };

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

  /** Reads the size of the stage; returns false while the element is hidden. */
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

  /** The visible rectangle in world units. */
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

  /** Zooms around a screen point. */
  zoomAt(point, factor) {
    const k = Math.min(MAX_ZOOM, Math.max(MIN_ZOOM, this.k * factor));
    const ratio = k / this.k;
    this.set({ k, x: point.x - (point.x - this.x) * ratio, y: point.y - (point.y - this.y) * ratio });
  }

  zoomBy(factor) {
    this.zoomAt({ x: this.width / 2, y: this.height / 2 }, factor);
  }

  centerOn(x, y, k = this.k) {
    this.set({ k, x: this.width / 2 - x * k, y: this.height / 2 - y * k });
  }

  /** Fits a rectangle into the view without the margins; zooms beyond 100% only on very wide screens. */
  fit(rect) {
    const limited = (margin, size) => Math.min(margin, size / 10);
    const [left, right] = [limited(MARGINS.left, this.width), limited(MARGINS.right, this.width)];
    const [top, bottom] = [limited(MARGINS.top, this.height), limited(MARGINS.bottom, this.height)];
    const [w, h] = [this.width - left - right, this.height - top - bottom];
    const k = Math.max(MIN_ZOOM, Math.min(Math.max(1, this.width / WIDE), w / rect.w, h / rect.h));
    this.set({ k, x: left + w / 2 - (rect.x + rect.w / 2) * k, y: top + h / 2 - (rect.y + rect.h / 2) * k });
  }

  /** Pans as little as needed to bring a rectangle into view. */
  reveal(rect, margin = 40) {
    const seen = this.visibleRect();
    const gap = margin / this.k;
    const push = (low, high, from, to) => (low - gap < from ? low - gap - from : high + gap > to ? high + gap - to : 0);
    const dx = push(rect.x, rect.x + rect.w, seen.x, seen.x + seen.w);
    const dy = push(rect.y, rect.y + rect.h, seen.y, seen.y + seen.h);
    if (dx || dy) this.panBy(-dx * this.k, -dy * this.k);
  }

  /** Pans to the first of these points, unless one of them is in view. */
  revealAny(points) {
    const seen = this.visibleRect();
    const isSeen = ([x, y]) => x > seen.x && x < seen.x + seen.w && y > seen.y && y < seen.y + seen.h;
    if (points.length && !points.some(isSeen)) this.centerOn(...points[0]);
  }
}
