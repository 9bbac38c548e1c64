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
    /** Calls a method of the table. */
    call(method, ...args) {
      this.table[method](...args);
    },
  },
};
