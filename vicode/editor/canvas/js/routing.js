// The way of every edge and the place of its label. Ways depend on boxes alone; labels also on the ways near them.
import { Grid } from "./grid.js";
import { bounds, polylineTouches, curveBounds, grow, curveLength, overlaps, pointOnCurve, sampleCurve, rectAround, nodeRect } from "./geometry.js";
import { makeEdgeLabel, labelPosition, placeLabel, shorterLabels } from "./edge_labels.js";
import { LINKS, pairKey } from "./scene.js";
import { parallelCurves, selfLoopCurves, readingOrder, straightCurves } from "./edge_curves.js";

// What a label would hide, dearer first. A place farther along its line costs less than hiding a line.
const COST = { box: 12, label: 8, line: 1.4, link: 0.7 };
// In a scene of more edges a label looks only at ways and labels that are known already: those of what is in sight.
const MAX_PLANNED = 600;

export class Router {
  constructor(scene) {
    this.scene = scene;
    this.routes = new Map();
    this.paths = new Map();
    this.lines = new Grid();
    this.labels = new Grid();
    this.labelRects = new Map();
    // While a box follows a hand, labels look at boxes and labels alone; these want a second look then.
    this.isProvisional = false;
    this.provisional = new Set();
  }

  clear() {
    for (const store of [this.routes, this.paths, this.lines, this.labels, this.labelRects]) store.clear();
  }

  /** The route of an edge: `{curve, chip, at}`, worked out when first asked for. */
  route(edge) {
    if (!this.routes.has(edge.key)) this.#placeLabels();
    if (!this.routes.has(edge.key)) this.#label(edge);
    return this.routes.get(edge.key);
  }

  /** Straight curves, as `[key, curve]`, for edges that hands pull along with many others; they want a second look then. */
  roughCurves(edges) {
    const pairs = new Set(edges.map((edge) => this.scene.isDrawable(edge) && pairKey(edge)));
    pairs.delete(false);
    for (const edge of edges) {
      this.invalidate(edge);
      this.provisional.add(edge.key);
    }
    return [...pairs].flatMap((pair) => {
      const { edges: lanes, curves } = this.#curves(pair, straightCurves);
      return lanes.map(({ key }, index) => [key, curves[index]]);
    });
  }

  /** The curve alone, which needs no neighbours. */
  edgePath(edge) {
    if (!this.paths.has(edge.key)) this.#routePair(pairKey(edge));
    return this.paths.get(edge.key);
  }

  /** What all curves and labels cover, or null; in a large scene they stray little from the boxes. */
  extent() {
    if (this.scene.edges.size > MAX_PLANNED) return null;
    const edges = [...this.scene.edges.values()].filter((edge) => this.scene.isDrawable(edge));
    for (const edge of edges) this.route(edge);
    const points = edges.flatMap(({ key }) => this.paths.get(key).points);
    return bounds([...points.map(({ x, y }) => ({ x, y, w: 0, h: 0 })), ...this.labelRects.values()]);
  }

  invalidate(edge) {
    for (const key of this.scene.pairs.get(pairKey(edge)) ?? []) this.drop(key);
    this.drop(edge.key);
  }

  /** Forgets one edge only, also one that is gone from the scene: its label must not keep others from their places. */
  drop(key) {
    for (const store of [this.routes, this.paths, this.labelRects]) store.delete(key);
    this.labels.remove(key);
    this.lines.remove(key);
  }

  invalidateAround(nodeKey) {
    for (const edge of this.scene.edgesOf(nodeKey)) this.invalidate(edge);
  }

  /** The routed edges that come near a rectangle: they may want another way when a box arrives there or leaves. */
  edgesNear(rect) {
    const found = [];
    for (const key of this.scene.edgeGrid.query(grow(rect, 160))) {
      const way = this.paths.get(key);
      if (way && overlaps(this.#sweep(this.scene.edges.get(key), way.curve), rect)) found.push(this.scene.edges.get(key));
    }
    return found;
  }

  /** What an edge covers and, as it may have bowed around a box, what it would like to cover. */
  #sweep(edge, curve) {
    const ends = [edge.source, edge.target].map((key) => this.scene.nodes.get(key)).filter(Boolean);
    return bounds([curveBounds(curve), ...ends.map(({ x, y }) => ({ x, y, w: 0, h: 0 }))]);
  }

  #routePair(pair) {
    const { edges, chips, curves } = this.#curves(pair, parallelCurves);
    edges.forEach(({ key }, index) => {
      const length = curveLength(curves[index]);
      const way = { curve: curves[index], chip: chips[index], length, points: sampleCurve(curves[index], length) };
      this.paths.set(key, way);
      this.lines.putPath(key, way.points);
    });
  }

  #curves(pair, spread) {
    const edges = this.#lanes(pair);
    const [{ source, target }] = edges;
    const [from, to] = [this.scene.nodes.get(source), this.scene.nodes.get(target)];
    const chips = edges.map((edge) => makeEdgeLabel(edge, from, to, edges.length));
    return { edges, chips, curves: (source === target ? selfLoopCurves : spread)(edges, chips, this.scene) };
  }

  /** The shown edges of a pair as they are read: those to the right or downwards first, each way by its order in the design. */
  #lanes(pair) {
    const edges = [...this.scene.pairs.get(pair)].map((key) => this.scene.edges.get(key));
    const shown = edges.filter((edge) => this.scene.isDrawable(edge));
    const [node, other] = [shown[0].source, shown[0].target].map((key) => this.scene.nodes.get(key));
    const [first] = readingOrder(node, other);
    const rank = (edge) => (edge.source === first.key ? 0 : 1);
    return shown.sort((a, b) => rank(a) - rank(b) || (a.data.order ?? 0) - (b.data.order ?? 0) || (a.key < b.key ? -1 : 1));
  }

  /** Places all labels that have none, those with the least choice first: so places do not hang on what was asked first. */
  #placeLabels() {
    if (this.scene.edges.size > MAX_PLANNED) return;
    const edges = [...this.scene.edges.values()].filter((edge) => !this.routes.has(edge.key) && this.scene.isDrawable(edge));
    const lengths = new Map(edges.map((edge) => [edge, this.edgePath(edge).length]));
    edges.sort((a, b) => lengths.get(a) - lengths.get(b) || (a.key < b.key ? -1 : 1));
    for (const edge of edges) this.#label(edge);
    this.#makeRoom(edges);
  }

  /** Where labels had no choice but to lie on others, these look again, now that they know of them. */
  #makeRoom(edges) {
    const fresh = new Set(edges.map(({ key }) => key));
    const meet = (key, other) => key !== other && fresh.has(other) && overlaps(this.labelRects.get(key), this.labelRects.get(other));
    const isCovered = (key) => this.labelRects.has(key) && [...this.labels.query(this.labelRects.get(key))].some((other) => meet(key, other));
    for (const edge of edges.filter(({ key }) => isCovered(key))) {
      this.labels.remove(edge.key);
      this.#label(edge);
    }
  }

  #label(edge) {
    const { curve, chip: wanted } = this.edgePath(edge);
    if (!wanted) {
      this.routes.set(edge.key, { curve, chip: null, at: pointOnCurve(curve, 0.5) });
      return;
    }
    const { chip, at } = edge.data.label_at ? { chip: wanted, at: labelPosition(curve, edge.data.label_at) } : this.#freeLabel(edge, curve, wanted);
    this.routes.set(edge.key, { curve, chip, at });
    const rect = rectAround(at.x, at.y, chip.w, chip.h);
    this.labels.putRect(edge.key, rect);
    this.labelRects.set(edge.key, rect);
  }

  /** The best place for a label; where it would hide something else in any place, a shorter one may not. */
  #freeLabel(edge, curve, wanted) {
    let best = { cost: Infinity };
    for (const chip of [wanted, ...shorterLabels(edge, wanted)]) {
      const place = placeLabel(edge, curve, chip, (rect, limit) => this.#overlapCost(rect, edge.key, limit));
      if (this.isProvisional) this.provisional.add(edge.key);
      if (place.cost < best.cost) best = { ...place, chip };
      if (best.cost < COST.label) break;
    }
    return best;
  }

  /** What lies under a rectangle, or would be under a label there; as soon as it is too much, no more is looked for. */
  #overlapCost(rect, own, limit) {
    let sum = 0;
    for (const key of this.scene.nodeGrid.query(rect)) {
      const node = this.scene.nodes.get(key);
      if (node && overlaps(grow(nodeRect(node), 2), rect)) sum += COST.box;
    }
    for (const key of this.labels.query(rect)) {
      if (key !== own && overlaps(grow(this.labelRects.get(key), 2), rect)) sum += COST.label;
    }
    if (this.isProvisional || sum >= limit) return sum;
    for (const key of this.lines.query(rect)) {
      if (sum >= limit) return sum;
      if (key !== own && polylineTouches(this.paths.get(key).points, rect)) sum += key.startsWith(LINKS) ? COST.link : COST.line;
    }
    return sum;
  }
}
