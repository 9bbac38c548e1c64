// Keeps in the DOM what is near enough to be seen, and nothing else; knows the marks on every thing.
import { drawEdge, placeEdge } from "./edge_art.js";
import { covers, grow, overlaps, rectOf } from "./geometry.js";
import { drawNode, placeNode } from "./node_art.js";
import { showStop } from "./stop_sign.js";
import { svg } from "./svg.js";

// Marked things stay mounted also where the overview bitmap stands for the rest, up to this many of each mark.
export const MOST_PINNED = 150;
const PINNED = { selected: MOST_PINNED, active: MOST_PINNED, taken: 1, drop: 1, lit: 200, held: 1500 };

const MOST_MOUNTED = 2500;

const TOLD = { selected: "selected", active: "active now", taken: "just taken", stop: "breakpoint" };

export class Painter {
  constructor(scene, router) {
    this.scene = scene;
    this.router = router;
    this.items = new Map();
    this.marks = new Map(["selected", "active", "taken", "stop", "drop", "held", "lit", "hover"].map((name) => [name, new Set()]));
    const heard = (name) => svg("g", { role: "group", "aria-label": name });
    this.layers = { links: heard("Links to components"), edges: heard("Transitions"), nodes: heard("States and components"), chips: svg("g"), above: svg("g") };
    this.svg = svg("svg", { role: "presentation" }, [hatching(), ...Object.values(this.layers)]);
    this.covered = null;
    this.far = false;
    // They grow with everything that changes the picture, and with what only changes colours in it.
    this.revision = 0;
    this.looks = 0;
  }

  clear() {
    for (const key of [...this.items.keys()]) this.#unmount(key);
    for (const keys of this.marks.values()) keys.clear();
    this.covered = null;
  }

  /** Whether the mounted part still holds everything that is seen. */
  covers(seen) {
    return this.far || (this.covered !== null && covers(this.covered, seen));
  }

  /** Mounts what a rectangle (with a margin) shows; from far only what is marked. While the view moves nothing is taken away. */
  cull(seen, { far, zoom, moving = false }) {
    this.far = far;
    // The smaller things are, the more of them the margin would hold.
    this.covered = grow(seen, (Math.max(seen.w, seen.h) / 3) * Math.min(1, zoom * zoom));
    const wanted = far ? new Set() : this.#near(this.covered);
    for (const key of this.#pinned()) wanted.add(key);
    if (far || !moving || this.items.size > MOST_MOUNTED) {
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
    this.looks += 1;
    const isDim = this.marks.get("lit").size > 0;
    for (const name of ["links", "edges", "nodes", "chips"]) this.layers[name].classList.toggle("dim", isDim);
  }

  /** Redraws what changed; `near` are the nodes whose edges may want another way, `ground` is where boxes came or left. */
  refresh({ touched, gone, near, ground = [] }) {
    for (const key of gone) {
      this.#unmount(key);
      this.router.drop(key);
    }
    for (const keys of this.marks.values()) for (const key of gone) keys.delete(key);
    for (const key of near) this.router.forgetAround(key);
    const focused = this.svg.getRootNode().activeElement?.dataset?.key;
    for (const key of touched) {
      if (!this.items.has(key)) continue;
      this.#unmount(key);
      this.#mount(key);
    }
    if (focused && touched.includes(focused)) this.focus(focused);
    this.#placeEdges(near);
    this.settle(ground);
  }

  /** Follows nodes that are being moved, with the edges at them. */
  follow(nodeKeys) {
    this.revision += 1;
    this.router.isHasty = true;
    for (const key of nodeKeys) {
      const item = this.items.get(key);
      if (item) placeNode(item.node, this.scene.nodes.get(key));
      this.router.forgetAround(key);
    }
    this.#placeEdges(nodeKeys);
    this.router.isHasty = false;
  }

  /** The hand let go: labels that were placed in haste look for the best places. */
  tidy() {
    const edges = [...this.router.hasty].map((key) => this.scene.edges.get(key)).filter(Boolean);
    this.router.hasty.clear();
    for (const edge of edges) this.router.forget(edge);
    for (const edge of edges) this.#placeEdge(edge);
  }

  /** Puts everything where the scene has it now. */
  placeAnew() {
    for (const [key, item] of [...this.items]) {
      if (item.node) placeNode(item.node, this.scene.nodes.get(key));
      else this.#placeEdge(this.scene.edges.get(key));
    }
  }

  /** Boxes came to rest or left: edges that pass there are routed again. */
  settle(rects) {
    const passing = new Set(rects.flatMap((rect) => this.router.passing(rect)));
    for (const edge of passing) this.router.forget(edge);
    for (const edge of passing) this.#placeEdge(edge);
  }

  focus(key) {
    const item = this.items.get(key);
    (item?.node ?? item?.line)?.focus({ preventScroll: true });
  }

  #near(rect) {
    const wanted = new Set();
    for (const key of this.scene.nodeGrid.query(rect)) if (overlaps(rectOf(this.scene.nodes.get(key)), rect)) wanted.add(key);
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
  }

  #placeEdges(nodeKeys) {
    const edges = new Set();
    for (const key of nodeKeys) for (const edge of this.scene.edgesOf(key)) edges.add(edge);
    for (const edge of edges) this.#placeEdge(edge);
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
    this.looks += 1;
    if (name === "stop") showStop(this.items.get(key), this.scene.find(key), on);
    for (const part of Object.values(this.items.get(key) ?? {})) {
      if (!part) continue;
      part.classList.toggle(name, on);
      if (name in TOLD && part.role === "button") describeMarks(part);
      if (on && name === "lit" && part.nextSibling) bringForward(part);
    }
  }
}

/** Marks are told beside the name, which stays what it is. */
function describeMarks(part) {
  const words = Object.keys(TOLD).filter((name) => part.classList.contains(name)).map((name) => TOLD[name]);
  if (words.length) part.setAttribute("aria-description", words.join(", "));
  else part.removeAttribute("aria-description");
}

/** The lines across a disabled box. */
function hatching() {
  const names = { id: "hatch", width: 8, height: 8, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" };
  const parts = [svg("rect", { class: "hatch-ground", width: 8, height: 8 }), svg("path", { class: "hatch-line", d: "M0 0V8" })];
  return svg("defs", {}, [svg("pattern", names, parts)]);
}

/** Moving an element takes the focus away from it; it is given back. */
function bringForward(part) {
  const focused = part.getRootNode().activeElement === part;
  part.parentNode.append(part);
  if (focused) part.focus({ preventScroll: true });
}
