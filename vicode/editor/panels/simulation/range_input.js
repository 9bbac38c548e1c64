// A native slider, which supports keys and screen readers. While the user moves it, values from the server are ignored.
const OWN_MS = 500;

export default {
  template: `<input type="range" :min="min" :max="max" :step="step" :value="shown" :disabled="disable" @input="move" />`,
  props: { min: Number, max: Number, step: Number, value: Number, disable: Boolean },
  data() {
    return { shown: this.value, movedAt: -OWN_MS };
  },
  watch: {
    value(now) {
      if (performance.now() - this.movedAt > OWN_MS) this.shown = now;
    },
  },
  methods: {
    move(event) {
      this.movedAt = performance.now();
      this.shown = Number(event.target.value);
      this.$emit("moved", this.shown);
    },
  },
};
