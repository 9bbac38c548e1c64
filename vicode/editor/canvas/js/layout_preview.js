// Layout preview: shows nodes at proposed positions, with outlines at the current positions, until the user decides.
import { nodeRect } from "./geometry.js";
import { svg } from "./svg.js";

const VIEW_KEYS = new Set(["+", "=", "-", "0", "1"]);

export class LayoutPreview {
  constructor(canvas) {
    this.canvas = canvas;
    this.keys = null;
    this.pan = null;
    const { stage } = canvas;
    // Captured before all other listeners: during a preview the diagram can be viewed, but not edited.
    for (const [name, job] of [["pointerdown", this.#down], ["pointermove", this.#move], ["pointerup", this.#up], ["keydown", this.#key]]) {
      stage.addEventListener(name, (event) => this.keys && job.call(this, event), { capture: true });
    }
  }

  /** Shows nodes at the positions `{key, x, y}` and fits the view. */
  show(positions) {
    this.clear();
    const { canvas } = this;
    const known = positions.filter(({ key }) => canvas.scene.nodes.has(key));
    if (!known.length) return;
    const { x, y, k } = canvas.viewport;
    canvas.gestures.cancel();
    this.keys = known.map(({ key }) => key);
    this.view = { x, y, k };
    const d = this.keys.map((key) => outline(nodeRect(canvas.scene.nodes.get(key)))).join("");
    this.originalOutlines = svg("path", { class: "before", d });
    canvas.painter.layers.links.before(this.originalOutlines);
    this.#put(known);
    canvas.fit();
    canvas.stage.classList.add("previewing");
    canvas.stage.focus({ preventScroll: true });
  }

  /** Restores the positions of the scene, and the view unless `stay`. */
  clear({ stay = false } = {}) {
    if (!this.keys) return;
    const { canvas, keys } = this;
    this.keys = null;
    this.originalOutlines.remove();
    canvas.stage.classList.remove("previewing");
    const nodes = keys.map((key) => canvas.scene.nodes.get(key)).filter(Boolean);
    this.#put(nodes.map(({ key, data }) => ({ key, x: data.x, y: data.y })));
    if (!stay) canvas.viewport.set(this.view);
  }

  #put(positions) {
    const { scene } = this.canvas;
    for (const { key, x, y } of positions) scene.move(key, x, y);
    this.canvas.positionsChanged(positions.map(({ key }) => key));
  }

  #down(event) {
    if (event.target.closest(".corner")) return;
    event.stopPropagation();
    event.preventDefault();
    this.canvas.stage.focus({ preventScroll: true });
    this.canvas.stage.setPointerCapture(event.pointerId);
    this.pan = this.canvas.viewport.toLocal(event);
  }

  #move(event) {
    if (event.target.closest(".corner")) return;
    event.stopPropagation();
    if (!this.pan) return;
    const now = this.canvas.viewport.toLocal(event);
    this.canvas.viewport.panBy(now.x - this.pan.x, now.y - this.pan.y);
    this.pan = now;
  }

  #up(event) {
    if (!this.pan) return;
    event.stopPropagation();
    this.pan = null;
  }

  #key(event) {
    const isPlain = !(event.ctrlKey || event.metaKey || event.altKey);
    if (!isPlain || event.key === "Tab" || VIEW_KEYS.has(event.key) || event.target.closest("button")) return;
    event.stopPropagation();
    event.preventDefault();
    if (event.key === "Enter") this.canvas.report("preview", { accepted: true });
    if (event.key === "Escape") this.canvas.report("preview", { accepted: false });
  }
}

const outline = ({ x, y, w, h }) => `M${x} ${y}h${w}v${h}h${-w}Z`;
