// The way of every edge: all edges between one pair of nodes are routed together, so that they fan out.
import { Grid } from "./grid.js";
import { bounds, curveBounds, exitPoint, grow, overlaps, pointAt, raise, rectAround, rectOf } from "./geometry.js";
import { chipOf, labelAt, placeLabel } from "./labels.js";
import { pairOf } from "./scene.js";

const LANE = 34;
const CLEARANCE = 8;
// Tried in this order: straight first, then ever wider bows to either side around boxes in the way.
const BOWS = [0, 45, -45, 85, -85, 135, -135, 200, -200, 280, -280];
const SIDES = [
  { x: 0, y: -1 },
  { x: 1, y: 0 },
  { x: 0, y: 1 },
  { x: -1, y: 0 },
];

export class Router {
  constructor(scene) {
    this.scene = scene;
    this.routes = new Map();
    this.labels = new Grid();
    this.labelRects = new Map();
  }

  clear() {
    this.routes.clear();
    this.labels.clear();
    this.labelRects.clear();
  }

  /** The route of an edge: `{curve, chip, at}`, worked out when first asked for. */
  route(edge) {
    if (!this.routes.has(edge.key)) this.#routePair(pairOf(edge));
    return this.routes.get(edge.key);
  }

  forget(edge) {
    for (const key of this.scene.pairs.get(pairOf(edge)) ?? []) this.drop(key);
    this.drop(edge.key);
  }

  /** Forgets one edge only, also one that is gone from the scene: its label must not keep others from their places. */
  drop(key) {
    this.routes.delete(key);
    this.labels.remove(key);
    this.labelRects.delete(key);
  }

  forgetAround(nodeKey) {
    for (const edge of this.scene.edgesOf(nodeKey)) this.forget(edge);
  }

  /** The routed edges that come near a rectangle: they may want another way when a box arrives there or leaves. */
  passing(rect) {
    const found = [];
    for (const key of this.scene.edgeGrid.query(grow(rect, 160))) {
      const route = this.routes.get(key);
      if (route && overlaps(this.#sweep(this.scene.edges.get(key), route.curve), rect)) found.push(this.scene.edges.get(key));
    }
    return found;
  }

  /** What an edge covers and, as it may have bowed around a box, what it would like to cover. */
  #sweep(edge, curve) {
    const ends = [edge.source, edge.target].map((key) => this.scene.nodes.get(key)).filter(Boolean);
    return bounds([curveBounds(curve), ...ends.map(({ x, y }) => ({ x, y, w: 0, h: 0 }))]);
  }

  #routePair(pair) {
    const edges = this.#lanes(pair);
    const [first] = edges;
    const curves = first.source === first.target ? this.#loops(edges) : this.#fan(edges);
    edges.forEach((edge, index) => {
      const curve = curves[index];
      const chip = chipOf(edge, curve);
      const at = edge.data.label_at ? labelAt(curve, edge.data.label_at) : this.#freeLabel(edge, curve, chip);
      this.routes.set(edge.key, { curve, chip, at });
      if (chip) this.#fileLabel(edge.key, rectAround(at.x, at.y, chip.w, chip.h));
    });
  }

  #freeLabel(edge, curve, chip) {
    return edge.source === edge.target ? loopLabel(curve, chip) : placeLabel(curve, chip, (rect) => this.#crowd(rect));
  }

  /** The shown edges of a pair in lane order: one direction first, each by its order in the design. */
  #lanes(pair) {
    const edges = [...this.scene.pairs.get(pair)].map((key) => this.scene.edges.get(key));
    const shown = edges.filter((edge) => this.scene.isDrawable(edge));
    const rank = (edge) => (edge.source < edge.target ? 0 : 1);
    return shown.sort((a, b) => rank(a) - rank(b) || (a.data.order ?? 0) - (b.data.order ?? 0) || (a.key < b.key ? -1 : 1));
  }

  #fan(edges) {
    const a = this.scene.nodes.get(edges[0].source);
    const b = this.scene.nodes.get(edges[0].target);
    // Lanes are counted across the same normal for both directions.
    const [from, to] = a.key < b.key ? [a, b] : [b, a];
    let best = null;
    for (const bow of BOWS) {
      const curves = edges.map((edge, lane) => this.#bend(edge, from, to, bow + (lane - (edges.length - 1) / 2) * LANE));
      const blocked = curves.reduce((sum, curve) => sum + this.#boxesUnder(curve, from, to), 0);
      if (!best || blocked < best.blocked) best = { curves, blocked };
      if (blocked === 0) break;
    }
    return best.curves;
  }

  /** A curve whose middle lies `apex` beside the straight line between two nodes. */
  #bend(edge, from, to, apex) {
    const length = Math.hypot(to.x - from.x, to.y - from.y) || 1;
    const normal = { x: -(to.y - from.y) / length, y: (to.x - from.x) / length };
    const control = { x: (from.x + to.x) / 2 + normal.x * apex * 2, y: (from.y + to.y) / 2 + normal.y * apex * 2 };
    const source = this.scene.nodes.get(edge.source);
    const target = this.scene.nodes.get(edge.target);
    return raise(exitPoint(source, control.x, control.y), control, exitPoint(target, control.x, control.y));
  }

  /** How many boxes a curve runs over, looked up along the curve in steps smaller than a box. */
  #boxesUnder(curve, from, to) {
    const hit = new Set();
    const length = Math.hypot(curve[6] - curve[0], curve[7] - curve[1]);
    const steps = Math.min(80, Math.max(8, Math.ceil(length / 36)));
    for (let step = 1; step < steps; step += 1) {
      const { x, y } = pointAt(curve, step / steps);
      for (const key of this.scene.nodeGrid.at(x, y)) {
        const box = this.scene.nodes.get(key);
        if (box === from || box === to) continue;
        if (Math.abs(x - box.x) < box.w / 2 + CLEARANCE && Math.abs(y - box.y) < box.h / 2 + CLEARANCE) hit.add(key);
      }
    }
    return hit.size;
  }

  /** Self loops take the freest sides; further ones grow around the first. */
  #loops(edges) {
    const node = this.scene.nodes.get(edges[0].source);
    const sides = SIDES.map((side) => ({ side, burden: this.#burden(node, side) })).sort((a, b) => a.burden - b.burden);
    return edges.map((_, index) => loop(node, sides[index % 4].side, Math.floor(index / 4)));
  }

  #burden(node, side) {
    // The initial mark sits at the upper left, so that the top is a little worse than it looks.
    let burden = side.y === -1 && node.data.initial ? 1.5 : 0;
    if (side.x !== 0) burden += 0.2;
    for (const edge of this.scene.edgesOf(node.key)) {
      const other = this.scene.nodes.get(edge.source === node.key ? edge.target : edge.source);
      if (!other || other === node || !this.scene.isDrawable(edge)) continue;
      const length = Math.hypot(other.x - node.x, other.y - node.y) || 1;
      const facing = ((other.x - node.x) * side.x + (other.y - node.y) * side.y) / length;
      burden += Math.max(0, facing) ** 2;
    }
    const place = rectAround(node.x + side.x * (node.w / 2 + 40), node.y + side.y * (node.h / 2 + 40), 80, 80);
    for (const key of this.scene.nodeGrid.query(place)) {
      const other = this.scene.nodes.get(key);
      if (other && other !== node && overlaps(rectOf(other), place)) burden += 3;
    }
    return burden;
  }

  /** How much already lies under a rectangle: boxes weigh more than labels. */
  #crowd(rect) {
    let sum = 0;
    for (const key of this.scene.nodeGrid.query(rect)) {
      const node = this.scene.nodes.get(key);
      if (node && overlaps(grow(rectOf(node), 2), rect)) sum += 3;
    }
    for (const key of this.labels.query(rect)) if (overlaps(this.labelRects.get(key), rect)) sum += 2;
    return sum;
  }

  #fileLabel(key, rect) {
    this.labels.putRect(key, rect);
    this.labelRects.set(key, rect);
  }
}

/** The chip of a loop hangs on its outermost point, so that the loop itself stays visible. */
function loopLabel(curve, chip) {
  const apex = pointAt(curve, 0.5);
  const foot = { x: (curve[0] + curve[6]) / 2, y: (curve[1] + curve[7]) / 2 };
  if (!chip || Math.abs(apex.x - foot.x) < Math.abs(apex.y - foot.y)) return apex;
  return { x: apex.x + Math.sign(apex.x - foot.x) * (chip.w / 2 - 8), y: apex.y };
}

function loop(node, side, ring) {
  const reach = 62 + ring * 26;
  const half = 16 + ring * 6;
  const spread = half + 18;
  const along = { x: -side.y, y: side.x };
  const foot = { x: node.x + side.x * (node.w / 2), y: node.y + side.y * (node.h / 2) };
  const at = (across, out) => [foot.x + along.x * across + side.x * out, foot.y + along.y * across + side.y * out];
  return [...at(-half, 0), ...at(-spread, reach), ...at(spread, reach), ...at(half, 0)];
}
