// Fields for code and expressions: an editor with messages below it, and a tab for each language.
import { CodeEditor } from "./code_editor.js";
import { marksAt, sentence } from "./messages.js";

export const CodeText = {
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
      <code-editor ref="editor" :class="{ 'has-finding': field.error && !field.hasFocus }" :node="node" :path="path" :field="field" :marks="marks" />
      <q-dialog v-model="isLarge" :aria-label="node.label">
        <q-card class="dialog code-dialog nicegui-card">
          <div class="dialog-title" role="heading" aria-level="2">{{ node.label }}</div>
          <code-editor class="is-large" :node="node" :path="path" :field="field" :marks="marks" />
          <div class="dialog-buttons nicegui-row"><q-btn flat no-caps color="primary" label="Close" @click="isLarge = false" /></div>
        </q-card>
      </q-dialog>
      <div class="field-messages nicegui-column" role="status">
        <div v-if="field.error" class="field-finding" :class="{ 'is-info': field.hasFocus }">{{ sentence(field.error) }}</div>
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
    return { path, field: this.store.field(path, this.node), isLarge: false };
  },
  computed: {
    marks() {
      return marksAt(this.store, this.path);
    },
  },
  methods: {
    sentence,
    line(mark) {
      return this.field.local.trimEnd().includes("\n") ? `Line ${mark.line}: ` : "";
    },
    request(what) {
      this.store.sendAll();
      this.store.request(what, this.store.address(this.path));
    },
  },
};

export const Languages = {
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
