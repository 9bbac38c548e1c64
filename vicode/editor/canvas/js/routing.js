// The curve of each edge and the position of its label. Curves depend on nodes only; labels also on the curves near them.
import { Grid } from "./grid.js";
import { bounds, polylineTouches, curveBounds, grow, curveLength, overlaps, pointOnCurve, sampleCurve, rectAround, nodeRect } from "./geometry.js";
import { makeEdgeLabel, labelPosition, placeLabel, shorterLabels } from "./edge_labels.js";
import { titleRect } from "./frames.js";
import { LINKS, pairKey } from "./scene.js";
import { parallelCurves, selfLoopCurves, readingOrder, straightCurves } from "./edge_curves.js";

// Cost of what a label would hide. Moving the label farther along its curve costs less than hiding another curve.
const COST = { box: 12, label: 8, line: 1.4, link: 0.7 };
// With more edges, a label only avoids curves and labels that are already routed: those in the visible area.
const MAX_PLANNED = 600;

export class Router {
  constructor(scene) {
    this.scene = scene;
    this.routes = new Map();
    this.paths = new Map();
    this.lines = new Grid();
    this.labels = new Grid();
    this.labelRects = new Map();
    this.titles = [];
    // During a drag, labels avoid nodes and labels only; the edges in `provisional` are routed again after it.
    this.isProvisional = false;
    this.provisional = new Set();
  }

  clear() {
    for (const store of [this.routes, this.paths, this.lines, this.labels, this.labelRects]) store.clear();
  }

  /** Returns the route of an edge, `{curve, chip, at}`; computed on demand and cached. */
  route(edge) {
    if (!this.routes.has(edge.key)) this.#placeLabels();
    if (!this.routes.has(edge.key)) this.#label(edge);
    return this.routes.get(edge.key);
  }

  /** Returns straight curves, as `[key, curve]`, for the many edges of a large drag; they are routed again after it. */
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

  /** Returns the curve of an edge, which does not depend on other edges' labels. */
  edgePath(edge) {
    if (!this.paths.has(edge.key)) this.#routePair(pairKey(edge));
    return this.paths.get(edge.key);
  }

  /** Returns the bounds of all curves and labels; null in a large scene, where they exceed the nodes only slightly. */
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

  /** Drops the route of one edge, also of one that was removed from the scene: its label must not block others. */
  drop(key) {
    for (const store of [this.routes, this.paths, this.labelRects]) store.delete(key);
    this.labels.remove(key);
    this.lines.remove(key);
  }

  invalidateAround(nodeKey) {
    for (const edge of this.scene.edgesOf(nodeKey)) this.invalidate(edge);
  }

  /** Returns the routed edges near a rectangle, whose routes may change when a node comes or leaves there. */
  edgesNear(rect) {
    const found = [];
    for (const key of this.scene.edgeGrid.query(grow(rect, 160))) {
      const path = this.paths.get(key);
      if (path && overlaps(this.#sweep(this.scene.edges.get(key), path.curve), rect)) found.push(this.scene.edges.get(key));
    }
    return found;
  }

  /** Bounds of an edge's curve and of the straight line between its nodes, which it would follow without obstacles. */
  #sweep(edge, curve) {
    const ends = [edge.source, edge.target].map((key) => this.scene.nodes.get(key)).filter(Boolean);
    return bounds([curveBounds(curve), ...ends.map(({ x, y }) => ({ x, y, w: 0, h: 0 }))]);
  }

  #routePair(pair) {
    const { edges, chips, curves } = this.#curves(pair, parallelCurves);
    edges.forEach(({ key }, index) => {
      const length = curveLength(curves[index]);
      const path = { curve: curves[index], chip: chips[index], length, points: sampleCurve(curves[index], length) };
      this.paths.set(key, path);
      this.lines.putPath(key, path.points);
    });
  }

  #curves(pair, spread) {
    const edges = this.#lanes(pair);
    const [{ source, target }] = edges;
    const [from, to] = [this.scene.nodes.get(source), this.scene.nodes.get(target)];
    const chips = edges.map((edge) => makeEdgeLabel(edge, from, to, edges.length));
    return { edges, chips, curves: (source === target ? selfLoopCurves : spread)(edges, chips, this.scene) };
  }

  /** Visible edges of a pair in reading order: those to the right or down first, then by their order in the design. */
  #lanes(pair) {
    const edges = [...this.scene.pairs.get(pair)].map((key) => this.scene.edges.get(key));
    const shown = edges.filter((edge) => this.scene.isDrawable(edge));
    const [node, other] = [shown[0].source, shown[0].target].map((key) => this.scene.nodes.get(key));
    const [first] = readingOrder(node, other);
    const rank = (edge) => (edge.source === first.key ? 0 : 1);
    return shown.sort((a, b) => rank(a) - rank(b) || (a.data.order ?? 0) - (b.data.order ?? 0) || (a.key < b.key ? -1 : 1));
  }

  /** Places all missing labels, shortest edges first, so that positions do not depend on the order of requests. */
  #placeLabels() {
    this.titles = [...this.scene.frames.values()].filter(({ key }) => this.scene.boxOf(key)).map((frame) => titleRect(frame, this.scene.boxOf(frame.key)));
    if (this.scene.edges.size > MAX_PLANNED) return;
    const edges = [...this.scene.edges.values()].filter((edge) => !this.routes.has(edge.key) && this.scene.isDrawable(edge));
    const lengths = new Map(edges.map((edge) => [edge, this.edgePath(edge).length]));
    edges.sort((a, b) => lengths.get(a) - lengths.get(b) || (a.key < b.key ? -1 : 1));
    for (const edge of edges) this.#label(edge);
    this.#makeRoom(edges);
  }

  /** Places overlapping labels once more, now that the positions of the others are known. */
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

  /** Returns the best position of a label; if it overlaps something everywhere, shorter variants are tried. */
  #freeLabel(edge, curve, wanted) {
    let best = { cost: Infinity };
    for (const chip of [wanted, ...shorterLabels(edge, wanted)]) {
      const candidate = placeLabel(edge, curve, chip, (rect, limit) => this.#overlapCost(rect, edge.key, limit));
      if (this.isProvisional) this.provisional.add(edge.key);
      if (candidate.cost < best.cost) best = { ...candidate, chip };
      if (best.cost < COST.label) break;
    }
    return best;
  }

  /** Cost of what a label in a rectangle would hide; stops as soon as the limit is reached. */
  #overlapCost(rect, own, limit) {
    let sum = 0;
    for (const key of this.scene.nodeGrid.query(rect)) {
      const node = this.scene.nodes.get(key);
      if (node && overlaps(grow(nodeRect(node), 2), rect)) sum += COST.box;
    }
    for (const key of this.labels.query(rect)) {
      if (key !== own && overlaps(grow(this.labelRects.get(key), 2), rect)) sum += COST.label;
    }
    for (const title of this.titles) if (overlaps(grow(title, 2), rect)) sum += COST.label;
    if (this.isProvisional || sum >= limit) return sum;
    for (const key of this.lines.query(rect)) {
      if (sum >= limit) return sum;
      if (key !== own && polylineTouches(this.paths.get(key).points, rect)) sum += key.startsWith(LINKS) ? COST.link : COST.line;
    }
    return sum;
  }
}
