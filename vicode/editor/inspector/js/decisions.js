// The list of the decisions of a state or group, with buttons that add, move and remove them.

// With more states, the target of a transition is a filtered choice instead of a menu.
const MAX_IN_MENU = 60;

const DecisionRows = {
  name: "DecisionRows",
  props: { rows: Array, path: Array },
  inject: ["store"],
  data: () => ({ dragged: null, over: null }),
  template: `
    <template v-for="(row, index) in rows">
      <div class="decision-row nicegui-row" :class="{ 'is-disabled': row.is_disabled, 'is-over': over === index }" :draggable="!row.is_derived"
        @dragstart="dragged = index" @dragend="dragged = over = null" @dragover.prevent="over = index" @dragleave="over = null" @drop.prevent="drop(index)">
        <button type="button" class="decision" @click="store.openDecision(path, index)">
          <div class="order">{{ index + 1 }}</div>
          <div class="decision-target">{{ row.target }}{{ row.is_disabled ? " (disabled)" : "" }}</div>
          <div class="decision-guard mono">{{ row.guard }}</div>
        </button>
        <div v-if="row.is_derived" class="empty">derived</div>
        <div v-else class="row-buttons nicegui-row">
          <q-btn flat dense round size="sm" icon="arrow_upward" class="icon-button" :disable="isEnd(index - 1)" :aria-label="name('Move up', row, index)" @click="move(index, index - 1)" />
          <q-btn flat dense round size="sm" icon="arrow_downward" class="icon-button" :disable="isEnd(index + 1)" :aria-label="name('Move down', row, index)" @click="move(index, index + 1)" />
          <q-btn flat dense round size="sm" icon="close" class="icon-button" :aria-label="name('Remove', row, index)" @click="remove(index)" />
        </div>
      </div>
      <div v-if="row.then" class="nested nicegui-column">
        <decision-rows :rows="row.then" :path="[...path, index, 'then']" />
        <div v-if="row.otherwise" class="mono else">else</div>
        <decision-rows v-if="row.otherwise" :rows="row.otherwise" :path="[...path, index, 'else']" />
      </div>
    </template>`,
  methods: {
    isEnd(index) {
      return this.rows[index]?.is_derived ?? !this.rows[index];
    },
    name: (verb, row, index) => `${verb}: ${index + 1} ${row.target}`,
    move(index, to) {
      this.store.press("move-row", { path: this.path.join("/"), index, to: String(to) });
    },
    remove(index) {
      this.store.press("remove-row", { path: this.path.join("/"), index });
    },
    drop(index) {
      const from = this.dragged;
      this.dragged = this.over = null;
      if (from !== null && from !== index && !this.rows[index].is_derived) this.move(from, index);
    },
  },
};

export const Decisions = {
  props: { node: Object },
  inject: ["store"],
  components: { DecisionRows },
  data: () => ({ typed: "" }),
  template: `
    <div v-if="!node.rows.length" class="empty">No transitions</div>
    <decision-rows :rows="node.rows" :path="node.path" />
    <div class="adders nicegui-row">
      <q-select v-if="isLong" class="mono" dense outlined options-dense clearable use-input label="Transition to" :options="matching" :model-value="null"
        @filter="filter" @update:model-value="connect" />
      <q-btn v-else v-bind="small" icon="add" label="Transition" aria-label="Add Transition">
        <q-menu auto-close><q-list>
          <q-item v-for="state in states" clickable class="mono" role="menuitem" @click="connect(state)"><q-item-section>to {{ state }}</q-item-section></q-item>
        </q-list></q-menu>
      </q-btn>
      <q-btn v-bind="small" icon="add" label="Stay" title="Stay in this state while a condition holds, and try no transition below" aria-label="Add Stay" @click="add('add-stay')" />
      <q-btn v-bind="small" icon="add" label="Group" title="A condition for several transitions: if it holds, these, else those" aria-label="Add Group" @click="add('add-group')" />
    </div>`,
  computed: {
    small: () => ({ flat: true, dense: true, noCaps: true, size: "sm" }),
    states() {
      return this.store.view.lists.states;
    },
    isLong() {
      return this.states.length > MAX_IN_MENU;
    },
    matching() {
      return this.states.filter((name) => name.toLowerCase().includes(this.typed));
    },
  },
  methods: {
    filter(text, update) {
      update(() => (this.typed = text.toLowerCase()));
    },
    connect(to) {
      if (to) this.store.press("add-transition", { path: this.node.path.join("/"), to });
    },
    add(action) {
      this.store.press(action, { path: this.node.path.join("/") });
    },
  },
};
