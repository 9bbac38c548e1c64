// The nodes of a form as Vue components; see `nodes.py`.
import { AddRow } from "./add_row.js";
import { Cards, Group } from "./cards.js";
import { CodeText, Languages } from "./code_text.js";
import { Decisions } from "./decisions.js";
import { Check, Choice, MultiChoice, Colors, ItemName, TextField } from "./fields.js";
import { marksAt } from "./messages.js";

const Title = {
  props: { node: Object },
  inject: ["store"],
  template: `
    <div :class="node.is_hidden ? 'visually-hidden' : 'panel-title'" class="nicegui-row" role="heading" aria-level="2">
      <div>{{ node.text }}</div>
      <a v-if="node.opens" class="mono nicegui-link" href="#" @click.prevent="store.select({ of: node.opens[0], id: node.opens[1] })">{{ node.name }}</a>
      <div v-else-if="node.name" class="mono">{{ node.name }}</div>
    </div>`,
};

const Notice = {
  props: { node: Object },
  inject: ["store"],
  template: `
    <div v-for="mark in marks" class="outside-note nicegui-row" role="status"><q-icon name="input" aria-hidden="true" /><div>{{ mark.message }}</div></div>`,
  computed: {
    marks() {
      return marksAt(this.store, this.node.path.join("/"));
    },
  },
};

const Heading = {
  props: { node: Object },
  template: `
    <div class="heading nicegui-row"><div role="heading" aria-level="3">{{ node.text }}</div><div v-if="node.hint" class="heading-hint">{{ node.hint }}</div></div>`,
};

const Button = {
  props: { node: Object },
  inject: ["store"],
  template: `
    <q-btn flat dense no-caps :size="node.is_danger ? undefined : 'sm'" :icon="node.icon" :label="node.label" :color="node.is_danger ? 'negative' : 'primary'"
      :class="{ remove: node.is_danger }" @click="store.press(node.action, { path: node.path?.join('/') ?? '' })" />`,
};

const Row = {
  props: { node: Object },
  template: `<div class="field-row"><form-nodes :nodes="node.nodes" /></div>`,
};

const Section = {
  props: { node: Object },
  inject: ["store"],
  template: `
    <q-expansion-item ref="section" class="section nicegui-expansion" :class="{ 'declaration-more': node.look, 'declared-line': node.look === 'line' }" dense :duration="0" :label="node.title" :caption="node.caption" :model-value="isOpen" @update:model-value="turn">
      <div v-if="isOpen" class="nicegui-expansion-content nicegui-column"><form-nodes :nodes="node.nodes" /></div>
    </q-expansion-item>`,
  computed: {
    isOpen() {
      return this.store.isOpen(this.node);
    },
  },
  methods: {
    turn(isOpen) {
      this.store.toggle(this.node, isOpen);
      // A section at the lower edge opens out of sight.
      if (isOpen) this.$nextTick(() => this.$refs.section.$el.scrollIntoView({ block: "nearest" }));
    },
  },
};

const ItemLink = {
  props: { node: Object },
  inject: ["store"],
  template: `
    <button type="button" class="choice use-row" @click="store.select({ of: node.opens[0], id: node.opens[1] })">
      <div :class="{ mono: node.is_code }">{{ node.label }}</div><div class="component-name ellipsis">{{ node.caption }}</div>
    </button>`,
};

const Uses = {
  props: { node: Object },
  inject: ["store"],
  template: `
    <div v-for="row in node.rows" :key="row.alias" class="use-row nicegui-row">
      <div class="mono alias">{{ row.alias }}</div><div class="component-name">{{ row.component }}</div>
      <q-btn flat dense round size="sm" icon="close" class="icon-button" :aria-label="'Remove ' + row.alias" @click="store.press('remove-use', { to: row.alias })" />
    </div>
    <div class="adders nicegui-row">
      <q-btn flat dense no-caps size="sm" icon="add" label="Component" aria-label="Add Component" :disable="!unused.length">
        <q-menu auto-close><q-list>
          <q-item v-for="name in unused" clickable class="mono" role="menuitem" @click="store.press('add-use', { to: name })"><q-item-section>{{ name }}</q-item-section></q-item>
        </q-list></q-menu>
      </q-btn>
    </div>`,
  computed: {
    unused() {
      return this.store.view.lists.unused;
    },
  },
};

const Paragraph = {
  props: { node: Object },
  template: `<div :class="node.look">{{ node.text }}</div>`,
};

const DeclarationLine = {
  props: { node: Object },
  template: `
    <div class="interface-row nicegui-row">
      <div class="mono">{{ node.name }}</div><div class="interface-type">{{ node.about }}</div><div class="interface-doc">{{ node.doc }}</div>
    </div>`,
};

const KINDS = {
  TextField, ItemName, Choice, MultiChoice, Check, Colors, CodeText, Languages, Title, Notice, Heading, Button, Decisions, Cards, Row, Section, ItemLink, Uses, Group, Paragraph, DeclarationLine, AddRow,
};

/** The nodes of a form, or of a part of it. */
export const FormNodes = {
  props: { nodes: Array },
  inject: ["store"],
  template: `<component v-for="(node, index) in nodes" :is="kind(node)" :key="keyOf(node, index)" :node="node" />`,
  methods: {
    kind: (node) => KINDS[node.is],
    keyOf(node, index) {
      // Each item has elements of its own, with its own texts.
      return `${this.store.view.number}|${node.is}|${node.path?.join("/") ?? node.key ?? node.kind ?? index}`;
    },
  },
};

for (const parent of [Row, Section, Cards, Group]) parent.components = { ...parent.components, FormNodes };
