// Converts key events to shortcuts such as "Ctrl+Shift+Z" and runs their commands. Other keys are left to the page.

import { Typing } from "./typing.js";

// The page runs a command, such as saving, or shows something else: what is typed belongs to the design before that.
const SENDS_TEXT = ["vicode-send-text", "vicode-leave", "beforeunload"];
const MODIFIER_ORDER = ["Ctrl", "Alt", "Shift"];

export class Keyboard {
  constructor(canvas) {
    this.canvas = canvas;
    this.typing = new Typing();
    const { stage } = canvas;
    this.onPageKey = (event) => this.#pageKey(event);
    stage.addEventListener("keydown", (event) => this.#down(event));
    stage.addEventListener("keyup", (event) => this.#up(event));
    // The focus ring is only shown to keyboard users.
    stage.addEventListener("keyup", () => stage.classList.add("keys"));
    stage.addEventListener("pointerdown", () => stage.classList.remove("keys"), { capture: true });
    stage.addEventListener("blur", () => this.#space(false));
    document.addEventListener("keydown", this.onPageKey);
    this.onSendText = () => [canvas.rename, canvas.guard].forEach((field) => field.keep());
    for (const name of SENDS_TEXT) addEventListener(name, this.onSendText);
    this.onCommand = (event) => canvas.commands.isEdit(event.detail) && this.typing.continues() && event.preventDefault();
    addEventListener("vicode-command", this.onCommand);
    if (document.activeElement === document.body) stage.focus({ preventScroll: true });
  }

  dispose() {
    document.removeEventListener("keydown", this.onPageKey);
    for (const name of SENDS_TEXT) removeEventListener(name, this.onSendText);
    removeEventListener("vicode-command", this.onCommand);
    this.typing.dispose();
  }

  /** Keys pressed while no element of the page has the focus are handled by the canvas. */
  #pageKey(event) {
    if (event.target !== document.body || event.defaultPrevented || event.key === "Tab" || !this.canvas.host.offsetParent) return;
    this.canvas.stage.focus({ preventScroll: true });
    this.#down(event);
  }

  #down(event) {
    if (event.target.closest?.("input, button, [role=menu]")) return;
    if (!this.#take(event)) return;
    event.preventDefault();
    event.stopPropagation();
  }

  #take(event) {
    const { gestures, commands } = this.canvas;
    const chord = chordOf(event);
    if (chord === "Space") return this.#space(true);
    if (gestures.connectMode && /^[\p{L}\p{N}_]$/u.test(event.key) && !/Ctrl|Alt/.test(chord)) return gestures.connectMode.aimByName(event.key);
    if (commands.isEdit(commands.find(chord)?.name) && this.typing.continues()) return true;
    return commands.runShortcut(chord);
  }

  #up(event) {
    if (event.key === " ") this.#space(false);
  }

  #space(held) {
    this.canvas.gestures.spaceHeld = held;
    this.canvas.stage.classList.toggle("space", held);
    return true;
  }
}

/** Returns a shortcut such as "Ctrl+Shift+Z". Cmd counts as Ctrl; Shift is left out for signs such as "?". */
export function chordOf(event) {
  const isLetter = /^\p{L}$/u.test(event.key);
  const isSign = event.key.length === 1 && !isLetter && event.key !== " ";
  const isThirdLevel = event.getModifierState?.("AltGraph") ?? false;
  const held = {
    Ctrl: (event.ctrlKey || event.metaKey) && !isThirdLevel,
    Alt: event.altKey && !isThirdLevel,
    Shift: event.shiftKey && !isSign,
  };
  return [...MODIFIER_ORDER.filter((name) => held[name]), keyOf(event, held.Alt)].join("+");
}

/** With Alt, some keyboard layouts produce other letters; then the physical key is used. */
function keyOf({ key, code }, alt) {
  if (key === " ") return "Space";
  if (alt && /^Key[A-Z]$/.test(code)) return code.slice(3);
  return key.length === 1 ? key.toUpperCase() : key;
}
