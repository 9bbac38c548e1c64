// What a held pointer can do to the view and to boxes: pan, select by a frame, move. Each can be called off.
import { bounds, overlaps, pointOnCurve, rectBetween, nodeRect, snap } from "./geometry.js";
import { Guides } from "./guides.js";
import { svg } from "./svg.js";

// More boxes than this are moved as one outline; drawing each of them would stutter.
const MAX_LIVE_NODES = 120;

export class PanDrag {
  constructor(canvas) {
    this.canvas = canvas;
    this.last = null;
  }

  begin({ screen }) {
    this.last = screen;
    this.canvas.stage.classList.add("panning", "busy");
  }

  move({ screen }) {
    this.canvas.viewport.panBy(screen.x - this.last.x, screen.y - this.last.y);
    this.last = screen;
  }

  end() {
    this.canvas.stage.classList.remove("panning", "busy");
  }

  cancel() {
    this.end();
  }
}

export class MarqueeDrag {
  scrolls = true;

  constructor(canvas, added) {
    this.canvas = canvas;
    this.before = new Set(canvas.selection.keys);
    this.kept = added ? this.before : new Set();
  }

  begin({ world }) {
    this.from = world;
    this.rect = svg("rect", { class: "marquee" });
    this.canvas.painter.layers.above.append(this.rect);
  }

  move({ world }) {
    const area = rectBetween(this.from, world);
    for (const [name, value] of [["x", area.x], ["y", area.y], ["width", area.w], ["height", area.h]]) this.rect.setAttribute(name, value);
    this.area = area;
  }

  end() {
    this.rect.remove();
    if (this.area) this.canvas.selection.set([...this.kept, ...this.#inside(this.area)]);
  }

  cancel() {
    this.rect.remove();
  }

  /** Boxes that the frame touches, and edges whose middle lies in it when no box does. */
  #inside(area) {
    const { scene, router } = this.canvas;
    const nodes = [...scene.nodeGrid.query(area)].filter((key) => overlaps(nodeRect(scene.nodes.get(key)), area));
    const edges = [...scene.edgeGrid.query(area)].map((key) => scene.edges.get(key)).filter((edge) => {
      if (!scene.isDrawable(edge)) return false;
      if (nodes.length) return nodes.includes(edge.source) && nodes.includes(edge.target);
      const middle = pointOnCurve(router.route(edge).curve, 0.5);
      return overlaps({ ...middle, w: 0, h: 0 }, area);
    });
    return [...nodes, ...edges.map((edge) => edge.key)];
  }
}

export class MoveDrag {
  scrolls = true;

  constructor(canvas, lead) {
    this.canvas = canvas;
    this.lead = lead;
  }

  begin({ world }) {
    const { scene, selection } = this.canvas;
    this.from = world;
    this.places = new Map(selection.nodes().map((key) => [key, { x: scene.nodes.get(key).x, y: scene.nodes.get(key).y }]));
    this.rects = [...this.places.keys()].map((key) => nodeRect(scene.nodes.get(key)));
    this.frame = bounds(this.rects);
    this.by = { x: 0, y: 0 };
    if (this.places.size > MAX_LIVE_NODES) return this.#raiseGhost();
    this.#lift();
    this.guides = new Guides(this.canvas, this.places);
  }

  move({ world, free }) {
    const start = this.places.get(this.lead);
    if (!start) return;
    const by = { x: world.x - this.from.x, y: world.y - this.from.y };
    const pull = free || !this.guides ? {} : this.guides.snapOffsets(shifted(this.frame, by));
    this.by = { x: landing(start.x, by.x, pull.x, free), y: landing(start.y, by.y, pull.y, free) };
    if (free) this.guides?.hide();
    else this.guides?.show(shifted(this.frame, this.by));
    if (this.ghost) this.ghost.setAttribute("transform", `translate(${this.by.x} ${this.by.y})`);
    else this.#put();
  }

  end() {
    this.#release();
    if (this.by.x || this.by.y) this.canvas.reportMove([...this.places.keys()], this.rects);
  }

  cancel() {
    this.by = { x: 0, y: 0 };
    this.#release();
    this.canvas.painter.refineRoutes();
  }

  /** Python changed the scene meanwhile: what is still there keeps following the hand. */
  sceneChanged() {
    for (const key of [...this.places.keys()]) if (!this.canvas.scene.nodes.has(key)) this.places.delete(key);
    if (!this.ghost) this.#put();
  }

  #put() {
    this.#place();
    this.canvas.painter.updateDrag([...this.places.keys()], this.by);
  }

  #place() {
    for (const [key, { x, y }] of this.places) this.canvas.scene.move(key, x + this.by.x, y + this.by.y);
  }

  #lift() {
    const { scene, painter, stage } = this.canvas;
    const held = new Set(this.places.keys());
    for (const key of this.places.keys()) for (const edge of scene.edgesOf(key)) held.add(edge.key);
    painter.mark("held", held);
    stage.classList.add("lifting");
    this.canvas.cull();
    painter.beginDrag(this.places.keys());
  }

  #raiseGhost() {
    const d = this.rects.map(({ x, y, w, h }) => `M${x} ${y}h${w}v${h}h${-w}Z`).join("");
    this.ghost = svg("path", { class: "ghost", d });
    this.canvas.painter.layers.above.append(this.ghost);
  }

  #release() {
    const { painter, stage } = this.canvas;
    this.#place();
    painter.endDrag([...this.places.keys()]);
    painter.mark("held", []);
    stage.classList.remove("lifting");
    this.guides?.close();
    this.ghost?.remove();
    this.ghost = null;
  }
}

const shifted = (rect, by) => ({ ...rect, x: rect.x + by.x, y: rect.y + by.y });

/** How far a box goes: in line with another where one pulls, else to the grid; freely, to whole pixels. */
function landing(start, by, pull, free) {
  const wanted = by + (pull ?? 0);
  return free || (pull ?? null) !== null ? Math.round(start + wanted) - start : snap(start + by) - start;
}
