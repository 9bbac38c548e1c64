// Key events become chords such as "Ctrl+Shift+Z"; what they mean is in the table of commands. Others go on to the page.

const HELD_ORDER = ["Ctrl", "Alt", "Shift"];

export class Keyboard {
  constructor(canvas) {
    this.canvas = canvas;
    const { stage } = canvas;
    this.onPageKey = (event) => this.#pageKey(event);
    stage.addEventListener("keydown", (event) => this.#down(event));
    stage.addEventListener("keyup", (event) => this.#up(event));
    // The focus is shown to those who steer by keys, and only to them.
    stage.addEventListener("keyup", () => stage.classList.add("keys"));
    stage.addEventListener("pointerdown", () => stage.classList.remove("keys"), { capture: true });
    stage.addEventListener("blur", () => this.#space(false));
    document.addEventListener("keydown", this.onPageKey);
    if (document.activeElement === document.body) stage.focus({ preventScroll: true });
  }

  dispose() {
    document.removeEventListener("keydown", this.onPageKey);
  }

  /** Keys pressed while nothing on the page has the focus are meant for the drawing. */
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

/** "Ctrl+Shift+Z": Cmd counts as Ctrl; signs are named as they are printed, whatever must be held to reach them. */
export function chordOf(event) {
  const isLetter = /^\p{L}$/u.test(event.key);
  const isSign = event.key.length === 1 && !isLetter && event.key !== " ";
  const isThirdLevel = event.getModifierState?.("AltGraph") ?? false;
  const held = {
    Ctrl: (event.ctrlKey || event.metaKey) && !isThirdLevel,
    Alt: event.altKey && !isThirdLevel,
    Shift: event.shiftKey && !isSign,
  };
  return [...HELD_ORDER.filter((name) => held[name]), keyOf(event, held.Alt)].join("+");
}

/** With Alt some keyboards give other letters; then the place of the key counts. */
function keyOf({ key, code }, alt) {
  if (key === " ") return "Space";
  if (alt && /^Key[A-Z]$/.test(code)) return code.slice(3);
  return key.length === 1 ? key.toUpperCase() : key;
}
