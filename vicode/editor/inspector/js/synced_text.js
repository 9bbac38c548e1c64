// The text of a field: what its user has typed, what the design has, and what is on its way to the server.
import { mergeTexts } from "./text_merge.js";

export class SyncedText {
  /**
   * `kind` is "checked" if the server may refuse a text: then one edit at a time is on its way, so that each is typed over a
   * text that the design has. The text of a "name" or a "committed" one is sent when its user has finished it.
   */
  constructor(text, kind = "") {
    this.kind = kind;
    /** The text of the design, as last received. */
    this.server = text;
    /** The text that the field shows. */
    this.local = text;
    /** A typed text that the design stores as `server`, without its outer spaces for example. */
    this.settled = text;
    /** The edits on their way: their ids and texts, each typed over the one before. */
    this.sent = [];
    /** The latest text received while edits were on their way. */
    this.received = null;
    /** Why the design does not have the typed text; "" if it does. */
    this.error = "";
    this.hasFocus = false;
  }

  /** Whether some of the shown text is not on its way to the design yet. */
  get isUnsent() {
    if (this.error) return false;
    return this.sent.length ? this.local !== this.sent.at(-1).text : this.local !== this.server && this.local !== this.settled;
  }

  get isDirty() {
    return Boolean(this.error) || this.isUnsent || this.sent.length > 0;
  }

  type(text) {
    this.local = text;
    this.error = "";
  }

  /** The base and the text of the next edit; null if there is nothing to send. `isLeft` says that the user has finished the text. */
  takeEdit(id, isLeft = false) {
    if (!this.isUnsent) return null;
    if (!isLeft && (["name", "committed"].includes(this.kind) || (this.kind === "checked" && this.sent.length))) return null;
    const base = this.sent.at(-1)?.text ?? this.server;
    this.sent.push({ id, text: this.local });
    return { base, text: this.local };
  }

  /** The design has this text. */
  receive(text) {
    // The answers to edits on their way say which part of the text is their own.
    if (this.sent.length) this.received = text;
    else if (text !== this.server) adopt(this, this.server, text);
  }

  /** The server answered edit `id`: the design stores it as `own`, or the edit was refused with an error. */
  acknowledge(id, own, error) {
    const { text: typed } = this.sent.find((edit) => edit.id === id);
    this.sent = this.sent.filter((edit) => edit.id > id);
    if (this.sent.length) return;
    const now = this.received ?? this.server;
    this.received = null;
    if (error) {
      if (this.local === typed) this.error = error;
      this.server = now;
      return;
    }
    if (now !== own) this.local = mergeTexts(own, this.local, now);
    this.settled = now === own && this.local === typed ? typed : now;
    this.server = now;
    if (!this.hasFocus) this.blur();
  }

  blur() {
    this.hasFocus = false;
    if (!this.sent.length && this.local === this.settled) this.local = this.settled = this.server;
  }
}

// Not a private method: Vue calls methods on a proxy.
function adopt(field, base, now) {
  const isTyping = field.local !== base && field.local !== field.settled;
  field.server = field.settled = now;
  // What the design does not have stays in sight.
  if (isTyping && field.error && field.local !== now) return;
  field.error = "";
  if (isTyping && field.kind === "name") field.error = `Another user renamed it to ${now}. Press Enter to use your name instead.`;
  else field.local = isTyping || field.hasFocus ? mergeTexts(base, field.local, now) : now;
}
