// The tour: a card next to its target element, and a ring around the target. Facts from the server complete a step.
const KEY = "vicode-tour";
const WATCH_MS = 150;
const GAP = 12;

export default {
  template: `
    <div v-if="step" class="tour-ring" :style="ring" aria-hidden="true"></div>
    <section v-if="step" ref="card" class="tour" :style="place" role="region" aria-label="Tour" tabindex="-1">
      <div class="tour-count">{{ at + 1 }} of {{ steps.length }}</div>
      <div class="tour-words" role="status">
        <div class="tour-title" role="heading" aria-level="2">{{ step.title }}</div>
        <div class="tour-text">{{ step.text }}</div>
      </div>
      <div class="tour-buttons">
        <button type="button" class="tour-quiet" @click="end">Do not show again</button>
        <button v-if="at > 0" type="button" class="tour-quiet" @click="go(at - 1)">Back</button>
        <button ref="next" type="button" class="tour-next" @click="next">{{ at + 1 < steps.length ? (step.completed_by ? "Skip" : "Next") : "Done" }}</button>
      </div>
    </section>`,
  props: { steps: Array, startsAutomatically: Boolean, facts: Object },
  data: () => ({ at: -1, ring: {}, place: {} }),
  computed: {
    step() {
      return this.steps[this.at];
    },
  },
  watch: {
    facts(now) {
      if (this.step && isCompleted(this.step.completed_by, { now, stepFacts: this.stepFacts, startFacts: this.startFacts })) this.next();
    },
  },
  mounted() {
    this.escape = (event) => this.onKeyDown(event);
    document.addEventListener("keydown", this.escape, true);
    if (this.startsAutomatically && !isDismissed()) this.waiting = setInterval(() => findCanvas() && this.start(), WATCH_MS);
  },
  unmounted() {
    document.removeEventListener("keydown", this.escape, true);
    clearInterval(this.waiting);
    clearInterval(this.watching);
  },
  methods: {
    start() {
      clearInterval(this.waiting);
      clearInterval(this.watching);
      this.startFacts = this.facts;
      this.watching = setInterval(() => this.updatePosition(), WATCH_MS);
      this.go(0);
    },
    go(at) {
      this.at = at;
      this.stepFacts = this.facts;
      this.$nextTick(() => {
        this.updatePosition();
        // Focus the canvas for steps that use its keys, else the button of the card.
        if (this.step?.completed_by && at > 0) findCanvas()?.focus();
        else this.$refs.next?.focus({ preventScroll: true });
      });
    },
    next() {
      if (this.at + 1 < this.steps.length) this.go(this.at + 1);
      else this.end();
    },
    end() {
      clearInterval(this.watching);
      this.at = -1;
      try {
        localStorage.setItem(KEY, "over");
      } catch {
        // Private windows have no storage: the tour opens again.
      }
      findCanvas()?.focus();
    },
    /** Escape ends the tour, except in text fields. */
    onKeyDown(event) {
      if (event.key !== "Escape" || !this.step || document.querySelector(".q-dialog, dialog[open], .q-menu")) return;
      if (event.composedPath()[0].closest?.("input, textarea, [contenteditable=true]")) return;
      event.preventDefault();
      event.stopPropagation();
      this.end();
    },
    updatePosition() {
      const card = this.$refs.card;
      const target = this.step?.target && document.querySelector(this.step.target);
      if (!card || !target) return;
      const box = target.getBoundingClientRect();
      this.ring = { left: `${box.left + 2}px`, top: `${box.top + 2}px`, width: `${box.width - 4}px`, height: `${box.height - 4}px` };
      const { left, top } = placeCard(box, card.getBoundingClientRect());
      this.place = { left: `${left}px`, top: `${top}px` };
    },
  },
};

const isDismissed = () => {
  try {
    return localStorage.getItem(KEY) === "over";
  } catch {
    return false;
  }
};

const findCanvas = () => document.querySelector(".vicode-canvas[data-ready]")?.shadowRoot?.querySelector(".stage");

/** Whether a step is completed: compares the facts with those at the start of the step and of the tour. */
function isCompleted(condition, { now, stepFacts, startFacts }) {
  const checks = {
    selected: () => now.selected >= 0 && now.selected < stepFacts.states,
    "state-added": () => now.states > stepFacts.states,
    "transition-added": () => now.transitions > stepFacts.transitions,
    restored: () => now.states === startFacts.states && now.transitions === startFacts.transitions,
    table: () => now.table,
  };
  return checks[condition]?.() ?? false;
}

/** Places the card next to its target; inside a large target, near the bottom. */
function placeCard(box, card) {
  const clampX = (x) => Math.max(GAP, Math.min(innerWidth - card.width - GAP, x));
  const clampY = (y) => Math.max(GAP, Math.min(innerHeight - card.height - GAP, y));
  if (box.left > card.width + 2 * GAP && box.height > innerHeight / 2) return { left: clampX(box.left - card.width - GAP), top: clampY(box.top + 56) };
  if (box.height > innerHeight / 2) return { left: clampX(box.left + GAP), top: clampY(box.bottom - card.height - GAP) };
  if (box.top > innerHeight / 2) return { left: clampX(box.left + GAP), top: clampY(box.top - card.height - GAP) };
  return { left: clampX(box.width > innerWidth / 2 ? box.right - card.width - 24 : box.left), top: clampY(box.bottom + GAP) };
}
