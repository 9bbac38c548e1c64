// Keeps in the DOM what is near enough to be seen, and nothing else; knows the marks on every thing.
import { DragLayer } from "./drag_layer.js";
import { drawEdge, placeEdge, placeLine } from "./edge_svg.js";
import { bounds, containsRect, grow, overlaps, nodeRect } from "./geometry.js";
import { drawNode, placeNode } from "./node_svg.js";
import { bakeTransform } from "./group_transforms.js";
import { showBreakpoint } from "./breakpoint_sign.js";
import { bringToFront, svg } from "./svg.js";

// Marked things stay mounted also where the overview bitmap stands for the rest, up to this many of each mark.
export const MAX_PINNED = 150;
const PINNED = { selected: MAX_PINNED, active: MAX_PINNED, taken: 1, drop: 1, lit: 200, held: 1500 };

// So many edges look for a good way, and a place for their label, whenever a hand moves; with more it would stutter.
const MAX_FULL_ROUTING = 40;
const MAX_MOUNTED = 2500;
// So far arrows may bow, and boxes be dragged, beyond what was there before.
const GROUND = 1000;

// Back to front. What a hand moves lies on sheets of its own, so that a browser need not paint all the rest with every movement.
const LAYER_STACK = [
  ["links", "edges"],
  ["held links", "held edges"],
  ["nodes", "chips"],
  ["held nodes", "held chips", "above"],
];
const ARIA_LABELS = { links: "Links to components", edges: "Transitions", nodes: "States and components" };
const TWINS = ["links", "edges", "nodes", "chips"].map((name) => [name, `held ${name}`]);

const MARK_DESCRIPTIONS = { selected: "selected", active: "active now", taken: "just taken", breakpoint: "breakpoint" };

export class Painter {
  constructor(scene, router) {
    this.scene = scene;
    this.router = router;
    this.items = new Map();
    this.marks = new Map(["selected", "active", "taken", "breakpoint", "drop", "held", "lit", "hover"].map((name) => [name, new Set()]));
    this.layers = Object.fromEntries(LAYER_STACK.flat().map((name) => [name, layer(name)]));
    this.hitAreas = LAYER_STACK.map(() => svg("rect", { class: "ground" }));
    this.svgRoots = LAYER_STACK.map((names, index) => svg("svg", { role: "presentation" }, [this.hitAreas[index], ...names.map((name) => this.layers[name])]));
    this.svgRoots[0].prepend(hatching());
    this.heldLayers = new Map(TWINS.flatMap((pair) => [pair, pair.toReversed()]).map((pair) => pair.map((name) => this.layers[name])));
    this.dragLayer = new DragLayer(TWINS.map(([, held]) => this.layers[held]));
    this.mountedRect = null;
    this.hitArea = null;
    this.far = false;
    // They grow with everything that changes the picture, and with what only changes colours in it.
    this.revision = 0;
    this.styleRevision = 0;
  }

  clear() {
    for (const key of [...this.items.keys()]) this.#unmount(key);
    for (const keys of this.marks.values()) keys.clear();
    this.mountedRect = null;
  }

  /** Whether the mounted part still holds everything that is seen. */
  covers(seen) {
    return this.far || (this.mountedRect !== null && containsRect(this.mountedRect, seen));
  }

  /** Mounts what a rectangle (with a margin) shows; from far only what is marked. While the view moves nothing is taken away. */
  cull(seen, { far, zoom, moving = false }) {
    this.far = far;
    // The smaller things are, the more of them the margin would hold.
    this.mountedRect = grow(seen, (Math.max(seen.w, seen.h) / 3) * Math.min(1, zoom * zoom));
    this.#extendHitAreas(bounds([this.mountedRect, this.scene.extent() ?? this.mountedRect]));
    const wanted = far ? new Set() : this.#near(this.mountedRect);
    for (const key of this.#pinned()) wanted.add(key);
    if (far || !moving || this.items.size > MAX_MOUNTED) {
      for (const key of [...this.items.keys()]) if (!wanted.has(key)) this.#unmount(key);
    }
    for (const key of wanted) if (!this.items.has(key)) this.#mount(key);
  }

  /** Gives a mark to exactly these keys. */
  mark(name, keys) {
    const old = this.marks.get(name);
    const now = new Set(keys);
    this.marks.set(name, now);
    for (const key of old) if (!now.has(key)) this.#toggle(key, name, false);
    for (const key of now) if (!old.has(key)) this.#toggle(key, name, true);
  }

  /** Lets everything that is not lit step back. This paints all anew, so it is not for moments when the hand moves. */
  dim() {
    this.styleRevision += 1;
    const isDim = this.marks.get("lit").size > 0;
    for (const [name, layer] of Object.entries(this.layers)) layer.classList.toggle("dim", isDim && name !== "above");
  }

  /** Redraws what changed; `affectedNodes` have edges that may want another way, in `changedRects` boxes came or left. */
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
    this.#placeEdges(affectedNodes);
    this.rerouteNear(changedRects);
  }

  /** Follows nodes that are being moved, with the edges at them. */
  updateNodes(nodeKeys) {
    this.#placeNodes(nodeKeys);
    this.router.isProvisional = true;
    const edges = this.#edgesOutsideDrag(nodeKeys);
    for (const edge of edges) this.router.invalidate(edge);
    for (const edge of edges) this.#placeEdge(edge);
    this.router.isProvisional = false;
  }

  /** Makes one of held nodes and the edges between them, which `updateDrag` moves. */
  beginDrag(nodeKeys) {
    const nodes = new Set(nodeKeys);
    const inner = this.#edgesAt(nodes).filter((edge) => nodes.has(edge.source) && nodes.has(edge.target));
    const keys = [...nodes, ...inner.map((edge) => edge.key)];
    this.dragLayer.attach(new Map(keys.filter((key) => this.items.has(key)).map((key) => [key, this.items.get(key)])));
  }

  /** Follows nodes that moved `by` since they were lifted. Edges to others are led anew, many of them without labels. */
  updateDrag(nodeKeys, by) {
    this.dragLayer.move(by);
    const edges = this.#edgesOutsideDrag(nodeKeys);
    const isRough = edges.length > MAX_FULL_ROUTING;
    this.layers["held chips"].classList.toggle("rough", isRough);
    if (!isRough) return this.updateNodes(nodeKeys);
    this.#placeNodes(nodeKeys);
    for (const [key, curve] of this.router.roughCurves(edges)) if (this.items.has(key)) placeLine(this.items.get(key), curve);
  }

  /** Ends carrying: what was carried stands where the scene has it, and its edges are routed by `refineRoutes`. */
  endDrag(nodeKeys) {
    this.dragLayer.release();
    this.layers["held chips"].classList.remove("rough");
    this.#placeNodes(nodeKeys);
    for (const edge of this.#edgesAt(nodeKeys)) this.router.provisional.add(edge.key);
  }

  /** The hand let go: labels that were placed in haste look for the best places; boxes left or came to some rectangles. */
  refineRoutes(rects = []) {
    const edges = [...this.router.provisional].map((key) => this.scene.edges.get(key)).filter(Boolean);
    this.router.provisional.clear();
    this.#route(new Set([...edges, ...this.#passing(rects)]));
  }

  /** Puts everything where the scene has it now. */
  repositionAll() {
    for (const [key, item] of [...this.items]) {
      if (item.node) placeNode(item.node, this.scene.nodes.get(key));
      else this.#placeEdge(this.scene.edges.get(key));
    }
  }

  /** Boxes came to rest or left: edges that pass there are routed again. */
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

  focus(key) {
    const item = this.items.get(key);
    (item?.node ?? item?.line)?.focus({ preventScroll: true });
  }

  /**
   * Lays an invisible ground under each sheet. The browser notes for every element where it hears wheel and touch, and
   * joins all these rectangles whenever the bounds of a sheet change: 30 ms with 700 things. A ground holds them all.
   */
  #extendHitAreas(rect) {
    if (this.hitArea && containsRect(this.hitArea, rect)) return;
    this.hitArea = grow(rect, GROUND);
    const { x, y, w, h } = this.hitArea;
    for (const element of this.hitAreas) for (const [name, value] of Object.entries({ x, y, width: w, height: h })) element.setAttribute(name, value);
  }

  #near(rect) {
    const wanted = new Set();
    for (const key of this.scene.nodeGrid.query(rect)) if (overlaps(nodeRect(this.scene.nodes.get(key)), rect)) wanted.add(key);
    for (const key of this.scene.edgeGrid.query(rect)) wanted.add(key);
    return wanted;
  }

  #pinned() {
    const pinned = new Set();
    for (const [name, most] of Object.entries(PINNED)) {
      const keys = this.marks.get(name);
      if (keys.size <= most) for (const key of keys) pinned.add(key);
    }
    return pinned;
  }

  #mount(key) {
    this.revision += 1;
    const thing = this.scene.find(key);
    if (!thing) return;
    const item = this.scene.nodes.has(key) ? this.#mountNode(thing) : this.#mountEdge(thing);
    if (!item) return;
    this.items.set(key, item);
    for (const [name, keys] of this.marks) if (keys.has(key)) this.#toggle(key, name, true);
  }

  #mountNode(node) {
    const group = drawNode(node);
    this.layers.nodes.append(group);
    return { node: group };
  }

  #mountEdge(edge) {
    if (!this.scene.isDrawable(edge)) return null;
    const item = drawEdge(edge, this.router.route(edge), this.#endsOf(edge));
    this.layers[edge.of === "links" ? "links" : "edges"].append(item.line);
    if (item.chip) this.layers.chips.append(item.chip);
    return item;
  }

  #endsOf(edge) {
    const nameOf = (key) => (key === "common" ? "every state" : String(this.scene.nodes.get(key).data.name));
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
  }

  #placeEdges(nodeKeys) {
    for (const edge of this.#edgesOutsideDrag(nodeKeys)) this.#placeEdge(edge);
  }

  /** The edges at nodes that are not carried. */
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
    // There is more or less room for the text now.
    this.#unmount(edge.key);
    this.#mount(edge.key);
  }

  #toggle(key, name, on) {
    this.styleRevision += 1;
    if (name === "breakpoint") showBreakpoint(this.items.get(key), this.scene.find(key), on);
    for (const part of Object.values(this.items.get(key) ?? {})) {
      if (!part) continue;
      if (name === "held") this.#hold(part, on);
      else part.classList.toggle(name, on);
      if (name in MARK_DESCRIPTIONS && part.role === "button") describeMarks(part);
      if (on && name === "lit" && part.nextSibling) bringToFront(part, part.parentNode);
    }
  }

  #hold(part, on) {
    bringToFront(part, this.heldLayers.get(part.parentNode));
    if (!on) bakeTransform(part);
  }
}

const layer = (name) => svg("g", { class: name, id: ARIA_LABELS[name] && name, role: ARIA_LABELS[name] && "group", "aria-label": ARIA_LABELS[name] });

/** Marks are told beside the name, which stays what it is. */
function describeMarks(part) {
  const words = Object.keys(MARK_DESCRIPTIONS).filter((name) => part.classList.contains(name)).map((name) => MARK_DESCRIPTIONS[name]);
  if (words.length) part.setAttribute("aria-description", words.join(", "));
  else part.removeAttribute("aria-description");
}

/** The lines across a disabled box. */
function hatching() {
  const names = { id: "hatch", width: 8, height: 8, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" };
  const parts = [svg("rect", { class: "hatch-ground", width: 8, height: 8 }), svg("path", { class: "hatch-line", d: "M0 0V8" })];
  return svg("defs", {}, [svg("pattern", names, parts)]);
}
