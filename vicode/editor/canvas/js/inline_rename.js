// Inline rename: an input field over a node. Python validates the name.
import { keyOf } from "./scene.js";
import { NAME } from "./strings.js";
import { html } from "./svg.js";

export class InlineRename {
  constructor(canvas) {
    this.canvas = canvas;
    this.key = null;
    this.input = html("input", { class: "rename", type: "text", spellcheck: "false", hidden: true, "aria-label": NAME });
    this.input.addEventListener("keydown", (event) => this.#down(event));
    this.input.addEventListener("blur", () => this.#close(true));
    for (const name of ["pointerdown", "keyup", "wheel"]) this.input.addEventListener(name, (event) => event.stopPropagation());
  }

  start(key) {
    const node = this.canvas.scene.nodes.get(key);
    if (!node) return;
    this.canvas.reveal(key);
    this.key = key;
    this.input.value = nameOf(node);
    this.input.hidden = false;
    this.viewChanged();
    this.input.focus({ preventScroll: true });
    this.input.select();
  }

  /** Another user renamed the state: the field stays open, and its text will rename the state again. */
  stateRenamed(old, name) {
    if (!this.key || this.key !== keyOf("states", old)) return;
    this.key = keyOf("states", name);
    this.isRenamePending = true;
    this.canvas.report("state-renamed", { old, new: name });
  }

  /** Keeps the field over its node; closes it if the node was removed. */
  viewChanged() {
    if (!this.key) return;
    const node = this.canvas.scene.nodes.get(this.key);
    if (!node && this.isRenamePending) return;
    this.isRenamePending = false;
    if (!node) return this.#close(false);
    const { viewport } = this.canvas;
    const at = viewport.toScreen({ x: node.x - node.w / 2, y: node.y - node.h / 2 });
    const scale = Math.max(0.6, viewport.k);
    Object.assign(this.input.style, {
      left: `${at.x}px`,
      top: `${at.y + (node.h * viewport.k - 36 * scale) / 2}px`,
      width: `${Math.max(120, node.w * viewport.k)}px`,
      height: `${36 * scale}px`,
      fontSize: `${14 * scale}px`,
    });
  }

  #down(event) {
    // The page handles saving; the typed name is applied first, so that it is saved too.
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "s") return this.#leave(true);
    event.stopPropagation();
    if (!["Enter", "Escape", "Tab"].includes(event.key)) return;
    event.preventDefault();
    this.#leave(event.key !== "Escape");
  }

  #leave(keep) {
    this.#close(keep);
    this.canvas.stage.focus({ preventScroll: true });
  }

  #close(keep) {
    if (!this.key) return;
    const node = this.canvas.scene.nodes.get(this.key);
    const name = this.input.value.trim();
    this.key = null;
    this.input.hidden = true;
    if (keep && node && name && name !== nameOf(node)) this.canvas.report("rename", { item: { of: node.of, id: node.id }, name });
  }
}

const nameOf = (node) => (node.of === "states" ? node.data.name : node.data.id);
