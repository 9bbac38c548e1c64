// Guides during a drag: lines through aligned nodes, marks of equal gaps, and snapping to both.
import { grow, nodeRect } from "./geometry.js";
import { equalGaps } from "./spacing.js";
import { svg } from "./svg.js";

const SNAP_DISTANCE = 6;
const MAX_NODES = 400;
const OVER = 12;
const TICK = 5;

const AXES = [
  { name: "x", size: "w", across: "y", length: "h" },
  { name: "y", size: "h", across: "x", length: "w" },
];

export class Guides {
  /** @param dragged the keys of the dragged nodes, which are not guides */
  constructor(canvas, dragged) {
    this.canvas = canvas;
    this.group = svg("g", { class: "guides" });
    canvas.painter.layers.above.append(this.group);
    const seen = canvas.viewport.visibleRect();
    const near = [...canvas.scene.nodeGrid.query(grow(seen, Math.max(seen.w, seen.h) / 2))].filter((key) => !dragged.has(key));
    this.rects = near.slice(0, MAX_NODES).map((key) => nodeRect(canvas.scene.nodes.get(key)));
  }

  /** Returns the snap offset of a rectangle for each axis, or null where nothing is near enough. */
  snapOffsets(rect) {
    const reach = SNAP_DISTANCE / this.canvas.viewport.k;
    return Object.fromEntries(AXES.map((axis) => [axis.name, this.#nearest(rect, axis, reach)]));
  }

  /** Draws a line through all nodes that are aligned with a rectangle, and a mark in each of its equal gaps. */
  show(rect) {
    this.group.replaceChildren();
    for (const axis of AXES) {
      for (const { offset, gaps } of equalGaps(rect, this.rects, axis)) {
        if (Math.abs(offset) < 1) this.group.append(...gaps.map((gap) => gapMark(axis, gap, rect, TICK / this.canvas.viewport.k)));
      }
      for (const at of alignmentLines(rect, axis)) {
        const inLine = this.rects.filter((other) => alignmentLines(other, axis).some((stop) => Math.abs(stop - at) < 0.5));
        if (inLine.length) this.group.append(line(axis, at, [rect, ...inLine]));
      }
    }
  }

  hide() {
    this.group.replaceChildren();
  }

  close() {
    this.group.remove();
  }

  #nearest(rect, axis, reach) {
    const inLine = this.rects.flatMap((other) => alignmentLines(other, axis).flatMap((stop) => alignmentLines(rect, axis).map((own) => stop - own)));
    const even = equalGaps(rect, this.rects, axis).map(({ offset }) => offset);
    const near = [...inLine, ...even].filter((offset) => Math.abs(offset) <= reach);
    return near.length ? near.reduce((best, offset) => (Math.abs(offset) < Math.abs(best) ? offset : best)) : null;
  }
}

/** The two sides and the middle of a rectangle along one axis. */
const alignmentLines = (rect, { name, size }) => [rect[name], rect[name] + rect[size] / 2, rect[name] + rect[size]];

function line({ name, across, length }, at, rects) {
  const low = Math.min(...rects.map((rect) => rect[across])) - OVER;
  const high = Math.max(...rects.map((rect) => rect[across] + rect[length])) + OVER;
  return svg("path", { class: "guide", d: name === "x" ? `M${at} ${low}V${high}` : `M${low} ${at}H${high}` });
}

/** A line across a gap with a tick at each end. */
function gapMark({ name, across, length }, [from, to], rect, tick) {
  const at = rect[across] + rect[length] / 2;
  const ends = [from, to].map((end) => (name === "x" ? `M${end} ${at - tick}V${at + tick}` : `M${at - tick} ${end}H${at + tick}`));
  return svg("path", { class: "guide gap", d: `${name === "x" ? `M${from} ${at}H${to}` : `M${at} ${from}V${to}`}${ends.join("")}` });
}
