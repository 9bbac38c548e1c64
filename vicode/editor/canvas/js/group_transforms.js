// Where groups stand. A browser goes through all elements that have a transform whenever one of them moves, which with a
// thousand takes longer than a frame. So what rests has its place in its coordinates; only what is held has a transform.

const drawnAt = new WeakMap();
const ORIGIN = { x: 0, y: 0 };

/** Puts a group, drawn around the origin, at a place; it tells that place in `data-at`. */
export function placeGroup(group, ...at) {
  const [x, y] = at.map(round);
  const from = drawnAt.get(group) ?? ORIGIN;
  group.dataset.at = `${x} ${y}`;
  if (isHeld(group)) return group.setAttribute("transform", `translate(${x - from.x} ${y - from.y})`);
  group.removeAttribute("transform");
  if (x !== from.x || y !== from.y) translateElement(group, x - from.x, y - from.y);
  drawnAt.set(group, { x, y });
}

/** A group that was held rests again. */
export function bakeTransform(group) {
  if (group.hasAttribute("transform")) placeGroup(group, ...group.dataset.at.split(" ").map(Number));
}

/** The point that the coordinates of a group are drawn around. */
export const groupOrigin = (group) => drawnAt.get(group) ?? ORIGIN;

/** Moves an element, and all in it, by changing its coordinates; returns it. */
export function translateElement(element, dx, dy) {
  if (element.tagName === "g") for (const child of element.children) translateElement(child, dx, dy);
  else if (element.tagName === "path") element.setAttribute("d", shiftPath(element.getAttribute("d"), dx, dy));
  else if (element.tagName === "circle") add(element, { cx: dx, cy: dy });
  else add(element, { x: dx, y: dy });
  return element;
}

const isHeld = (group) => Boolean(group.parentNode?.classList.contains("held"));

function add(element, by) {
  for (const [name, value] of Object.entries(by)) element.setAttribute(name, round(Number(element.getAttribute(name) ?? 0) + value));
}

/** Only commands in capitals have coordinates; the others go on from where the pen is. Arcs in capitals are not drawn here. */
const shiftPath = (path, dx, dy) =>
  path.replace(/([MLHVCQ])([^A-Za-z]*)/g, (_, command, numbers) => command + shiftNumbers(command, numbers, dx, dy));

function shiftNumbers(command, numbers, dx, dy) {
  const isAcross = (index) => command === "H" || (command !== "V" && index % 2 === 0);
  return numbers.match(/-?[\d.]+/g).map((number, index) => round(Number(number) + (isAcross(index) ? dx : dy))).join(" ");
}

// On a grid, so that no errors add up when a group is moved often.
const round = (value) => Math.round(value * 100) / 100;
