// The Vue component that NiceGUI loads; the table itself is in the ES modules of this folder.
import { mountTable } from "vicode-table";

export default {
  template: `<div class="vicode-table"></div>`,
  mounted() {
    this.table = mountTable(this.$el, (event, payload) => this.$emit(event, payload));
    this.$emit("ready", {});
  },
  unmounted() {
    this.table.dispose();
  },
  methods: {
    load(table) {
      this.table.load(table);
    },
    apply(changes) {
      this.table.apply(changes);
    },
    select(rows) {
      this.table.select(rows);
    },
    editCell(row, column) {
      this.table.editCell(row, column);
    },
    showError(payload, message) {
      this.table.showError(payload, message);
    },
    focusGrid() {
      this.table.focusGrid();
    },
  },
};
