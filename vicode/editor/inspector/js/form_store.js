// What the inspector knows: the forms of all items, the texts of their fields, and the edits on their way.
import { nextTick, reactive } from "vue";
import { SyncedText } from "./synced_text.js";

const SEND_MS = 200;
// The fields in which Python looks for times when their user leaves them.
const READS_TIMES = /\|guard\/(when|after)$/;

export const keyOf = ({ of, id }) => `${of}/${id}`;

export class FormStore {
  constructor(emit) {
    this.emit = emit;
    this.rev = -1;
    this.editId = 0;
    this.forms = new Map();
    this.fields = new Map();
    this.actions = new Map();
    this.timers = new Map();
    this.unsettled = new Set();
    this.view = reactive({ key: null, nodes: [], lists: {}, marks: {}, openSections: [], language: "" });
  }

  load({ rev, forms, lists, marks, openSections, language }) {
    this.forms.clear();
    Object.assign(this.view, { marks: {}, lists: {}, openSections, language });
    this.update({ rev, forms, lists, marks, moved: {}, acks: [] });
  }

  /** Applies changes of the design; `acks` answers edits. */
  update({ rev, forms = {}, lists, marks = {}, moved = {}, acks = [] }) {
    if (rev !== undefined) this.rev = rev;
    this.#move(moved);
    for (const [key, form] of Object.entries(forms)) {
      if (form === null) this.forms.delete(key);
      else this.forms.set(key, form);
    }
    if (lists) this.view.lists = lists;
    for (const [key, list] of Object.entries(marks)) {
      if (list === null) delete this.view.marks[key];
      else this.view.marks[key] = list;
    }
    for (const key of Object.keys(forms)) if (this.hasFields(key)) this.#refresh(key);
    for (const ack of acks) this.#acknowledge(ack);
    if (this.view.key in forms || this.view.key in moved) this.#draw();
  }

  /** Shows the form of an item; null shows none. */
  show(item) {
    const key = item && keyOf(item);
    if (key === this.view.key) return;
    this.view.key = key;
    this.#draw();
  }

  get hasForm() {
    return this.forms.has(this.view.key);
  }

  hasFields(key) {
    return [...this.fields.keys()].some((each) => each.startsWith(`${key}|`));
  }

  /** The field at a path of the shown item. */
  field(path, value) {
    const key = `${this.view.key}|${path}`;
    if (!this.fields.has(key)) this.fields.set(key, reactive(new SyncedText(value)));
    const field = this.fields.get(key);
    return field;
  }

  type(path, text) {
    const key = `${this.view.key}|${path}`;
    this.fields.get(key).type(text);
    if (READS_TIMES.test(key)) this.unsettled.add(key);
    this.#sendSoon(key);
  }

  focus(path) {
    const key = `${this.view.key}|${path}`;
    this.fields.get(key).hasFocus = true;
    this.request("focus", { item: this.#item(key), path });
  }

  blur(key) {
    const field = this.fields.get(key);
    if (!field) return;
    this.#send(key);
    this.#settle(key);
    field.blur();
    this.request("focus", { item: this.#item(key), path: null });
  }

  keyOfField(path) {
    return `${this.view.key}|${path}`;
  }

  choose(path, value) {
    this.#emitEdit("choose", this.keyOfField(path), { value });
  }

  check(path, value) {
    this.#emitEdit("check", this.keyOfField(path), { value });
  }

  press(action, fields = {}) {
    this.sendAll();
    this.emit("edit", { kind: "press", id: (this.editId += 1), rev: this.rev, item: this.#item(`${this.view.key}|`), action, ...fields });
  }

  /** Sends all typed texts now. */
  sendAll() {
    for (const key of this.fields.keys()) this.#send(key);
    for (const key of this.unsettled) this.#settle(key);
  }

  #settle(key) {
    if (this.unsettled.delete(key)) this.#emitEdit("settle", key, {});
  }

  #emitEdit(kind, key, fields) {
    const path = key.slice(key.indexOf("|") + 1);
    this.emit("edit", { kind, id: (this.editId += 1), rev: this.rev, item: this.#item(key), path, ...fields });
  }

  #sendSoon(key) {
    if (this.timers.has(key)) return;
    // The first letter is sent at once; further ones are sent together.
    this.#send(key);
    this.timers.set(key, setTimeout(() => (this.timers.delete(key), this.#send(key)), SEND_MS));
  }

  #send(key) {
    const field = this.fields.get(key);
    const edit = field?.takeEdit(this.editId + 1);
    if (edit) this.#emitEdit("text", key, edit);
  }

  #acknowledge({ id, own, error }) {
    for (const [key, field] of this.fields) {
      if (!field.sent.some((edit) => edit.id === id)) continue;
      field.acknowledge(id, own, error);
      this.#sendSoon(key);
      return;
    }
    // A refused choice: shows the design again.
    if (error) this.#draw();
  }

  /** Requests the completion of a text; `assist` receives the answer. */
  complete(assist, path, { number, text, offset }) {
    this.requests ??= new Map();
    const id = (this.requestId = (this.requestId ?? 0) + 1);
    this.requests.set(id, [assist, number]);
    this.request("complete", { number: id, ...this.address(path), text, offset });
  }

  answerCompletion(id, answer) {
    const [assist, number] = this.requests.get(id) ?? [];
    this.requests.delete(id);
    assist?.answer(number, answer);
  }

  askFixes(finding) {
    this.view.fixes = null;
    this.request("fixes", { finding });
  }

  fix(finding, index, label) {
    this.sendAll();
    this.request("fix", { finding, index, label });
  }

  request(kind, fields) {
    this.emit("request", { kind, ...fields });
  }

  showLanguage = (language) => {
    this.view.language = language;
    this.request("language", { language });
  };

  select(item) {
    this.sendAll();
    this.show(item);
    this.request("select", { item });
  }

  openDecision(path, index) {
    const { id } = this.#item(`${this.view.key}|`);
    const rest = path[0] === "transitions" ? path.slice(1) : path;
    this.select({ of: "transitions", id: [id, ...rest, index].join("/") });
  }

  /** The field that a double-click on a transition opens: the timer if the guard has nothing else. */
  firstPath() {
    const valueAt = (path) => this.view.nodes.find((node) => node.path?.join("/") === path)?.value;
    return valueAt("guard/after") && !valueAt("guard/when") ? "guard/after" : "guard/when";
  }

  address(path) {
    return { rev: this.rev, item: this.#item(this.keyOfField(path)), path };
  }

  /** Items that others renamed or moved keep their fields. */
  #move(moved) {
    if (!Object.keys(moved).length) return;
    const renamed = (key) => {
      const [item, path] = [key.slice(0, key.indexOf("|")), key.slice(key.indexOf("|"))];
      return (moved[item] ?? item) + path;
    };
    this.fields = new Map([...this.fields].map(([key, field]) => [renamed(key), field]));
    this.unsettled = new Set([...this.unsettled].map(renamed));
    if (this.view.key in moved) this.view.key = moved[this.view.key];
  }

  #refresh(item) {
    const form = this.forms.get(item);
    if (!form) return;
    const texts = textsOf(JSON.parse(form));
    for (const [key, field] of this.fields) {
      if (!key.startsWith(`${item}|`)) continue;
      const path = key.slice(item.length + 1);
      if (texts.has(path)) field.receive(texts.get(path));
      else if (!field.isDirty) this.fields.delete(key);
    }
  }

  #draw() {
    const form = this.forms.get(this.view.key);
    this.view.nodes = form ? JSON.parse(form) : [];
  }

  #item(key) {
    const item = key.slice(0, key.indexOf("|"));
    const slash = item.indexOf("/");
    return { of: item.slice(0, slash), id: item.slice(slash + 1) };
  }

  async focusField(root, path) {
    await nextTick();
    const field = root.querySelector(`[data-path="${path}"]`);
    (field?.querySelector(".cm-content, input, textarea") ?? field)?.focus();
  }
}

/** The texts of a form by their paths. */
function textsOf(nodes, texts = new Map()) {
  for (const node of nodes) {
    if (node.is === "TextField" || node.is === "CodeText") texts.set(node.path.join("/"), node.value ?? "");
    for (const part of [node.texts, node.nodes]) if (part) textsOf(part, texts);
  }
  return texts;
}
