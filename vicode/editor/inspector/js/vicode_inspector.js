// The Vue component that NiceGUI loads: the form of the selected item, drawn from data that the browser has already.
import { FormNodes, FormStore } from "vicode-inspector";

const BUTTON = "button, [role=button], [role=checkbox]";
const CLICK_TOLERANCE_PX = 4;
const SENDS_TEXT = ["vicode-send-text", "vicode-leave", "beforeunload"];

export default {
  components: { FormNodes },
  provide() {
    return { store: this.store };
  },
  template: `
    <div v-show="store.view.nodes.length" class="inspector" @keydown.esc="leave" @pointerdown.capture="press">
      <form-nodes :nodes="store.view.nodes" />
    </div>`,
  beforeCreate() {
    this.store = new FormStore((event, payload) => window.deliver((each) => this.$emit(event, each), payload));
  },
  mounted() {
    this.onSelect = ({ detail }) => this.showSelected(detail.items, detail.seq);
    this.onOpen = (event) => this.open(event.detail.item) && event.preventDefault();
    this.onLeave = () => this.store.sendAll();
    this.onRelease = (event) => this.release(event);
    document.addEventListener("pointerup", this.onRelease);
    this.onFocus = ({ target }) => (this.focused = this.$el.contains(target) ? target : null);
    document.addEventListener("focusin", this.onFocus);
    this.moves = new MutationObserver((records) => this.keepFocus(records));
    this.moves.observe(this.$el, { childList: true, subtree: true });
    document.addEventListener("vicode-select", this.onSelect);
    document.addEventListener("vicode-open", this.onOpen);
    for (const event of SENDS_TEXT) addEventListener(event, this.onLeave);
    this.$emit("ready", { is_continued: !this.store.typed.isEmpty });
  },
  unmounted() {
    this.moves.disconnect();
    document.removeEventListener("focusin", this.onFocus);
    document.removeEventListener("pointerup", this.onRelease);
    document.removeEventListener("vicode-select", this.onSelect);
    document.removeEventListener("vicode-open", this.onOpen);
    for (const event of SENDS_TEXT) removeEventListener(event, this.onLeave);
  },
  methods: {
    load(data) {
      this.store.load(data);
      if (this.isOpening && this.store.hasForm) this.focusField(this.store.firstPath());
      this.isOpening = false;
    },
    update(changes) {
      this.store.update(changes);
    },
    /** The selection of Python; ignored if the user has selected something else since. */
    select(items, seq) {
      if ((this.seq ?? seq) <= seq) this.showSelected(items, this.seq ?? seq);
    },
    complete(number, answer) {
      this.store.answerCompletion(number, answer);
    },
    showFixes(labels) {
      this.store.view.fixes = labels;
    },
    focusField(path) {
      this.store.focusField(this.$el, path);
    },
    showSelected(items, seq) {
      this.seq = seq;
      const [first = { of: "design", id: "" }, ...others] = items;
      if (!this.store.show(others.length ? null : first)) return;
      for (let each = this.$el; each && !each.matches(".side"); each = each.parentElement) each.scrollTop = 0;
    },
    /** Opens the first field of an item. Returns whether its form is here. */
    open(item) {
      if (!["transitions", "common", "notes"].includes(item.of)) return false;
      this.showSelected([item], this.seq);
      this.isOpening = !this.store.hasForm;
      if (!this.isOpening) this.focusField(this.store.firstPath());
      return !this.isOpening;
    },
    /** Moving an element, such as a card of a list, takes the focus away from it. */
    keepFocus(records) {
      const { focused } = this;
      if (!focused?.isConnected || document.activeElement !== document.body) return;
      const isMoved = records.some(({ removedNodes }) => [...removedNodes].some((node) => node.contains(focused)));
      if (isMoved) focused.focus({ preventScroll: true });
    },
    press({ target, clientX: x, clientY: y }) {
      const button = target.closest(BUTTON);
      this.pressed = button && { button, x, y };
    },
    /** A button that moves away while it is pressed gets no click from the browser. */
    release({ target, clientX, clientY }) {
      const { button, x, y } = this.pressed ?? {};
      this.pressed = null;
      const isAway = button?.isConnected && !button.contains(target);
      if (isAway && Math.hypot(clientX - x, clientY - y) < CLICK_TOLERANCE_PX) button.click();
    },
    /** Escape returns the focus to the canvas, unless it closes an open list or completion. */
    leave(event) {
      if (event.defaultPrevented || event.target.getAttribute("aria-expanded") === "true") return;
      document.querySelector(".canvas")?.shadowRoot?.querySelector(".stage")?.focus();
    },
  },
};
