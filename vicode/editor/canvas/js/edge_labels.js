// The label (chip) of a transition: its text, its size, and its position along the curve.
import { pointOnCurve, rectAround } from "./geometry.js";
import { truncate, textWidth } from "./text_metrics.js";

const HEIGHT = 22;
const PADDING = 8;
const ICON = 15;
// Width of the badge with findings, which follows the text inside the label.
export const BADGE = 24;
const MAX_TEXT_WIDTH = 150;
const MIN_TEXT_WIDTH = 60;
const CROWDED_ROOM = 100;
const MEMBER = /(?<![\p{L}\p{N}_])((?:[\p{L}_][\p{L}\p{N}_]*\.)+)([\p{L}_][\p{L}\p{N}_]*)/gu;
const LOOP_SHIFTS = [0, 0, 1, -1];
// Candidate positions by cost: fraction along the curve, and side: 0 on it, ±1 directly next to it, ±2 farther away.
const POSITIONS = [0.5, 0.42, 0.58, 0.34, 0.66, 0.27, 0.73, 0.2, 0.8, 0.14, 0.86].flatMap((part) =>
  [0, 1, -1, 2, -2].map((side) => ({ part, side, cost: Math.abs(part - 0.5) * 2.4 + Math.abs(side) * 1.2 })),
);
POSITIONS.sort((a, b) => a.cost - b.cost);
const LOOP_POSITIONS = [0, 1, 2, 3].map((out) => ({ out, cost: out * 0.4 }));
// At most a pixel per step, except on very long curves.
const STEPS = 500;

/** Returns the content and size of an edge's label, or null if it has none. `count`: edges between the two nodes. */
export function makeEdgeLabel(edge, from, to, count) {
  if (edge.of !== "transitions") return null;
  const { order, icon, badgeWidth } = partsOf(edge.data);
  const used = (order ? 18 : 0) + (icon ? ICON : 0) + badgeWidth;
  return chipWith(edge, Math.max(MIN_TEXT_WIDTH, roomBetween(from, to, count) - used));
}

/** Returns shorter variants of a label. */
export const shorterLabels = (edge, chip) =>
  [90, 50].filter((room) => textWidth(chip.text, "label") > room + 10).map((room) => chipWith(edge, room));

function chipWith({ data }, room) {
  const { order, icon, badgeWidth } = partsOf(data);
  const full = data.label ?? "";
  const text = truncate(textWidth(full, "label") > room ? withoutAliases(full) : full, "label", room);
  if (!order && !text && !icon) return null;
  const orderWidth = order ? textWidth(text || icon ? `${order} · ` : order, "label") + 1 : 0;
  const iconWidth = icon ? ICON : 0;
  const w = Math.ceil(2 * PADDING + orderWidth + iconWidth + (text ? textWidth(text, "label") : 0)) + badgeWidth;
  return { order, text, icon, orderWidth, iconWidth, badgeWidth, padding: PADDING, w, h: HEIGHT };
}

/** The label with the names of outputs only; unchanged if that would make two of them equal. */
export function withoutAliases(label) {
  const members = new Map([...label.matchAll(MEMBER)].map(([whole, , name]) => [whole, name]));
  return new Set(members.values()).size === members.size ? label.replace(MEMBER, "$2") : label;
}

const partsOf = (data) => ({
  order: data.of > 1 ? String(data.order) : "",
  icon: data.disabled ? "off" : ["timer", "code", "tree"].includes(data.kind) ? data.kind : "",
  badgeWidth: data.severity ? BADGE : 0,
});

/**
 * Maximum text width between two nodes: the gap between nodes side by side, so that the label fits its curve; less for
 * stacked nodes with several edges. In steps of 10, so that a label is not redrawn at every movement.
 */
function roomBetween(from, to, count) {
  const gap = Math.abs(to.x - from.x) - (from.w + to.w) / 2;
  if (from === to) return MAX_TEXT_WIDTH;
  if (gap < 30 || gap < 2 * (Math.abs(to.y - from.y) - from.h)) return count > 2 ? CROWDED_ROOM : MAX_TEXT_WIDTH;
  return Math.min(MAX_TEXT_WIDTH, Math.max(MIN_TEXT_WIDTH, Math.floor((gap - 30) / 10) * 10));
}

/** Returns the position `{at, cost}` where a label hides least; `overlapCost(rect, limit)` may stop at the limit. */
export function placeLabel(edge, curve, chip, overlapCost) {
  const isLoop = edge.source === edge.target;
  let best = { cost: Infinity };
  for (const candidate of isLoop ? LOOP_POSITIONS : POSITIONS) {
    if (candidate.cost >= best.cost) break;
    const at = isLoop ? positionAtLoop(curve, chip, candidate.out) : positionAtLine(curve, chip, candidate);
    const cost = candidate.cost + overlapCost(rectAround(at.x, at.y, chip.w, chip.h), best.cost - candidate.cost);
    if (cost < best.cost) best = { at, cost };
  }
  return best;
}

/** The label of a loop is at its outermost point, so that the loop stays visible. */
function positionAtLoop(curve, chip, out) {
  const apex = pointOnCurve(curve, 0.5);
  const foot = { x: (curve[0] + curve[6]) / 2, y: (curve[1] + curve[7]) / 2 };
  const [dx, dy] = [Math.sign(apex.x - foot.x), Math.sign(apex.y - foot.y)];
  if (Math.abs(apex.x - foot.x) < Math.abs(apex.y - foot.y)) return { x: apex.x + LOOP_SHIFTS[out] * chip.w * 0.4, y: apex.y + (out ? dy * 9 : 0) };
  return { x: apex.x + dx * (chip.w / 2 - 8), y: apex.y + LOOP_SHIFTS[out] * 18 };
}

/** On the line, or far enough from it that the line stays visible. */
function positionAtLine(curve, chip, { part, side }) {
  if (!side) return pointOnCurve(curve, part);
  const [behind, ahead] = [pointOnCurve(curve, Math.max(0, part - 0.02)), pointOnCurve(curve, Math.min(1, part + 0.02))];
  const length = Math.hypot(ahead.x - behind.x, ahead.y - behind.y) || 1;
  const reach = (Math.abs(ahead.y - behind.y) * chip.w + Math.abs(ahead.x - behind.x) * chip.h) / length / 2;
  return offsetFromCurve(curve, part, Math.sign(side) * (reach + (Math.abs(side) === 1 ? 3 : 9)));
}

/** Position of a label from its stored offset: fraction along the curve, and distance to the right of its direction. */
export const labelPosition = (curve, [part, shift]) => offsetFromCurve(curve, Math.min(1, Math.max(0, part)), shift);

/** The offset `[part, shift]` of a label at a point: its nearest point on the curve, and the distance from it. */
export function labelOffset(curve, { x, y }) {
  let best = { t: 0.5, reach: Infinity };
  for (let step = 0; step <= STEPS; step += 1) {
    const foot = pointOnCurve(curve, step / STEPS);
    const reach = (foot.x - x) ** 2 + (foot.y - y) ** 2;
    if (reach < best.reach) best = { t: step / STEPS, reach };
  }
  const foot = pointOnCurve(curve, best.t);
  const right = offsetFromCurve(curve, best.t, 1);
  return [best.t, Math.round((x - foot.x) * (right.x - foot.x) + (y - foot.y) * (right.y - foot.y))];
}

function offsetFromCurve(curve, t, shift) {
  const point = pointOnCurve(curve, t);
  if (!shift) return point;
  const [behind, ahead] = [pointOnCurve(curve, Math.max(0, t - 0.02)), pointOnCurve(curve, Math.min(1, t + 0.02))];
  const length = Math.hypot(ahead.x - behind.x, ahead.y - behind.y) || 1;
  return { x: point.x - ((ahead.y - behind.y) / length) * shift, y: point.y + ((ahead.x - behind.x) / length) * shift };
}
