// The SVG groups of nodes: states, components and the common badge. Marks differ in shape, not only in color.
import { HEX_SLANT } from "./geometry.js";
import { translateElement, placeGroup } from "./group_transforms.js";
import { CHANGED_OUTSIDE, COMMON_TITLE, DISABLED, alias, colored, commonName, componentName, markName, noteName, stateName } from "./strings.js";
import { svg } from "./svg.js";
import { largestLines } from "./text_metrics.js";

const MARK_ROW = 16;
const NAME_RISE = -8;
const MARK_GAP = 9;
const NOTE_LINE = 16;
const NOTE_PADDING = 12;
const FOLD = 10;
const MARKS = {
  enter: { w: 11, d: "M0 0H7M4.5 -2.8L7.3 0L4.5 2.8M10.3 -4V4" },
  actions: { w: 10, d: "M0 -3.5H10M0 0H10M0 3.5H6" },
  leave: { w: 11, d: "M0.7 -4V4M3.5 0H10.5M8 -2.8L10.8 0L8 2.8" },
  requires: { w: 10, d: "M2.5 -4H7.5L10 0L7.5 4H2.5L0 0Z" },
  modulates: { w: 10, d: "M2.5 -4H7.5L10 0L7.5 4H2.5L0 0Z" },
};

const OFF = "M0 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0M1.6 3.4L8.4 -3.4";

export function drawNode(node) {
  const draw = { states: drawState, components: drawComponent, common: drawCommon, notes: drawNote }[node.of];
  const group = svg("g", {
    class: `item node ${kindOf(node)}${node.data.color ? ` color-${node.data.color}` : ""}${node.data.disabled ? " disabled" : ""}${node.data.dead ? " dead" : ""}`,
    "data-id": node.id,
    "data-kind": kindOf(node),
    "data-key": node.key,
    role: "button",
    tabindex: "-1",
    "aria-label": describe(node),
  });
  group.append(...draw(node));
  placeNode(group, node);
  return group;
}

export const placeNode = (group, node) => placeGroup(group, node.x, node.y);

export const kindOf = (thing) =>
  ({ states: "state", components: "component", transitions: "transition", links: "link", common: "common", notes: "note" })[thing.of];

function drawState(node) {
  const { w, h, data } = node;
  const marks = marksOf(data);
  const parts = [box("shadow", w, h, 0, 2), box("box bg", w, h, 0)];
  if (data.final) parts.push(box("inner", w, h, 4));
  parts.push(svg("text", { class: "name", y: marks.length ? NAME_RISE : 0, text: node.label }), ...largeName(node, w));
  if (marks.length) parts.push(markRow(marks, MARK_ROW));
  if (data.disabled) parts.push(translateElement(svg("path", { class: "off", d: OFF }), -w / 2 + 9, -h / 2 + 14));
  if (data.outside) parts.push(translateElement(outsideBadge(), -w / 2 + 4, -h / 2 + 2));
  if (data.severity) parts.push(badge(data, w / 2 - 4, -h / 2 + 2));
  return parts;
}

/** Badge of a state whose code another program changed: an arrow into a box. */
function outsideBadge() {
  const group = svg("g", { class: "badge outside", "aria-hidden": "true" });
  group.append(svg("rect", { x: -9, y: -9, width: 18, height: 18, rx: 4 }), svg("path", { d: "M4.5 -5V5H0M-5.5 0H1M-2 -3.2L1.3 0L-2 3.2" }));
  return group;
}

function drawComponent(node) {
  const { w, h, data } = node;
  const s = HEX_SLANT;
  const points = [-w / 2, 0, -w / 2 + s, -h / 2, w / 2 - s, -h / 2, w / 2, 0, w / 2 - s, h / 2, -w / 2 + s, h / 2].join(" ");
  const parts = [svg("path", { class: "box bg", d: `M${points}Z` })];
  parts.push(svg("text", { class: "name", y: node.second ? NAME_RISE : 0, text: node.label }), ...largeName(node, w - 2 * s));
  if (node.second) parts.push(svg("text", { class: "second", y: 12, text: node.second }));
  if (data.design) parts.push(translateElement(svg("path", { class: "mark open", d: "M-5 -3.5H3.5V5M3.5 -3.5L-4.5 4.5" }), w / 2 - 25, 0));
  if (data.severity) parts.push(badge(data, w / 2 - s, -h / 2 + 2));
  return parts;
}

function drawNote({ w, h, data }) {
  const [x, y] = [-w / 2, -h / 2];
  const outline = `M${x} ${y}H${-x - FOLD}L${-x} ${y + FOLD}V${-y}H${x}Z`;
  const lines = data.lines.map((text, index) => svg("text", { x: x + NOTE_PADDING, y: y + NOTE_PADDING + (index + 0.5) * NOTE_LINE, text }));
  return [svg("path", { class: "box bg", d: outline }), ...lines];
}

function drawCommon(node) {
  const { w, h, data } = node;
  const parts = [svg("rect", { class: "box bg", x: -w / 2, y: -h / 2, width: w, height: h, rx: h / 2 })];
  parts.push(svg("path", { class: "mark", d: "M-52 -6V6M-57.2 -3L-46.8 3M-57.2 3L-46.8 -3" }));
  parts.push(svg("text", { class: "name", x: 4, y: 0, text: node.label }), ...largeName(node, w));
  if (data.actions) parts.push(translateElement(svg("path", { class: "mark", d: MARKS.actions.d }), w / 2 - 24, 0));
  if (data.severity) parts.push(badge(data, w / 2 - 8, -h / 2 + 2));
  return parts;
}

/** The name alone, as large as the box allows; shown at small zooms. */
function largeName(node, w) {
  const { lines, size } = largestLines(node.label, w - 12, node.h - 8);
  return lines.map((text, index) => svg("text", { class: "large", y: (index - (lines.length - 1) / 2) * size * 1.05, style: `font-size: ${size}px`, text }));
}

const box = (kind, w, h, inset, drop = 0) =>
  svg("rect", { class: kind, x: inset - w / 2, y: inset - h / 2 + drop, width: w - 2 * inset, height: h - 2 * inset, rx: 12 - inset });

function marksOf(data) {
  const code = ["enter", "actions", "leave"].filter((name) => data[name]).map((name) => ({ name, count: "" }));
  const uses = ["requires", "modulates"].filter((name) => data[name] > 0).map((name) => ({ name, count: String(data[name]) }));
  return [...code, ...uses];
}

function markRow(marks, y) {
  const widths = marks.map(({ name, count }) => MARKS[name].w + (count ? 3 + 7 * count.length : 0));
  let x = -(widths.reduce((sum, width) => sum + width, 0) + MARK_GAP * (marks.length - 1)) / 2;
  const row = svg("g", { class: "marks", "aria-hidden": "true" });
  marks.forEach(({ name, count }, index) => {
    row.append(translateElement(svg("path", { class: `mark ${name}`, d: MARKS[name].d }), x, y));
    if (count) row.append(svg("text", { class: `count ${name}`, x: x + MARKS[name].w + 3, y, text: count }));
    x += widths[index] + MARK_GAP;
  });
  return row;
}

/** Badge with the number of findings of the worst severity; gray on what is being drawn. Error: octagon. Warning: triangle. Note: disc. */
export function badge(data, x, y) {
  const shape = {
    error: "M-4.2 -10H4.2L10 -4.2V4.2L4.2 10H-4.2L-10 4.2V-4.2Z",
    warning: "M0 -11L11.5 9H-11.5Z",
    note: "M-9.5 0a9.5 9.5 0 1 0 19 0a9.5 9.5 0 1 0 -19 0Z",
  }[data.severity];
  const count = data.count ?? data.messages?.length ?? 0;
  const isUnfinished = data.unfinished && data.severity !== "error";
  const group = svg("g", { class: `badge ${data.severity}${isUnfinished ? " unfinished" : ""}`, "aria-hidden": "true" });
  group.append(svg("path", { d: shape }));
  group.append(svg("text", { y: data.severity === "warning" ? 2.5 : 0, text: count > 9 ? "9+" : count > 0 ? String(count) : "!" }));
  return translateElement(group, x, y);
}

/** The tooltip of a node. */
export function nodeTooltip(node) {
  const { data } = node;
  const title = node.of === "common" ? COMMON_TITLE : data.name;
  const second = node.of === "components" && data.name !== data.id ? alias(data.id) : "";
  return [title, second, data.outside && CHANGED_OUTSIDE, data.disabled && DISABLED, data.doc, ...findingMessages(data)].filter(Boolean).join("\n");
}

function describe(node) {
  const { data } = node;
  if (node.of === "notes") return noteName(data.name);
  if (node.of === "common") return [commonName(data.transitions ?? 0), ...findingMessages(data)].join(", ");
  if (node.of === "components") return [componentName(data.id), data.name, ...findingMessages(data)].join(", ");
  const marks = marksOf(data).map(({ name, count }) => markName(name, count));
  const facts = [data.outside && CHANGED_OUTSIDE, data.initial && "initial", data.final && "final", data.color && colored(data.color), data.disabled && DISABLED, ...marks, ...findingMessages(data)];
  return [stateName(data.name), ...facts.filter(Boolean)].join(", ");
}

/** The messages, each with its severity. */
export const findingMessages = (data) => (data.severity ? data.messages ?? [] : []);
