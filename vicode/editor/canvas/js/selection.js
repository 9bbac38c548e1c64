// What is selected and what is under the pointer, and therefore what is brought forward.

const MAX_HIGHLIGHTED = 40;

export class Selection {
  constructor(canvas) {
    this.canvas = canvas;
    this.scene = canvas.scene;
    this.painter = canvas.painter;
    this.keys = new Set();
    this.hovered = null;
  }

  /** Selects exactly these keys; `quiet` when Python said so and need not be told. */
  set(keys, { quiet = false } = {}) {
    const known = [...new Set(keys)].filter((key) => this.scene.find(key));
    const same = known.length === this.keys.size && known.every((key) => this.keys.has(key));
    if (same) return;
    this.keys = new Set(known);
    this.painter.mark("selected", this.keys);
    this.updateHighlight();
    this.canvas.selectionChanged(quiet);
  }

  toggle(key) {
    const keys = new Set(this.keys);
    if (!keys.delete(key)) keys.add(key);
    this.set(keys);
  }

  hover(key) {
    if (key === this.hovered) return false;
    this.hovered = key;
    this.painter.mark("hover", key ? [key] : []);
    this.updateHighlight();
    return true;
  }

  /** Things went away or changed their ends. */
  prune() {
    if (this.hovered && !this.scene.find(this.hovered)) this.hovered = null;
    const known = [...this.keys].filter((key) => this.scene.find(key));
    const lost = known.length !== this.keys.size;
    this.keys = new Set(known);
    this.updateHighlight();
    return lost;
  }

  /** The only selected key, or null. */
  single() {
    return this.keys.size === 1 ? [...this.keys][0] : null;
  }

  nodes() {
    return [...this.keys].filter((key) => this.scene.nodes.has(key));
  }

  items() {
    return [...this.keys].map((key) => this.scene.find(key)).map(({ of, id }) => ({ of, id }));
  }

  /** Marks the thing in question together with its ends; everything else steps back. */
  updateHighlight() {
    const centre = this.hovered ? [this.hovered] : this.keys.size <= MAX_HIGHLIGHTED ? [...this.keys] : [];
    const lit = new Set(centre);
    for (const key of centre) {
      const edge = this.scene.edges.get(key);
      const edges = edge ? [edge] : this.scene.edgesOf(key).filter((each) => this.scene.isDrawable(each));
      for (const each of edges) for (const part of [each.key, each.source, each.target]) lit.add(part);
    }
    this.painter.mark("lit", lit);
    this.canvas.scheduleDim();
  }
}
