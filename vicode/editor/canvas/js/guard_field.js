// The guard field: over the label of a transition, or on the line of one that is created when it closes. Python reads the text.
import { ConnectionPreview } from "./connect_drags.js";
import { GUARD, GUARD_HINT } from "./strings.js";
import { html } from "./svg.js";

const MARGIN = 8;
const [MIN_LETTERS, MAX_LETTERS] = [18, 60];

export class GuardField {
  constructor(canvas) {
    this.canvas = canvas;
    this.edited = null;
    this.input = html("input", { class: "guard-field", type: "text", spellcheck: "false", autocapitalize: "off", hidden: true, "aria-label": GUARD, placeholder: GUARD_HINT });
    this.input.addEventListener("keydown", (event) => this.#down(event));
    this.input.addEventListener("input", () => this.viewChanged());
    this.input.addEventListener("blur", () => this.keep());
    for (const name of ["pointerdown", "keyup", "wheel"]) this.input.addEventListener(name, (event) => event.stopPropagation());
  }

  get isOpen() {
    return Boolean(this.edited);
  }

  /** Opens the guard of a transition; returns false if its form has to, because it is code. */
  start(key) {
    const { canvas } = this;
    const edge = canvas.scene.edges.get(key);
    if (typeof edge?.data.guard !== "string") return false;
    canvas.reveal(key);
    this.#open({ key, id: edge.id, base: edge.data.guard, at: canvas.router.route(edge).at });
    return true;
  }

  /** Asks for the guard of a new transition; `report` is what creates it, `to` its target or the place of a new state. */
  startNew(from, to, report) {
    const { canvas } = this;
    const isNode = canvas.scene.nodes.get(to.key) === to;
    const preview = new ConnectionPreview(canvas, { box: !isNode });
    preview.show(from, to, !isNode);
    const middle = { x: (from.x + to.x) / 2, y: (from.y + to.y) / 2 };
    const at = from === to ? { x: from.x, y: from.y - from.h / 2 - 40 } : middle;
    canvas.revealPlace({ ...at, w: 240, h: 30 });
    this.#open({ report, preview, base: "", at });
  }

  /** Keeps the field over its place. */
  viewChanged() {
    if (!this.edited) return;
    const { viewport, scene, router } = this.canvas;
    const edge = scene.edges.get(this.edited.key);
    if (edge && edge.id === this.edited.id && scene.isDrawable(edge)) this.edited.at = router.route(edge).at;
    const at = viewport.toScreen(this.edited.at);
    this.input.style.width = `${Math.min(MAX_LETTERS, Math.max(MIN_LETTERS, this.input.value.length + 4))}ch`;
    const reach = this.input.offsetWidth / 2 + MARGIN;
    this.input.style.left = `${Math.max(reach, Math.min(viewport.width - reach, at.x))}px`;
    this.input.style.top = `${at.y}px`;
  }

  /** Others may change the design meanwhile: the gesture belongs to the revision that the user sees now. */
  #open(edited) {
    this.edited = { ...edited, rev: this.canvas.scene.rev };
    this.input.value = edited.base;
    this.input.hidden = false;
    this.viewChanged();
    this.input.focus({ preventScroll: true });
    this.input.select();
  }

  /** Applies what is typed; the user has turned to something else. */
  keep() {
    this.#close({ keep: true, select: false });
  }

  #down(event) {
    // The page handles saving; the typed guard is applied first, so that it is saved too.
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "s") return this.#leave(true);
    event.stopPropagation();
    if (!["Enter", "Escape", "Tab"].includes(event.key) || event.isComposing) return;
    event.preventDefault();
    const { key, id } = this.edited;
    this.#leave(event.key !== "Escape");
    // From the label, Tab leads to the form.
    if (key && event.key === "Tab") this.canvas.report("open", { item: { of: "transitions", id } });
  }

  #leave(keep) {
    this.#close({ keep, select: true });
    this.canvas.stage.focus({ preventScroll: true });
  }

  /** `select`: selects what is created; not if the user has turned to something else. */
  #close({ keep, select }) {
    const { edited, canvas } = this;
    if (!edited) return;
    const text = keep ? this.input.value.trim() : edited.base;
    this.edited = null;
    this.input.hidden = true;
    edited.preview?.close();
    if (edited.report) canvas.report("connect", { ...edited.report, guard: text, select }, edited.rev);
    else if (text !== edited.base) canvas.report("guard", { id: edited.id, text, base: edited.base }, edited.rev);
  }
}
