// Mounts the elements near the visible area in the DOM and keeps the marks of all elements.
import { DragLayer } from "./drag_layer.js";
import { drawFrame, placeFrame } from "./frames.js";
import { drawEdge, placeEdge, placeLine } from "./edge_svg.js";
import { bounds, containsRect, grow, overlaps, nodeRect } from "./geometry.js";
import { drawNode, placeNode } from "./node_svg.js";
import { placeInitialMark } from "./initial_mark.js";
import { bakeTransform } from "./group_transforms.js";
import { showBreakpoint } from "./breakpoint_sign.js";
import { keyOf } from "./scene.js";
import { EVERY_STATE, HEAT, LAYERS, MARKS } from "./strings.js";
import { bringToFront, svg } from "./svg.js";

// Marked elements stay mounted even in the overview, up to this many of each mark.
export const MAX_PINNED = 150;
const PINNED = { selected: MAX_PINNED, active: MAX_PINNED, taken: 1, drop: 1, lit: 200, near: 200, held: 1500 };

// During a drag, up to this many edges are fully routed and labeled in each frame; more would drop frames.
const MAX_FULL_ROUTING = 40;
const MAX_MOUNTED = 2500;
// Margin for bent edges and dragged nodes beyond the scene.
const HIT_AREA_MARGIN = 1000;

// Back to front. Dragged elements have separate SVG roots, so that a movement does not repaint the rest.
const LAYER_STACK = [
  ["frames", "links", "edges"],
  ["held links", "held edges"],
  ["nodes", "chips"],
  ["held nodes", "held chips", "above"],
];
const TWINS = ["links", "edges", "nodes", "chips"].map((name) => [name, `held ${name}`]);

export class Painter {
  /** `isInset`: the layers have no ids, which those of the canvas have. */
  constructor(scene, router, { isInset = false } = {}) {
    this.scene = scene;
    this.router = router;
    this.items = new Map();
    const names = ["selected", "active", "taken", "breakpoint", "drop", "held", "near", "lit", "member", "hover", ...HEAT.map((color) => `heat-${color}`)];
    this.marks = new Map(names.map((name) => [name, new Set()]));
    this.layers = Object.fromEntries(LAYER_STACK.flat().map((name) => [name, layer(name, isInset)]));
    this.hitAreas = LAYER_STACK.map(() => svg("rect", { class: "ground" }));
    this.svgRoots = LAYER_STACK.map((names, index) => svg("svg", { role: "presentation" }, [this.hitAreas[index], ...names.map((name) => this.layers[name])]));
    this.svgRoots[0].prepend(hatching());
    this.heldLayers = new Map(TWINS.flatMap((pair) => [pair, pair.toReversed()]).map((pair) => pair.map((name) => this.layers[name])));
    this.dragLayer = new DragLayer(TWINS.map(([, held]) => this.layers[held]));
    this.mountedRect = null;
    this.hitArea = null;
    this.far = false;
    // Counters of changes to shapes, and of changes to styles only.
    this.revision = 0;
    this.styleRevision = 0;
  }

  clear() {
    for (const key of [...this.items.keys()]) this.#unmount(key);
    for (const keys of this.marks.values()) keys.clear();
    this.mountedRect = null;
  }

  /** Whether the mounted area still covers the visible one. */
  covers(seen) {
    return this.far || (this.mountedRect !== null && containsRect(this.mountedRect, seen));
  }

  /** Mounts what is visible, with a margin; in the overview only marked elements. While the view moves nothing is unmounted. */
  cull(seen, { far, zoom, moving = false }) {
    this.far = far;
    // The margin shrinks with the zoom, since it would contain more elements.
    this.mountedRect = grow(seen, (Math.max(seen.w, seen.h) / 3) * Math.min(1, zoom * zoom));
    this.#extendHitAreas(bounds([this.mountedRect, this.scene.extent() ?? this.mountedRect]));
    const wanted = far ? new Set() : this.#near(this.mountedRect);
    for (const key of this.#pinned()) wanted.add(key);
    if (far || !moving || this.items.size > MAX_MOUNTED) {
      for (const key of [...this.items.keys()]) if (!wanted.has(key)) this.#unmount(key);
    }
    for (const key of wanted) if (!this.items.has(key)) this.#mount(key);
    this.#placeInitialMarks();
  }

  /** Sets a mark on exactly these keys. */
  mark(name, keys) {
    const old = this.marks.get(name);
    const now = new Set(keys);
    this.marks.set(name, now);
    for (const key of old) if (!now.has(key)) this.#toggle(key, name, false);
    for (const key of now) if (!old.has(key)) this.#toggle(key, name, true);
  }

  /** Colors elements by the statistics of a trace; without items, as before. */
  showHeat(items = this.heat ?? []) {
    this.heat = items;
    for (const color of HEAT) this.mark(`heat-${color}`, items.filter((item) => item.color === color).map(({ of, id }) => keyOf(of, id)));
    for (const root of this.svgRoots) root.classList.toggle("heat", items.length > 0);
  }

  /** Redraws changed elements. Edges at `affectedNodes` and near `changedRects`, where nodes came or left, are rerouted. */
  refresh({ touched, gone, affectedNodes, changedRects = [] }) {
    for (const key of gone) {
      this.#unmount(key);
      this.router.drop(key);
    }
    for (const keys of this.marks.values()) for (const key of gone) keys.delete(key);
    for (const key of affectedNodes) this.router.invalidateAround(key);
    const focused = this.svgRoots[0].getRootNode().activeElement?.dataset?.key;
    for (const key of touched) {
      if (!this.items.has(key)) continue;
      this.#unmount(key);
      this.#mount(key);
    }
    if (focused && touched.includes(focused)) this.focus(focused);
    this.#placeFrames();
    this.#placeEdges(affectedNodes);
    this.rerouteNear(changedRects);
    this.#placeInitialMarks();
  }

  /** Redraws nodes that are being moved, with their edges. */
  updateNodes(nodeKeys) {
    this.#placeNodes(nodeKeys);
    this.router.isProvisional = true;
    const edges = this.#edgesOutsideDrag(nodeKeys);
    for (const edge of edges) this.router.invalidate(edge);
    for (const edge of edges) this.#placeEdge(edge);
    this.router.isProvisional = false;
  }

  /** Moves dragged nodes and the edges between them into the drag layer; `updateDrag` moves it. */
  beginDrag(nodeKeys) {
    const nodes = new Set(nodeKeys);
    const inner = this.#edgesAt(nodes).filter((edge) => nodes.has(edge.source) && nodes.has(edge.target));
    const keys = [...nodes, ...inner.map((edge) => edge.key)];
    this.dragLayer.attach(new Map(keys.filter((key) => this.items.has(key)).map((key) => [key, this.items.get(key)])));
  }

  /** Moves the dragged nodes to an offset from their start. Edges to other nodes are rerouted, many of them without labels. */
  updateDrag(nodeKeys, offset) {
    this.dragLayer.move(offset);
    const edges = this.#edgesOutsideDrag(nodeKeys);
    const isRough = edges.length > MAX_FULL_ROUTING;
    this.layers["held chips"].classList.toggle("rough", isRough);
    if (!isRough) return this.updateNodes(nodeKeys);
    this.#placeNodes(nodeKeys);
    for (const [key, curve] of this.router.roughCurves(edges)) if (this.items.has(key)) placeLine(this.items.get(key), curve);
  }

  /** Ends a drag: nodes are drawn at their positions in the scene; `refineRoutes` routes their edges. */
  endDrag(nodeKeys) {
    this.dragLayer.release();
    this.layers["held chips"].classList.remove("rough");
    this.#placeNodes(nodeKeys);
    for (const edge of this.#edgesAt(nodeKeys)) this.router.provisional.add(edge.key);
  }

  /** Reroutes edges that were routed provisionally during a drag, and edges near `rects`, where nodes came or left. */
  refineRoutes(rects = []) {
    const edges = [...this.router.provisional].map((key) => this.scene.edges.get(key)).filter(Boolean);
    this.router.provisional.clear();
    this.#route(new Set([...edges, ...this.#passing(rects)]));
    this.#placeInitialMarks();
  }

  /** Draws everything at its position in the scene. */
  repositionAll() {
    for (const [key, item] of [...this.items]) {
      if (item.node) placeNode(item.node, this.scene.nodes.get(key));
      else if (item.line) this.#placeEdge(this.scene.edges.get(key));
    }
    this.#placeFrames();
    this.#placeInitialMarks();
  }

  /** Reroutes edges near rectangles where nodes came or left. */
  rerouteNear(rects) {
    this.#route(this.#passing(rects));
  }

  #passing(rects) {
    return new Set(rects.flatMap((rect) => this.router.edgesNear(rect)));
  }

  #route(edges) {
    for (const edge of edges) this.router.invalidate(edge);
    for (const edge of edges) this.#placeEdge(edge);
  }

  /** Dims everything but these elements; nothing if there are none. The layers of the rest are dimmed as a whole. */
  dimAround(keys) {
    this.mark("near", keys);
    this.svgRoots[0].parentNode.classList.toggle("dimming", keys.size > 0);
  }

  focus(key) {
    const item = this.items.get(key);
    (item?.node ?? item?.line ?? item?.frame)?.focus({ preventScroll: true });
  }

  /**
   * Puts an invisible rectangle under each SVG root. The browser keeps a wheel and touch region of every element, and
   * merges all of them whenever the bounds of the root change: 30 ms with 700 elements. The rectangle contains them all.
   */
  #extendHitAreas(rect) {
    if (this.hitArea && containsRect(this.hitArea, rect)) return;
    this.hitArea = grow(rect, HIT_AREA_MARGIN);
    const { x, y, w, h } = this.hitArea;
    for (const element of this.hitAreas) for (const [name, value] of Object.entries({ x, y, width: w, height: h })) element.setAttribute(name, value);
  }

  #near(rect) {
    const wanted = new Set();
    for (const key of this.scene.nodeGrid.query(rect)) if (overlaps(nodeRect(this.scene.nodes.get(key)), rect)) wanted.add(key);
    for (const key of this.scene.edgeGrid.query(rect)) wanted.add(key);
    for (const { key } of this.scene.shownFrames()) wanted.add(key);
    return wanted;
  }

  #pinned() {
    const pinned = new Set();
    for (const [name, max] of Object.entries(PINNED)) {
      const keys = this.marks.get(name);
      if (keys.size <= max) for (const key of keys) if (!this.scene.hidden.has(key)) pinned.add(key);
    }
    return pinned;
  }

  #mount(key) {
    this.revision += 1;
    const element = this.scene.find(key);
    if (!element) return;
    const item = this.scene.nodes.has(key) ? this.#mountNode(element) : this.scene.frames.has(key) ? this.#mountFrame(element) : this.#mountEdge(element);
    if (!item) return;
    this.items.set(key, item);
    for (const [name, keys] of this.marks) if (keys.has(key)) this.#toggle(key, name, true);
  }

  #mountNode(node) {
    const group = drawNode(node);
    this.layers.nodes.append(group);
    return { node: group };
  }

  /** Frames are few; all are sorted again, so that inner ones stay in front. */
  #mountFrame(frame) {
    const area = this.scene.boxOf(frame.key);
    if (!area) return null;
    const group = drawFrame(frame, area);
    const others = this.scene.framesInOrder().map(({ key }) => (key === frame.key ? group : this.items.get(key)?.frame));
    this.layers.frames.append(...others.filter(Boolean));
    return { frame: group };
  }

  /** Draws the frames around the current positions of their states. */
  #placeFrames() {
    for (const frame of this.scene.frames.values()) {
      const group = this.items.get(frame.key)?.frame;
      const area = group && this.scene.boxOf(frame.key);
      if (area) placeFrame(group, frame, area);
    }
  }

  #mountEdge(edge) {
    if (!this.scene.isDrawable(edge)) return null;
    const item = drawEdge(edge, this.router.route(edge), this.#endsOf(edge));
    this.layers[edge.of === "links" ? "links" : "edges"].append(item.line);
    if (item.chip) this.layers.chips.append(item.chip);
    return item;
  }

  #endsOf(edge) {
    const nameOf = (key) => (key === "common" ? EVERY_STATE : String(this.scene.nodes.get(key).data.name));
    return { source: nameOf(edge.source), target: nameOf(edge.target) };
  }

  #unmount(key) {
    this.revision += 1;
    const item = this.items.get(key);
    if (!item) return;
    for (const part of Object.values(item)) part?.remove();
    this.items.delete(key);
    if (this.dragLayer.detach(key) && item.line) this.router.drop(key);
  }

  #placeNodes(nodeKeys) {
    this.revision += 1;
    for (const key of nodeKeys) {
      const item = this.items.get(key);
      if (item && !this.dragLayer.has(key)) placeNode(item.node, this.scene.nodes.get(key));
    }
    this.#placeFrames();
  }

  #placeEdges(nodeKeys) {
    for (const edge of this.#edgesOutsideDrag(nodeKeys)) this.#placeEdge(edge);
  }

  #placeInitialMarks() {
    const { scene, router, items } = this;
    for (const key of scene.initialNodes) if (items.has(key)) placeInitialMark(items.get(key).node, scene.nodes.get(key), scene, router);
  }

  /** The edges at nodes that are not in the drag layer. */
  #edgesOutsideDrag(nodeKeys) {
    return this.#edgesAt(nodeKeys).filter((edge) => !this.dragLayer.has(edge.key));
  }

  #edgesAt(nodeKeys) {
    return [...new Set([...nodeKeys].flatMap((key) => this.scene.edgesOf(key)))];
  }

  #placeEdge(edge) {
    this.revision += 1;
    const item = this.items.get(edge.key);
    if (!item) return;
    if (!this.scene.isDrawable(edge)) return this.#unmount(edge.key);
    const route = this.router.route(edge);
    if (route.chip?.text === item.line.dataset.text || !route.chip) return placeEdge(item, route);
    // The label needs another text, since the available width changed.
    this.#unmount(edge.key);
    this.#mount(edge.key);
  }

  #toggle(key, name, on) {
    this.styleRevision += 1;
    if (name === "breakpoint") showBreakpoint(this.items.get(key), this.scene.find(key), on);
    for (const part of Object.values(this.items.get(key) ?? {})) {
      if (!part) continue;
      if (name === "held" || name === "near") this.#raise(part, key);
      else part.classList.toggle(name, on);
      if (name in MARKS && part.role === "button") describeMarks(part);
      if (on && name === "lit" && part.nextSibling) bringToFront(part, part.parentNode);
    }
  }

  /** Puts an element above the rest, or back: while it is dragged, or while everything else is dimmed. */
  #raise(part, key) {
    const isRaised = ["held", "near"].some((name) => this.marks.get(name).has(key));
    if (part.parentNode.classList.contains("held") !== isRaised) bringToFront(part, this.heldLayers.get(part.parentNode));
    if (!isRaised) bakeTransform(part);
  }
}

const layer = (name, isInset) => svg("g", { class: name, id: !isInset && LAYERS[name] && name, role: LAYERS[name] && "group", "aria-label": LAYERS[name] });

/** Describes the marks in addition to the name, which does not change. */
function describeMarks(part) {
  const words = Object.keys(MARKS).filter((name) => part.classList.contains(name)).map((name) => MARKS[name]);
  if (words.length) part.setAttribute("aria-description", words.join(", "));
  else part.removeAttribute("aria-description");
}

/** The hatching of disabled nodes. */
function hatching() {
  const names = { id: "hatch", width: 8, height: 8, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" };
  const parts = [svg("rect", { class: "hatch-ground", width: 8, height: 8 }), svg("path", { class: "hatch-line", d: "M0 0V8" })];
  return svg("defs", {}, [svg("pattern", names, parts)]);
}
