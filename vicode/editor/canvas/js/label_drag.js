// Dragging the label of a transition: to another position, or onto another label to change the priority.
import { rectAround } from "./geometry.js";
import { labelPosition, labelOffset } from "./edge_labels.js";
import { placeGroup } from "./group_transforms.js";
import { DROP_ON_LABEL } from "./strings.js";
import { svg } from "./svg.js";

export class LabelDrag {
  constructor(canvas, key) {
    this.canvas = canvas;
    this.key = key;
  }

  begin({ world }) {
    const route = this.#route();
    if (!route) return;
    this.grip = { x: route.at.x - world.x, y: route.at.y - world.y };
    this.tie = svg("path", { class: "guide" });
    this.canvas.painter.layers.above.append(this.tie);
    this.canvas.painter.mark("held", [this.key]);
    this.canvas.showMessage(DROP_ON_LABEL);
  }

  move({ world }) {
    const route = this.#route();
    if (!route || !this.grip) return;
    this.at = { x: world.x + this.grip.x, y: world.y + this.grip.y };
    this.onto = this.#siblingAt(world);
    this.canvas.painter.mark("drop", this.onto ? [this.onto.key] : []);
    this.#put(this.at);
    const [part, shift] = labelOffset(route.curve, this.at);
    const foot = labelPosition(route.curve, [part, 0]);
    this.tie.setAttribute("d", Math.abs(shift) > 14 && !this.onto ? `M${foot.x} ${foot.y}L${this.at.x} ${this.at.y}` : "");
  }

  end() {
    const { at, onto } = this;
    const route = this.#route();
    this.#release();
    if (!at || !route) return;
    const edge = this.#edge();
    if (onto) this.#putBack();
    if (onto) this.canvas.report("reorder", { id: edge.id, onto: onto.id });
    else this.canvas.report("label", { id: edge.id, at: labelOffset(route.curve, at) });
  }

  cancel() {
    this.#release();
    this.#putBack();
  }

  sceneChanged() {
    if (!this.#edge()) this.canvas.gestures.cancel();
  }

  #edge() {
    return this.canvas.scene.edges.get(this.key);
  }

  #route() {
    const edge = this.#edge();
    return edge && this.canvas.scene.isDrawable(edge) ? this.canvas.router.route(edge) : null;
  }

  #putBack() {
    const route = this.#route();
    if (route) this.#put(route.at);
  }

  #put({ x, y }) {
    const chip = this.canvas.painter.items.get(this.key)?.chip;
    if (chip) placeGroup(chip, x, y);
  }

  #release() {
    this.tie?.remove();
    this.canvas.showMessage("");
    for (const name of ["drop", "held"]) this.canvas.painter.mark(name, []);
  }

  /** Returns another transition of the same source whose label is under the pointer. */
  #siblingAt({ x, y }) {
    const { scene, router } = this.canvas;
    const own = this.#edge();
    return scene.edgesOf(own.source).find((edge) => {
      if (edge === own || edge.source !== own.source || edge.of !== own.of || !scene.isDrawable(edge)) return false;
      const { at, chip } = router.route(edge);
      const rect = chip && rectAround(at.x, at.y, chip.w, chip.h);
      return Boolean(rect) && x >= rect.x && x <= rect.x + rect.w && y >= rect.y && y <= rect.y + rect.h;
    });
  }
}

/** Arrow keys on a selected transition move its label. */
export function nudgeLabel(canvas, edge, dx, dy) {
  const { at, curve, chip } = canvas.router.route(edge);
  if (chip) canvas.report("label", { id: edge.id, at: labelOffset(curve, { x: at.x + dx, y: at.y + dy }), by: "nudge" });
}
