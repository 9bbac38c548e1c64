// Copy and paste through the system clipboard. Python converts elements to text and back.
import { CLIPBOARD_EMPTY, CLIPBOARD_TOO_LARGE, COPIED, COPY_FAILED, COPY_TIMED_OUT, CUT, PASTE_BY_KEY } from "./strings.js";

// Well below the size limit of a message to the server.
const MAX_CHARACTERS = 400_000;
const ANSWER_MS = 20_000;
const TIMEOUT = new Error("no answer");

export class Clipboard {
  constructor(canvas) {
    this.canvas = canvas;
    this.answer = null;
    this.onPaste = (event) => this.#handlePaste(event);
    document.addEventListener("paste", this.onPaste);
  }

  dispose() {
    document.removeEventListener("paste", this.onPaste);
  }

  /** Requests the selection as text from Python and copies it to the clipboard; a cut deletes it only after that. */
  copy({ cut = false } = {}) {
    const items = this.canvas.selection.itemsWithContent();
    const text = this.#requestCopy(items);
    this.#write(text).then(
      () => {
        if (cut) this.canvas.report("delete", { items });
        this.canvas.showToast(cut ? CUT : COPIED);
      },
      (error) => this.canvas.showToast(error === TIMEOUT ? COPY_TIMED_OUT : COPY_FAILED),
    );
  }

  /** Receives Python's answer: the text, or null if there is nothing to copy. */
  resolveCopy(text) {
    this.answer?.(text);
    this.answer = null;
  }

  /** Pastes from the menu. The browser may ask for permission or deny it. */
  paste() {
    const { canvas } = this;
    const position = canvas.gestures.pointerPosition();
    const read = navigator.clipboard?.readText ? navigator.clipboard.readText() : Promise.reject(new Error("no clipboard"));
    read.then((text) => this.#report(text, position), () => canvas.showToast(PASTE_BY_KEY));
  }

  /** Writes a promise: the browser only allows a write that starts during the user's gesture. */
  #write(text) {
    if (!navigator.clipboard?.write) return text.then(writeByCommand);
    const blob = text.then((content) => new Blob([content], { type: "text/plain" }));
    return navigator.clipboard.write([new ClipboardItem({ "text/plain": blob })]);
  }

  #requestCopy(items) {
    return new Promise((resolve, reject) => {
      this.answer = (text) => (text === null ? reject(new Error("nothing")) : resolve(text));
      setTimeout(() => reject(TIMEOUT), ANSWER_MS);
      this.canvas.report("copy", { items });
    });
  }

  #handlePaste(event) {
    const [inner] = event.composedPath();
    const isForCanvas = event.composedPath().includes(this.canvas.stage) || inner === document.body;
    const isShown = Boolean(this.canvas.host.offsetParent);
    if (!isForCanvas || !isShown || inner.closest?.("input, textarea, [contenteditable=true]")) return;
    event.preventDefault();
    this.#report(event.clipboardData?.getData("text/plain") ?? "", this.canvas.gestures.pointerPosition());
  }

  #report(text, { x, y }) {
    const { canvas } = this;
    if (!text.trim()) canvas.showToast(CLIPBOARD_EMPTY);
    else if (text.length > MAX_CHARACTERS) canvas.showToast(CLIPBOARD_TOO_LARGE);
    else canvas.report("paste", { text, x, y });
  }
}

/** Fallback for pages without HTTPS, where the clipboard interface is missing. */
function writeByCommand(text) {
  const field = document.createElement("textarea");
  field.value = text;
  field.style.position = "fixed";
  const focused = document.activeElement;
  document.body.append(field);
  field.select();
  const done = document.execCommand("copy");
  field.remove();
  focused?.focus?.({ preventScroll: true });
  if (!done) throw new Error("not allowed");
}
