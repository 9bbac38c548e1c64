// The Vue shell NiceGUI loads beside a code editor; the aid itself lives in the ES modules beside it.
import { aidEditor } from "vicode-code";

export default {
  template: `<span hidden></span>`,
  props: { editor: Number, wishes: Object },
  async mounted() {
    this.aid = await aidEditor(this.editor, this.wishes, (event, payload) => this.$emit(event, payload));
    // The page may have gone on to something else before the editor was there.
    if (this.isGone) this.aid.dispose();
    else this.$emit("ready", {});
  },
  unmounted() {
    this.isGone = true;
    this.aid?.dispose();
  },
  methods: {
    showMarks(text, marks) {
      this.aid?.showMarks(text, marks);
    },
    showLines(first, last, reveal) {
      this.aid?.showLines(first, last, reveal);
    },
    showStyles(lines) {
      this.aid?.showStyles(lines);
    },
    goTo(start) {
      this.aid?.goTo(start);
    },
    answer(number, answer) {
      this.aid?.answer(number, answer);
    },
  },
};
