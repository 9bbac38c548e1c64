// A field for text that a server shows and changes, too. What is typed here is told with the number of the text it was
// typed on; a text that was sent before the server heard that is not shown: it would take away what was typed.
export default {
  template: `<q-input ref="qRef" v-bind="$attrs" :model-value="text" @update:model-value="sendText" @blur="showDeferred" />`,
  props: { id: String, value: String, serverSeq: Number, ackedSeq: Number },
  data() {
    return { text: this.value, baseSeq: this.serverSeq, clientSeq: this.ackedSeq, deferred: null };
  },
  mounted() {
    this.recordNative();
  },
  beforeUnmount() {
    // Who comes back to it finds what was here: a tab, for one.
    const element = mounted_app.elements[this.id.slice(1)];
    if (element) Object.assign(element.props, { value: this.text, serverSeq: this.baseSeq, ackedSeq: this.clientSeq });
  },
  methods: {
    sendText(text) {
      this.text = text;
      this.clientSeq += 1;
      this.deferred = null;
      this.nativeText = this.$refs.qRef?.nativeEl?.value;
      this.$emit("update:value", { text, base_seq: this.baseSeq, client_seq: this.clientSeq });
    },
    /** Shows text number `serverSeq`, sent by a server that had heard so much. */
    show(text, serverSeq, ackedSeq) {
      if (ackedSeq < this.clientSeq || serverSeq <= this.baseSeq) return;
      if (this.nativeText !== this.$refs.qRef?.nativeEl?.value) {
        this.deferred = [text, serverSeq, ackedSeq];
        return;
      }
      this.deferred = null;
      this.text = text;
      this.baseSeq = serverSeq;
      this.$nextTick(this.recordNative);
    },
    /** What was typed and taken back is not told: what came meanwhile can be shown. */
    showDeferred() {
      const { deferred } = this;
      this.deferred = null;
      if (deferred) this.show(...deferred);
    },
    /** A browser has a spelling of its own: of the ends of lines, for one. */
    recordNative() {
      this.nativeText = this.$refs.qRef?.nativeEl?.value;
    },
  },
};
