// The breakpoint sign: a disc with a square in it, at a corner of a node or in front of a label.
import { groupOrigin, translateElement } from "./group_transforms.js";
import { svg } from "./svg.js";

const R = 7;

/** Shows or hides the sign on the SVG groups of an element. */
export function showBreakpoint(item, element, on) {
  const part = item?.node ?? item?.chip ?? item?.line;
  if (!part) return;
  part.querySelector(":scope > .breakpoint-sign")?.remove();
  if (!on) return;
  const shapes = [svg("circle", { r: R }), svg("rect", { x: -2.5, y: -2.5, width: 5, height: 5 })];
  const { x, y } = positionOf(item, element);
  part.append(translateElement(svg("g", { class: "breakpoint-sign", "aria-hidden": "true" }, shapes), x, y));
}

function positionOf(item, element) {
  if (!item.node && !item.chip) return halfway(item.line.children[1]);
  const { x, y } = groupOrigin(item.node ?? item.chip);
  if (item.node) return { x: x + 3 - element.w / 2, y: y + element.h / 2 - 3 };
  const plate = item.chip.querySelector(".plate");
  return { x: plate ? Number(plate.getAttribute("x")) - R + 3 : x - 18, y };
}

const halfway = (path) => path.getPointAtLength(path.getTotalLength() / 2);
