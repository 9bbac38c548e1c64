// Drag handles: around a hovered or selected node, and at both ends of a selected transition.
import { svg } from "./svg.js";

const OUT = 9;
const RADIUS = 5;
const REACH = 11;
// Touch target of 44 pixels.
const TOUCH_REACH = 22;

export class Handles {
  constructor(canvas) {
    this.canvas = canvas;
    this.group = svg("g", { class: "handles" });
    canvas.painter.layers.above.append(this.group);
  }

  /** Draws the handles of the hovered or the only selected element; none during a drag. */
  refresh() {
    const { selection, scene, gestures } = this.canvas;
    this.group.replaceChildren();
    if (gestures.isDragging()) return;
    const node = scene.nodes.get(selection.hovered) ?? scene.nodes.get(selection.single());
    if (node && node.of !== "notes") this.#aroundNode(node);
    const edge = scene.edges.get(selection.single());
    if (edge?.of === "transitions" && scene.isDrawable(edge)) this.#atEnds(edge);
  }

  #aroundNode(node) {
    const size = this.#size();
    if (size > 2.5) return;
    const out = OUT * size;
    const positions = [
      [node.x, node.y - node.h / 2 - out],
      [node.x + node.w / 2 + out, node.y],
      [node.x, node.y + node.h / 2 + out],
      [node.x - node.w / 2 - out, node.y],
    ];
    for (const [x, y] of positions) this.#disc(x, y, size, { "data-handle": node.key });
  }

  #atEnds(edge) {
    const { curve } = this.canvas.router.route(edge);
    const size = this.#size();
    this.#disc(curve[0], curve[1], size, { "data-end": "source", "data-edge": edge.key });
    this.#disc(curve[6], curve[7], size, { "data-end": "target", "data-edge": edge.key });
  }

  #disc(cx, cy, size, names) {
    const reach = this.canvas.stage.classList.contains("touch") ? TOUCH_REACH : REACH;
    this.group.append(
      svg("circle", { class: "handle-hit", cx, cy, r: reach * size, ...names }),
      svg("circle", { class: "handle", cx, cy, r: RADIUS * size }),
    );
  }

  /** Scale that keeps the size of handles on the screen when the view is zoomed out. */
  #size() {
    return 1 / Math.min(1, this.canvas.viewport.k);
  }
}
