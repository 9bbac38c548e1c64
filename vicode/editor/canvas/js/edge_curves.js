// The curves of the edges between one pair of nodes: parallel lanes that bend around other nodes, and self loops on free sides.
import { exitFrom, grow, curveLength, overlaps, pointOnCurve, quadraticToCubic, rectAround, nodeRect } from "./geometry.js";

const CLEARANCE = 8;
const LABEL_GAP = 6;
const MIN_LANE = 24;
const MAX_LANE = 100;
// Minimum distance between the start of a curve and the corners of its node.
const INSET = { x: 14, y: 12 };
// Tried in this order: straight first, then wider bows to either side around obstacles.
const BOWS = [0, 45, -45, 85, -85, 135, -135, 200, -200, 280, -280, 370, -370];
const FLAT_FROM = 85;
const SIDES = [
  { x: 0, y: -1 },
  { x: 1, y: 0 },
  { x: 0, y: 1 },
  { x: -1, y: 0 },
];

/** Returns curves for edges between two nodes, in lane order; `chips` are their labels, which need room between lanes. */
export function parallelCurves(edges, chips, scene) {
  const { pair, bent } = lanesBetween(edges, chips, scene);
  let best = null;
  for (const bow of BOWS) {
    for (const flat of Math.abs(bow) < FLAT_FROM ? [false] : [false, true]) {
      const curves = bent(bow, flat);
      const blocked = curves.reduce((sum, curve) => sum + boxesUnder(curve, pair, scene), 0);
      if (!best || blocked < best.blocked) best = { curves, blocked };
      if (blocked === 0) return curves;
    }
  }
  return best.curves;
}

/** Like `parallelCurves`, but ignores obstacles. */
export const straightCurves = (edges, chips, scene) => lanesBetween(edges, chips, scene).bent(0, false);

function lanesBetween(edges, chips, scene) {
  const [from, to] = readingOrder(scene.nodes.get(edges[0].source), scene.nodes.get(edges[0].target));
  const pair = { from, to, normal: normalOf(from, to) };
  const lanes = lanesOf(chips, pair.normal);
  return { pair, bent: (bow, flat) => edges.map((edge, index) => bend(edge, pair, { lane: lanes[index], bow, flat })) };
}

/** Places self loops on the least crowded sides; from the fifth loop on they enclose the first ones. */
export function selfLoopCurves(edges, chips, scene) {
  const node = scene.nodes.get(edges[0].source);
  const room = chips.reduce((most, chip) => Math.max(most, chip?.w ?? 0), 40);
  const sides = SIDES.map((side) => ({ side, load: sideLoad(node, side, room, scene) })).sort((a, b) => a.load - b.load);
  return edges.map((_, index) => loop(node, sides[index % 4].side, Math.floor(index / 4)));
}

/** Orders two nodes: the left one first, or the upper one if they are stacked. */
export function readingOrder(a, b) {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const isFirst = Math.abs(dx) > 0.4 * Math.abs(dy) ? dx > 0 : dy > 0 || (dy === 0 && a.key < b.key);
  return isFirst ? [a, b] : [b, a];
}

/** Unit normal of the line between two nodes: it points down, or to the right if the nodes are stacked. */
function normalOf(from, to) {
  const length = Math.hypot(to.x - from.x, to.y - from.y) || 1;
  const sign = Math.abs(to.x - from.x) > 0.4 * Math.abs(to.y - from.y) ? 1 : -1;
  return { x: (-sign * (to.y - from.y)) / length, y: (sign * (to.x - from.x)) / length };
}

/** Returns the offset of each lane from the center line, so that labels of neighboring lanes do not touch. */
function lanesOf(chips, normal) {
  const offsets = [0];
  for (let index = 1; index < chips.length; index += 1) {
    const [one, other] = [chips[index - 1], chips[index]];
    const wide = ((one?.w ?? 0) + (other?.w ?? 0)) / 2 + LABEL_GAP;
    const high = Math.max(one?.h ?? 0, other?.h ?? 0) + LABEL_GAP;
    const gap = Math.min(wide / Math.abs(normal.x || 1e-9), high / Math.abs(normal.y || 1e-9));
    offsets.push(offsets[index - 1] + Math.min(MAX_LANE, Math.max(MIN_LANE, gap)));
  }
  const middle = offsets.at(-1) / 2;
  return offsets.map((offset) => offset - middle);
}

/** A curve in a lane: its ends are shifted as far as the nodes allow; the rest of the offset, and `bow`, bend it. */
function bend(edge, { from, to, normal }, { lane, bow, flat }) {
  const maxShift = Math.min(...[from, to].map((node) => roomAcross(node, normal)));
  const inner = Math.max(-maxShift, Math.min(maxShift, lane));
  const apex = lane - inner + bow;
  const [source, target] = edge.source === from.key ? [from, to] : [to, from];
  const [start, end] = [source, target].map(({ x, y }) => ({ x: x + normal.x * inner, y: y + normal.y * inner }));
  const along = (part, out) => ({
    x: start.x + (end.x - start.x) * part + normal.x * out,
    y: start.y + (end.y - start.y) * part + normal.y * out,
  });
  if (!flat) {
    const control = along(0.5, apex * 2);
    return quadraticToCubic(exitFrom(source, start, control), control, exitFrom(target, end, control));
  }
  const [first, second] = [along(0.12, (apex * 4) / 3), along(0.88, (apex * 4) / 3)];
  const [p, q] = [exitFrom(source, start, first), exitFrom(target, end, second)];
  return [p.x, p.y, first.x, first.y, second.x, second.y, q.x, q.y];
}

function roomAcross(node, normal) {
  const wide = (node.w / 2 - INSET.x) / Math.abs(normal.x || 1e-9);
  const high = (node.h / 2 - INSET.y) / Math.abs(normal.y || 1e-9);
  return Math.min(wide, high);
}

/** Counts the nodes that a curve crosses, sampled in steps smaller than a node. */
function boxesUnder(curve, { from, to }, scene) {
  const hit = new Set();
  const steps = Math.min(120, Math.max(8, Math.ceil(curveLength(curve) / 24)));
  for (let step = 1; step < steps; step += 1) {
    const { x, y } = pointOnCurve(curve, step / steps);
    for (const key of scene.nodeGrid.at(x, y)) {
      const box = scene.nodes.get(key);
      if (box === from || box === to) continue;
      if (Math.abs(x - box.x) < box.w / 2 + CLEARANCE && Math.abs(y - box.y) < box.h / 2 + CLEARANCE) hit.add(key);
    }
  }
  return hit.size;
}

function sideLoad(node, side, room, scene) {
  // The initial mark is at the upper left, which makes the top side less free.
  let load = side.y === -1 && node.data.initial ? 1.5 : 0;
  if (side.x !== 0) load += 0.2;
  for (const edge of scene.edgesOf(node.key)) {
    const other = scene.nodes.get(edge.source === node.key ? edge.target : edge.source);
    if (!other || other === node || !scene.isDrawable(edge)) continue;
    const length = Math.hypot(other.x - node.x, other.y - node.y) || 1;
    const facing = ((other.x - node.x) * side.x + (other.y - node.y) * side.y) / length;
    load += Math.max(0, facing) ** 2;
  }
  const [w, h] = side.x ? [62 + room - 16, 70] : [Math.max(room, 80), 76];
  const area = rectAround(node.x + (side.x * (node.w + w)) / 2, node.y + (side.y * (node.h + h)) / 2, w, h);
  for (const key of scene.nodeGrid.query(area)) {
    const other = scene.nodes.get(key);
    if (other && other !== node && overlaps(grow(nodeRect(other), 4), area)) load += 3;
  }
  return load;
}

function loop(node, side, ring) {
  const reach = 62 + ring * 26;
  const half = 16 + ring * 6;
  const spread = half + 18;
  const along = { x: -side.y, y: side.x };
  const foot = { x: node.x + side.x * (node.w / 2), y: node.y + side.y * (node.h / 2) };
  const at = (across, out) => [foot.x + along.x * across + side.x * out, foot.y + along.y * across + side.y * out];
  return [...at(-half, 0), ...at(-spread, reach), ...at(spread, reach), ...at(half, 0)];
}
