// Frames: rectangles with a title behind states. They follow their states; only the title and the border react to the pointer.
import { bounds, nodeRect } from "./geometry.js";
import { badge, findingMessages } from "./node_svg.js";
import { FRAME, colored, frameName } from "./strings.js";
import { svg } from "./svg.js";
import { textWidth, truncate } from "./text_metrics.js";

const TITLE_HEIGHT = 28;
const INSET = 14;
const MIN_TITLE = 160;
const RADIUS = 16;
// At small zooms, titles are larger, as the names of states.
const LARGE = 26;
const NAME = 14;
// The padding of a frame that is not in the scene yet.
const NEW = { side: 24, top: 52 };

/** Returns the rectangle around nodes; null if there are none. */
export function frameRect(nodes, { side, top } = NEW) {
  const inner = bounds(nodes.map(nodeRect));
  return inner && { x: inner.x - side, y: inner.y - top, w: inner.w + 2 * side, h: inner.h + side + top };
}

/** Returns the place of a title, by its middle, as that of a node. */
export function titlePlace({ x, y, w }) {
  const width = Math.max(w, MIN_TITLE);
  return { x: x + width / 2, y: y + TITLE_HEIGHT / 2, w: width, h: TITLE_HEIGHT };
}

/** Returns the rectangle of a title, which labels avoid. */
export function titleRect({ data }, { x, y, w }) {
  const room = Math.min(w - 2 * INSET, textWidth(data.name, "name"));
  return { x: x + INSET, y, w: room, h: TITLE_HEIGHT };
}

export function drawFrame(frame, rect) {
  const { data } = frame;
  const group = svg("g", {
    class: `item frame${data.color ? ` color-${data.color}` : ""}`,
    "data-id": frame.id,
    "data-kind": "frame",
    "data-key": frame.key,
    role: "button",
    tabindex: "-1",
    "aria-label": [frameName(data.name, data.states), data.color && colored(data.color), ...findingMessages(data)].filter(Boolean).join(", "),
  });
  placeFrame(group, frame, rect);
  return group;
}

/** Draws a frame at a rectangle, unless it is there. */
export function placeFrame(group, { data }, { x, y, w, h }) {
  const place = [x, y, w, h].join(" ");
  if (group.dataset.at === place) return;
  group.dataset.at = place;
  const area = { x, y, width: w, height: h, rx: RADIUS };
  const at = { x: x + INSET, y: y + TITLE_HEIGHT / 2 };
  const room = w - 2 * INSET;
  group.replaceChildren(
    svg("rect", { class: "box", ...area }),
    svg("rect", { class: "border", ...area }),
    svg("rect", { class: "handle-bar", x, y, width: w, height: TITLE_HEIGHT }),
    svg("text", { class: "title", ...at, text: truncate(data.name, "name", room) }),
    svg("text", { class: "large-title", x: at.x, y: y + 22, style: `font-size: ${LARGE}px`, text: truncate(data.name, "name", (room * NAME) / LARGE) }),
    ...(data.severity ? [badge(data, x + w - 4, y + 2)] : []),
  );
}

/** The tooltip of a frame: its title, in case it is shortened, and its findings. */
export const frameTooltip = ({ data }) => [`${FRAME} ${data.name}`, ...findingMessages(data)].join("\n");

/** The outline of a frame whose title is being typed. */
export class FramePreview {
  constructor(canvas, { x, y, w, h }) {
    this.outline = svg("rect", { class: "preview-box", x, y, width: w, height: h, rx: RADIUS });
    canvas.painter.layers.above.append(this.outline);
  }

  show() {}

  close() {
    this.outline.remove();
  }
}
