// The Vue shell NiceGUI loads; the canvas itself lives in the ES modules beside it.
import { mountCanvas } from "vicode-canvas";

export default {
  props: { commands: { type: Array, default: () => [] }, scene: { type: String, default: "" } },
  template: `<div class="vicode-canvas"></div>`,
  mounted() {
    // A press takes the focus from a field, which tells at the end of this task what was typed there: first that, then the press.
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

/** The scene that came with the page, in a script of this id; it is there once. */
function takeScene(id) {
  const script = document.getElementById(id);
  script?.remove();
  return script && JSON.parse(script.textContent);
}
