// Lists of cards, such as the actions of a state. A new card is there at once, and its first field has the focus.
import { nextTick } from "vue";
import * as CM from "nicegui-codemirror";

const newId = () => `b${Math.random().toString(36).slice(2, 12).padEnd(4, "0")}`;

const DETAILS = ["Section", "Cards", "Button"];
const SMALL = { flat: true, dense: true, round: true, size: "sm", class: "icon-button" };

/** The framed form of a declaration; its details are below its fields. */
export const Group = {
  props: { node: Object },
  inject: ["store"],
  template: `
    <div class="declaration" :class="look" role="group" :aria-label="node.noun + ' ' + node.title" :data-card="path">
      <form-nodes :nodes="fields" />
      <q-btn v-if="node.can_move_up" v-bind="small" icon="arrow_upward" class="move-up" :aria-label="'Move up ' + name" @click="store.press('move-card', { path, to: '-1' })" />
      <q-btn v-bind="small" icon="close" :aria-label="'Remove ' + name" @click="store.press('remove-card', { path })" />
      <form-nodes :nodes="details" />
    </div>`,
  computed: {
    small: () => SMALL,
    look() {
      return { shared: "shared removable", element: "element-row" }[this.node.look];
    },
    path() {
      return this.node.path.join("/");
    },
    /** In project.yaml, things of different kinds have the same names. */
    name() {
      return this.node.path[0] === "project" ? `${this.node.noun} ${this.node.title}` : this.node.title;
    },
    details() {
      return this.node.nodes.filter(({ is }) => DETAILS.includes(is));
    },
    fields() {
      return this.node.nodes.filter(({ is }) => !DETAILS.includes(is));
    },
  },
};

/** The buttons that move and remove a card of a list. */
const OrderButtons = {
  props: { node: Object, card: Object, index: Number },
  inject: ["store"],
  template: `
    <div class="row-buttons nicegui-row">
      <template v-if="node.is_ordered">
        <q-btn v-bind="small" icon="arrow_upward" :disable="index === 0" :aria-label="name('Move up')" @click="move(-1)" />
        <q-btn v-bind="small" icon="arrow_downward" :disable="index === node.cards.length - 1" :aria-label="name('Move down')" @click="move(1)" />
      </template>
      <q-btn v-bind="small" icon="close" :aria-label="name('Remove')" @click="store.press('remove-card', { path })" />
    </div>`,
  computed: {
    small: () => SMALL,
    path() {
      return [...this.node.path, this.card.id].join("/");
    },
  },
  methods: {
    name(verb) {
      return this.node.is_ordered ? `${verb}: ${this.index + 1} ${this.card.title}` : `${verb}: ${this.card.title}`;
    },
    move(by) {
      this.store.press("move-card", { path: this.path, to: String(by) });
    },
  },
};

export const Cards = {
  components: { OrderButtons },
  props: { node: Object },
  inject: ["store"],
  template: `
    <div v-if="node.noun && node.is_ordered" v-for="(card, index) in node.cards" :key="card.id" class="construct nicegui-row" role="group" :aria-label="node.noun + ' ' + card.title" :data-card="pathOf(card)">
      <form-nodes :nodes="card.nodes" />
      <order-buttons :node="node" :card="card" :index="index" />
    </div>
    <template v-else-if="node.noun" v-for="card in node.cards" :key="card.id"><form-nodes :nodes="card.nodes" /></template>
    <div v-else v-for="(card, index) in node.cards" :key="card.id" class="card nicegui-column" :data-card="pathOf(card)">
      <div class="card-head nicegui-row">
        <div class="card-title">{{ card.title }}</div>
        <order-buttons :node="node" :card="card" :index="index" />
      </div>
      <form-nodes :nodes="card.nodes" />
    </div>
    <div v-if="adders.length" class="adders wide nicegui-row">
      <q-btn v-for="adder in adders" flat dense no-caps size="sm" :icon="adder.icon" :label="adder.label" :aria-label="nameOf(adder)"
        :disable="adder.options && !optionsOf(adder).length" @click="adder.options || add(adder)">
        <q-menu v-if="adder.options" auto-close no-refocus><q-list>
          <q-item v-for="option in optionsOf(adder)" clickable class="mono" role="menuitem" @click="add(adder, option)"><q-item-section>{{ option }}</q-item-section></q-item>
        </q-list></q-menu>
      </q-btn>
      <q-btn v-if="node.menu" flat dense no-caps size="sm" icon="add" :label="node.menu" :aria-label="'Add ' + node.menu">
        <q-menu auto-close no-refocus><q-list>
          <q-item v-for="adder in store.view.lists.adders.constructs" clickable role="menuitem" :disable="!adder.adds" @click="add(adder, '', ['design', adder.adds])">
            <q-item-section><q-item-label>{{ adder.label }}</q-item-label><q-item-label caption>{{ adder.hint }}</q-item-label></q-item-section>
          </q-item>
        </q-list></q-menu>
      </q-btn>
    </div>`,
  computed: {
    small: () => SMALL,
    list() {
      return this.node.path.join("/");
    },
    adders() {
      return this.store.view.lists.adders[this.node.adders] ?? [];
    },
  },
  methods: {
    nameOf({ label }) {
      const { noun, owner } = this.node;
      if (!noun) return `Add to ${this.list}: ${label}`;
      return label === "Add" ? `Add ${noun}` : owner ? `Add ${label} to ${owner}` : `Add ${label}`;
    },
    pathOf(card) {
      return `${this.list}/${card.id}`;
    },
    optionsOf(adder) {
      const options = this.store.view.lists[adder.options];
      return adder.is_unique ? options.filter((option) => !this.node.cards.some(({ id }) => id === option)) : options;
    },
    add(adder, alias = "", path = this.node.path) {
      if (!adder.nodes.length) return this.store.press("add-card", { path: path.join("/") });
      const id = adder.is_unique ? alias : newId();
      const title = this.node.noun ? this.store.freeName(this.node, path, adder.title || this.node.noun) : [adder.title, alias].filter(Boolean).join(" ");
      const text = this.node.noun ? title : (adder.nodes[0].value ?? "");
      this.store.addCard(path, adder, { id, alias, title, text });
      nextTick(() => this.edit([...path, id].join("/")));
    },
    /**
     * Focuses the first field of a card; its text is selected, to be typed over. A new list comes from the server, and
     * a menu that closes takes the focus away again.
     */
    edit(path, attempts = 100, isSelected = false) {
      // The same declarations may stand in two lists of a form.
      const card = [...document.querySelectorAll(`[data-card="${CSS.escape(path)}"]`)].find((each) => each.offsetParent);
      const { activeElement: active } = document;
      const isTyping = attempts < 100 && active.matches("input, textarea, .cm-content");
      if (isTyping && !card?.contains(active)) return;
      if (card && !isTyping) this.focusFirst(card, path, isSelected);
      const isClosing = document.querySelector(".q-menu") !== null;
      if (attempts && (!card || isClosing)) setTimeout(() => this.edit(path, attempts - 1, isSelected || Boolean(card)), 20);
    },
    focusFirst(card, path, isSelected) {
      const input = card.querySelector("input:not([role=combobox])");
      // The condition of an interrupt is its first text.
      if (this.node.noun && !path.includes("/interrupts/")) return isSelected ? input.focus() : input.select();
      const content = card.querySelector(".cm-content");
      const view = content && CM.EditorView.findFromDOM(content);
      if (!view) return;
      view.focus();
      if (!isSelected) view.dispatch({ selection: { anchor: 0, head: view.state.doc.length } });
    },
  },
};
