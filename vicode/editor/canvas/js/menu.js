// Context menu of the selection, opened by right-click, long press or Shift+F10.
import { nodeRect } from "./geometry.js";
import { MENU } from "./strings.js";
import { html } from "./svg.js";

const EDGE = 8;

export class Menu {
  constructor(canvas) {
    this.canvas = canvas;
    this.element = html("div", { class: "menu", role: "menu", tabindex: "-1", popover: "manual", hidden: true });
    this.element.addEventListener("keydown", (event) => this.#down(event));
    this.element.addEventListener("focusout", (event) => this.#lost(event));
    for (const name of ["pointerdown", "pointermove", "pointerup", "dblclick", "wheel", "keyup"]) this.element.addEventListener(name, (event) => event.stopPropagation());
    this.element.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  /** Opens at a point of the stage. */
  open({ x, y }) {
    const entries = this.canvas.commands.menuEntries();
    if (!entries.length) return;
    this.element.replaceChildren(...this.#rows(entries));
    this.element.setAttribute("aria-label", MENU);
    this.element.hidden = false;
    // A popover may cover the panels around the stage, which leave little room for a long menu.
    this.element.showPopover();
    const stage = this.canvas.stage.getBoundingClientRect();
    const fit = (at, size, room) => Math.max(EDGE, Math.min(at, room - size - EDGE));
    this.element.style.left = `${fit(stage.left + x, this.element.offsetWidth, window.innerWidth)}px`;
    this.element.style.top = `${fit(stage.top + y, this.element.offsetHeight, window.innerHeight)}px`;
    this.#items()[0].focus({ preventScroll: true });
  }

  /** Opens below the selected element, or in the middle of the view if nothing is selected. */
  openAtSelection() {
    const { selection, scene, router, viewport } = this.canvas;
    const key = selection.single() ?? selection.nodes().at(-1);
    if (key) this.canvas.reveal(key);
    const element = key && scene.find(key);
    if (!element) return this.open({ x: viewport.width / 2, y: viewport.height / 2 });
    const rect = scene.nameOf(key) ? nodeRect(scene.nameOf(key)) : { ...(scene.isDrawable(element) ? router.route(element).at : viewport.middle()), w: 0, h: 0 };
    this.open(viewport.toScreen({ x: rect.x + rect.w / 2, y: rect.y + rect.h }));
  }

  close({ refocus = false } = {}) {
    if (this.element.hidden) return;
    this.canvas.gestures.menuAt = null;
    if (refocus) this.canvas.stage.focus({ preventScroll: true });
    this.element.hidden = true;
    this.element.hidePopover();
  }

  #rows(entries) {
    let group = entries[0].group;
    return entries.flatMap((command) => {
      const row = this.#row(command);
      const opens = command.group !== group;
      group = command.group;
      return opens ? [html("div", { class: "menu-line", role: "separator" }), row] : [row];
    });
  }

  #row({ name, label, keys }) {
    const shown = keys[0] ?? "";
    const row = html("button", { type: "button", role: "menuitem", tabindex: "-1", "data-command": name, "aria-keyshortcuts": shown.replace("Ctrl", "Control") }, [
      html("span", { text: label }),
      html("kbd", { text: shown }),
    ]);
    row.addEventListener("click", () => this.#choose(name));
    return row;
  }

  /** Runs a command. Commands from the menu create elements where the menu was opened. */
  #choose(name) {
    const { commands, gestures } = this.canvas;
    const at = gestures.menuAt;
    this.close({ refocus: true });
    gestures.menuAt = at;
    commands.run(name);
    gestures.menuAt = null;
  }

  #items() {
    return [...this.element.querySelectorAll("[role=menuitem]")];
  }

  #down(event) {
    const items = this.#items();
    const at = items.indexOf(this.canvas.root.activeElement);
    const moves = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: items.length - 1 };
    event.stopPropagation();
    if (event.key === "Enter" || event.key === " ") return;
    event.preventDefault();
    if (event.key in moves) items.at(moves[event.key] % items.length).focus();
    else if (event.key === "Escape" || event.key === "Tab") this.close({ refocus: true });
    else if (event.key.length === 1) this.#jump(items, at, event.key.toLowerCase());
  }

  #jump(items, at, letter) {
    const rotated = [...items.slice(at + 1), ...items.slice(0, at + 1)];
    rotated.find((item) => item.textContent.toLowerCase().startsWith(letter))?.focus();
  }

  #lost(event) {
    if (!this.element.contains(event.relatedTarget)) this.close();
  }
}
