// The Vue component that NiceGUI loads; the extensions themselves are in the ES modules of this folder.
import { attachCodeAssist } from "vicode-code";

export default {
  template: `<span hidden></span>`,
  props: { editor: Number, options: Object },
  async mounted() {
    this.codeAssist = await attachCodeAssist(this.editor, this.options, (event, payload) => this.$emit(event, payload));
    // The page may have been left before the editor was mounted.
    if (this.isUnmounted) this.codeAssist.dispose();
    else this.$emit("ready", {});
  },
  unmounted() {
    this.isUnmounted = true;
    this.codeAssist?.dispose();
  },
  methods: {
    showMarks(text, marks) {
      this.codeAssist?.showMarks(text, marks);
    },
    highlightLines(first, last, reveal) {
      this.codeAssist?.highlightLines(first, last, reveal);
    },
    setLineStyles(lines) {
      this.codeAssist?.setLineStyles(lines);
    },
    goTo(start) {
      this.codeAssist?.goTo(start);
    },
  },
};
