// Insets: the machines of used components, drawn under a node without moving others, side by side if there are several.
// The design has no trace of them; edits go to the designs of the components.
import { bounds, grow } from "./geometry.js";
import { InsetEditor } from "./inset_editor.js";
import { LEGIBLE_ZOOM } from "./level_of_detail.js";
import { Painter } from "./painter.js";
import { Router } from "./routing.js";
import { keyOf, Scene } from "./scene.js";
import { FOLD, INSIDE_EDIT, OPEN_DESIGN, insetEditName, insetName } from "./strings.js";
import { html } from "./svg.js";

const MAX_WIDTH = 560;
const MAX_HEIGHT = 360;
const PADDING = 6;
// Room for the mark of the initial state.
const MARK = 24;
const LARGEST = 0.8;
const GAP = 8;
const EVENTS = ["pointerdown", "pointermove", "pointerup", "click", "contextmenu", "keydown", "keyup"];

export class Insets {
  constructor(canvas) {
    this.canvas = canvas;
    this.element = html("div", { class: "insets" });
    this.open = new Map();
    this.active = {};
  }

  /** Requests the machines of a node from Python, or folds them. */
  toggle(key) {
    const { of, id } = this.canvas.scene.nodes.get(key);
    const shown = !this.open.has(key);
    if (!shown) this.#fold(key);
    this.canvas.report("inside", { item: { of, id }, shown });
  }

  /** Shows machines, each as `{alias, component, file, scene}`, under a node; none folds it. */
  show({ of, id }, machines) {
    const key = keyOf(of, id);
    const kept = new Map(this.open.get(key)?.figures.map(({ component, editor }) => [component, editor.state()]));
    this.#fold(key);
    if (!machines.length || !this.canvas.scene.nodes.has(key)) return;
    const width = Math.min(MAX_WIDTH, (this.canvas.viewport.width - 2 * GAP) / machines.length);
    const figures = machines.map((machine) => this.#figure(machine, width));
    const fold = button("inset-fold", FOLD, "×", () => this.toggle(key));
    const panel = html("div", { class: "inset", "data-inside": key }, [...figures.map(({ element }) => element), fold]);
    for (const name of EVENTS) panel.addEventListener(name, (event) => event.stopPropagation());
    this.open.set(key, { panel, figures });
    this.element.append(panel);
    this.place();
    this.highlight(this.active);
    for (const { component, editor } of figures) if (kept.has(component)) editor.restore(kept.get(component));
  }

  /** Marks the active states of running components, `{component: state}`. */
  highlight(active) {
    this.active = active;
    for (const { figures } of this.open.values()) {
      for (const { component, painter } of figures) painter.mark("active", component in active ? [keyOf("states", active[component])] : []);
    }
  }

  /** Keeps the panels under their nodes; folds those whose node was removed. */
  place() {
    const { scene, viewport } = this.canvas;
    for (const [key, { panel }] of this.open) {
      const node = scene.nodes.get(key);
      if (!node) this.#fold(key);
      else {
        const [above, below] = [-1, 1].map((side) => viewport.toScreen({ x: node.x, y: node.y + (side * node.h) / 2 }));
        const { x, y } = placeBeside(above, below, panel, viewport);
        panel.style.transform = `translate(${Math.round(x)}px, ${Math.round(y)}px)`;
      }
    }
  }

  #fold(key) {
    this.open.get(key)?.panel.remove();
    this.open.delete(key);
  }

  #figure({ alias, component, file, scene }, width) {
    const machine = drawMachine(scene, width);
    const { painter, view } = machine;
    view.setAttribute("aria-label", insetEditName(component));
    const editor = new InsetEditor(this.canvas, component, machine);
    const open = () => this.canvas.report("open", { item: { of: "components", id: alias } });
    const caption = html("div", { class: "inset-caption" }, [
      html("span", { text: alias === component ? alias : `${alias}: ${component}` }),
      html("span", { class: "inset-file", text: file, title: INSIDE_EDIT }),
      button("inset-open", OPEN_DESIGN, "↗", open),
    ]);
    const element = html("div", { class: "inset-figure", role: "group", "aria-label": insetName(alias, component) }, [caption, view]);
    element.addEventListener("dblclick", (event) => {
      event.stopPropagation();
      open();
    });
    return { component, painter, editor, element };
  }
}

/** Under a node, or above it if there is more room; across, inside the view while the node is. */
function placeBeside(above, below, { offsetWidth: w, offsetHeight: h }, { width, height }) {
  const isAbove = below.y + GAP + h > height && above.y - GAP - h >= 0;
  const isSeen = below.x >= 0 && below.x <= width;
  const x = below.x - w / 2;
  return { x: isSeen ? Math.max(GAP, Math.min(x, width - w - GAP)) : x, y: isAbove ? above.y - GAP - h : below.y + GAP };
}

/** Draws states and transitions as the canvas does, scaled to a panel of this width. */
function drawMachine(data, width) {
  const scene = new Scene();
  scene.load({ ...data, components: [], links: [] });
  const router = new Router(scene);
  const painter = new Painter(scene, router, { isInset: true });
  const extent = grow(bounds([scene.extent(), router.extent()].filter(Boolean)) ?? { x: 0, y: 0, w: 0, h: 0 }, MARK);
  painter.cull(extent, { far: false, zoom: 1 });
  const [room, height] = [width - 2 * PADDING, MAX_HEIGHT - 2 * PADDING];
  const k = Math.min(LARGEST, room / extent.w, height / extent.h);
  const plane = html("div", { class: `plane${k < LEGIBLE_ZOOM ? " small" : ""}` }, painter.svgRoots);
  const origin = { x: PADDING - extent.x * k, y: PADDING - extent.y * k };
  plane.style.transform = `translate(${origin.x}px, ${origin.y}px) scale(${k})`;
  const view = html("div", { class: "inset-view", role: "group", tabindex: "0" }, [plane]);
  Object.assign(view.style, { width: `${extent.w * k + 2 * PADDING}px`, height: `${extent.h * k + 2 * PADDING}px` });
  return { scene, painter, view, origin, k };
}

function button(name, title, text, job) {
  const element = html("button", { class: name, type: "button", title, "aria-label": title, text });
  element.addEventListener("click", job);
  return element;
}
