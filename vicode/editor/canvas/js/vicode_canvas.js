// The Vue component that NiceGUI loads; the canvas itself is in the ES modules of this folder.
import { mountCanvas } from "vicode-canvas";

export default {
  props: { commands: { type: Array, default: () => [] }, scene: { type: String, default: "" } },
  template: `<div class="vicode-canvas"></div>`,
  mounted() {
    // A press blurs a text field, which reports its text at the end of the current task; the press must be reported after it.
    const emit = (event, payload) => queueMicrotask(() => this.send(event, payload));
    this.canvas = mountCanvas(this.$el, emit, this.commands);
    const scene = takeScene(this.scene);
    if (scene) this.canvas.load(scene);
    this.$emit("ready", { rev: scene?.rev ?? null });
  },
  unmounted() {
    this.canvas.dispose();
  },
  methods: {
    /** Gestures arrive once each, also if the connection is lost; a page that is only a canvas does without. */
    send(event, payload) {
      const send = (fields) => this.$emit(event, fields);
      if (event === "gesture" && window.deliver) window.deliver(send, payload);
      else send(payload);
    },
    /** Calls a method of the canvas, or of one of its parts: `call("presence.show", others)`. */
    call(path, ...args) {
      const [method, part] = path.split(".").reverse();
      const target = part ? this.canvas[part] : this.canvas;
      target[method](...args);
    },
  },
};

/** Returns the scene; as part of a new page, it is a script element with an id, which is removed. */
function takeScene(text) {
  if (text.startsWith("{")) return JSON.parse(text);
  const script = document.getElementById(text);
  script?.remove();
  return script && JSON.parse(script.textContent);
}
