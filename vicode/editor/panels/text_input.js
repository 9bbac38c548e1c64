// A field for text that a server shows and changes, too. What is typed here is told with the number of the text it was
// typed on; a text that was sent before the server heard that is not shown: it would take away what was typed.
export default {
  template: `<q-input ref="qRef" v-bind="$attrs" :model-value="text" @update:model-value="tell" @blur="settle" />`,
  props: { id: String, value: String, number: Number, heard: Number },
  data() {
    return { text: this.value, on: this.number, told: this.heard, late: null };
  },
  mounted() {
    this.note();
  },
  beforeUnmount() {
    // Who comes back to it finds what was here: a tab, for one.
    const element = mounted_app.elements[this.id.slice(1)];
    if (element) Object.assign(element.props, { value: this.text, number: this.on, heard: this.told });
  },
  methods: {
    tell(text) {
      this.text = text;
      this.told += 1;
      this.late = null;
      this.plain = this.$refs.qRef?.nativeEl?.value;
      this.$emit("update:value", { text, on: this.on, told: this.told });
    },
    /** Shows text `number`, sent by a server that had heard so much. */
    show(text, number, heard) {
      if (heard < this.told || number <= this.on) return;
      if (this.plain !== this.$refs.qRef?.nativeEl?.value) {
        this.late = [text, number, heard];
        return;
      }
      this.late = null;
      this.text = text;
      this.on = number;
      this.$nextTick(this.note);
    },
    /** What was typed and taken back is not told: what came meanwhile can be shown. */
    settle() {
      const late = this.late;
      this.late = null;
      if (late) this.show(...late);
    },
    /** A browser has a spelling of its own: of the ends of lines, for one. */
    note() {
      this.plain = this.$refs.qRef?.nativeEl?.value;
    },
  },
};
