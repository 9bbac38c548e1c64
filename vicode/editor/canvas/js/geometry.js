// Rectangles, cubic curves and the points where a ray leaves a shape. Pure functions in world units.

export const SNAP = 10;
export const HEX_SLANT = 16;

export const snap = (value) => Math.round(value / SNAP) * SNAP;

export const nodeRect = (node) => ({ x: node.x - node.w / 2, y: node.y - node.h / 2, w: node.w, h: node.h });

/** Distance of a point from the outline of a node; negative inside. */
export function distanceToOutline({ x, y, w, h }, at) {
  const [dx, dy] = [Math.abs(at.x - x) - w / 2, Math.abs(at.y - y) - h / 2];
  return Math.max(dx, dy) < 0 ? Math.max(dx, dy) : Math.hypot(Math.max(dx, 0), Math.max(dy, 0));
}

export const rectAround = (x, y, w, h) => ({ x: x - w / 2, y: y - h / 2, w, h });

export const rectBetween = (a, b) => ({
  x: Math.min(a.x, b.x),
  y: Math.min(a.y, b.y),
  w: Math.abs(a.x - b.x),
  h: Math.abs(a.y - b.y),
});

export const grow = (rect, margin) => ({ x: rect.x - margin, y: rect.y - margin, w: rect.w + 2 * margin, h: rect.h + 2 * margin });

export const overlaps = (a, b) => a.x < b.x + b.w && b.x < a.x + a.w && a.y < b.y + b.h && b.y < a.y + a.h;

export const containsPoint = (rect, x, y) => x >= rect.x && x <= rect.x + rect.w && y >= rect.y && y <= rect.y + rect.h;

export const containsRect = (outer, inner) =>
  containsPoint(outer, inner.x, inner.y) && containsPoint(outer, inner.x + inner.w, inner.y + inner.h);

/** Returns the bounding rectangle of all rectangles, or null if there are none. */
export function bounds(rects) {
  let x0 = Infinity;
  let y0 = Infinity;
  let x1 = -Infinity;
  let y1 = -Infinity;
  for (const rect of rects) {
    x0 = Math.min(x0, rect.x);
    y0 = Math.min(y0, rect.y);
    x1 = Math.max(x1, rect.x + rect.w);
    y1 = Math.max(y1, rect.y + rect.h);
  }
  return x0 === Infinity ? null : { x: x0, y: y0, w: x1 - x0, h: y1 - y0 };
}

/** Returns the point where the ray from a node's center to (x, y) leaves its shape. */
export const exitPoint = (node, x, y) => exitFrom(node, node, { x, y });

/** Returns the point where the ray from a point inside a node to another point leaves the node's shape. */
export function exitFrom(node, from, towards) {
  const [dx, dy] = [towards.x - from.x, towards.y - from.y];
  const [x, y] = [from.x - node.x, from.y - node.y];
  if (dx === 0 && dy === 0) return { x: node.x, y: node.y - node.h / 2 };
  let reach = Math.min(stretch(x, dx, node.w / 2), stretch(y, dy, node.h / 2));
  if (node.of === "components") {
    // The slanted sides of the hexagon: |x| + slant * |y| / (h/2) = w/2.
    const slope = HEX_SLANT / (node.h / 2);
    for (const sign of [-1, 1]) reach = Math.min(reach, stretch(x + sign * slope * y, dx + sign * slope * dy, node.w / 2));
  }
  return { x: from.x + dx * reach, y: from.y + dy * reach };
}

/** Returns the factor `t` for which `value + t * delta` reaches the border ±half. */
function stretch(value, delta, half) {
  return delta === 0 ? Infinity : (Math.sign(delta) * half - value) / delta;
}

/** A cubic curve is an array of eight numbers: start, two control points, end. This converts a quadratic curve. */
export const quadraticToCubic = (p, c, q) => [
  p.x,
  p.y,
  p.x + (2 / 3) * (c.x - p.x),
  p.y + (2 / 3) * (c.y - p.y),
  q.x + (2 / 3) * (c.x - q.x),
  q.y + (2 / 3) * (c.y - q.y),
  q.x,
  q.y,
];

export function pointOnCurve(curve, t) {
  const u = 1 - t;
  const a = u * u * u;
  const b = 3 * u * u * t;
  const c = 3 * u * t * t;
  const d = t * t * t;
  return {
    x: a * curve[0] + b * curve[2] + c * curve[4] + d * curve[6],
    y: a * curve[1] + b * curve[3] + c * curve[5] + d * curve[7],
  };
}

/** Returns the bounding rectangle of the control points, which contains the curve. */
export function curveBounds(curve) {
  const xs = [curve[0], curve[2], curve[4], curve[6]];
  const ys = [curve[1], curve[3], curve[5], curve[7]];
  const x = Math.min(...xs);
  const y = Math.min(...ys);
  return { x, y, w: Math.max(...xs) - x, h: Math.max(...ys) - y };
}

/** Returns the squared distance from a point to a curve, sampled: precise enough for hit testing. */
export function distanceToCurve(curve, x, y) {
  let best = Infinity;
  for (let step = 0; step <= 24; step += 1) {
    const point = pointOnCurve(curve, step / 24);
    best = Math.min(best, (point.x - x) ** 2 + (point.y - y) ** 2);
  }
  return best;
}

/** Upper bound of the length of a curve: the length of its control polygon. */
export const curveLength = (c) =>
  Math.hypot(c[2] - c[0], c[3] - c[1]) + Math.hypot(c[4] - c[2], c[5] - c[3]) + Math.hypot(c[6] - c[4], c[7] - c[5]);

/** Returns points along a curve as an approximation of it. */
export function sampleCurve(curve, length) {
  const steps = Math.min(32, Math.max(4, Math.ceil(length / 40)));
  return Array.from({ length: steps + 1 }, (_, step) => pointOnCurve(curve, step / steps));
}

/** Whether a polyline touches a rectangle. */
export function polylineTouches(points, rect) {
  let before = sidesOf(points[0], rect);
  for (let index = 1; index < points.length; index += 1) {
    const sides = sidesOf(points[index], rect);
    // Fast path for segments beyond one side of the rectangle, which are nearly all of thousands.
    if ((before & sides) === 0 && touches(points[index - 1], points[index], rect)) return true;
    before = sides;
  }
  return false;
}

/** Bit set of the sides of a rectangle that a point lies beyond. */
const sidesOf = ({ x, y }, rect) =>
  (x < rect.x ? 1 : x > rect.x + rect.w ? 2 : 0) | (y < rect.y ? 4 : y > rect.y + rect.h ? 8 : 0);

/** Whether a segment that is not entirely beyond one side of a rectangle intersects it. */
function touches(a, b, rect) {
  const [right, bottom] = [rect.x + rect.w, rect.y + rect.h];
  if (a.x === b.x || a.y === b.y) return true;
  // Only an oblique segment that passes a corner misses; then all four corners lie on one side of it.
  const side = (x, y) => (b.x - a.x) * (y - a.y) > (b.y - a.y) * (x - a.x);
  const first = side(rect.x, rect.y);
  return side(right, rect.y) !== first || side(rect.x, bottom) !== first || side(right, bottom) !== first;
}
