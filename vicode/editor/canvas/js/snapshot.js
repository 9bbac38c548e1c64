// Bitmap of the mounted elements for zooming: browsers repeat the layout of every SVG text at each zoom step.
import { html } from "./svg.js";

// Fewer elements than this are zoomed as SVG and stay sharp.
const MIN_ITEMS = 250;
const MAX_PIXELS = 4096;
const STEP = 20;

export class Snapshot {
  constructor(painter, viewport, colors) {
    this.painter = painter;
    this.viewport = viewport;
    this.colors = colors;
    this.element = html("canvas", { class: "bitmap snapshot" });
    this.styles = new Map();
    this.taken = null;
    this.drawing = null;
  }

  /** Whether zooming is smoother with a bitmap. */
  isUseful() {
    return this.painter.items.size > MIN_ITEMS && this.painter.mountedRect !== null;
  }

  /** Draws the bitmap in idle time, before a zoom needs it. */
  prepare(zoom) {
    const { revision, styleRevision } = this.painter;
    if (!this.isUseful() || (this.#isCurrent(zoom) && this.taken.styleRevision === styleRevision)) return;
    this.taken = null;
    const drawing = this.#draw(zoom);
    const step = (deadline) => {
      if (this.drawing !== drawing || this.painter.revision !== revision) return;
      while (deadline.timeRemaining() > 4) if (drawing.next().done) return;
      this.#idle(step);
    };
    this.drawing = drawing;
    this.#idle(step);
  }

  /** Completes the bitmap, or draws a new one if shapes changed; an outdated highlight is acceptable. */
  finish(zoom) {
    if (this.#isCurrent(zoom)) return;
    this.drawing = this.#draw(zoom);
    while (!this.drawing.next().done);
  }

  #isCurrent(zoom) {
    const { revision, mountedRect } = this.painter;
    return this.taken?.revision === revision && this.taken.region === mountedRect && this.taken.zoom === zoom;
  }

  /** The colors changed. */
  invalidate() {
    this.styles.clear();
    this.taken = null;
  }

  place() {
    if (!this.taken) return;
    const { x, y, k } = this.viewport;
    const { region, scale } = this.taken;
    this.element.style.transform = `translate(${x + region.x * k}px, ${y + region.y * k}px) scale(${k / scale})`;
  }

  /** Draws in batches; yields between them. */
  *#draw(zoom) {
    const { revision, styleRevision, mountedRect: region } = this.painter;
    const scale = Math.min(zoom * devicePixelRatio, MAX_PIXELS / Math.max(region.w, region.h));
    const pen = this.#begin(region, scale);
    const groups = Object.values(this.painter.layers).flatMap((layer) => {
      const opacity = Number(getComputedStyle(layer.ownerSVGElement).opacity);
      return [...layer.children].map((group) => ({ layer, opacity, group }));
    });
    for (const [index, { layer, opacity, group }] of groups.entries()) {
      this.opacity = opacity;
      this.#drawGroup(pen, group, `${layer.getAttribute("class")} ${group.getAttribute("class")}`);
      // Reading a pixel back forces the browser to paint the recorded operations.
      if (index % STEP === STEP - 1) yield pen.getImageData(0, 0, 1, 1);
    }
    pen.getImageData(0, 0, 1, 1);
    this.taken = { revision, styleRevision, region, zoom, scale };
  }

  #begin(region, scale) {
    this.element.width = Math.round(region.w * scale);
    this.element.height = Math.round(region.h * scale);
    const pen = this.element.getContext("2d", { alpha: false, willReadFrequently: true });
    pen.fillStyle = this.colors("paper");
    pen.fillRect(0, 0, this.element.width, this.element.height);
    pen.setTransform(scale, 0, 0, scale, -region.x * scale, -region.y * scale);
    pen.textBaseline = "middle";
    return pen;
  }

  #idle(job) {
    if (window.requestIdleCallback) requestIdleCallback(job);
    else setTimeout(() => job({ timeRemaining: () => 6 }), 30);
  }

  #drawGroup(pen, group, context) {
    const offset = offsetOf(group);
    pen.translate(offset.x, offset.y);
    for (const element of group.children) {
      if (element.tagName === "title") continue;
      const style = this.#styleOf(element, context);
      if (style.isHidden) continue;
      if (element.tagName === "g") this.#drawGroup(pen, element, `${context} ${element.getAttribute("class")}`);
      else this.#drawShape(pen, element, style);
    }
    pen.translate(-offset.x, -offset.y);
  }

  #drawShape(pen, element, style) {
    if (!style.fill && !style.stroke) return;
    if (element.tagName === "text") writeText(pen, element, style, this.opacity);
    else drawPath(pen, pathOf(element), style, this.opacity);
  }

  /** Returns the style of an element, cached by its classes and the level of detail, which hides some. */
  #styleOf(element, context) {
    const level = this.painter.svgRoots[0].parentNode.className;
    const name = `${level} ${context}|${element.tagName} ${element.getAttribute("class")}`;
    if (!this.styles.has(name)) this.styles.set(name, readStyle(getComputedStyle(element), this.colors));
    return this.styles.get(name);
  }
}

function readStyle(style, colors) {
  // The only pattern is the hatching of disabled nodes; its background color replaces it.
  const plain = (value) => (value.startsWith("url(") ? colors("faint") : value);
  const paint = (value) => (value === "none" || value === "rgba(0, 0, 0, 0)" ? null : plain(value));
  return {
    isHidden: style.display === "none",
    fill: paint(style.fill),
    fillOpacity: Number(style.fillOpacity),
    stroke: paint(style.stroke),
    strokeOpacity: Number(style.strokeOpacity),
    width: Number.parseFloat(style.strokeWidth),
    dashes: style.strokeDasharray === "none" ? [] : style.strokeDasharray.split(/[ ,]+/).map((part) => Number.parseFloat(part)),
    cap: style.strokeLinecap,
    font: `${style.fontWeight} ${style.fontSize} ${style.fontFamily}`,
    align: { middle: "center", end: "end" }[style.textAnchor] ?? "start",
  };
}

function drawPath(pen, path, style, opacity) {
  if (style.fill) {
    pen.globalAlpha = style.fillOpacity * opacity;
    pen.fillStyle = style.fill;
    pen.fill(path);
  }
  if (style.stroke) {
    pen.globalAlpha = style.strokeOpacity * opacity;
    pen.strokeStyle = style.stroke;
    pen.lineWidth = style.width;
    pen.lineCap = style.cap;
    pen.setLineDash(style.dashes);
    pen.stroke(path);
  }
}

function writeText(pen, element, style, opacity) {
  pen.globalAlpha = style.fillOpacity * opacity;
  pen.fillStyle = style.fill;
  pen.font = style.font;
  pen.textAlign = style.align;
  pen.fillText(element.textContent, numberOf(element, "x"), numberOf(element, "y"));
}

function pathOf(element) {
  const number = (name) => numberOf(element, name);
  if (element.tagName === "path") return new Path2D(element.getAttribute("d"));
  const path = new Path2D();
  if (element.tagName === "rect") path.roundRect(number("x"), number("y"), number("width"), number("height"), number("rx"));
  if (element.tagName === "circle") path.arc(number("cx"), number("cy"), number("r"), 0, 2 * Math.PI);
  return path;
}

const numberOf = (element, name) => Number(element.getAttribute(name) ?? 0);

function offsetOf(element) {
  const match = element.getAttribute("transform")?.match(/^translate\(([-\d.e]+) ([-\d.e]+)\)$/);
  return match ? { x: Number(match[1]), y: Number(match[2]) } : { x: 0, y: 0 };
}
