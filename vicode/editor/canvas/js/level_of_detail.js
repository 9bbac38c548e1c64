// Level of detail: SVG when zoomed in, bitmaps when zoomed out, and a snapshot while many elements are being zoomed.
import { MAX_PINNED } from "./painter.js";
import { NameLayer } from "./name_layer.js";
import { Overview } from "./overview.js";
import { Snapshot } from "./snapshot.js";

const OVERVIEW_ZOOM = 0.3;
// Below this zoom, labels are not legible: only names are shown, enlarged.
export const LEGIBLE_ZOOM = 0.5;
const FAR_STATES = 150;
const MAX_VISIBLE_NODES = 240;
const LEAVING = 0.88;
const THAW_MS = 300;

export class LevelOfDetail {
  constructor(canvas, plane, colors) {
    this.canvas = canvas;
    this.plane = plane;
    this.far = false;
    this.frozen = false;
    this.shownZoom = 1;
    this.overview = new Overview(canvas.scene, canvas.viewport, colors);
    this.snapshot = new Snapshot(canvas.painter, canvas.viewport, colors);
    this.names = new NameLayer(canvas, colors);
    this.elements = [...this.overview.elements, this.snapshot.element, plane, this.names.element];
    // A press needs mounted elements for its hit test.
    canvas.stage.addEventListener("pointerdown", () => this.#unfreeze(), { capture: true });
  }

  /** Moves the planes and bitmaps with the view. */
  viewChanged() {
    const { viewport, painter } = this.canvas;
    const zooms = viewport.k !== this.shownZoom;
    if (zooms) this.#freeze();
    this.shownZoom = viewport.k;
    this.plane.classList.toggle("small", viewport.k < LEGIBLE_ZOOM);
    this.overview.place();
    this.snapshot.place();
    this.names.place();
    if (this.frozen) return;
    this.#placePlane();
    if (!this.far && this.#isTooDense(1)) this.#setFar(true);
    else if (!painter.covers(viewport.visibleRect())) this.#uncovered(zooms);
  }

  /** Draws the visible part in full detail; after a snapshot with a delay, since wheel events pause. */
  viewIdle() {
    if (!this.frozen) return this.#settle();
    this.canvas.frame.debounce("thaw", THAW_MS, () => this.canvas.viewport.isIdle && this.#settle());
  }

  /** Mounts what is visible. */
  cull() {
    if (!this.far && this.#isTooDense(1)) this.#setFar(true);
    else this.#mount();
  }

  scheduleCull() {
    this.canvas.frame.schedule("cull", () => this.cull());
  }

  sceneChanged() {
    this.overview.invalidate();
    this.#unfreeze();
    if (this.far && !this.#isTooDense(LEAVING)) this.#setFar(false);
    this.scheduleRedraw();
  }

  colorsChanged() {
    this.overview.invalidate();
    this.snapshot.invalidate();
  }

  selectionChanged() {
    this.scheduleNames();
    if (!this.far) return;
    this.scheduleCull();
    // A small selection is SVG above the bitmap; a large one is part of the bitmap.
    const inBitmap = this.canvas.selection.keys.size > MAX_PINNED;
    if (inBitmap || this.overview.showsSelection) this.overview.invalidate();
    this.overview.showsSelection = inBitmap;
    this.scheduleRedraw();
  }

  /** Redraws the names at the next frame in which nothing moves. */
  scheduleNames() {
    this.canvas.frame.schedule("names", () => {
      if (!this.canvas.viewport.isIdle) return;
      this.#drawNames();
      if (!this.far && !this.frozen) this.snapshot.prepare(this.shownZoom);
    });
  }

  /** Redraws the bitmaps after a pause, which is short if they are visible. */
  scheduleRedraw() {
    const { frame, gestures, viewport, selection } = this.canvas;
    frame.debounce("overview", this.far ? 60 : 500, () => {
      if (gestures.isDragging() || !viewport.isIdle) return this.scheduleRedraw();
      this.overview.drawCoarse(selection.keys);
      if (this.far) this.overview.drawSharp(selection.keys);
      this.#drawNames();
    });
  }

  #settle() {
    if (this.far && !this.#isTooDense(LEAVING)) this.#setFar(false);
    this.#unfreeze();
    this.cull();
    this.#drawNames();
    if (this.far) this.overview.drawSharp(this.canvas.selection.keys);
    if (!this.far) this.snapshot.prepare(this.shownZoom);
  }

  #drawNames() {
    const isDrawn = this.names.draw(this);
    this.plane.classList.toggle("named", isDrawn);
  }

  #placePlane() {
    const { x, y, k } = this.canvas.viewport;
    this.plane.style.transform = `translate(${x}px, ${y}px) scale(${k})`;
  }

  /** Shows the snapshot during a zoom: browsers repeat the layout of every SVG text at each zoom step. */
  #freeze() {
    const { gestures, root, viewport } = this.canvas;
    const isBusy = this.far || gestures.isDragging() || this.plane.contains(root.activeElement);
    if (this.frozen || isBusy || viewport.isIdle || !this.snapshot.isUseful() || !this.overview.isDrawn()) return;
    this.snapshot.finish(this.shownZoom);
    this.frozen = true;
    this.canvas.stage.classList.add("frozen");
    this.#showUnderlay(true);
  }

  #unfreeze() {
    if (!this.frozen) return;
    this.frozen = false;
    this.#placePlane();
    this.cull();
    this.canvas.stage.classList.remove("frozen");
  }

  /** The view left the mounted area: shows the coarse bitmap during a zoom, and mounts elements while panning. */
  #uncovered(zooms) {
    if (zooms && this.overview.isDrawn()) this.#showUnderlay(true);
    else this.#mount();
  }

  #mount() {
    const { painter, viewport } = this.canvas;
    painter.cull(viewport.visibleRect(), { far: this.far, zoom: viewport.k, moving: !viewport.isIdle });
    this.#showUnderlay(false);
  }

  #showUnderlay(shown) {
    this.canvas.stage.classList.toggle("under", shown);
  }

  /** Whether too many elements for SVG are visible; `slack` below 1 adds hysteresis for leaving the overview. */
  #isTooDense(slack) {
    const { scene, viewport } = this.canvas;
    if (scene.nodes.size - scene.hidden.size <= FAR_STATES) return false;
    return viewport.k < OVERVIEW_ZOOM / slack || scene.nodeGrid.query(viewport.visibleRect()).size > MAX_VISIBLE_NODES * slack;
  }

  #setFar(far) {
    this.far = far;
    if (far) this.overview.drawCoarse(this.canvas.selection.keys);
    this.canvas.stage.classList.toggle("far", far);
    this.#mount();
  }
}
