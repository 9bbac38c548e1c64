// The nodes of a form as Vue components, on the components of Quasar; see `nodes.py`.
import { nextTick } from "vue";
import { CodeEditor } from "./code_editor.js";
import { Decisions } from "./decisions.js";
import { findChange } from "./text_merge.js";

const Messages = {
  props: { marks: Array, error: String },
  inject: ["store"],
  template: `
    <div v-if="error || marks.length" class="field-messages nicegui-column" role="status">
      <div v-if="error" class="field-finding">{{ error }}</div>
      <div v-for="mark in marks" class="field-finding" :class="mark.severity">{{ mark.message }}</div>
    </div>`,
};

const marksAt = (store, path) => (store.view.marks[store.view.key] ?? []).filter((mark) => mark.path === path);

const TextField = {
  props: { node: Object },
  inject: ["store"],
  components: { Messages },
  template: `
    <div class="field nicegui-column" :data-path="path">
      <q-input ref="input" outlined dense stack-label :label="node.label" :placeholder="node.hint" :model-value="field.local"
        :type="node.is_long ? 'textarea' : 'text'" :autogrow="node.is_long" :class="[{ mono: node.is_code, 'has-finding': worst }, worst]"
        v-bind="corrections" @update:model-value="type" @focus="store.focus(path)" @blur="store.blur(key)" />
      <messages :marks="marks" :error="field.error" />
    </div>`,
  data() {
    const path = this.node.path.join("/");
    return { path, key: this.store.keyOfField(path), field: this.store.field(path, this.node.value ?? "") };
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
      return this.node.is_code ? { autocapitalize: "off", spellcheck: "false", autocomplete: "off" } : {};
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
    type(text) {
      this.store.type(this.path, String(text ?? ""));
    },
  },
};

const Choice = {
  props: { node: Object },
  inject: ["store"],
  components: { Messages },
  template: `
    <div class="field nicegui-column" :data-path="path">
      <q-select outlined dense options-dense stack-label :label="node.label" :options="options" :model-value="value" @update:model-value="choose" />
      <messages :marks="marks" error="" />
    </div>`,
  data() {
    return { path: this.node.path.join("/"), chosen: null };
  },
  computed: {
    value() {
      return this.chosen ?? this.node.value;
    },
    options() {
      return [...new Set([...this.store.view.lists[this.node.options], this.value])];
    },
    marks() {
      return marksAt(this.store, this.path);
    },
  },
  watch: {
    node() {
      this.chosen = null;
    },
  },
  methods: {
    choose(value) {
      this.chosen = value;
      this.store.choose(this.path, value);
    },
  },
};

const Check = {
  props: { node: Object },
  inject: ["store"],
  template: `<q-checkbox dense :label="node.label" :model-value="value" @update:model-value="check" :data-path="path" />`,
  data() {
    return { path: this.node.path.join("/"), checked: null };
  },
  computed: {
    value() {
      return this.checked ?? this.node.value;
    },
  },
  watch: {
    node() {
      this.checked = null;
    },
  },
  methods: {
    check(value) {
      this.checked = value;
      this.store.check(this.path, value);
    },
  },
};

const CodeText = {
  props: { node: Object },
  inject: ["store"],
  components: { CodeEditor },
  template: `
    <div class="field nicegui-column" :data-path="path">
      <div class="field-head nicegui-row">
        <div class="field-label">{{ node.label }}</div>
        <div class="spacer"></div>
        <q-btn v-if="node.can_open" flat dense round size="sm" icon="open_in_new" class="icon-button" :aria-label="'Open in editor: ' + node.label" @click="request('open-code')" />
        <q-btn flat dense round size="sm" icon="open_in_full" class="icon-button" :aria-label="'Enlarge: ' + node.label" @click="isLarge = true" />
      </div>
      <code-editor ref="editor" :node="node" :path="path" :field="field" :marks="marks" />
      <q-dialog v-model="isLarge" :aria-label="node.label">
        <q-card class="dialog code-dialog nicegui-card">
          <div class="dialog-title" role="heading" aria-level="2">{{ node.label }}</div>
          <code-editor class="is-large" :node="node" :path="path" :field="field" :marks="marks" />
          <div class="dialog-buttons nicegui-row"><q-btn flat no-caps color="primary" label="Close" @click="isLarge = false" /></div>
        </q-card>
      </q-dialog>
      <div class="field-messages nicegui-column" role="status">
        <div v-if="field.error" class="field-finding">{{ field.error }}</div>
        <div v-for="mark in marks.slice(0, 6)" class="field-message-row nicegui-row">
          <button type="button" class="field-message" :class="mark.severity" @click="$refs.editor.goTo(mark.start)">{{ line(mark) }}{{ mark.message }}</button>
          <q-btn v-if="mark.fix !== null" flat dense no-caps size="sm" icon="auto_fix_high" label="Fix" class="finding-fix" aria-label="Quick fixes">
            <q-menu auto-close @before-show="store.askFixes(mark.fix)">
              <q-list>
                <q-item v-for="(fix, index) in store.view.fixes" clickable role="menuitem" @click="store.fix(mark.fix, index, fix)"><q-item-section>{{ fix }}</q-item-section></q-item>
                <q-item v-if="store.view.fixes && !store.view.fixes.length" disable role="menuitem"><q-item-section>No automatic fix available</q-item-section></q-item>
              </q-list>
            </q-menu>
          </q-btn>
        </div>
        <div v-if="marks.length > 6" class="empty">{{ marks.length - 6 }} more</div>
      </div>
    </div>`,
  data() {
    const path = this.node.path.join("/");
    return { path, field: this.store.field(path, this.node.value ?? ""), isLarge: false };
  },
  computed: {
    marks() {
      return marksAt(this.store, this.path);
    },
  },
  methods: {
    line(mark) {
      return this.field.local.trimEnd().includes("\n") ? `Line ${mark.line}: ` : "";
    },
    request(what) {
      this.store.sendAll();
      this.store.request(what, this.store.address(this.path));
    },
  },
};

const Languages = {
  props: { node: Object },
  inject: ["store"],
  components: { CodeText },
  template: `
    <q-tabs dense no-caps align="left" class="code-tabs" :aria-label="node.label" :model-value="shown" @update:model-value="store.showLanguage">
      <q-tab v-for="text in node.texts" :name="text.language" :label="text.title" />
    </q-tabs>
    <template v-for="text in node.texts"><code-text v-if="text.language === shown" :key="text.language" :node="text" /></template>`,
  computed: {
    shown() {
      const languages = this.node.texts.map((text) => text.language);
      return languages.includes(this.store.view.language) ? this.store.view.language : languages[0];
    },
  },
};

const Title = {
  props: { node: Object },
  inject: ["store"],
  template: `
    <div class="panel-title nicegui-row" role="heading" aria-level="2">
      <div>{{ node.text }}</div>
      <a v-if="node.opens" class="mono nicegui-link" href="#" @click.prevent="store.select({ of: node.opens[0], id: node.opens[1] })">{{ node.name }}</a>
    </div>`,
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
      :class="{ remove: node.is_danger }" @click="store.press(node.action)" />`,
};

export const FORM_NODES = { TextField, Choice, Check, CodeText, Languages, Title, Heading, Button, Decisions };
