// A text field that the server changes, too. Input contains the sequence number of the text it is based on. A text that
// the server sent before it received the input is ignored: it would overwrite the input.
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
    // Keep the text for when the element is mounted again, in a tab for example.
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
    /** Shows text number `serverSeq`, sent after the server received input `ackedSeq`. */
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
    /** Input that was undone is not sent: a deferred text can be shown. */
    showDeferred() {
      const { deferred } = this;
      this.deferred = null;
      if (deferred) this.show(...deferred);
    },
    /** The browser may normalize the text, line endings for example. */
    recordNative() {
      this.nativeText = this.$refs.qRef?.nativeEl?.value;
    },
  },
};
