// Overview for small zooms: a coarse bitmap of the whole scene and a sharp bitmap of the visible part.
import { bounds, containsRect, grow, overlaps, nodeRect } from "./geometry.js";
import { html } from "./svg.js";

const COARSE_PIXELS = 1536;
const SHARP_PIXELS = 4096;

export class Overview {
  constructor(scene, viewport, colors) {
    this.scene = scene;
    this.viewport = viewport;
    this.colors = colors;
    this.coarse = { canvas: html("canvas", { class: "bitmap" }), region: null, scale: 1 };
    this.sharp = { canvas: html("canvas", { class: "bitmap" }), region: null, scale: 1 };
    this.elements = [this.coarse.canvas, this.sharp.canvas];
    this.stale = true;
    this.showsSelection = false;
  }

  /** The scene or its colors changed. The old bitmaps remain until new ones are drawn, which avoids flicker. */
  invalidate() {
    this.stale = true;
  }

  /** Draws the coarse bitmap if it is outdated. */
  drawCoarse(selected) {
    const extent = this.scene.extent();
    if (!this.stale || !extent) return;
    this.stale = false;
    this.sharp.region = null;
    const region = grow(extent, 60);
    this.#draw(this.coarse, region, Math.min(1, COARSE_PIXELS / Math.max(region.w, region.h)), selected);
  }

  isDrawn() {
    return this.coarse.region !== null;
  }

  /** Draws the visible part with a margin at the current zoom. */
  drawSharp(selected) {
    const extent = this.scene.extent();
    if (!extent) return;
    const seen = this.viewport.visibleRect();
    if (this.sharp.region && this.sharp.zoom === this.viewport.k && holdsSeen(this.sharp.region, seen, extent)) return;
    this.sharp.zoom = this.viewport.k;
    const region = intersection(grow(extent, 60), grow(seen, Math.max(seen.w, seen.h) / 3));
    if (!region) return;
    const scale = Math.min(this.viewport.k * devicePixelRatio, SHARP_PIXELS / Math.max(region.w, region.h));
    this.#draw(this.sharp, region, scale, selected);
    this.place();
  }

  /** Positions both bitmaps for the current view. */
  place() {
    if (!this.isDrawn()) return;
    const { x, y, k } = this.viewport;
    for (const { canvas, region, scale } of [this.coarse, this.sharp]) {
      canvas.style.visibility = region ? "visible" : "hidden";
      if (region) canvas.style.transform = `translate(${x + region.x * k}px, ${y + region.y * k}px) scale(${k / scale})`;
    }
  }

  #draw(bitmap, region, scale, selected) {
    const { canvas } = bitmap;
    Object.assign(bitmap, { region, scale });
    canvas.width = Math.max(1, Math.round(region.w * scale));
    canvas.height = Math.max(1, Math.round(region.h * scale));
    const pen = canvas.getContext("2d", { alpha: false });
    pen.fillStyle = this.colors("paper");
    pen.fillRect(0, 0, canvas.width, canvas.height);
    pen.setTransform(scale, 0, 0, scale, -region.x * scale, -region.y * scale);
    this.#drawFrames(pen, scale, selected);
    this.#drawEdges(pen, scale);
    const nodes = this.scene.shownNodes().filter((node) => overlaps(nodeRect(node), region));
    this.#drawNodes(pen, nodes, scale, selected);
  }

  #drawFrames(pen, scale, selected) {
    pen.lineWidth = Math.max(1, 0.7 / scale);
    for (const { key, data } of this.scene.framesInOrder()) {
      const area = this.scene.boxOf(key);
      if (!area) continue;
      pen.fillStyle = this.colors(data.color ? `color-${data.color}` : "faint");
      pen.strokeStyle = this.colors(selected.has(key) ? "accent" : "plate-line");
      pen.fillRect(area.x, area.y, area.w, area.h);
      pen.strokeRect(area.x, area.y, area.w, area.h);
    }
  }

  #drawEdges(pen, scale) {
    const edges = [...this.scene.edges.values()].filter((edge) => this.scene.isDrawable(edge));
    const colorOf = (edge) => (edge.of === "links" ? edge.data.kind : edge.source === "common" ? "common" : "edge");
    pen.lineWidth = Math.max(1.4, 0.5 / scale);
    for (const [color, group] of Map.groupBy(edges, colorOf)) {
      pen.strokeStyle = this.colors(color);
      pen.globalAlpha = 0.55;
      pen.beginPath();
      for (const edge of group) {
        const source = this.scene.nodes.get(edge.source);
        const target = this.scene.nodes.get(edge.target);
        pen.moveTo(source.x, source.y);
        pen.lineTo(target.x, target.y);
      }
      pen.stroke();
    }
    pen.globalAlpha = 1;
  }

  #drawNodes(pen, nodes, scale, selected) {
    pen.lineWidth = Math.max(1.5, 0.7 / scale);
    const lookOf = (node) => {
      if (selected.has(node.key)) return "selected";
      if (node.data.severity) return node.data.severity;
      if (node.data.color) return node.data.color;
      return node.of === "states" && node.data.initial ? "initial" : node.of;
    };
    for (const [look, group] of Map.groupBy(nodes, lookOf)) {
      const [fill, stroke] = (LOOKS[look] ?? [`color-${look}`, "box-line"]).map((name) => this.colors(name));
      pen.fillStyle = fill;
      pen.strokeStyle = stroke;
      pen.beginPath();
      for (const node of group) pen.rect(node.x - node.w / 2, node.y - node.h / 2, node.w, node.h);
      pen.fill();
      pen.stroke();
    }
  }
}

const LOOKS = {
  states: ["box", "box-line"],
  initial: ["box-line", "text"],
  components: ["component", "component-line"],
  common: ["common-fill", "common"],
  notes: ["color-yellow", "plate-line"],
  selected: ["accent-soft", "accent"],
  error: ["error", "error"],
  warning: ["warning", "warning"],
  note: ["note", "note"],
};

/** Whether a bitmap of a region covers the visible part of the scene. */
function holdsSeen(region, seen, extent) {
  const part = intersection(seen, extent);
  return !part || containsRect(region, part);
}

function intersection(a, b) {
  if (!overlaps(a, b)) return null;
  const x = Math.max(a.x, b.x);
  const y = Math.max(a.y, b.y);
  return bounds([{ x, y, w: Math.min(a.x + a.w, b.x + b.w) - x, h: Math.min(a.y + a.h, b.y + b.h) - y }]);
}
