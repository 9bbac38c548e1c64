// What the inspector knows: the forms of all items, the texts of their fields, and the edits on their way.
import { nextTick, reactive } from "vue";
import { cardsIn, expanded, named, placed, placeOf, syncedText, textNodes, withPending } from "./form_data.js";
import { TypedLog } from "./typed_log.js";

const SEND_MS = 200;
// The fields that a double-click opens, by the kinds of items.
const FIRST_PATHS = { common: "doc", notes: "text" };
// The fields in which Python looks for times when their user leaves them.
const READS_TIMES = /^guard\/(when|after)$/;

// The forms that are parts of those of several items.
const PARTS = /^project\/|^design\/./;

export const keyOf = ({ of, id }) => `${of}/${id}`;

/** What the browser keeps of an item: its fields, choices and new cards that the design does not have yet. */
class ShownItem {
  constructor(key, number) {
    this.key = key;
    /** Stays the same when the item is renamed. */
    this.number = number;
    this.fields = new Map();
    this.pending = [];
    this.chosen = reactive({});
    this.closed = reactive({});
    this.opened = reactive({});
    this.drafts = {};
  }

  get ref() {
    const slash = this.key.indexOf("/");
    return { of: this.key.slice(0, slash), id: this.key.slice(slash + 1) };
  }
}

export class FormStore {
  constructor(emit) {
    this.emit = emit;
    this.rev = -1;
    this.editId = 0;
    this.itemCount = 0;
    this.forms = new Map();
    this.items = new Map();
    this.timers = new Map();
    this.unsettled = new Set();
    this.typed = new TypedLog();
    this.answers = new Map();
    this.view = reactive({ key: null, number: 0, nodes: [], lists: {}, marks: {}, openSections: [], language: "" });
  }

  load({ rev, forms, lists, marks, open_sections: openSections, language, server }) {
    this.forms.clear();
    Object.assign(this.view, { marks: {}, lists: {}, openSections, language });
    this.update({ rev, forms, lists, marks, moved: {}, acks: [] });
    for (const typed of this.typed.take(server)) this.#restore(typed);
  }

  /** Types a text again that the server may have lost. */
  #restore({ item, place, steps, text }) {
    const nodes = this.#nodesOf(keyOf(item)) ?? [];
    const [path, node] = [...textNodes(nodes)].find(([path]) => placeOf(nodes, path) === place) ?? [];
    const now = node && (node.value ?? "");
    if (now === text) return;
    if (steps.includes(now)) this.type(this.#field(this.#item(keyOf(item)), path, node), text);
    else this.request("lost-text", { item, text });
  }

  #note(field) {
    const [item, path] = this.#find(field);
    if (item) this.typed.note(field, () => ({ item: item.ref, place: placeOf(withPending(this.#nodesOf(item.key) ?? [], item.pending), path) }));
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
    const hasNewParts = Object.keys(forms).some((key) => PARTS.test(key));
    const isNew = (key) => key in forms || hasNewParts;
    for (const [key, item] of this.items) if (isNew(key)) this.#refresh(item);
    for (const ack of acks) this.#acknowledge(ack);
    if (isNew(this.view.key) || this.view.key in moved) this.#draw();
  }

  /** Shows the form of an item; null shows none. Returns whether it is another one. */
  show(item) {
    const key = item && keyOf(item);
    if (key === this.view.key) return false;
    this.view.key = key;
    this.#draw();
    return true;
  }

  get hasForm() {
    return this.forms.has(this.view.key);
  }

  /** The shown item. */
  get shown() {
    return this.#item(this.view.key);
  }

  #item(key) {
    if (!this.items.has(key)) this.items.set(key, new ShownItem(key, (this.itemCount += 1)));
    return this.items.get(key);
  }

  /** The field at a path of the shown item. */
  field(path, node) {
    return this.#field(this.shown, path, node);
  }

  #field({ fields }, path, node) {
    if (!fields.has(path)) fields.set(path, reactive(syncedText(node)));
    return fields.get(path);
  }

  type(field, text) {
    field.type(text);
    this.#note(field);
    if (READS_TIMES.test(this.#find(field)[1])) this.unsettled.add(field);
    this.#sendSoon(field);
  }

  focus(field) {
    field.hasFocus = true;
    const [item, path] = this.#find(field);
    if (item) this.request("focus", { item: item.ref, path });
  }

  /** Its user has left a field. */
  blur(field) {
    this.#send(field, true);
    this.#settle(field);
    field.blur();
    const [item] = this.#find(field);
    if (item) this.request("focus", { item: item.ref, path: null });
  }

  /** Sends a finished text, also one that was refused before. */
  commit(field) {
    field.error = "";
    this.#send(field, true);
  }

  /** Makes a choice; `kind` is that of the edit. */
  choose(kind, path, value, fields = {}) {
    const { chosen, ref } = this.shown;
    chosen[path] = { id: this.#emitEdit(kind, ref, { path, value, ...fields }), value };
  }

  /** The value at a path: that of the design, or one on its way there. */
  valueAt(path, value) {
    return this.shown.chosen[path]?.value ?? value;
  }

  press(action, fields = {}) {
    this.sendAll();
    return this.#emitEdit("press", this.shown.ref, { action, ...fields });
  }

  /** Presses a button; `answer` is called with the error, or "". */
  ask(action, fields, answer) {
    this.answers.set(this.press(action, fields), answer);
  }

  /** Texts of the shown item that are no part of the design yet. */
  draft(name, empty) {
    return (this.shown.drafts[name] ??= reactive(empty));
  }

  /** Adds a card at once; the design has it later. */
  addCard(list, adder, { id, alias, title, text }) {
    const item = this.shown;
    const nodes = placed(adder.nodes, [...list, id], alias);
    if (text) named(nodes, text);
    if (nodes[0].is === "Section") item.opened[nodes[0].key] = true;
    const card = { id, title, nodes };
    const edit = this.press("add-card", { path: list.join("/"), adds: adder.adds, card: id, to: alias, text });
    item.pending.push({ edit, list: list.join("/"), card });
    this.#draw();
  }

  /** A name for a new declaration or construct in a list at a path. */
  freeName(list, path, base) {
    // All declarations of the design have different names.
    const isOfDesign = path.length === 1 || path[0] === "design";
    const lists = isOfDesign ? this.view.nodes.filter((node) => node.noun) : [list];
    const taken = new Set(lists.flatMap(({ cards = [] }) => cards).map(({ title }) => title));
    let name = base;
    for (let number = 2; taken.has(name); number += 1) name = `${base}${number}`;
    return name;
  }

  /** Sends all typed texts now. */
  sendAll() {
    for (const { fields } of this.items.values()) for (const field of fields.values()) this.#send(field, true);
    for (const field of this.unsettled) this.#settle(field);
  }

  #settle(field) {
    const [item, path] = this.#find(field);
    if (this.unsettled.delete(field) && item) this.#emitEdit("settle", item.ref, { path });
  }

  #emitEdit(kind, item, fields) {
    this.editId += 1;
    this.emit("edit", { kind, id: this.editId, rev: this.rev, item, ...fields });
    return this.editId;
  }

  #sendSoon(field) {
    if (this.timers.has(field)) return;
    // The first letter is sent at once; further ones are sent together.
    this.#send(field);
    this.timers.set(field, setTimeout(() => (this.timers.delete(field), this.#send(field)), SEND_MS));
  }

  #send(field, isLeft = false) {
    const edit = field.takeEdit(this.editId + 1, isLeft);
    if (!edit) return;
    const [item, path] = this.#find(field);
    if (item) this.#emitEdit(field.kind === "name" ? "name" : "text", item.ref, { path, ...edit });
  }

  #find(field) {
    for (const item of this.items.values()) for (const [path, each] of item.fields) if (each === field) return [item, path];
    return [null, ""];
  }

  #acknowledge({ id, own, error }) {
    this.answers.get(id)?.(error);
    this.answers.delete(id);
    for (const item of this.items.values()) {
      for (const field of item.fields.values()) {
        if (!field.sent.some((edit) => edit.id === id)) continue;
        field.acknowledge(id, own, error);
        this.#note(field);
        this.#sendSoon(field);
        return;
      }
      for (const [path, choice] of Object.entries(item.chosen)) if (choice.id === id) delete item.chosen[path];
      const isAnswered = item.pending.some(({ edit }) => edit === id);
      item.pending = item.pending.filter(({ edit }) => edit !== id);
      if (isAnswered) this.#refresh(item);
      if (isAnswered && item.key === this.view.key) this.#draw();
    }
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

  /** A section is open if a user has opened it, for all items, or if one of its fields is set and it was not closed here. */
  isOpen({ key, is_set: isSet, look }) {
    if (look) return Boolean(this.shown.opened[key]);
    return this.view.openSections.includes(key) || Boolean(isSet && !this.shown.closed[key]);
  }

  toggle({ key, look }, isOpen) {
    if (look) {
      this.shown.opened[key] = isOpen;
      return;
    }
    const others = this.view.openSections.filter((each) => each !== key);
    this.view.openSections = isOpen ? [...others, key] : others;
    this.shown.closed[key] = !isOpen;
    this.request("section", { key, is_open: isOpen });
  }

  select(item) {
    this.sendAll();
    this.show(item);
    this.request("select", { item });
  }

  openDecision(path, index) {
    const rest = path[0] === "transitions" ? path.slice(1) : path;
    this.select({ of: "transitions", id: [this.shown.ref.id, ...rest, index].join("/") });
  }

  /** The field that a double-click opens: that of the guard, or its timer if the guard has nothing else. */
  firstPath() {
    const known = FIRST_PATHS[this.shown.ref.of];
    if (known) return known;
    const valueAt = (path) => this.view.nodes.find((node) => node.path?.join("/") === path)?.value;
    return valueAt("guard/after") && !valueAt("guard/when") ? "guard/after" : "guard/when";
  }

  address(path) {
    return { rev: this.rev, item: this.shown.ref, path };
  }

  /** Items that were renamed or moved keep what the browser has of them. */
  #move(moved) {
    const found = Object.entries(moved).map(([from, to]) => [this.items.get(from), to]);
    for (const from of Object.keys(moved)) this.items.delete(from);
    for (const [item, to] of found) {
      if (!item) continue;
      item.key = to;
      this.items.set(to, item);
    }
    if (this.view.key in moved) this.view.key = moved[this.view.key];
  }

  #refresh(item) {
    const nodes = this.#nodesOf(item.key);
    if (!nodes) return;
    const cards = cardsIn(nodes);
    item.pending = item.pending.filter(({ list, card }) => !cards.has(`${list}/${card.id}`));
    const isPending = (path) => item.pending.some(({ list, card }) => path.startsWith(`${list}/${card.id}/`));
    const texts = textNodes(nodes);
    for (const [path, field] of item.fields) {
      if (texts.has(path)) field.receive(texts.get(path).value ?? "");
      else if (!field.isDirty && !isPending(path)) item.fields.delete(path);
      this.#note(field);
    }
  }

  #nodesOf(key) {
    const form = this.forms.get(key);
    return form && expanded(JSON.parse(form), this.forms);
  }

  #draw() {
    const nodes = this.#nodesOf(this.view.key);
    this.view.nodes = nodes ? withPending(nodes, this.shown.pending) : [];
    this.view.number = nodes ? this.shown.number : -1;
  }

  async focusField(root, path) {
    await nextTick();
    const field = root.querySelector(`[data-path="${path}"]`);
    const input = field?.querySelector(".cm-content, input, textarea") ?? field;
    input?.focus();
    if (this.shown.ref.of === "notes") input?.select();
  }
}
