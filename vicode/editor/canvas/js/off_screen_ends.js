// Labels at the border of the view for the ends of the selected node's edges that lie outside; a click goes there.
import { overlaps, nodeRect } from "./geometry.js";
import { goTo } from "./strings.js";
import { html } from "./svg.js";
import { textWidth, truncateMiddle } from "./text_metrics.js";

const MAX_LABELS = 12;
const ROOM = 150;
const HEIGHT = 26;
const PADDING = 24;
const MARGIN = 8;
// Room for the view switch and messages at the top.
const TOP = 52;

export class OffScreenEnds {
  constructor(canvas) {
    this.canvas = canvas;
    this.element = html("div", { class: "off-screen" });
    for (const name of ["pointerdown", "pointermove", "dblclick"]) this.element.addEventListener(name, (event) => event.stopPropagation());
  }

  /** Shows the labels while the view rests; none if they would be many. */
  refresh() {
    const { viewport, scene, selection, gestures } = this.canvas;
    const node = viewport.isIdle && !gestures.isDragging() && scene.nodes.get(selection.single());
    const ends = node && overlaps(nodeRect(node), viewport.visibleRect()) ? this.#outside(node) : [];
    const taken = [];
    const labels = ends.length > MAX_LABELS ? [] : ends.map((end) => this.#label(node, end, taken)).filter(Boolean);
    if (labels.length || this.element.firstChild) this.element.replaceChildren(...labels);
  }

  /** The other ends outside the view, each with whether an edge leads to it. */
  #outside(node) {
    const { scene, viewport } = this.canvas;
    const seen = viewport.visibleRect();
    const ends = new Map();
    for (const edge of scene.edgesOf(node.key).filter((each) => scene.isDrawable(each))) {
      const isTarget = edge.source === node.key;
      const other = scene.nodes.get(isTarget ? edge.target : edge.source);
      if (!overlaps(nodeRect(other), seen)) ends.set(other, isTarget || ends.get(other) === true);
    }
    return [...ends].map(([other, isTarget]) => ({ other, isTarget }));
  }

  /** Where the tools and the minimap are. */
  #corner() {
    const { offsetLeft: x, offsetTop: y, offsetWidth: w, offsetHeight: h } = this.canvas.corner;
    return { x, y, w, h };
  }

  #label(node, { other, isTarget }, taken) {
    const { viewport, selection } = this.canvas;
    const text = `${isTarget ? "→" : "←"} ${truncateMiddle(other.label, "label", ROOM)}`;
    const w = textWidth(text, "label") + PADDING;
    const area = { left: MARGIN + w / 2, right: viewport.width - MARGIN - w / 2, top: TOP, bottom: viewport.height - MARGIN - HEIGHT / 2 };
    const at = crossing(viewport.toScreen(node), viewport.toScreen(other), area);
    const rect = { x: at.x - w / 2, y: at.y - HEIGHT / 2, w, h: HEIGHT };
    // Labels move down where they would collide, and up from the tools and the minimap.
    const corner = this.#corner();
    let step = HEIGHT + 2;
    if (overlaps(corner, rect)) [rect.y, step] = [corner.y - HEIGHT - 2, -step];
    while (taken.some((each) => overlaps(each, rect))) rect.y += step;
    if (rect.y < TOP - HEIGHT / 2 || rect.y > viewport.height - HEIGHT || overlaps(corner, rect)) return null;
    taken.push(rect);
    const button = html("button", { type: "button", tabindex: "-1", text, title: goTo(other.data.name ?? other.label), style: `left: ${rect.x}px; top: ${rect.y}px` });
    button.addEventListener("click", () => {
      selection.set([other.key]);
      viewport.centerOn(other.x, other.y);
      this.canvas.focus();
    });
    return button;
  }
}

/** The point where the line from one point to another leaves an area; the start, if it is outside, is moved inside. */
function crossing(from, to, { left, right, top, bottom }) {
  const clamp = (value, low, high) => Math.min(Math.max(value, low), Math.max(low, high));
  const start = { x: clamp(from.x, left, right), y: clamp(from.y, top, bottom) };
  const reach = (at, delta, low, high) => (delta > 0 ? (high - at) / delta : delta < 0 ? (low - at) / delta : Infinity);
  const [dx, dy] = [to.x - start.x, to.y - start.y];
  const t = clamp(Math.min(reach(start.x, dx, left, right), reach(start.y, dy, top, bottom)), 0, 1);
  return { x: clamp(start.x + dx * t, left, right), y: clamp(start.y + dy * t, top, bottom) };
}
