// How much is drawn piece by piece: near everything in sight, far bitmaps of it, and while a crowd zooms its picture.
import { MAX_PINNED } from "./painter.js";
import { Overview } from "./overview.js";
import { Snapshot } from "./snapshot.js";

const OVERVIEW_ZOOM = 0.3;
const FAR_STATES = 150;
const MAX_VISIBLE_NODES = 240;
const LEAVING = 0.88;
const THAW_MS = 300;

export class LevelOfDetail {
  constructor(canvas, plane, colours) {
    this.canvas = canvas;
    this.plane = plane;
    this.far = false;
    this.frozen = false;
    this.shownZoom = 1;
    this.overview = new Overview(canvas.scene, canvas.viewport, colours);
    this.snapshot = new Snapshot(canvas.painter, canvas.viewport, colours);
    this.elements = [...this.overview.elements, this.snapshot.element, plane];
    // What is pressed must be there to be found.
    canvas.stage.addEventListener("pointerdown", () => this.#unfreeze(), { capture: true });
  }

  /** The view moved: what is shown moves along. */
  viewChanged() {
    const { viewport, painter } = this.canvas;
    const zooms = viewport.k !== this.shownZoom;
    if (zooms) this.#freeze();
    this.shownZoom = viewport.k;
    this.overview.place();
    this.snapshot.place();
    if (this.frozen) return;
    this.#placePlane();
    if (!this.far && this.#isTooDense(1)) this.#setFar(true);
    else if (!painter.covers(viewport.visibleRect())) this.#uncovered(zooms);
  }

  /** The view came to rest: what is seen is drawn as well as it can be; after a picture a little later, as wheels pause. */
  viewIdle() {
    if (!this.frozen) return this.#settle();
    this.canvas.frame.debounce("thaw", THAW_MS, () => this.canvas.viewport.isIdle && this.#settle());
  }

  /** Brings the mounted part up to what is seen. */
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

  coloursChanged() {
    this.overview.invalidate();
    this.snapshot.invalidate();
  }

  selectionChanged() {
    if (!this.far) return;
    this.scheduleCull();
    // A small selection lies as SVG above the bitmap; a large one is drawn into it.
    const inBitmap = this.canvas.selection.keys.size > MAX_PINNED;
    if (inBitmap || this.overview.showsSelection) this.overview.invalidate();
    this.overview.showsSelection = inBitmap;
    this.scheduleRedraw();
  }

  /** Bitmaps follow a change when there is time: soon when they are looked at, later when they only stand by. */
  scheduleRedraw() {
    const { frame, gestures, viewport, selection } = this.canvas;
    frame.debounce("overview", this.far ? 60 : 500, () => {
      if (gestures.isDragging() || !viewport.isIdle) return this.scheduleRedraw();
      this.overview.drawCoarse(selection.keys);
      if (this.far) this.overview.drawSharp(selection.keys);
    });
  }

  #settle() {
    if (this.far && !this.#isTooDense(LEAVING)) this.#setFar(false);
    this.#unfreeze();
    this.cull();
    if (this.far) this.overview.drawSharp(this.canvas.selection.keys);
    if (!this.far) this.snapshot.prepare(this.shownZoom);
  }

  #placePlane() {
    const { x, y, k } = this.canvas.viewport;
    this.plane.style.transform = `translate(${x}px, ${y}px) scale(${k})`;
  }

  /** A browser lays out every SVG text anew at each step of a zoom: a crowd of things is stood for by its picture. */
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

  /** The view moved past what is mounted. While it zooms the coarse bitmap must do; while it pans, things are mounted. */
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

  /** Whether there is more in sight than the browser should draw piece by piece; `slack` below 1 makes leaving harder. */
  #isTooDense(slack) {
    const { scene, viewport } = this.canvas;
    if (scene.nodes.size <= FAR_STATES) return false;
    return viewport.k < OVERVIEW_ZOOM / slack || scene.nodeGrid.query(viewport.visibleRect()).size > MAX_VISIBLE_NODES * slack;
  }

  #setFar(far) {
    this.far = far;
    if (far) this.overview.drawCoarse(this.canvas.selection.keys);
    this.canvas.stage.classList.toggle("far", far);
    this.#mount();
  }
}
