// Dragging a new edge from a node, or one end of a transition to another node, with a preview under the pointer.
import { headOf, pathOf } from "./edge_svg.js";
import { exitPoint, quadraticToCubic, rectAround, snap } from "./geometry.js";
import { svg } from "./svg.js";

// A release this close to the source node is accidental and creates no state.
const ACCIDENTAL_DISTANCE = 40;
export const NEW_STATE = { w: 120, h: 60 };

export class ConnectDrag {
  scrolls = true;

  constructor(canvas, source) {
    this.canvas = canvas;
    this.source = source;
  }

  begin() {
    this.preview = new ConnectionPreview(this.canvas, { line: true, box: this.#from()?.of !== "components" });
  }

  move({ world }) {
    this.world = world;
    const target = this.#targetAt(world);
    this.canvas.painter.mark("drop", target ? [target.key] : []);
    this.preview.show(this.#from(), target ?? { ...world }, !target && !this.#isAccidental(world));
  }

  /** Whether a node may be the other end. */
  accepts(node) {
    const source = this.#from();
    return Boolean(source) && canJoin(source, node);
  }

  end() {
    const target = this.world && this.#targetAt(this.world);
    const world = this.world;
    this.cancel();
    if (target) this.connectTo(target);
    else if (world && !this.#isAccidental(world)) this.#connectToNew(world);
  }

  cancel() {
    this.preview?.close();
    this.canvas.painter.mark("drop", []);
  }

  sceneChanged() {
    if (!this.#from()) this.canvas.gestures.cancel();
  }

  /** Reports the link between the two nodes, or asks for the guard of their transition. */
  connectTo(target) {
    const source = this.#from();
    if (!source || !canJoin(source, target)) return;
    if (source.of !== "components" && target.of === "states") {
      this.canvas.guard.startNew(source, target, { source: source.id, target: target.id });
      return;
    }
    const [state, component] = source.of === "states" ? [source, target] : [target, source];
    // A component without parameters cannot be modulated, only required.
    const kind = source.of === "states" && target.data.parameters !== 0 ? "modulates" : "requires";
    this.canvas.report("link", { kind_of_link: kind, state: state.id, component: component.id });
  }

  #connectToNew(world) {
    const source = this.#from();
    if (!source || source.of === "components") return;
    this.canvas.rename.startNew({ source: this.source, x: snap(world.x), y: snap(world.y) });
  }

  #from() {
    return this.canvas.scene.nodes.get(this.source);
  }

  #targetAt(world) {
    const target = this.canvas.scene.nodeAt(world.x, world.y, 6);
    return target && this.accepts(target) ? target : null;
  }

  #isAccidental(world) {
    const from = this.#from();
    if (!from) return true;
    const distance = ACCIDENTAL_DISTANCE / Math.min(1, this.canvas.viewport.k);
    return Math.abs(world.x - from.x) < from.w / 2 + distance && Math.abs(world.y - from.y) < from.h / 2 + distance;
  }
}

export class ReconnectDrag {
  scrolls = true;

  constructor(canvas, key, end) {
    this.canvas = canvas;
    this.key = key;
    this.whichEnd = end;
  }

  begin() {
    this.preview = new ConnectionPreview(this.canvas, { line: true, box: false });
  }

  move({ world }) {
    const edge = this.#edge();
    if (!edge) return;
    this.world = world;
    const target = this.#targetAt(world);
    this.canvas.painter.mark("drop", target ? [target.key] : []);
    const fixed = this.canvas.scene.nodes.get(this.whichEnd === "source" ? edge.target : edge.source);
    const free = target ?? { ...world };
    if (this.whichEnd === "source") this.preview.show(free, fixed, false);
    else this.preview.show(fixed, free, false);
  }

  accepts(node) {
    return node.of === "states" || (node.of === "common" && this.whichEnd === "source");
  }

  end() {
    const target = this.world && this.#targetAt(this.world);
    this.cancel();
    if (target) this.connectTo(target);
  }

  connectTo(target) {
    const edge = this.#edge();
    if (!edge || edge[this.whichEnd] === target.key) return;
    this.canvas.report("reconnect", { id: edge.id, end: this.whichEnd, state: target.id });
  }

  cancel() {
    this.preview?.close();
    this.canvas.painter.mark("drop", []);
  }

  sceneChanged() {
    if (!this.#edge()) this.canvas.gestures.cancel();
  }

  #edge() {
    return this.canvas.scene.edges.get(this.key);
  }

  #targetAt(world) {
    const node = this.canvas.scene.nodeAt(world.x, world.y, 6);
    return node && this.accepts(node) ? node : null;
  }
}

const canJoin = (source, target) =>
  target.of === "states" || (source.of === "states" && target.of === "components");

/** The dashed curve that follows the pointer, and the outline of the state that would be created. */
export class ConnectionPreview {
  constructor(canvas, { box }) {
    this.canvas = canvas;
    this.line = svg("path", { class: "preview" });
    this.head = svg("path", { class: "preview-head" });
    this.box = box ? svg("rect", { class: "preview-box", rx: 12, visibility: "hidden" }) : null;
    this.group = svg("g", {}, [this.line, this.head, ...(this.box ? [this.box] : [])]);
    canvas.painter.layers.above.append(this.group);
    canvas.stage.classList.add("connecting");
  }

  /** The ends are nodes or points. */
  show(from, to, createsState) {
    if (from && to) this.#showLine(from, to);
    if (to) this.#showBox(to, createsState);
  }

  close() {
    this.group.remove();
    this.canvas.stage.classList.remove("connecting");
  }

  #showLine(from, to) {
    const curve = from === to ? loopOver(from) : straight(from, to);
    const { tip, base } = headOf(curve);
    this.line.setAttribute("d", pathOf(curve, base));
    this.head.setAttribute("d", tip);
  }

  #showBox(at, shown) {
    if (!this.box) return;
    const { x, y, w, h } = rectAround(snap(at.x), snap(at.y), NEW_STATE.w, NEW_STATE.h);
    for (const [name, value] of Object.entries({ x, y, width: w, height: h, visibility: shown ? "visible" : "hidden" })) this.box.setAttribute(name, value);
  }
}

function straight(from, to) {
  const leave = from.w ? exitPoint(from, to.x, to.y) : from;
  const arrive = to.w ? exitPoint(to, from.x, from.y) : to;
  return quadraticToCubic(leave, { x: (leave.x + arrive.x) / 2, y: (leave.y + arrive.y) / 2 }, arrive);
}

const loopOver = ({ x, y, h }) => [x - 16, y - h / 2, x - 34, y - h / 2 - 56, x + 34, y - h / 2 - 56, x + 16, y - h / 2];
