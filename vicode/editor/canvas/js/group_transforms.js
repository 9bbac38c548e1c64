// Positions of SVG groups. Whenever one element with a transform moves, the browser visits all elements with a transform;
// with a thousand this takes longer than a frame. So positions are baked into coordinates, except during a drag.

const drawnAt = new WeakMap();
const ORIGIN = { x: 0, y: 0 };

/** Moves a group, drawn around the origin, to a position, which is also stored in `data-at`. */
export function placeGroup(group, ...position) {
  const [x, y] = position.map(round);
  const from = drawnAt.get(group) ?? ORIGIN;
  group.dataset.at = `${x} ${y}`;
  if (isHeld(group)) return group.setAttribute("transform", `translate(${x - from.x} ${y - from.y})`);
  group.removeAttribute("transform");
  if (x !== from.x || y !== from.y) translateElement(group, x - from.x, y - from.y);
  drawnAt.set(group, { x, y });
}

/** Replaces the transform of a group after a drag by coordinates. */
export function bakeTransform(group) {
  if (group.hasAttribute("transform")) placeGroup(group, ...group.dataset.at.split(" ").map(Number));
}

/** Returns the point around which the coordinates of a group are drawn. */
export const groupOrigin = (group) => drawnAt.get(group) ?? ORIGIN;

/** Moves an element and its children by changing their coordinates; returns the element. */
export function translateElement(element, dx, dy) {
  if (element.tagName === "g") for (const child of element.children) translateElement(child, dx, dy);
  else if (element.tagName === "path") element.setAttribute("d", shiftPath(element.getAttribute("d"), dx, dy));
  else if (element.tagName === "circle") add(element, { cx: dx, cy: dy });
  else add(element, { x: dx, y: dy });
  return element;
}

const isHeld = (group) => Boolean(group.parentNode?.classList.contains("held"));

function add(element, offsets) {
  for (const [name, value] of Object.entries(offsets)) element.setAttribute(name, round(Number(element.getAttribute(name) ?? 0) + value));
}

/** Only uppercase commands have absolute coordinates. Absolute arcs are not supported. */
const shiftPath = (path, dx, dy) =>
  path.replace(/([MLHVCQ])([^A-Za-z]*)/g, (_, command, numbers) => command + shiftNumbers(command, numbers, dx, dy));

function shiftNumbers(command, numbers, dx, dy) {
  const isAcross = (index) => command === "H" || (command !== "V" && index % 2 === 0);
  return numbers.match(/-?[\d.]+/g).map((number, index) => round(Number(number) + (isAcross(index) ? dx : dy))).join(" ");
}

// Rounded, so that errors do not accumulate when a group is moved often.
const round = (value) => Math.round(value * 100) / 100;
