// Elements that a drag moves as one: the dragged nodes and the edges between them. One transform per layer moves them.
import { bringToFront, svg } from "./svg.js";

// From this many elements on they get a compositor layer; for fewer, compositing takes longer than painting.
const MIN_LAYER_ITEMS = 60;

export class DragLayer {
  /** @param layers the SVG layers of dragged elements */
  constructor(layers) {
    this.groups = new Map(layers.map((layer) => [layer, svg("g", { class: `${layer.getAttribute("class")} dragged` })]));
    this.keys = new Set();
  }

  /** Moves SVG groups, `{key: {node} or {line, chip}}`, from their layers into the drag layer. */
  attach(items) {
    for (const [layer, group] of this.groups) {
      group.removeAttribute("transform");
      group.classList.toggle("many", items.size > MIN_LAYER_ITEMS);
      layer.prepend(group);
    }
    for (const [key, item] of items) {
      this.keys.add(key);
      for (const part of Object.values(item)) if (part) bringToFront(part, this.groups.get(part.parentNode));
    }
  }

  has(key) {
    return this.keys.has(key);
  }

  /** Sets the offset from the positions at the start of the drag. */
  move({ x, y }) {
    for (const group of this.groups.values()) group.setAttribute("transform", `translate(${x} ${y})`);
  }

  /** Removes one element; returns whether it was part of the drag. */
  detach(key) {
    return this.keys.delete(key);
  }

  /** Moves all elements back to their layers, at the positions of the start of the drag. */
  release() {
    this.keys.clear();
    for (const [layer, group] of this.groups) {
      for (const part of [...group.children]) bringToFront(part, layer);
      group.remove();
    }
  }
}
