// The command palette: an input and a list in a native dialog. The search itself runs on the server.
export default {
  template: `
    <dialog ref="box" class="palette" aria-label="Find anything" @click="onBackdropClick">
      <div class="palette-frame">
        <div class="palette-top">
          <i class="q-icon material-icons" aria-hidden="true">search</i>
          <input ref="field" class="palette-field" type="text" role="combobox" aria-expanded="true" aria-autocomplete="list"
            autocomplete="off" spellcheck="false" aria-label="Find states, transitions, components and commands"
            placeholder="Find states, transitions, components, commands"
            :aria-controls="$.uid + '-list'" :aria-activedescendant="hits.length ? optionId(at) : null"
            v-model="text" @input="sendQuery" @keydown="onKeyDown">
        </div>
        <ul ref="list" class="palette-list" role="listbox" :id="$.uid + '-list'" aria-label="Results">
          <li v-for="(hit, index) in hits" :key="index" :id="optionId(index)" role="option" class="palette-hit" :class="{ refused: hit.refused }"
            :aria-selected="index === at" @mousemove="at = index" @click="choose(index, shown)">
            <i class="q-icon material-icons" aria-hidden="true">{{ hit.icon }}</i>
            <span class="palette-title"><template v-for="part in hit.parts"><mark v-if="part.found">{{ part.text }}</mark><template v-else>{{ part.text }}</template></template></span>
            <span class="palette-detail">{{ hit.detail }}</span>
            <span class="palette-where">{{ hit.where }}</span>
            <kbd v-if="hit.keys">{{ hit.keys }}</kbd>
            <span class="palette-kind">{{ hit.kind }}</span>
          </li>
        </ul>
        <div class="palette-foot"><span role="status">{{ words }}</span><span aria-hidden="true">↑ ↓ to navigate, Enter to open, Esc to close</span></div>
      </div>
    </dialog>`,
  data: () => ({ text: "", shown: "", hits: [], at: 0, words: "", opening: 0 }),
  mounted() {
    // Opens without the server: text typed next must not reach the canvas.
    this.onCommand = (event) => {
      if (event.detail !== "find") return;
      event.preventDefault();
      this.open();
    };
    addEventListener("vicode-command", this.onCommand);
  },
  unmounted() {
    removeEventListener("vicode-command", this.onCommand);
  },
  methods: {
    open(text = "") {
      if (this.$refs.box.open) return this.$refs.field.select();
      this.text = text;
      this.opening += 1;
      this.$refs.box.showModal();
      this.$refs.field.focus();
      this.sendQuery();
    },
    /** Shows the results of a query. Answers may arrive in any order. */
    answer({ text, hits, words }) {
      if (text !== this.text) return;
      // Keep a row that the user selected before the answer, if it is still in the list.
      const chosen = this.at && hitKey(this.hits[this.at]);
      this.shown = text;
      this.hits = hits;
      this.words = words;
      this.at = chosen ? Math.max(0, hits.findIndex((hit) => hitKey(hit) === chosen)) : 0;
      if (this.at) this.show();
      else if (this.$refs.list) this.$refs.list.scrollTop = 0;
    },
    sendQuery() {
      this.at = 0;
      this.$emit("ask", { text: this.text, opening: this.opening });
    },
    onKeyDown(event) {
      const steps = { ArrowDown: 1, ArrowUp: -1, PageDown: 8, PageUp: -8 };
      if (event.isComposing) return;
      if (event.key === "Enter") this.choose(this.at, this.at ? this.shown : this.text);
      else if (event.key in steps) this.move(steps[event.key]);
      else return;
      event.preventDefault();
    },
    /** Single steps wrap around; pages stop at the ends. */
    move(by) {
      const count = this.hits.length;
      if (!count) return;
      const to = this.at + by;
      this.at = Math.abs(by) === 1 ? (to + count) % count : Math.min(count - 1, Math.max(0, to));
      this.show();
    },
    show() {
      this.$nextTick(() => document.getElementById(this.optionId(this.at))?.scrollIntoView({ block: "nearest" }));
    },
    /** The server repeats the search: the first result of the text in the field may not be shown yet. */
    choose(index, text) {
      if (text === this.shown && this.hits[index]?.refused) return;
      this.$refs.box.close();
      this.$emit("choose", { text, opening: this.opening, index });
    },
    onBackdropClick(event) {
      if (event.target === this.$refs.box) this.$refs.box.close();
    },
    optionId(index) {
      return `${this.$.uid}-hit-${index}`;
    },
  },
};

/** Identifies a result. */
function hitKey(hit) {
  const title = hit.parts.map((part) => part.text).join("");
  return [hit.kind, hit.where, hit.detail, title].join("\n");
}
