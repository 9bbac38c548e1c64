// Messages below a field: why its text is not in the design, findings, who else types there.

export const marksAt = (store, path) => (store.view.marks[path.match(/^(project|design)\//)?.[0] ?? store.view.key] ?? []).filter((mark) => mark.path === path);

export const sentence = (text) => text.slice(0, 1).toUpperCase() + text.slice(1);

export const Messages = {
  props: { marks: Array, error: { type: String, default: "" } },
  template: `
    <div v-if="error || marks.length" class="field-messages nicegui-column" role="status">
      <div v-if="error" class="field-finding">{{ sentence(error) }}</div>
      <div v-for="mark in marks" class="field-finding" :class="mark.severity">{{ mark.message }}</div>
    </div>`,
  methods: { sentence },
};
