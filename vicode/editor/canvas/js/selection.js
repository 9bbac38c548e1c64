// The selected elements, the hovered element, and the highlight that follows from them.
import { keyOf } from "./scene.js";

const MAX_HIGHLIGHTED = 40;
// In a diagram of more nodes than this, the selection of a single node or edge dims what is not connected to it.
const MAX_UNDIMMED = 30;

export class Selection {
  constructor(canvas) {
    this.canvas = canvas;
    this.scene = canvas.scene;
    this.painter = canvas.painter;
    this.keys = new Set();
    this.hovered = null;
    this.renamed = new Map();
  }

  /** Sets the selection; `quiet` if Python set it, so that no gesture is reported. */
  set(keys, { quiet = false } = {}) {
    const known = [...new Set(keys)].filter((key) => this.scene.find(key));
    const isSame = known.length === this.keys.size && known.every((key) => this.keys.has(key));
    if (isSame) return;
    this.keys = new Set(known);
    this.painter.mark("selected", this.keys);
    this.updateHighlight();
    this.canvas.selectionChanged(quiet);
  }

  /** Sets what the user clicks: also if it is selected already, as Python may be about to select something else. */
  choose(keys) {
    if (keys.length !== this.keys.size || !keys.every((key) => this.keys.has(key))) this.set(keys);
    else this.canvas.selectionChanged(false);
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

  /** The next change of the scene renames a state, which stays selected. */
  stateRenamed(old, name) {
    this.renamed.set(keyOf("states", old), keyOf("states", name));
  }

  /** Follows renamed states and removes deleted elements; returns whether the selection changed. */
  prune() {
    if (this.hovered && !this.scene.find(this.hovered)) this.hovered = null;
    const known = [...this.keys].map((key) => this.renamed.get(key) ?? key).filter((key) => this.scene.find(key));
    const isSame = known.length === this.keys.size && known.every((key) => this.keys.has(key));
    this.keys = new Set(known);
    this.renamed.clear();
    this.updateHighlight();
    return !isSame;
  }

  /** The only selected key, or null. */
  single() {
    return this.keys.size === 1 ? [...this.keys][0] : null;
  }

  nodes() {
    return [...this.keys].filter((key) => this.scene.nodes.has(key));
  }

  /** The selected nodes, and those inside selected frames. */
  movable() {
    const frames = [...this.keys].filter((key) => this.scene.frames.has(key));
    return [...new Set([...this.nodes(), ...frames.flatMap((key) => this.scene.contentOf(key))])];
  }

  /** The selected elements, with the content of selected frames. */
  itemsWithContent() {
    return [...new Set([...this.keys, ...this.movable()])].map((key) => this.scene.find(key)).map(({ of, id }) => ({ of, id }));
  }

  items() {
    return [...this.keys].map((key) => this.scene.find(key)).map(({ of, id }) => ({ of, id }));
  }

  /** Highlights the hovered or selected elements with their edges and ends; nothing else changes. */
  updateHighlight() {
    const isFrame = (key) => this.scene.frames.has(key);
    const elements = this.hovered ? [this.hovered] : this.keys.size <= MAX_HIGHLIGHTED ? [...this.keys] : [];
    this.painter.mark("lit", this.#connected(elements.filter((key) => !isFrame(key))));
    this.#dim();
    const frames = [...this.keys].map((key) => this.scene.frames.get(key)).filter(Boolean);
    this.painter.mark("member", frames.flatMap(({ data }) => data.states.map((name) => keyOf("states", name))));
  }

  /** Dims what is not connected to the selected element; not during a simulation, which shows the active state. */
  #dim() {
    const key = this.single();
    const isDimming = key && !this.scene.frames.has(key) && this.scene.nodes.size > MAX_UNDIMMED && !this.painter.marks.get("active").size;
    this.painter.dimAround(isDimming ? this.#connected([key]) : new Set());
  }

  /** Nodes and edges, with the edges of the nodes and the ends of the edges. */
  #connected(keys) {
    const found = new Set(keys);
    for (const key of keys) {
      const edge = this.scene.edges.get(key);
      const edges = edge ? [edge] : this.scene.edgesOf(key).filter((candidate) => this.scene.isDrawable(candidate));
      for (const { key: edgeKey, source, target } of edges) for (const part of [edgeKey, source, target]) found.add(part);
    }
    return found;
  }
}
