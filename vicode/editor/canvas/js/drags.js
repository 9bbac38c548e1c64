// Pointer drags that pan the view, select with a marquee and move nodes. Each can be canceled.
import { bounds, containsRect, overlaps, pointOnCurve, rectBetween, nodeRect, snap } from "./geometry.js";
import { Guides } from "./guides.js";
import { svg } from "./svg.js";

// More nodes than this are moved as one outline; drawing each of them would drop frames.
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

  constructor(canvas, isAdditive) {
    this.canvas = canvas;
    this.kept = isAdditive ? new Set(canvas.selection.keys) : new Set();
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

  /** Nodes that the marquee touches with the edges between them; without nodes, the edges whose middle lies inside. */
  #inside(area) {
    const { scene, router } = this.canvas;
    const nodes = [...scene.nodeGrid.query(area)].filter((key) => overlaps(nodeRect(scene.nodes.get(key)), area));
    const edges = [...scene.edgeGrid.query(area)].map((key) => scene.edges.get(key)).filter((edge) => {
      if (!scene.isDrawable(edge)) return false;
      if (nodes.length) return nodes.includes(edge.source) && nodes.includes(edge.target);
      const middle = pointOnCurve(router.route(edge).curve, 0.5);
      return overlaps({ ...middle, w: 0, h: 0 }, area);
    });
    const frames = [...scene.frames.keys()].filter((key) => containsRect(area, scene.boxOf(key)));
    return [...nodes, ...edges.map((edge) => edge.key), ...frames];
  }
}

/** A marquee whose states get a frame. */
export class FrameDrag extends MarqueeDrag {
  end() {
    super.end();
    this.canvas.commands.run("frame");
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
    this.origins = new Map(selection.movable().map((key) => [key, { x: scene.nodes.get(key).x, y: scene.nodes.get(key).y }]));
    // A frame moves by its states.
    if (!this.origins.has(this.lead)) this.lead = this.origins.keys().next().value;
    this.rects = [...this.origins.keys()].map((key) => nodeRect(scene.nodes.get(key)));
    this.frame = bounds(this.rects);
    this.offset = { x: 0, y: 0 };
    if (this.origins.size > MAX_LIVE_NODES) return this.#raiseGhost();
    this.#lift();
    this.guides = new Guides(this.canvas, this.origins);
  }

  move({ world, free }) {
    const start = this.origins.get(this.lead);
    if (!start) return;
    const offset = { x: world.x - this.from.x, y: world.y - this.from.y };
    const pull = free || !this.guides ? {} : this.guides.snapOffsets(shifted(this.frame, offset));
    this.offset = { x: snappedOffset(start.x, offset.x, pull.x, free), y: snappedOffset(start.y, offset.y, pull.y, free) };
    if (free) this.guides?.hide();
    else this.guides?.show(shifted(this.frame, this.offset));
    if (this.ghost) this.ghost.setAttribute("transform", `translate(${this.offset.x} ${this.offset.y})`);
    else this.#put();
  }

  end() {
    this.#release();
    if (this.offset.x || this.offset.y) this.canvas.reportMove([...this.origins.keys()], this.rects);
  }

  cancel() {
    this.offset = { x: 0, y: 0 };
    this.#release();
    this.canvas.painter.refineRoutes();
  }

  /** Python changed the scene during the drag: the remaining nodes stay in it. */
  sceneChanged() {
    for (const key of [...this.origins.keys()]) if (!this.canvas.scene.nodes.has(key)) this.origins.delete(key);
    if (!this.ghost) this.#put();
  }

  #put() {
    this.#place();
    this.canvas.painter.updateDrag([...this.origins.keys()], this.offset);
    this.canvas.insets.place();
  }

  #place() {
    for (const [key, { x, y }] of this.origins) this.canvas.scene.move(key, x + this.offset.x, y + this.offset.y);
  }

  #lift() {
    const { scene, painter, stage } = this.canvas;
    const held = new Set(this.origins.keys());
    for (const key of this.origins.keys()) for (const edge of scene.edgesOf(key)) held.add(edge.key);
    painter.mark("held", held);
    stage.classList.add("lifting");
    this.canvas.cull();
    painter.beginDrag(this.origins.keys());
  }

  #raiseGhost() {
    const d = this.rects.map(({ x, y, w, h }) => `M${x} ${y}h${w}v${h}h${-w}Z`).join("");
    this.ghost = svg("path", { class: "ghost", d });
    this.canvas.painter.layers.above.append(this.ghost);
  }

  #release() {
    const { painter, stage } = this.canvas;
    this.#place();
    painter.endDrag([...this.origins.keys()]);
    painter.mark("held", []);
    stage.classList.remove("lifting");
    this.guides?.close();
    this.ghost?.remove();
    this.ghost = null;
  }
}

const shifted = (rect, offset) => ({ ...rect, x: rect.x + offset.x, y: rect.y + offset.y });

/** The offset of a node: snapped to a guide if there is one, else to the grid; free: rounded to pixels. */
function snappedOffset(start, offset, pull, free) {
  const wanted = offset + (pull ?? 0);
  return free || (pull ?? null) !== null ? Math.round(start + wanted) - start : snap(start + offset) - start;
}
