// Positions of nodes after aligning and distributing, and free positions for new states. Pure functions.
import { bounds, grow, overlaps, rectAround, nodeRect, snap } from "./geometry.js";

const NEW_STATE = { w: 120, h: 60 };
const STEP = { x: 180, y: 120 };
const GAP = 20;
const MAX_TRIES = 400;

const SIDES = {
  left: (box, all) => ({ x: all.x + box.w / 2 }),
  center: (_box, all) => ({ x: all.x + all.w / 2 }),
  right: (box, all) => ({ x: all.x + all.w - box.w / 2 }),
  top: (box, all) => ({ y: all.y + box.h / 2 }),
  middle: (_box, all) => ({ y: all.y + all.h / 2 }),
  bottom: (box, all) => ({ y: all.y + all.h - box.h / 2 }),
};

/** Returns the new centers, by key, of nodes aligned at one side of their common bounds; `how` is "align-left", … */
export function align(boxes, how) {
  const all = bounds(boxes.map(nodeRect));
  const alignedCenter = SIDES[how.replace("align-", "")];
  return new Map(boxes.map((box) => [box.key, rounded({ x: box.x, y: box.y, ...alignedCenter(box, all) })]));
}

/** Returns the new centers, by key, of nodes with equal gaps between them; the first and the last node stay. */
export function distribute(boxes, how) {
  const [axis, size] = how === "distribute-across" ? ["x", "w"] : ["y", "h"];
  const row = [...boxes].sort((a, b) => a[axis] - b[axis]);
  const first = row[0];
  const last = row.at(-1);
  const inside = row.slice(1, -1).reduce((sum, box) => sum + box[size], 0);
  const gap = (last[axis] - last[size] / 2 - (first[axis] + first[size] / 2) - inside) / (row.length - 1);
  let edge = first[axis] + first[size] / 2;
  const positions = new Map();
  for (const box of row.slice(1, -1)) {
    positions.set(box.key, rounded({ x: box.x, y: box.y, [axis]: edge + gap + box[size] / 2 }));
    edge += gap + box[size];
  }
  return positions;
}

/** Returns the nearest position to the right of or below (x, y) where a new state covers no node. */
export function findFreePosition(scene, x, y) {
  for (let ring = 0, tries = 0; tries < MAX_TRIES; ring += 1) {
    for (let column = 0; column <= ring; column += 1, tries += 1) {
      const position = { x: snap(x + column * STEP.x), y: snap(y + (ring - column) * STEP.y) };
      if (isFree(scene, position)) return position;
    }
  }
  return { x: snap(x), y: snap(y) };
}

function isFree(scene, { x, y }) {
  const area = grow(rectAround(x, y, NEW_STATE.w, NEW_STATE.h), GAP);
  return ![...scene.nodeGrid.query(area)].some((key) => overlaps(nodeRect(scene.nodes.get(key)), area));
}

const rounded = ({ x, y }) => ({ x: Math.round(x), y: Math.round(y) });
