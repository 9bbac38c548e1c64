// Everything the canvas does without a pointer. Keys it does not know go on to the page.
import { rectOf, SNAP } from "./geometry.js";

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

export class Keyboard {
  constructor(canvas) {
    this.canvas = canvas;
    canvas.stage.addEventListener("keydown", (event) => this.#down(event));
    canvas.stage.addEventListener("keyup", (event) => this.#up(event));
    // The focus is shown to those who steer by keys, and only to them.
    canvas.stage.addEventListener("keyup", () => canvas.stage.classList.add("keys"));
    canvas.stage.addEventListener("pointerdown", () => canvas.stage.classList.remove("keys"), { capture: true });
    canvas.stage.addEventListener("blur", () => this.#space(false));
  }

  #down(event) {
    if (event.target.closest("input, button")) return;
    const done = event.ctrlKey || event.metaKey ? this.#command(event) : this.#plain(event);
    if (!done) return;
    event.preventDefault();
    event.stopPropagation();
  }

  #up(event) {
    if (event.key === " ") this.#space(false);
  }

  #command({ key, shiftKey }) {
    const { canvas } = this;
    const jobs = {
      z: () => canvas.report(shiftKey ? "redo" : "undo", {}),
      y: () => canvas.report("redo", {}),
      a: () => canvas.selection.set([...canvas.scene.nodes.keys(), ...canvas.drawableEdges()]),
    };
    return run(jobs[key.toLowerCase()]);
  }

  #plain(event) {
    const { canvas } = this;
    if (event.altKey) return false;
    if (event.key in ARROWS) return this.#nudge(ARROWS[event.key], event.shiftKey ? 1 : SNAP);
    if (event.key === "Tab") return this.#walk(event.shiftKey ? -1 : 1);
    const jobs = {
      Escape: () => this.#escape(),
      Delete: () => this.#delete(),
      Backspace: () => this.#delete(),
      Enter: () => this.#enter(),
      F2: () => this.#rename(),
      "+": () => canvas.viewport.zoomBy(1.25),
      "=": () => canvas.viewport.zoomBy(1.25),
      "-": () => canvas.viewport.zoomBy(0.8),
      0: () => canvas.viewport.centreOn(canvas.viewport.middle().x, canvas.viewport.middle().y, 1),
      1: () => canvas.fit(),
      " ": () => this.#space(true),
      s: () => canvas.report("create", canvas.gestures.spot()),
      t: () => this.#connect(),
    };
    return run(jobs[event.key.length === 1 ? event.key.toLowerCase() : event.key]);
  }

  #escape() {
    if (!this.canvas.gestures.cancel()) this.canvas.selection.set([]);
  }

  #delete() {
    const items = this.canvas.selection.items();
    if (items.length) this.canvas.report("delete", { items });
  }

  #enter() {
    const { canvas } = this;
    const key = canvas.selection.single();
    if (canvas.gestures.tool) return canvas.gestures.connectTo(key);
    const thing = key && canvas.scene.find(key);
    if (thing?.of === "states") canvas.rename.start(key);
    else if (thing) canvas.report("open", { of: thing.of, id: thing.id });
    return true;
  }

  #rename() {
    const key = this.canvas.selection.single();
    if (["states", "components"].includes(this.canvas.scene.nodes.get(key)?.of)) this.canvas.rename.start(key);
  }

  #connect() {
    const key = this.canvas.selection.single();
    if (this.canvas.scene.nodes.has(key)) this.canvas.gestures.connectFrom(key);
  }

  #nudge([dx, dy], by) {
    const { canvas } = this;
    const keys = canvas.selection.nodes();
    if (!keys.length) {
      canvas.viewport.panBy(-dx * 60, -dy * 60);
      return true;
    }
    const rects = keys.map((key) => rectOf(canvas.scene.nodes.get(key)));
    for (const key of keys) {
      const node = canvas.scene.nodes.get(key);
      canvas.scene.move(key, node.x + dx * by, node.y + dy * by);
    }
    canvas.painter.follow(keys);
    canvas.reportMove(keys, rects);
    canvas.afterGesture();
    return true;
  }

  /** Tab goes through the things in the order of the design; past the last it leaves the canvas. */
  #walk(step) {
    const { canvas } = this;
    const things = walkOf(canvas.scene);
    const at = things.indexOf(canvas.selection.single());
    const next = at < 0 && step < 0 ? undefined : things[at + step];
    if (!next) return false;
    canvas.selection.set([next]);
    canvas.reveal(next);
    canvas.painter.focus(next);
    return true;
  }

  #space(held) {
    this.canvas.gestures.spaceHeld = held;
    this.canvas.stage.classList.toggle("space", held);
  }
}

/** Every node, each followed by what leaves it: transitions by their order, then links. */
function walkOf(scene) {
  return [...scene.nodes.values()].flatMap((node) => {
    const leaving = scene.edgesOf(node.key).filter((edge) => edge.source === node.key && scene.isDrawable(edge));
    leaving.sort((a, b) => (a.data.order ?? Infinity) - (b.data.order ?? Infinity) || 0);
    return [node.key, ...leaving.map((edge) => edge.key)];
  });
}

function run(job) {
  if (!job) return false;
  job();
  return true;
}
