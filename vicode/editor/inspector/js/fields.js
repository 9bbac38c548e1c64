// Fields with a text, a choice or a check as Vue components, on the components of Quasar.
import { nextTick } from "vue";
import { Messages, marksAt } from "./messages.js";
import { findChange } from "./text_merge.js";

const WITHOUT_CORRECTIONS = { autocapitalize: "off", spellcheck: "false", autocomplete: "off" };

/** A field with a text. */
const textField = (template) => ({
  props: { node: Object },
  inject: ["store"],
  components: { Messages },
  template,
  data() {
    const path = this.node.path.join("/");
    return { path, field: this.store.field(path, this.node) };
  },
  computed: {
    marks() {
      return marksAt(this.store, this.path);
    },
    /** The worst severity of the messages; "" if they are not about the text. */
    worst() {
      if (this.field.error) return "error";
      return ["error", "warning", "note"].find((severity) => this.marks.some((mark) => mark.severity === severity)) ?? "";
    },
    corrections() {
      return this.node.is_code || this.field.kind === "name" ? WITHOUT_CORRECTIONS : {};
    },
  },
  watch: {
    "field.local"(now, before) {
      // A text of the design is set without moving the cursor.
      const element = this.$refs.input?.nativeEl;
      if (!element || element !== document.activeElement || element.value === now) return;
      const change = findChange(before, now);
      const moved = (at) => (at <= change.start ? at : Math.max(change.start, at + now.length - before.length));
      const [start, end] = [moved(element.selectionStart), moved(element.selectionEnd)];
      nextTick(() => element.setSelectionRange(start, end));
    },
  },
  methods: {
    /** Enter finishes a text of one line. */
    finish() {
      if (this.node.is_committed && !this.node.is_long) this.store.commit(this.field);
    },
    type(text) {
      this.store.type(this.field, String(text ?? ""));
    },
  },
});

// Quasar emits "blur" a task later, when the next field may already have the next letters: they would arrive before the name.
export const TextField = textField(
  `<div class="field nicegui-column" :class="{ wide: node.is_wide }" :data-path="path">
    <q-input ref="input" outlined dense stack-label :label="node.label" :maxlength="node.is_committed ? 2000 : undefined" :placeholder="node.hint" :model-value="field.local"
      :type="node.is_long ? 'textarea' : 'text'" :autogrow="node.is_long" :class="[{ mono: node.is_code, 'has-finding': worst }, worst]"
      v-bind="corrections" @update:model-value="type" @focus="store.focus(field)" @focusout="store.blur(field)" @keydown.enter="finish" />
    <messages :marks="marks" :error="field.error" />
    <div v-if="node.help" class="empty">{{ node.help }}</div>
  </div>`,
);

export const ItemName = textField(
  `<div class="field nicegui-column" :data-path="path">
    <q-input ref="input" outlined dense stack-label class="mono" :class="[{ 'has-finding': worst }, worst]" :label="node.label" maxlength="80" :model-value="field.local"
      v-bind="corrections" @update:model-value="type" @focus="store.focus(field)" @focusout="store.blur(field)" @keydown.enter="store.commit(field)" />
    <messages :marks="marks" :error="field.error" />
  </div>`,
);

const valueField = (template, members = {}) => ({
  props: { node: Object },
  inject: ["store"],
  components: { Messages },
  template,
  computed: {
    path() {
      return this.node.path.join("/");
    },
    value() {
      return this.store.valueAt(this.path, this.node.value);
    },
    marks() {
      return marksAt(this.store, this.path);
    },
    options() {
      return [...new Set([...this.store.view.lists[this.node.options], ...[this.value].flat()])].filter(Boolean);
    },
  },
  ...members,
});

export const Choice = valueField(`
  <div class="field nicegui-column" :data-path="path">
    <q-select outlined dense options-dense stack-label :clearable="node.is_clearable" :class="{ 'has-finding': marks.length }" :label="node.label" :options="options"
      :model-value="value || null" @update:model-value="(chosen) => store.choose('choose', path, chosen ?? '')" />
    <messages :marks="marks" />
    <div v-if="node.help" class="empty">{{ node.help }}</div>
  </div>`);

export const MultiChoice = valueField(`
  <div class="field nicegui-column" :data-path="path">
    <q-select outlined dense options-dense stack-label multiple use-chips :class="{ 'has-finding': marks.length }" :label="node.label" :options="options" :model-value="value"
      @update:model-value="(chosen) => store.choose('choose-several', path, chosen ?? [], { base: value })" />
    <messages :marks="marks" />
  </div>`);

export const Check = valueField(`
  <q-checkbox dense :class="{ wide: node.is_wide }" :label="node.label" :model-value="value" :data-path="path" @update:model-value="(checked) => store.choose('check', path, checked)">
    <q-tooltip v-if="node.hint">{{ node.hint }}</q-tooltip>
  </q-checkbox>`);

export const Colors = valueField(
  `<div class="swatches" role="group" :aria-label="node.label">
    <div class="swatches-label">{{ node.label }}</div>
    <button v-for="color in colors" type="button" class="swatch" :class="'is-' + (color || 'none')" :aria-label="'Color ' + (color || 'none')" :aria-pressed="String(color === value)"
      @click="store.choose('choose', path, color)"><q-tooltip>{{ color || "none" }}</q-tooltip></button>
  </div>`,
  {
    data() {
      return { colors: ["", ...this.node.options] };
    },
  },
);
