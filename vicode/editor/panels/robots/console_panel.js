// A line for commands, and their answers below it, the newest first. History and typing need no server; Tab asks it for names.
const MAX_ANSWERS = 100;
const MAX_SHOWN = 24;

export default {
  template: `
    <div class="console">
      <div v-if="hint" class="empty">{{ hint }}</div>
      <template v-else>
        <div class="console-line mono">
          <span aria-hidden="true">&gt;</span>
          <input ref="field" v-model="text" aria-label="Command" placeholder="help, pause, go, set …" spellcheck="false"
            autocapitalize="off" autocomplete="off" @keydown="press" @input="candidates = []" />
        </div>
        <div class="console-candidates mono" role="status">{{ listed }}</div>
        <div class="console-answers mono" role="log" aria-label="Answers" tabindex="0">
          <div v-for="each in shown" :key="each.id">
            <div class="console-command">&gt; {{ each.line }}</div>
            <div v-for="row in each.rows" :class="['console-row', { error: each.failed }]">{{ row }}</div>
          </div>
        </div>
      </template>
    </div>`,
  props: { hint: String },
  data() {
    return { text: "", candidates: [], answers: [], position: 0, draft: "", lastId: 0 };
  },
  computed: {
    shown() {
      return this.answers.toReversed();
    },
    listed() {
      const more = this.candidates.length > MAX_SHOWN ? " …" : "";
      return this.candidates.slice(0, MAX_SHOWN).join("  ") + more;
    },
  },
  methods: {
    press(event) {
      if (event.isComposing || event.ctrlKey || event.altKey || event.metaKey) return;
      const act = { Enter: this.send, ArrowUp: this.older, ArrowDown: this.newer, Tab: this.complete, Escape: this.clear }[event.key];
      // Without a text, Tab leaves the field, as Shift+Tab always does.
      if (!act || (event.key === "Tab" && (event.shiftKey || !this.text.trim()))) return;
      event.preventDefault();
      event.stopPropagation();
      act();
    },
    send() {
      const line = this.text.trim();
      this.clear();
      if (!line) return;
      this.lastId += 1;
      this.answers.push({ id: this.lastId, line, rows: ["…"], failed: false });
      if (this.answers.length > MAX_ANSWERS) this.answers.shift();
      this.position = this.answers.length;
      this.$emit("run", { id: this.lastId, line });
    },
    clear() {
      this.text = "";
      this.candidates = [];
      this.position = this.answers.length;
    },
    older() {
      if (this.position === 0) return;
      if (this.position === this.answers.length) this.draft = this.text;
      this.position -= 1;
      this.text = this.answers[this.position].line;
    },
    newer() {
      if (this.position >= this.answers.length) return;
      this.position += 1;
      this.text = this.answers[this.position]?.line ?? this.draft;
    },
    complete() {
      this.$emit("complete", { line: this.text });
    },
    /** The candidates for the last word; ignored if the user has typed on. */
    offer(line, candidates) {
      if (line !== this.text || !candidates.length) return;
      const word = line.match(/[^\s()]*$/)[0];
      let common = candidates[0];
      for (const each of candidates) while (!each.startsWith(common)) common = common.slice(0, -1);
      this.text = line.slice(0, line.length - word.length) + common + (candidates.length === 1 ? " " : "");
      this.candidates = candidates.length > 1 ? candidates : [];
    },
    answer(id, text, failed) {
      const found = this.answers.find((each) => each.id === id);
      if (found) Object.assign(found, { rows: text.replaceAll("\t", ": ").split("\n"), failed });
    },
  },
};
