// Minimap of the scene; a press or drag centers the view there.
import { bounds, containsRect, grow, nodeRect } from "./geometry.js";
import { html } from "./svg.js";

const WIDTH = 180;
const HEIGHT = 116;
const MAX_LINES = 400;

export class Minimap {
  constructor(scene, viewport, colors) {
    this.scene = scene;
    this.viewport = viewport;
    this.colors = colors;
    this.canvas = html("canvas", { width: WIDTH * 2, height: HEIGHT * 2 });
    this.frame = html("div", { class: "frame" });
    this.element = html("div", { class: "minimap", "aria-hidden": "true" }, [this.canvas, this.frame]);
    this.map = null;
    this.extent = null;
    this.#listen();
  }

  /** Redraws the minimap after a change of the scene. */
  draw() {
    const pen = this.canvas.getContext("2d");
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, this.canvas.width, this.canvas.height);
    const extent = this.scene.extent();
    this.extent = extent;
    if (!extent) return this.viewChanged();
    const area = grow(extent, Math.max(extent.w, extent.h) * 0.06);
    const scale = Math.min(WIDTH / area.w, HEIGHT / area.h);
    this.map = { scale, x: (WIDTH - area.w * scale) / 2 - area.x * scale, y: (HEIGHT - area.h * scale) / 2 - area.y * scale };
    pen.setTransform(2 * scale, 0, 0, 2 * scale, 2 * this.map.x, 2 * this.map.y);
    pen.strokeStyle = this.colors("muted");
    pen.lineWidth = 1 / scale;
    for (const area of this.scene.shownFrames().map(({ key }) => this.scene.boxOf(key)).filter(Boolean)) pen.strokeRect(area.x, area.y, area.w, area.h);
    this.#drawEdges(pen, scale);
    const colorOf = (node) => node.data.severity ?? { states: "box-line", components: "component-line", common: "common", notes: "plate-line" }[node.of];
    for (const [color, nodes] of Map.groupBy(this.scene.shownNodes(), colorOf)) {
      pen.fillStyle = this.colors(color);
      pen.beginPath();
      for (const { x, y, w, h } of nodes.map(nodeRect)) pen.rect(x, y, Math.max(w, 2.5 / scale), Math.max(h, 2 / scale));
      pen.fill();
    }
    this.viewChanged();
  }

  /** Draws the edges, unless there are too many to be readable. */
  #drawEdges(pen, scale) {
    if (this.scene.edges.size > MAX_LINES) return;
    pen.strokeStyle = this.colors("plate-line");
    pen.lineWidth = 0.75 / scale;
    pen.beginPath();
    for (const edge of this.scene.edges.values()) {
      if (!this.scene.isDrawable(edge) || edge.of === "links") continue;
      const [source, target] = [edge.source, edge.target].map((key) => this.scene.nodes.get(key));
      pen.moveTo(source.x, source.y);
      pen.lineTo(target.x, target.y);
    }
    pen.stroke();
  }

  /** Shows the visible part; hides the minimap if everything is visible. */
  viewChanged() {
    const seen = this.viewport.visibleRect();
    this.element.hidden = !this.extent || containsRect(seen, this.extent);
    if (this.element.hidden) return;
    const corner = (x, y) => ({ x: clamp(x * this.map.scale + this.map.x, WIDTH), y: clamp(y * this.map.scale + this.map.y, HEIGHT), w: 0, h: 0 });
    const box = bounds([corner(seen.x, seen.y), corner(seen.x + seen.w, seen.y + seen.h)]);
    Object.assign(this.frame.style, { left: `${box.x}px`, top: `${box.y}px`, width: `${box.w}px`, height: `${box.h}px` });
  }

  #listen() {
    const go = (event) => {
      const box = this.element.getBoundingClientRect();
      if (!this.map) return;
      this.viewport.centerOn((event.clientX - box.left - this.map.x) / this.map.scale, (event.clientY - box.top - this.map.y) / this.map.scale);
    };
    this.element.addEventListener("pointerdown", (event) => {
      event.stopPropagation();
      event.preventDefault();
      this.element.setPointerCapture(event.pointerId);
      go(event);
    });
    this.element.addEventListener("pointermove", (event) => {
      if (this.element.hasPointerCapture(event.pointerId)) go(event);
    });
  }
}

const clamp = (value, max) => Math.min(max - 1, Math.max(1, value));
