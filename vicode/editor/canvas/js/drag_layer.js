// What moves with a hand as one: held boxes, and arrows of which both ends are held. One transform a layer moves them all.
import { bringToFront, svg } from "./svg.js";

// So many things have layers of their own; for fewer it takes longer to put one more layer together than to paint them.
const MANY = 60;

export class DragLayer {
  /** Args: the layers of what is held. */
  constructor(layers) {
    this.groups = new Map(layers.map((layer) => [layer, svg("g", { class: `${layer.getAttribute("class")} dragged` })]));
    this.keys = new Set();
  }

  /** Takes the parts of what is shown, `{key: {node} or {line, chip}}`, out of the layers they lie in. */
  attach(items) {
    for (const [layer, group] of this.groups) {
      group.removeAttribute("transform");
      group.classList.toggle("many", items.size > MANY);
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

  /** Moves all to so far from where they were lifted. */
  move({ x, y }) {
    for (const group of this.groups.values()) group.setAttribute("transform", `translate(${x} ${y})`);
  }

  /** One of them goes: who draws it again moves it alone. */
  detach(key) {
    return this.keys.delete(key);
  }

  /** Gives all back to their layers, at the places where they were lifted. */
  release() {
    this.keys.clear();
    for (const [layer, group] of this.groups) {
      for (const part of [...group.children]) bringToFront(part, layer);
      group.remove();
    }
  }
}
