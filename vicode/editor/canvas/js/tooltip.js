// Tooltip of the hovered or focused element. A press, the wheel or a key closes it; it ignores the pointer.
import { edgeTooltip } from "./edge_svg.js";
import { frameTooltip } from "./frames.js";
import { nodeRect } from "./geometry.js";
import { nodeTooltip } from "./node_svg.js";
import { EVERY_STATE } from "./strings.js";
import { html } from "./svg.js";

const DELAY_MS = 450;
const GAP = 14;
const MARGIN = 8;

export class Tooltip {
  constructor(canvas) {
    this.canvas = canvas;
    this.key = null;
    this.element = html("div", { class: "tooltip", id: "tooltip", role: "tooltip", hidden: true });
    const { stage } = canvas;
    for (const name of ["pointerdown", "wheel", "keydown"]) stage.addEventListener(name, () => this.hide(), { capture: true, passive: true });
    stage.addEventListener("focusin", (event) => this.#focused(event));
  }

  /** Opens the tooltip of an element after a delay; null closes it. */
  request(key) {
    this.hide();
    this.requestedKey = key;
    if (key) this.canvas.frame.debounce("tooltip", DELAY_MS, () => this.#show(key));
  }

  hide() {
    this.requestedKey = null;
    if (!this.key) return;
    this.key = null;
    this.element.hidden = true;
    this.described?.removeAttribute("aria-describedby");
  }

  /** Adds the sections of text that Python sends for the open tooltip. */
  addSections({ of, id, sections }) {
    const element = this.key && this.canvas.scene.find(this.key);
    if (element?.of !== of || element.id !== id) return;
    for (const { name, text } of sections) {
      this.element.append(html("div", { class: "tooltip-name", text: name }), html("pre", { text }));
    }
    this.#place(element);
  }

  #show(key) {
    const { canvas } = this;
    const element = canvas.scene.find(key);
    if (this.requestedKey !== key || !element || element.of === "notes" || canvas.gestures.isDragging() || !canvas.rename.input.hidden) return;
    this.key = key;
    const [title, ...lines] = this.#linesOf(element);
    this.element.replaceChildren(html("div", { class: "tooltip-title", text: title }), ...lines.map((text) => html("div", { class: "tooltip-line", text })));
    this.element.hidden = false;
    this.#place(element);
    this.described = canvas.root.activeElement?.closest("[data-key]");
    this.described?.setAttribute("aria-describedby", "tooltip");
    canvas.report("tooltip", { item: { of: element.of, id: element.id } });
  }

  #linesOf(element) {
    const { scene } = this.canvas;
    const nameOf = (key) => (key === "common" ? EVERY_STATE : String(scene.nodes.get(key)?.data.name));
    if (element.of === "frames") return frameTooltip(element).split("\n");
    const text = scene.nodes.has(element.key) ? nodeTooltip(element) : edgeTooltip(element, { source: nameOf(element.source), target: nameOf(element.target) });
    return text.split("\n");
  }

  /** Positions the tooltip on the side of the element with more space. */
  #place(element) {
    const { viewport, scene, router } = this.canvas;
    const name = scene.nameOf(element.key);
    const box = name ? nodeRect(name) : chipRect(router.route(element));
    const [a, b] = [viewport.toScreen(box), viewport.toScreen({ x: box.x + box.w, y: box.y + box.h })];
    const { offsetWidth: w, offsetHeight: h } = this.element;
    const isRight = b.x + GAP + w + MARGIN <= viewport.width || viewport.width - b.x > a.x;
    const fit = (value, size, available) => Math.max(MARGIN, Math.min(value, available - size - MARGIN));
    this.element.style.left = `${fit(isRight ? b.x + GAP : a.x - GAP - w, w, viewport.width)}px`;
    this.element.style.top = `${fit(a.y, h, viewport.height)}px`;
  }

  #focused(event) {
    if (this.canvas.stage.classList.contains("keys")) this.request(event.target.closest("[data-key]")?.dataset.key ?? null);
  }
}

const chipRect = ({ at, chip }) => ({ x: at.x - (chip?.w ?? 0) / 2, y: at.y - (chip?.h ?? 0) / 2, w: chip?.w ?? 0, h: chip?.h ?? 0 });
