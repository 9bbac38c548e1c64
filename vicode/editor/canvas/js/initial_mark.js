// The mark of the initial state: a dot and an arrow at the corner of the node where they cover the fewest lines and labels.
import { grow, nodeRect, overlaps, polylineTouches } from "./geometry.js";
import { groupOrigin, translateElement } from "./group_transforms.js";
import { svg } from "./svg.js";

// Upper left first; a corner is a pair of signs.
const CORNERS = [
  [-1, -1],
  [1, -1],
  [-1, 1],
  [1, 1],
];
const [OUT, RISE, INSET, RADIUS] = [12, 20, 22, 6];

/** Draws the mark of a mounted node again, at its best corner. */
export function placeInitialMark(group, node, scene, router) {
  const corner = CORNERS.map((signs) => ({ signs, cost: covered(markRect(node, signs), node, scene, router) })).reduce((a, b) => (b.cost < a.cost ? b : a));
  const { x, y } = groupOrigin(group);
  const mark = translateElement(svg("g", { class: "initial" }, initialMark(node, corner.signs)), x, y);
  const old = group.querySelector(".initial");
  if (old) old.replaceWith(mark);
  else group.append(mark);
}

function initialMark({ w, h }, [across, down]) {
  const [x, y] = [across * (w / 2 + OUT), down * (h / 2 + RISE)];
  const tip = [across * (w / 2 - INSET), down * (h / 2 + 1)];
  return [
    svg("path", { class: "start", d: `M${x} ${y}Q${tip[0]} ${y} ${tip[0]} ${tip[1] + down * 6}` }),
    svg("path", { class: "start-head", d: `M${tip[0]} ${tip[1]}l-4.5 ${down * 8}h9Z` }),
    svg("circle", { class: "start-dot", cx: x, cy: y, r: RADIUS }),
  ];
}

function markRect(node, [across, down]) {
  const w = OUT + INSET + RADIUS + 5;
  const h = RISE + RADIUS;
  const x = node.x + across * (node.w / 2 - INSET - 5);
  const y = node.y + (down * node.h) / 2;
  return { x: across < 0 ? x - w : x, y: down < 0 ? y - h : y, w, h };
}

/** How many edges, labels and other nodes a mark in this rectangle would cover. */
function covered(rect, node, scene, router) {
  let sum = 0;
  for (const key of scene.nodeGrid.query(rect)) if (key !== node.key && overlaps(nodeRect(scene.nodes.get(key)), rect)) sum += 1;
  for (const key of router.labels.query(rect)) if (overlaps(router.labelRects.get(key), rect)) sum += 1;
  for (const key of scene.edgeGrid.query(grow(rect, 160))) {
    const edge = scene.edges.get(key);
    if (scene.isDrawable(edge) && polylineTouches(router.edgePath(edge).points, rect)) sum += 1;
  }
  return sum;
}
