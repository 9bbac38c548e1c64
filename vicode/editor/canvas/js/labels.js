// The chip on a transition: what it says, how large it is, and where along the curve it fits.
import { pointAt, rectAround } from "./geometry.js";
import { shorten, textWidth } from "./text.js";

const HEIGHT = 22;
const PADDING = 8;
const ICON = 15;
// The mark of findings stands behind the text, within the chip's room, so that it hides nothing.
export const BADGE = 24;
const MOST_ROOM = 150;
const LEAST_ROOM = 60;
const PLACES = [0.5, 0.42, 0.58, 0.34, 0.66, 0.27, 0.73, 0.2, 0.8];
const SHIFTS = [0, -14, 14, -26, 26];

/**
 * How wide a text may be on a curve: between two boxes side by side no wider than the gap, else it would be pushed off its curve.
 * In steps of 10, so that a chip is not drawn anew at every movement.
 */
function roomOn(curve) {
  const [dx, dy] = [Math.abs(curve[6] - curve[0]), Math.abs(curve[7] - curve[1])];
  if (dx < 2 * dy || dx < 30) return MOST_ROOM;
  return Math.min(MOST_ROOM, Math.max(LEAST_ROOM, Math.floor((dx - 30) / 10) * 10));
}

/** What the chip of an edge shows and its size, or null when there is nothing to say. */
export function chipOf(edge, curve) {
  if (edge.of !== "transitions") return null;
  const { data } = edge;
  const order = data.of > 1 ? String(data.order) : "";
  const icon = ["timer", "code", "tree"].includes(data.kind);
  const badgeWidth = data.severity ? BADGE : 0;
  const used = (order ? 18 : 0) + (icon ? ICON : 0) + badgeWidth;
  const isLoop = edge.source === edge.target;
  const text = shorten(data.label ?? "", "label", isLoop ? MOST_ROOM : Math.max(LEAST_ROOM, roomOn(curve) - used));
  if (!order && !text && !icon) return null;
  const orderWidth = order ? textWidth(text || icon ? `${order} · ` : order, "label") + 1 : 0;
  const iconWidth = icon ? ICON : 0;
  const w = Math.ceil(2 * PADDING + orderWidth + iconWidth + (text ? textWidth(text, "label") : 0)) + badgeWidth;
  return { order, text, icon: icon ? data.kind : "", orderWidth, iconWidth, badgeWidth, padding: PADDING, w, h: HEIGHT };
}

/** The first free place along the curve, beside it when there is none on it, else the least crowded. */
export function placeLabel(curve, chip, crowd) {
  const middle = pointAt(curve, 0.5);
  if (!chip) return middle;
  let best = { at: middle, cost: Infinity };
  for (const shift of SHIFTS) {
    for (const t of PLACES) {
      const at = beside(curve, t, shift);
      const cost = crowd(rectAround(at.x, at.y, chip.w, chip.h));
      if (cost < best.cost) best = { at, cost };
      if (cost === 0) return at;
    }
  }
  return best.at;
}

/** Where a label was put by hand: `part` of the way along the curve, `shift` to the right of who walks along it. */
export const labelAt = (curve, [part, shift]) => beside(curve, Math.min(1, Math.max(0, part)), shift);

/** The `[part, shift]` that puts a label at a point, as near as can be: its foot on the curve, and how far beside. */
export function labelPlace(curve, { x, y }) {
  let best = { t: 0.5, reach: Infinity };
  for (let step = 0; step <= 100; step += 1) {
    const foot = pointAt(curve, step / 100);
    const reach = (foot.x - x) ** 2 + (foot.y - y) ** 2;
    if (reach < best.reach) best = { t: step / 100, reach };
  }
  const foot = pointAt(curve, best.t);
  const right = beside(curve, best.t, 1);
  return [best.t, Math.round((x - foot.x) * (right.x - foot.x) + (y - foot.y) * (right.y - foot.y))];
}

function beside(curve, t, shift) {
  const point = pointAt(curve, t);
  if (!shift) return point;
  const [behind, ahead] = [pointAt(curve, Math.max(0, t - 0.02)), pointAt(curve, Math.min(1, t + 0.02))];
  const length = Math.hypot(ahead.x - behind.x, ahead.y - behind.y) || 1;
  return { x: point.x - ((ahead.y - behind.y) / length) * shift, y: point.y + ((ahead.x - behind.x) / length) * shift };
}
