// The names at small zooms, in letters of a readable size. Where names would collide, the more important ones stay.
import { grow, overlaps, nodeRect } from "./geometry.js";
import { html } from "./svg.js";
import { FONTS, textWidth, truncateMiddle } from "./text_metrics.js";

// From this zoom on, the names inside the boxes are large enough.
const NAMES_BELOW = 0.36;
const SMALLEST = 10;
const LARGEST = 14;
const MEASURED = 14;
const FRAME_SIZE = 12;
const FRAME_ROOM = 260;
const HIGHEST_RANK = 1e6;
const DIMMED = 0.3;
const PADDING = 2;
const ROW = LARGEST + 2 * PADDING;

export class NameLayer {
  constructor(canvas, colors) {
    this.canvas = canvas;
    this.colors = colors;
    this.element = html("canvas", { class: "bitmap names" });
    this.taken = null;
    this.shown = [];
  }

  /** Draws the names near the visible part, or none at zooms where the boxes contain them; returns whether it drew. */
  draw({ far }) {
    const { viewport, scene } = this.canvas;
    this.shown = far || viewport.k < NAMES_BELOW ? this.#choose(grow(viewport.visibleRect(), viewport.width / viewport.k / 4)) : [];
    this.taken = scene.nodes.size && this.shown.length ? { x: viewport.x, y: viewport.y, k: viewport.k, margin: Math.round(viewport.width / 4) } : null;
    this.element.style.visibility = this.taken ? "visible" : "hidden";
    if (this.taken) this.#paint();
    this.place();
    return this.taken !== null;
  }

  /** Moves the names with the view. */
  place() {
    if (!this.taken) return;
    const { x, y, k } = this.canvas.viewport;
    const ratio = k / this.taken.k;
    const { margin } = this.taken;
    this.element.style.transform = `translate(${x - (this.taken.x + margin) * ratio}px, ${y - (this.taken.y + margin) * ratio}px) scale(${ratio / devicePixelRatio})`;
  }

  /** The names that do not collide, most important ones first: frames, what is selected, then by the number of edges. */
  #choose(region) {
    const { scene, viewport, painter } = this.canvas;
    const rows = new Map();
    const frames = scene.shownFrames().map((frame) => this.#frameLabel(frame)).filter(Boolean);
    const nodes = scene.shownNodes().filter((node) => node.of !== "notes" && overlaps(nodeRect(node), region));
    const ranked = nodes.map((node) => ({ node, rank: this.#rankOf(node) })).sort((a, b) => b.rank - a.rank);
    const near = painter.marks.get("near");
    const labels = [...frames, ...ranked.map(({ node }) => ({ ...nodeLabel(node, viewport), isDim: near.size > 0 && !near.has(node.key) }))];
    return labels.filter((label) => claim(rows, label));
  }

  #rankOf(node) {
    const { selection, painter, scene } = this.canvas;
    if (["active", "near"].some((name) => painter.marks.get(name).has(node.key)) || selection.keys.has(node.key)) return HIGHEST_RANK;
    return (scene.edgesAt.get(node.key)?.size ?? 0) + (node.data.initial ? 1000 : 0) + (node.data.severity ? 100 : 0);
  }

  #frameLabel(frame) {
    const { scene, viewport } = this.canvas;
    const area = scene.boxOf(frame.key);
    if (!area) return null;
    const text = truncateMiddle(frame.data.name, "name", (FRAME_ROOM * MEASURED) / FRAME_SIZE);
    const w = (textWidth(text, "name") * FRAME_SIZE) / MEASURED;
    const at = viewport.toScreen({ x: area.x, y: area.y });
    return { text, size: FRAME_SIZE, x: at.x + 4 + w / 2, y: at.y + FRAME_SIZE, w, color: "muted" };
  }

  #paint() {
    const { viewport } = this.canvas;
    const { margin } = this.taken;
    this.element.width = Math.round((viewport.width + 2 * margin) * devicePixelRatio);
    this.element.height = Math.round((viewport.height + 2 * margin) * devicePixelRatio);
    const pen = this.element.getContext("2d");
    pen.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, margin * devicePixelRatio, margin * devicePixelRatio);
    Object.assign(pen, { textAlign: "center", textBaseline: "middle", lineJoin: "round", lineWidth: 3 });
    pen.strokeStyle = this.colors("paper");
    for (const { text, size, x, y, color, isDim } of this.shown) {
      pen.globalAlpha = isDim ? DIMMED : 1;
      pen.font = FONTS.name.replace("14px", `${size}px`);
      pen.strokeText(text, x, y);
      pen.fillStyle = this.colors(color);
      pen.fillText(text, x, y);
    }
  }
}

/** The name of a node, as large as its box allows within the readable sizes; in screen units. */
function nodeLabel(node, viewport) {
  const natural = textWidth(node.label, "name");
  const size = Math.min(LARGEST, Math.max(SMALLEST, Math.floor((MEASURED * (node.w * viewport.k - 6)) / natural)));
  return { key: node.key, text: node.label, size, ...viewport.toScreen(node), w: (natural * size) / MEASURED, color: "text" };
}

/** Takes the place of a label if it is free. */
function claim(rows, label) {
  const [left, right] = [label.x - label.w / 2 - PADDING, label.x + label.w / 2 + PADDING];
  const row = Math.floor(label.y / ROW);
  const others = [row - 1, row, row + 1].flatMap((index) => rows.get(index) ?? []);
  if (others.some((other) => Math.abs(other.y - label.y) < (other.size + label.size) / 2 + PADDING && left < other.right && other.left < right)) return false;
  if (!rows.has(row)) rows.set(row, []);
  rows.get(row).push({ left, right, y: label.y, size: label.size });
  return true;
}
