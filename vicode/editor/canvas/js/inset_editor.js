// Edits in an inset. They are gestures on the design of the used component, which has its own file and its own undo.
import { keyOf } from "./scene.js";
import { NAME } from "./strings.js";
import { html } from "./svg.js";

const DRAG_START = 4;
const NEXT_STATE = 180;
const MARKS = { i: "initial", f: "final" };

export class InsetEditor {
  /** `origin` and `k` place the machine in `view`: a point p of the scene is at origin + k * p. */
  constructor(canvas, component, { scene, painter, view, origin, k }) {
    Object.assign(this, { canvas, component, scene, painter, view, origin, k });
    this.selected = null;
    this.input = null;
    view.addEventListener("pointerdown", (event) => this.#down(event));
    view.addEventListener("pointermove", (event) => this.#move(event));
    view.addEventListener("pointerup", () => this.#up());
    view.addEventListener("keydown", (event) => this.#key(event));
  }

  /** What must survive that the machine is drawn again. */
  state() {
    const isFocused = this.view.contains(this.view.getRootNode().activeElement);
    return { selected: this.selected, isFocused, typed: this.input?.value ?? null };
  }

  restore({ selected, isFocused, typed }) {
    this.#select(this.scene.find(selected) ? selected : null);
    if (isFocused) this.view.focus({ preventScroll: true });
    if (typed !== null && this.selected) this.#type(typed);
  }

  #report(kind, fields = {}) {
    this.canvas.report("inside-edit", { component: this.component, seen: this.scene.rev, edit: { kind, ...fields } });
  }

  #select(key) {
    this.selected = key;
    this.painter.mark("selected", key ? [key] : []);
  }

  #down(event) {
    if (event.button !== 0 || event.target === this.input) return;
    this.#keep();
    const key = event.target.closest("[data-key]")?.dataset.key ?? null;
    const [source, node] = [this.scene.nodes.get(this.source), this.scene.nodes.get(key)];
    this.#connectFrom(null);
    if (source && node?.of === "states") this.#report("connect", { source: source.id, target: node.id, guard: "", select: false });
    this.#select(key);
    this.view.focus({ preventScroll: true });
    if (node) this.drag = { node, from: { x: event.clientX, y: event.clientY }, at: { x: node.x, y: node.y }, isMoved: false };
  }

  #move(event) {
    if (!this.drag) return;
    const { node, from, at } = this.drag;
    const [dx, dy] = [event.clientX - from.x, event.clientY - from.y];
    if (!this.drag.isMoved && Math.hypot(dx, dy) < DRAG_START) return;
    if (!this.drag.isMoved) this.view.setPointerCapture(event.pointerId);
    this.drag.isMoved = true;
    this.scene.move(node.key, at.x + dx / this.k, at.y + dy / this.k);
    this.painter.updateNodes([node.key]);
  }

  #up() {
    const { node, isMoved } = this.drag ?? {};
    this.drag = null;
    if (isMoved) this.#report("move", { items: [{ of: node.of, id: node.id, x: node.x, y: node.y }] });
  }

  #key(event) {
    if (event.target === this.input) return this.#typed(event);
    const [element, key] = [this.scene.find(this.selected), event.key.length === 1 ? event.key.toLowerCase() : event.key];
    const isUndo = (event.ctrlKey || event.metaKey) && ["z", "y"].includes(key);
    if (!isUndo && (event.ctrlKey || event.metaKey || event.altKey)) return;
    if (isUndo) this.#report(key === "y" || event.shiftKey ? "redo" : "undo");
    else if (key === "s") this.#create();
    else if (key === "Escape" && this.source) this.#connectFrom(null);
    else if (key === "Escape" && this.selected) this.#select(null);
    else if (key === "Escape") this.canvas.stage.focus({ preventScroll: true });
    else if (element && ["F2", "Enter"].includes(key)) this.#type();
    else if (element && ["Delete", "Backspace"].includes(key)) this.#report("delete", { items: [itemOf(element)] });
    else if (element && key === "d") this.#report("disable", { items: [itemOf(element)] });
    else if (element?.of === "states" && key === "t") this.#connectFrom(this.selected);
    else if (element?.of === "states" && key in MARKS) this.#report("mark", { mark: MARKS[key], id: element.id });
    else return;
    event.preventDefault();
  }

  #create() {
    const node = this.scene.nodes.get(this.selected) ?? [...this.scene.nodes.values()].at(-1) ?? { x: 0, y: 0 };
    this.#report("create", { x: node.x + NEXT_STATE, y: node.y, select: false });
  }

  /** The next click on a state adds a transition from this one. */
  #connectFrom(key) {
    this.source = key;
    this.view.classList.toggle("connects", Boolean(key));
  }

  /** Opens a field for the name of a state, or for the guard of a transition. */
  #type(text = null) {
    const element = this.scene.find(this.selected);
    const base = element.of === "states" ? element.data.name : element.data.guard;
    if (typeof base !== "string") return;
    this.input = html("input", { class: "rename", type: "text", spellcheck: "false", "aria-label": NAME });
    this.input.value = text ?? base;
    const at = element.of === "states" ? element : this.painter.router.route(element).at;
    Object.assign(this.input.style, { left: `${this.origin.x + at.x * this.k - 60}px`, top: `${this.origin.y + at.y * this.k - 15}px`, width: "120px", height: "30px" });
    this.input.addEventListener("blur", () => this.#keep());
    this.view.append(this.input);
    this.input.focus({ preventScroll: true });
    this.input.select();
  }

  #typed(event) {
    if (!["Enter", "Escape", "Tab"].includes(event.key)) return;
    event.preventDefault();
    if (event.key === "Escape") this.input.value = "";
    this.#keep({ isEmptyKept: event.key !== "Escape" });
    this.view.focus({ preventScroll: true });
  }

  /** Applies the field. An empty name changes nothing; an empty guard removes the condition, but not on Escape. */
  #keep({ isEmptyKept = true } = {}) {
    const { input } = this;
    if (!input) return;
    this.input = null;
    const [element, text] = [this.scene.find(this.selected), input.value.trim()];
    input.remove();
    if (element?.of === "states" && text && text !== element.data.name) {
      this.#report("rename", { item: itemOf(element), name: text });
      this.selected = keyOf("states", text);
    } else if (element?.of === "transitions" && text !== element.data.guard && (text || isEmptyKept)) {
      this.#report("guard", { id: element.id, text, base: element.data.guard });
    }
  }
}

const itemOf = ({ of, id }) => ({ of, id });
