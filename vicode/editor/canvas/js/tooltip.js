// The card that tells more of what the pointer rests on, or the keys have reached. It is never in the way: a press,
// a turn of the wheel or a key takes it away, and the pointer goes through it.
import { edgeTooltip } from "./edge_svg.js";
import { nodeRect } from "./geometry.js";
import { nodeTooltip } from "./node_svg.js";
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

  /** Something is pointed at (or nothing any more): tell of it when that lasts. */
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

  /** What Python knows of it: sections of text. */
  addSections({ of, id, sections }) {
    const thing = this.key && this.canvas.scene.find(this.key);
    if (thing?.of !== of || thing.id !== id) return;
    for (const { name, text } of sections) {
      this.element.append(html("div", { class: "tooltip-name", text: name }), html("pre", { text }));
    }
    this.#place(thing);
  }

  #show(key) {
    const { canvas } = this;
    const thing = canvas.scene.find(key);
    if (this.requestedKey !== key || !thing || canvas.gestures.isDragging() || !canvas.rename.input.hidden) return;
    this.key = key;
    const [title, ...lines] = this.#words(thing);
    this.element.replaceChildren(html("div", { class: "tooltip-title", text: title }), ...lines.map((text) => html("div", { class: "tooltip-line", text })));
    this.element.hidden = false;
    this.#place(thing);
    this.described = canvas.root.activeElement?.closest("[data-key]");
    this.described?.setAttribute("aria-describedby", "tooltip");
    canvas.report("tooltip", { of: thing.of, id: thing.id });
  }

  #words(thing) {
    const { scene } = this.canvas;
    const nameOf = (key) => (key === "common" ? "every state" : String(scene.nodes.get(key)?.data.name));
    const hint = scene.nodes.has(thing.key) ? nodeTooltip(thing) : edgeTooltip(thing, { source: nameOf(thing.source), target: nameOf(thing.target) });
    return hint.split("\n");
  }

  /** Beside the thing, where there is more room. */
  #place(thing) {
    const { viewport, scene, router } = this.canvas;
    const box = scene.nodes.has(thing.key) ? nodeRect(thing) : chipRect(router.route(thing));
    const [a, b] = [viewport.toScreen(box), viewport.toScreen({ x: box.x + box.w, y: box.y + box.h })];
    const { offsetWidth: w, offsetHeight: h } = this.element;
    const isRight = b.x + GAP + w + MARGIN <= viewport.width || viewport.width - b.x > a.x;
    const fit = (value, size, all) => Math.max(MARGIN, Math.min(value, all - size - MARGIN));
    this.element.style.left = `${fit(isRight ? b.x + GAP : a.x - GAP - w, w, viewport.width)}px`;
    this.element.style.top = `${fit(a.y, h, viewport.height)}px`;
  }

  #focused(event) {
    if (this.canvas.stage.classList.contains("keys")) this.request(event.target.closest("[data-key]")?.dataset.key ?? null);
  }
}

const chipRect = ({ at, chip }) => ({ x: at.x - (chip?.w ?? 0) / 2, y: at.y - (chip?.h ?? 0) / 2, w: chip?.w ?? 0, h: chip?.h ?? 0 });
