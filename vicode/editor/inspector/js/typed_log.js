// What was typed within the last seconds, kept by the tab of the browser: a server that was killed may not have stored it.

const KEPT_MS = 10_000;
const MAX_STEPS = 40;

export class TypedLog {
  constructor(storage = sessionStorage, name = `vicode-typed ${location.pathname}`) {
    Object.assign(this, { storage, name, server: "" });
    /** By field: its address, the texts that it has passed through, and the typed text. */
    this.entries = new Map();
  }

  /** Whether no texts wait to be restored. */
  get isEmpty() {
    return this.storage.getItem(this.name) === null;
  }

  /**
   * Returns the texts that the server with this id may not have: `{item, place, steps, text}`. The design has one of the
   * `steps`, as it may have been stored at any moment of the typing.
   */
  take(server) {
    this.server = server;
    const kept = JSON.parse(this.storage.getItem(this.name) ?? "[]");
    this.storage.removeItem(this.name);
    return kept.filter((entry) => !(entry.isAnswered && entry.server === server));
  }

  /** Notes the state of a field after it has changed; `find` returns its current address, `{item, place}`. */
  note(field, find) {
    const before = this.entries.get(field);
    if (!before && !field.isDirty) return;
    if (before && !field.isDirty && field.local !== before.text) return this.#forget(field);
    const entry = before ?? { find, steps: [] };
    const [first, ...others] = new Set([...entry.steps, field.server, ...field.sent.map(({ text }) => text)]);
    Object.assign(entry, { steps: [first, ...others.slice(-MAX_STEPS)], text: field.local, isAnswered: !field.isDirty });
    this.entries.set(field, entry);
    clearTimeout(entry.timer);
    if (entry.isAnswered) entry.timer = setTimeout(() => this.#forget(field), KEPT_MS);
    this.#write();
  }

  #forget(field) {
    clearTimeout(this.entries.get(field)?.timer);
    this.entries.delete(field);
    this.#write();
  }

  #write() {
    const kept = [...this.entries.values()].map(({ find, steps, text, isAnswered }) => ({ ...find(), steps, text, isAnswered, server: this.server }));
    try {
      if (kept.length) this.storage.setItem(this.name, JSON.stringify(kept));
      else this.storage.removeItem(this.name);
    } catch {
      // The quota of the browser: the texts are on their way to the server, too.
      this.storage.removeItem(this.name);
    }
  }
}
