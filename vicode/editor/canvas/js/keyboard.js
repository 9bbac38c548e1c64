// Converts key events to shortcuts such as "Ctrl+Shift+Z" and runs their commands. Other keys are left to the page.

const MODIFIER_ORDER = ["Ctrl", "Alt", "Shift"];
const MAX_HOLD_MS = 3000;

export class Keyboard {
  constructor(canvas) {
    this.canvas = canvas;
    this.held = null;
    const { stage } = canvas;
    this.onPageKey = (event) => this.#pageKey(event);
    stage.addEventListener("keydown", (event) => this.#down(event));
    stage.addEventListener("keyup", (event) => this.#up(event));
    // The focus ring is only shown to keyboard users.
    stage.addEventListener("keyup", () => stage.classList.add("keys"));
    stage.addEventListener("pointerdown", () => stage.classList.remove("keys"), { capture: true });
    stage.addEventListener("blur", () => this.#space(false));
    document.addEventListener("keydown", this.onPageKey);
    if (document.activeElement === document.body) stage.focus({ preventScroll: true });
  }

  dispose() {
    document.removeEventListener("keydown", this.onPageKey);
  }

  /** Holds keys until Python has selected what a gesture created: they are for that, and not for the old selection. */
  hold() {
    const held = (this.held = []);
    setTimeout(() => this.held === held && this.release(), MAX_HOLD_MS);
  }

  release() {
    const held = this.held ?? [];
    this.held = null;
    for (const { key, code, shiftKey } of held) {
      this.canvas.stage.dispatchEvent(new KeyboardEvent("keydown", { key, code, shiftKey, bubbles: true, composed: true, cancelable: true }));
    }
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
    if (this.held && !event.ctrlKey && !event.altKey && !event.metaKey) return this.held.push(event);
    if (chord === "Space") return this.#space(true);
    if (gestures.connectMode && /^[\p{L}\p{N}_]$/u.test(event.key) && !/Ctrl|Alt/.test(chord)) return gestures.connectMode.aimByName(event.key);
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
