// The scene sent by Python: nodes and edges by key, with a spatial index and an index by node pair.
import { Grid } from "./grid.js";
import { frameRect, titlePlace } from "./frames.js";
import { bounds, containsRect, nodeRect } from "./geometry.js";
import { EVERY_STATE } from "./strings.js";
import { truncateMiddle, textWidth } from "./text_metrics.js";

/** Prefix of the keys of links. */
export const LINKS = "l:";
const KINDS = { states: "s:", components: "c:", transitions: "t:", links: LINKS, common: "common", frames: "f:", notes: "n:" };
const NODE_HEIGHT = 60;
const COMMON_ID = "@common";

export const keyOf = (of, id) => (of === "common" ? "common" : KINDS[of] + id);
export const pairKey = (edge) => (edge.source < edge.target ? `${edge.source}\n${edge.target}` : `${edge.target}\n${edge.source}`);

export class Scene {
  constructor() {
    this.rev = 0;
    this.component = "";
    this.nodes = new Map();
    this.edges = new Map();
    this.frames = new Map();
    this.initialNodes = new Set();
    this.pairs = new Map();
    this.edgesAt = new Map();
    this.drawnAs = new Map();
    this.nodeGrid = new Grid();
    this.edgeGrid = new Grid();
    this.affectedNodes = new Set();
    this.changedRects = [];
    this.linksShown = true;
    this.hidden = new Set();
  }

  load(view) {
    for (const store of [this.nodes, this.edges, this.frames, this.initialNodes, this.pairs, this.edgesAt, this.drawnAs, this.nodeGrid, this.edgeGrid, this.hidden]) store.clear();
    this.rev = view.rev;
    this.component = view.component;
    this.doc = view.doc ?? "";
    this.#upsert(view);
    if (view.common) this.#putNode("common", COMMON_ID, view.common);
    this.#index(this.nodes.keys(), this.edges.keys());
  }

  /**
   * Applies a difference; returns the keys that changed (`touched`) and were removed (`gone`), the nodes whose edges
   * need rerouting, and the rectangles where nodes came or left.
   */
  apply(changes) {
    this.rev = changes.rev;
    this.affectedNodes = new Set();
    this.changedRects = [];
    const gone = this.#remove(changes.remove ?? {});
    const touched = this.#upsert(changes.upsert ?? {});
    if ("common" in changes) {
      if (changes.common) touched.push(this.#putNode("common", COMMON_ID, changes.common));
      else if (this.nodes.has("common")) gone.push(this.#dropNode("common"));
    }
    const nodes = touched.filter((key) => this.nodes.has(key));
    this.#index(nodes, new Set([...this.#edgesAtAll(nodes), ...touched.filter((key) => this.edges.has(key))]));
    return { touched, gone, affectedNodes: this.affectedNodes, changedRects: this.changedRects };
  }

  /** Returns the key of an element; a transition may be drawn as part of another one. */
  keyOf(of, id) {
    const key = keyOf(of, id);
    return this.drawnAs.get(key) ?? key;
  }

  /** Moves a node without updating the spatial index; `reindex` does that at the end of a drag. */
  move(key, x, y) {
    const node = this.nodes.get(key);
    if (node) Object.assign(node, { x, y });
  }

  reindex(keys) {
    const nodes = [...keys];
    this.#index(nodes, this.#edgesAtAll(nodes));
  }

  /** Hides nodes with their edges; the spatial index contains only what is shown. */
  hide(keys) {
    this.hidden = new Set(keys);
    this.nodeGrid.clear();
    this.edgeGrid.clear();
    this.#index(this.nodes.keys(), this.edges.keys());
  }

  shownNodes() {
    return [...this.nodes.values()].filter(({ key }) => !this.hidden.has(key));
  }

  /** The frames with a state that is shown, or with none at all. */
  shownFrames() {
    return [...this.frames.values()].filter((frame) => {
      const states = this.#statesOf(frame);
      return !states.length || states.some(({ key }) => !this.hidden.has(key));
    });
  }

  /** Whether both ends of an edge are shown and its kind is visible. */
  isDrawable(edge) {
    return this.#isShown(edge.source) && this.#isShown(edge.target) && (this.linksShown || edge.of !== "links");
  }

  drawableEdges() {
    return [...this.edges.values()].filter((edge) => this.isDrawable(edge)).map(({ key }) => key);
  }

  edgesOf(nodeKey) {
    return [...(this.edgesAt.get(nodeKey) ?? [])].map((key) => this.edges.get(key));
  }

  #isShown(key) {
    return this.nodes.has(key) && !this.hidden.has(key);
  }

  find(key) {
    return this.nodes.get(key) ?? this.edges.get(key) ?? this.frames.get(key);
  }

  /** Returns the rectangle of a node or of a frame; null for other keys. */
  boxOf(key) {
    const [node, frame] = [this.nodes.get(key), this.frames.get(key)];
    if (frame) return frameRect(this.#statesOf(frame), frame.data);
    return node ? nodeRect(node) : null;
  }

  /** Returns the place of the name of a node or of the title of a frame, with the element. */
  nameOf(key) {
    const frame = this.frames.get(key);
    return frame ? { ...frame, ...titlePlace(this.boxOf(key)) } : this.nodes.get(key);
  }

  /** Returns the frames from back to front. */
  framesInOrder() {
    return this.shownFrames().sort((a, b) => b.data.level - a.data.level);
  }

  /** Returns the keys of the states of a frame, and of all nodes inside its rectangle. */
  contentOf(key) {
    const area = this.boxOf(key);
    const inside = [...this.nodeGrid.query(area)].filter((node) => containsRect(area, nodeRect(this.nodes.get(node))));
    return [...new Set([...this.#statesOf(this.frames.get(key)).map((node) => node.key), ...inside])];
  }

  #statesOf(frame) {
    return frame.data.states.map((name) => this.nodes.get(keyOf("states", name))).filter(Boolean);
  }

  /** Returns the topmost node under a point. */
  nodeAt(x, y, slack = 0) {
    const near = [...this.nodeGrid.query({ x, y, w: 0, h: 0 })].map((key) => this.nodes.get(key));
    return near.reverse().find((node) => Math.abs(x - node.x) <= node.w / 2 + slack && Math.abs(y - node.y) <= node.h / 2 + slack);
  }

  extent() {
    return bounds([...this.shownNodes().map(nodeRect), ...this.shownFrames().map(({ key }) => this.boxOf(key)).filter(Boolean)]);
  }

  /** Measures all nodes again, after a web font was loaded. */
  remeasure() {
    for (const node of this.nodes.values()) Object.assign(node, sizeOf(node.of, node.data));
    this.reindex(this.nodes.keys());
  }

  #upsert(lists) {
    const touched = [];
    for (const of of ["states", "components", "notes"]) {
      for (const data of lists[of] ?? []) touched.push(this.#putNode(of, data.id, data));
    }
    for (const data of lists.frames ?? []) {
      const key = keyOf("frames", data.id);
      this.frames.set(key, { key, of: "frames", id: data.id, data });
      touched.push(key);
    }
    for (const data of lists.transitions ?? []) touched.push(this.#putEdge(transitionOf(data)));
    for (const data of lists.links ?? []) touched.push(this.#putEdge(linkOf(data)));
    return touched;
  }

  #remove(lists) {
    const gone = [];
    for (const of of ["transitions", "links"]) {
      for (const id of lists[of] ?? []) gone.push(this.#dropEdge(keyOf(of, id)));
    }
    for (const key of (lists.frames ?? []).map((id) => keyOf("frames", id))) {
      this.frames.delete(key);
      gone.push(key);
    }
    for (const of of ["states", "components", "notes"]) {
      for (const id of lists[of] ?? []) gone.push(this.#dropNode(keyOf(of, id)));
    }
    return gone;
  }

  #putNode(of, id, data) {
    const key = keyOf(of, id);
    const old = this.nodes.get(key);
    const node = { key, of, id, data, x: data.x, y: data.y, ...sizeOf(of, data) };
    this.nodes.set(key, node);
    if (data.initial) this.initialNodes.add(key);
    else this.initialNodes.delete(key);
    if (old && isSamePlace(old, node)) return key;
    this.affectedNodes.add(key);
    this.changedRects.push(...[old, node].filter(Boolean).map(nodeRect));
    return key;
  }

  #dropNode(key) {
    this.affectedNodes.add(key);
    for (const edge of this.edgesOf(key)) this.affectedNodes.add(edge.source).add(edge.target);
    if (this.nodes.has(key)) this.changedRects.push(nodeRect(this.nodes.get(key)));
    this.nodes.delete(key);
    this.initialNodes.delete(key);
    this.nodeGrid.remove(key);
    for (const edge of this.edgesAt.get(key) ?? []) this.edgeGrid.remove(edge);
    return key;
  }

  #putEdge(edge) {
    const old = this.edges.get(edge.key);
    if (old && (old.source !== edge.source || old.target !== edge.target)) this.#unlink(old);
    this.affectedNodes.add(edge.source).add(edge.target);
    this.#drawAlso(old, edge);
    this.edges.set(edge.key, edge);
    member(this.edgesAt, edge.source).add(edge.key);
    member(this.edgesAt, edge.target).add(edge.key);
    member(this.pairs, pairKey(edge)).add(edge.key);
    return edge.key;
  }

  #drawAlso(old, edge) {
    for (const id of old?.data.also ?? []) this.drawnAs.delete(keyOf(old.of, id));
    for (const id of edge?.data.also ?? []) this.drawnAs.set(keyOf(edge.of, id), edge.key);
  }

  #dropEdge(key) {
    const edge = this.edges.get(key);
    if (edge) this.#unlink(edge);
    if (edge) this.#drawAlso(edge, null);
    this.edges.delete(key);
    this.edgeGrid.remove(key);
    return key;
  }

  #unlink(edge) {
    this.affectedNodes.add(edge.source).add(edge.target);
    this.edgesAt.get(edge.source)?.delete(edge.key);
    this.edgesAt.get(edge.target)?.delete(edge.key);
    this.pairs.get(pairKey(edge))?.delete(edge.key);
  }

  #edgesAtAll(nodes) {
    return new Set(nodes.flatMap((key) => [...(this.edgesAt.get(key) ?? [])]));
  }

  /** Updates the spatial index. */
  #index(nodes, edges) {
    for (const key of nodes) if (!this.hidden.has(key)) this.nodeGrid.putRect(key, nodeRect(this.nodes.get(key)));
    for (const key of edges) {
      const edge = this.edges.get(key);
      const [source, target] = [this.nodes.get(edge.source), this.nodes.get(edge.target)];
      if (this.#isShown(edge.source) && this.#isShown(edge.target)) this.edgeGrid.putLine(key, source, target);
    }
  }
}

/** Returns the texts of a node and its size; widths are multiples of 20, so that both sides are on the grid. */
export function sizeOf(of, data) {
  if (of === "notes") return { w: data.w, h: data.h, label: data.lines[0], second: "" };
  if (of === "common") return { w: 140, h: 40, label: EVERY_STATE, second: "" };
  const name = String(of === "states" ? data.name : data.id);
  const label = truncateMiddle(name, "name", 230);
  const second = of === "components" && data.name !== data.id ? truncateMiddle(String(data.name), "small", 200) : "";
  const room = Math.max(textWidth(label, "name"), textWidth(second, "small")) + (of === "components" ? 64 : 44);
  return { w: Math.max(120, Math.ceil(room / 20) * 20), h: NODE_HEIGHT, label, second };
}

/** Whether edges and labels near a node can stay; the mark of the initial state occupies space next to the node. */
const isSamePlace = (old, node) =>
  ["x", "y", "w", "h"].every((name) => old[name] === node[name]) && Boolean(old.data.initial) === Boolean(node.data.initial);

function transitionOf(data) {
  const source = data.source === COMMON_ID ? "common" : keyOf("states", data.source);
  return { key: keyOf("transitions", data.id), of: "transitions", id: data.id, data, source, target: keyOf("states", data.target) };
}

function linkOf(data) {
  const state = keyOf("states", data.state);
  const component = keyOf("components", data.component);
  const [source, target] = data.kind === "requires" ? [component, state] : [state, component];
  return { key: keyOf("links", data.id), of: "links", id: data.id, data, source, target };
}

function member(map, key) {
  let found = map.get(key);
  if (!found) map.set(key, (found = new Set()));
  return found;
}
