// The SVG groups of edges: a curve with an arrow head in the edge layer, and its label (chip) in the label layer.
import { badge, findingMessages, kindOf } from "./node_svg.js";
import { BADGE } from "./edge_labels.js";
import { translateElement, placeGroup } from "./group_transforms.js";
import { DISABLED, linkName, transitionName, transitionTitle } from "./strings.js";
import { svg } from "./svg.js";

const HEAD = 10;
const ICONS = {
  off: "M0 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0M1.6 3.4L8.4 -3.4",
  timer: "M0 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0M5 -2.6V0.3L7 1.6",
  code: "M3 -3.5L-0.2 0L3 3.5M7 -3.5L10.2 0L7 3.5",
  tree: "M1.5 -4.5V0C1.5 2.5 3 3 5.5 3H8.5M1.5 -1C1.5 -3 4 -3 8.5 -3",
};

/** Returns the groups of an edge: `line` for the edge layer and `chip` for the label layer, or null. */
export function drawEdge(edge, route, ends) {
  const names = { "data-id": edge.id, "data-kind": kindOf(edge), "data-key": edge.key, "data-text": route.chip?.text ?? "" };
  const style = ["item", "edge", kindOf(edge), edge.of === "links" ? edge.data.kind : edge.data.kind ?? "", styleOf(edge)].join(" ");
  const line = svg("g", { class: style, ...names, role: "button", tabindex: "-1", "aria-label": describe(edge, ends) }, [
    svg("path", { class: "hit" }),
    svg("path", { class: "line" }),
    svg("path", { class: "head" }),
  ]);
  const chip = route.chip || edge.data.severity ? drawChip(edge, route, names) : null;
  placeEdge({ line, chip }, route);
  return { line, chip };
}

export function placeEdge({ line, chip }, { curve, at }) {
  line.children[0].setAttribute("d", pathOf(curve, { x: curve[6], y: curve[7] }));
  placeLine({ line }, curve);
  if (chip) placeGroup(chip, round(at.x), round(at.y));
}

/** Updates only the visible parts of the line, not its hit area. */
export function placeLine({ line }, curve) {
  const [, stroke, head] = line.children;
  const { tip, base } = headOf(curve);
  if (!line.classList.contains("leads-back")) {
    stroke.setAttribute("d", pathOf(curve, base));
    head.setAttribute("d", tip);
    return;
  }
  const start = headOf([6, 7, 4, 5, 2, 3, 0, 1].map((index) => curve[index]));
  stroke.setAttribute("d", pathOf([start.base.x, start.base.y, ...curve.slice(2)], base));
  head.setAttribute("d", tip + start.tip);
}

/** Path data of a curve that ends at `end` instead of its last point. */
export const pathOf = (c, end) =>
  `M${round(c[0])} ${round(c[1])}C${round(c[2])} ${round(c[3])} ${round(c[4])} ${round(c[5])} ${round(end.x)} ${round(end.y)}`;

/** Path data of the arrow head, and the point where the line meets it. */
export function headOf(curve) {
  const dx = curve[6] - curve[4];
  const dy = curve[7] - curve[5];
  const length = Math.hypot(dx, dy) || 1;
  const u = { x: dx / length, y: dy / length };
  const base = { x: curve[6] - u.x * HEAD, y: curve[7] - u.y * HEAD };
  const side = { x: -u.y * HEAD * 0.42, y: u.x * HEAD * 0.42 };
  const corner = (sign) => `${round(base.x + sign * side.x)} ${round(base.y + sign * side.y)}`;
  const notch = `${round(base.x + u.x * 2)} ${round(base.y + u.y * 2)}`;
  return { tip: `M${round(curve[6])} ${round(curve[7])}L${corner(1)}L${notch}L${corner(-1)}Z`, base: { x: base.x + u.x * 2, y: base.y + u.y * 2 } };
}

function drawChip(edge, { chip }, names) {
  const group = svg("g", { class: `item chip ${kindOf(edge)} ${styleOf(edge)}`, ...names, "aria-hidden": "true" });
  if (chip) {
    const { w, h, padding, orderWidth, iconWidth, badgeWidth } = chip;
    let x = -w / 2 + padding;
    group.append(svg("rect", { class: "plate bg", x: -w / 2, y: -h / 2, width: w - badgeWidth, height: h, rx: h / 2 }));
    if (chip.order) group.append(svg("text", { class: "order", x, text: chip.text || chip.icon ? `${chip.order} · ` : chip.order }));
    x += orderWidth;
    if (chip.icon) group.append(translateElement(svg("path", { class: "icon", d: ICONS[chip.icon] }), x, 0));
    x += iconWidth;
    if (chip.text) group.append(svg("text", { class: "label", x, text: chip.text }));
  }
  if (edge.data.severity) group.append(badge(edge.data, chip ? (chip.w - BADGE) / 2 + 2 : 0, 0));
  return group;
}

const styleOf = (edge) => [edge.source === "common" ? "common-edge" : "", edge.data.disabled ? "disabled" : "", edge.data.dead ? "dead" : "", edge.data.derived ? "derived" : "", edge.data.leads_back ? "leads-back" : ""].join(" ");

/** Returns the tooltip of an edge, with its full text: the label may be truncated. */
export function edgeTooltip(edge, { source, target }) {
  const { data } = edge;
  if (edge.of === "links") return linkName(data);
  return [transitionTitle(data, source, target), data.disabled && DISABLED, data.doc || data.label, ...findingMessages(data)].filter(Boolean).join("\n");
}

function describe(edge, { source, target }) {
  const { data } = edge;
  if (edge.of === "links") return edgeTooltip(edge, { source, target });
  const label = data.label ? `: ${data.label}` : "";
  return [transitionName(data, source, target) + label, ...(data.disabled ? [DISABLED] : []), ...findingMessages(data)].join(", ");
}

const round = (value) => Math.round(value * 10) / 10;
