// The chip on a transition: what it says, how large it is, and where along the curve it fits.
import { pointOnCurve, rectAround } from "./geometry.js";
import { truncate, textWidth } from "./text_metrics.js";

const HEIGHT = 22;
const PADDING = 8;
const ICON = 15;
// The mark of findings stands behind the text, within the chip's room, so that it hides nothing.
export const BADGE = 24;
const MAX_TEXT_WIDTH = 150;
const MIN_TEXT_WIDTH = 60;
const CROWDED_ROOM = 100;
const SLIPS = [0, 0, 1, -1];
// Parts of the way along the curve, and how far beside it, the best first. 1 is just beside the line, 2 a little farther.
const PLACES = [0.5, 0.42, 0.58, 0.34, 0.66, 0.27, 0.73, 0.2, 0.8, 0.14, 0.86].flatMap((part) =>
  [0, 1, -1, 2, -2].map((beside) => ({ part, beside, cost: Math.abs(part - 0.5) * 2.4 + Math.abs(beside) * 1.2 })),
);
PLACES.sort((a, b) => a.cost - b.cost);
const LOOP_PLACES = [0, 1, 2, 3].map((out) => ({ out, cost: out * 0.4 }));
// As fine as a pixel on all but very long curves.
const STEPS = 500;

/** What the chip of an edge between two nodes shows and its size, or null when there is nothing to say. */
export function makeEdgeLabel(edge, from, to, beside) {
  if (edge.of !== "transitions") return null;
  const { order, icon, badgeWidth } = partsOf(edge.data);
  const used = (order ? 18 : 0) + (icon ? ICON : 0) + badgeWidth;
  return chipWith(edge, Math.max(MIN_TEXT_WIDTH, roomBetween(from, to, beside) - used));
}

/** The chip with ever less of its text. */
export const shorterLabels = (edge, chip) =>
  [90, 50].filter((room) => textWidth(chip.text, "label") > room + 10).map((room) => chipWith(edge, room));

function chipWith({ data }, room) {
  const { order, icon, badgeWidth } = partsOf(data);
  const text = truncate(data.label ?? "", "label", room);
  if (!order && !text && !icon) return null;
  const orderWidth = order ? textWidth(text || icon ? `${order} · ` : order, "label") + 1 : 0;
  const iconWidth = icon ? ICON : 0;
  const w = Math.ceil(2 * PADDING + orderWidth + iconWidth + (text ? textWidth(text, "label") : 0)) + badgeWidth;
  return { order, text, icon, orderWidth, iconWidth, badgeWidth, padding: PADDING, w, h: HEIGHT };
}

const partsOf = (data) => ({
  order: data.of > 1 ? String(data.order) : "",
  icon: data.disabled ? "off" : ["timer", "code", "tree"].includes(data.kind) ? data.kind : "",
  badgeWidth: data.severity ? BADGE : 0,
});

/**
 * How wide a text may be between two nodes: side by side no wider than the gap, else it would be pushed off its curve;
 * one above the other less when there are several. In steps of 10, so that a chip is not drawn anew at every movement.
 */
function roomBetween(from, to, beside) {
  const gap = Math.abs(to.x - from.x) - (from.w + to.w) / 2;
  if (from === to) return MAX_TEXT_WIDTH;
  if (gap < 30 || gap < 2 * (Math.abs(to.y - from.y) - from.h)) return beside > 2 ? CROWDED_ROOM : MAX_TEXT_WIDTH;
  return Math.min(MAX_TEXT_WIDTH, Math.max(MIN_TEXT_WIDTH, Math.floor((gap - 30) / 10) * 10));
}

/** The place `{at, cost}` where a label hides least; `crowd` says what a rectangle would hide, and may stop at a limit. */
export function placeLabel(edge, curve, chip, crowd) {
  const isLoop = edge.source === edge.target;
  let best = { cost: Infinity };
  for (const place of isLoop ? LOOP_PLACES : PLACES) {
    if (place.cost >= best.cost) break;
    const at = isLoop ? besideLoop(curve, chip, place.out) : besideLine(curve, chip, place);
    const cost = place.cost + crowd(rectAround(at.x, at.y, chip.w, chip.h), best.cost - place.cost);
    if (cost < best.cost) best = { at, cost };
  }
  return best;
}

/** The chip of a loop hangs on its outermost point, so that the loop itself stays visible. */
function besideLoop(curve, chip, out) {
  const apex = pointOnCurve(curve, 0.5);
  const foot = { x: (curve[0] + curve[6]) / 2, y: (curve[1] + curve[7]) / 2 };
  const [dx, dy] = [Math.sign(apex.x - foot.x), Math.sign(apex.y - foot.y)];
  if (Math.abs(apex.x - foot.x) < Math.abs(apex.y - foot.y)) return { x: apex.x + SLIPS[out] * chip.w * 0.4, y: apex.y + (out ? dy * 9 : 0) };
  return { x: apex.x + dx * (chip.w / 2 - 8), y: apex.y + SLIPS[out] * 18 };
}

/** On the line, or so far beside it that the line stays visible. */
function besideLine(curve, chip, { part, beside: side }) {
  if (!side) return pointOnCurve(curve, part);
  const [behind, ahead] = [pointOnCurve(curve, Math.max(0, part - 0.02)), pointOnCurve(curve, Math.min(1, part + 0.02))];
  const length = Math.hypot(ahead.x - behind.x, ahead.y - behind.y) || 1;
  const reach = (Math.abs(ahead.y - behind.y) * chip.w + Math.abs(ahead.x - behind.x) * chip.h) / length / 2;
  return beside(curve, part, Math.sign(side) * (reach + (Math.abs(side) === 1 ? 3 : 9)));
}

/** Where a label was put by hand: `part` of the way along the curve, `shift` to the right of who walks along it. */
export const labelPosition = (curve, [part, shift]) => beside(curve, Math.min(1, Math.max(0, part)), shift);

/** The `[part, shift]` that puts a label at a point, as near as can be: its foot on the curve, and how far beside. */
export function labelOffset(curve, { x, y }) {
  let best = { t: 0.5, reach: Infinity };
  for (let step = 0; step <= STEPS; step += 1) {
    const foot = pointOnCurve(curve, step / STEPS);
    const reach = (foot.x - x) ** 2 + (foot.y - y) ** 2;
    if (reach < best.reach) best = { t: step / STEPS, reach };
  }
  const foot = pointOnCurve(curve, best.t);
  const right = beside(curve, best.t, 1);
  return [best.t, Math.round((x - foot.x) * (right.x - foot.x) + (y - foot.y) * (right.y - foot.y))];
}

function beside(curve, t, shift) {
  const point = pointOnCurve(curve, t);
  if (!shift) return point;
  const [behind, ahead] = [pointOnCurve(curve, Math.max(0, t - 0.02)), pointOnCurve(curve, Math.min(1, t + 0.02))];
  const length = Math.hypot(ahead.x - behind.x, ahead.y - behind.y) || 1;
  return { x: point.x - ((ahead.y - behind.y) / length) * shift, y: point.y + ((ahead.x - behind.x) / length) * shift };
}
