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
    select(items, heard) {
      this.canvas.select(items, heard);
    },
    centre(of, id) {
      this.canvas.centre(of, id);
    },
    arriveAt(of, id) {
      this.canvas.arriveAt(of, id);
    },
    fit() {
      this.canvas.fit();
    },
    setActive(ids, seq, taken) {
      this.canvas.setActive(ids, seq, taken);
    },
    setStops(items) {
      this.canvas.setStops(items);
    },
    showLinks(flag) {
      this.canvas.showLinks(flag);
    },
    tellPeek(answer) {
      this.canvas.peek.tell(answer);
    },
    showPlaces(items, stay) {
      this.canvas.showPlaces(items, stay);
    },
    showPeople(others) {
      this.canvas.people.show(others);
    },
    renameInPlace(id) {
      this.canvas.renameInPlace(id);
    },
    stateRenamed(old, name) {
      this.canvas.rename.boxRenamed(old, name);
    },
    focus() {
      this.canvas.stage.focus({ preventScroll: true });
    },
    run(name) {
      this.canvas.commands.run(name);
    },
    putOnClipboard(text) {
      this.canvas.clipboard.put(text);
    },
  },
};

/** The scene that came with the page, in a script of this id; it is there once. */
function takeScene(id) {
  const script = document.getElementById(id);
  script?.remove();
  return script && JSON.parse(script.textContent);
}
