// The Vue component that NiceGUI loads; the canvas itself is in the ES modules of this folder.
import { mountCanvas } from "vicode-canvas";

export default {
  props: { commands: { type: Array, default: () => [] }, scene: { type: String, default: "" } },
  template: `<div class="vicode-canvas"></div>`,
  mounted() {
    // A press blurs a text field, which reports its text at the end of the current task; the press must be reported after it.
    const emit = (event, payload) => queueMicrotask(() => this.$emit(event, payload));
    this.canvas = mountCanvas(this.$el, emit, this.commands);
    const scene = takeScene(this.scene);
    if (scene) this.canvas.load(scene);
    this.$emit("ready", { rev: scene?.rev ?? null });
  },
  unmounted() {
    this.canvas.dispose();
  },
  methods: {
    load(view) {
      this.canvas.load(view);
    },
    apply(changes) {
      this.canvas.apply(changes);
    },
    select(items, seq) {
      this.canvas.select(items, seq);
    },
    centre(of, id) {
      this.canvas.centre(of, id);
    },
    scrollToInitial(of, id) {
      this.canvas.scrollToInitial(of, id);
    },
    fit() {
      this.canvas.fit();
    },
    highlightActive(ids, seq, taken) {
      this.canvas.highlightActive(ids, seq, taken);
    },
    setBreakpoints(items) {
      this.canvas.setBreakpoints(items);
    },
    showLinks(flag) {
      this.canvas.showLinks(flag);
    },
    showTooltip(answer) {
      this.canvas.tooltip.addSections(answer);
    },
    showPreview(items, stay) {
      this.canvas.showPreview(items, stay);
    },
    showPresence(others) {
      this.canvas.presence.show(others);
    },
    renameInPlace(id) {
      this.canvas.renameInPlace(id);
    },
    stateRenamed(old, name) {
      this.canvas.rename.stateRenamed(old, name);
    },
    focus() {
      this.canvas.stage.focus({ preventScroll: true });
    },
    runCommand(name) {
      this.canvas.commands.run(name);
    },
    writeClipboard(text) {
      this.canvas.clipboard.resolveCopy(text);
    },
  },
};

/** Removes and returns the scene that is embedded in the page as a script element, if any. */
function takeScene(id) {
  const script = document.getElementById(id);
  script?.remove();
  return script && JSON.parse(script.textContent);
}
