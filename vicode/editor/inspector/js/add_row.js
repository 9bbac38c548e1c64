// Two fields and a button that adds an input or a command. What was refused stays in the fields with the reason.
import { Messages } from "./messages.js";

export const AddRow = {
  props: { node: Object },
  inject: ["store"],
  components: { Messages },
  template: `
    <div class="adders add-row nicegui-row" @keydown.enter="add">
      <q-input dense outlined stack-label class="mono add-name" :label="'New ' + node.kind" maxlength="80" v-model="texts.name" v-bind="plain" @update:model-value="texts.error = ''" />
      <q-select v-if="node.options" dense outlined options-dense stack-label class="add-detail" :label="node.detail" :aria-label="node.detail + ' of ' + node.kind + 's to add'"
        :options="options" v-model="texts.detail" />
      <q-input v-else dense outlined stack-label class="add-detail" :label="node.detail" :placeholder="node.hint" v-model="texts.detail" v-bind="plain" />
      <q-btn flat dense no-caps size="sm" icon="add" label="Add" :aria-label="'Add ' + node.kind" @click="add" />
    </div>
    <messages :marks="[]" :error="texts.error" />`,
  computed: {
    plain: () => ({ autocapitalize: "off", spellcheck: "false", autocomplete: "off" }),
    /** Kept by the store while other items are shown. */
    texts() {
      return this.store.draft(this.node.kind, { name: "", detail: this.node.initial ?? "", error: "" });
    },
    options() {
      return this.store.view.lists[this.node.options].slice(1);
    },
  },
  methods: {
    add() {
      const { node, texts } = this;
      // `distance: float`, as in the parameters of a command.
      const [, name, type] = (node.options && texts.name.match(/^([^:]*):\s*(\S+)\s*$/)) || [null, texts.name, texts.detail];
      const sent = { name: name.trim(), detail: type };
      texts.error = "";
      Object.assign(texts, { name: "", detail: node.options ? texts.detail : "" });
      this.store.ask(`add-${node.kind}`, { path: "project", text: sent.name, to: sent.detail }, (error) => {
        if (!error) return;
        texts.error = error;
        // Not over what has been typed since.
        if (!texts.name) Object.assign(texts, sent);
      });
    },
  },
};
