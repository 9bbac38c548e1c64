// What moves with a hand as one: held boxes, and arrows of which both ends are held. One transform a layer moves them all.
import { moveTo, svg } from "./svg.js";

// So many things have layers of their own; for fewer it takes longer to put one more layer together than to paint them.
const MANY = 60;

export class Carried {
  /** Args: the layers of what is held. */
  constructor(layers) {
    this.groups = new Map(layers.map((layer) => [layer, svg("g", { class: `${layer.getAttribute("class")} carried` })]));
    this.keys = new Set();
  }

  /** Takes the parts of what is shown, `{key: {node} or {line, chip}}`, out of the layers they lie in. */
  lift(items) {
    for (const [layer, group] of this.groups) {
      group.removeAttribute("transform");
      group.classList.toggle("many", items.size > MANY);
      layer.prepend(group);
    }
    for (const [key, item] of items) {
      this.keys.add(key);
      for (const part of Object.values(item)) if (part) moveTo(part, this.groups.get(part.parentNode));
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
  drop(key) {
    return this.keys.delete(key);
  }

  /** Gives all back to their layers, at the places where they were lifted. */
  putDown() {
    this.keys.clear();
    for (const [layer, group] of this.groups) {
      for (const part of [...group.children]) moveTo(part, layer);
      group.remove();
    }
  }
}
