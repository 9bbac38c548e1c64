// Copy and paste through the clipboard of the system. What is copied comes from Python as text; what is pasted goes there.

// What travels to Python must stay well below its limit for one message.
const MAX_CHARACTERS = 400_000;
const ANSWER_MS = 20_000;
const TOO_LATE = new Error("no answer");

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

  /** Asks Python for the selection as text and puts it on the clipboard; a cut deletes it only then. */
  copy({ cut = false } = {}) {
    const items = this.canvas.selection.items();
    const text = this.#requestCopy(items);
    this.#write(text).then(
      () => {
        if (cut) this.canvas.report("delete", { items });
        this.canvas.showToast(cut ? "Cut" : "Copied");
      },
      (error) => this.canvas.showToast(error === TOO_LATE ? "vicode does not answer: nothing was copied" : "Nothing was copied"),
    );
  }

  /** Python's answer: the text, or null when there is nothing to copy. */
  resolveCopy(text) {
    this.answer?.(text);
    this.answer = null;
  }

  /** From a menu: the browser may ask whether it is allowed, or not allow it at all. */
  paste() {
    const { canvas } = this;
    const spot = canvas.gestures.pointerPosition();
    const read = navigator.clipboard?.readText ? navigator.clipboard.readText() : Promise.reject(new Error("no clipboard"));
    read.then((text) => this.#report(text, spot), () => canvas.showToast("Press Ctrl+V to paste"));
  }

  /** Within reach of the hand that pressed the key, the browser lets a promise be written. */
  #write(text) {
    if (!navigator.clipboard?.write) return text.then(writeOld);
    const blob = text.then((found) => new Blob([found], { type: "text/plain" }));
    return navigator.clipboard.write([new ClipboardItem({ "text/plain": blob })]);
  }

  #requestCopy(items) {
    return new Promise((resolve, reject) => {
      this.answer = (text) => (text === null ? reject(new Error("nothing")) : resolve(text));
      setTimeout(() => reject(TOO_LATE), ANSWER_MS);
      this.canvas.report("copy", { items });
    });
  }

  #handlePaste(event) {
    const [inner] = event.composedPath();
    const isOurs = event.composedPath().includes(this.canvas.stage) || inner === document.body;
    const isShown = Boolean(this.canvas.host.offsetParent);
    if (!isOurs || !isShown || inner.closest?.("input, textarea, [contenteditable=true]")) return;
    event.preventDefault();
    this.#report(event.clipboardData?.getData("text/plain") ?? "", this.canvas.gestures.pointerPosition());
  }

  #report(text, { x, y }) {
    const { canvas } = this;
    if (!text.trim()) canvas.showToast("The clipboard holds no text");
    else if (text.length > MAX_CHARACTERS) canvas.showToast("The clipboard holds too much text for a part of a design");
    else canvas.report("paste", { text, x, y });
  }
}

/** Pages that are not served securely have only the old way. */
function writeOld(text) {
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
