// The Vue shell NiceGUI loads; the table itself lives in the ES modules beside it.
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
    showError(payload, words) {
      this.table.showError(payload, words);
    },
    focusGrid() {
      this.table.focusGrid();
    },
  },
};
