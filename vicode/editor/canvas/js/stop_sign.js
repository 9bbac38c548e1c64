// The sign of a breakpoint: a disc with a square in it, at a corner of a box or before a label.
import { svg } from "./svg.js";

const R = 7;

/** Shows or hides the sign on what is drawn of a thing. */
export function showStop(item, thing, on) {
  const part = item?.node ?? item?.chip ?? item?.line;
  if (!part) return;
  part.querySelector(":scope > .stop-sign")?.remove();
  if (!on) return;
  part.append(svg("g", { class: "stop-sign", transform: placeOf(item, thing), "aria-hidden": "true" }, [
    svg("circle", { r: R }),
    svg("rect", { x: -2.5, y: -2.5, width: 5, height: 5 }),
  ]));
}

function placeOf(item, thing) {
  if (item.node) return `translate(${3 - thing.w / 2} ${thing.h / 2 - 3})`;
  if (!item.chip) return halfway(item.line.children[1]);
  const plate = item.chip.querySelector(".plate");
  return plate ? `translate(${Number(plate.getAttribute("x")) - R + 3} 0)` : "translate(-18 0)";
}

function halfway(path) {
  const { x, y } = path.getPointAtLength(path.getTotalLength() / 2);
  return `translate(${x} ${y})`;
}
