// Whether the user is typing text. A letter that follows is no command, wherever the focus has gone meanwhile.

const PAUSE_MS = 1000;
const ENDS = ["Enter", "Tab", "Escape"];

export class Typing {
  constructor() {
    this.lastMs = -Infinity;
    this.onKey = (event) => this.#key(event);
    this.onPointer = () => this.end();
    document.addEventListener("keydown", this.onKey, true);
    document.addEventListener("pointerdown", this.onPointer, true);
  }

  dispose() {
    document.removeEventListener("keydown", this.onKey, true);
    document.removeEventListener("pointerdown", this.onPointer, true);
  }

  /** Whether a key belongs to the text; it continues it then. */
  continues() {
    const now = performance.now();
    if (now - this.lastMs >= PAUSE_MS) return false;
    this.lastMs = now;
    return true;
  }

  end() {
    this.lastMs = -Infinity;
  }

  #key(event) {
    if (ENDS.includes(event.key) && !event.isComposing) return this.end();
    const isLetter = event.isComposing || (event.key.length === 1 && !event.ctrlKey && !event.metaKey && !event.altKey);
    const field = event.composedPath()[0];
    if (isLetter && field.matches?.("input:not([type=checkbox], [type=radio]), textarea, [contenteditable=true]")) this.lastMs = performance.now();
  }
}
