// A code editor bound to the text of a field; it is created by the browser, so that it can be typed in at once.
import * as CM from "nicegui-codemirror";
import { createCodeAssist } from "vicode-code";
import { findChange } from "./text_merge.js";

const fromElsewhere = CM.Annotation.define();

export const CodeEditor = {
  props: { node: Object, path: String, field: Object, marks: Array },
  inject: ["store"],
  template: `<div class="code-field nicegui-codemirror" :class="{ 'expression-field': isExpression }"></div>`,
  computed: {
    isExpression() {
      return ["expression", "pairs"].includes(this.node.language);
    },
  },
  mounted() {
    const { node, store, path, field } = this;
    const hint = node.alias ? store.view.lists.parameters[node.alias] : node.hint;
    const options = { label: node.label, completes: true, isExpression: this.isExpression, isSingle: node.language === "expression", hint };
    this.assist = createCodeAssist(options, (_event, request) => store.complete(this.assist, path, request));
    this.theme = new CM.Compartment();
    this.language = new CM.Compartment();
    const listener = CM.EditorView.updateListener.of((update) => {
      if (update.docChanged && !update.transactions.some((each) => each.annotation(fromElsewhere))) store.type(field, update.state.doc.toString());
      if (update.focusChanged) update.view.hasFocus ? store.focus(field) : store.blur(field);
    });
    this.view = new CM.EditorView({
      doc: this.field.local,
      parent: this.$el,
      extensions: [
        CM.basicSetup,
        CM.keymap.of([CM.indentWithTab]),
        CM.indentUnit.of("    "),
        // Long lines are read without scrolling; and in Chromium, letters typed fast into a scrolled line change places.
        CM.EditorView.lineWrapping,
        this.theme.of(this.themeOf(this.$q.dark.isActive)),
        this.language.of([]),
        listener,
        this.assist.extensions,
      ],
    });
    this.assist.attach(this.view);
    this.showMarks();
    const mode = { python: "Python", cpp: "C++", xabsl: "C" }[node.language];
    const found = CM.languages.find(({ name }) => name === mode);
    found?.load().then((extension) => this.view.dispatch({ effects: this.language.reconfigure(extension) }));
  },
  beforeUnmount() {
    this.assist.dispose();
    this.view.destroy();
  },
  watch: {
    "field.local"(text) {
      const shown = this.view.state.doc.toString();
      if (shown === text) return;
      const { start, end, text: insert } = findChange(shown, text);
      this.view.dispatch({ changes: { from: start, to: end, insert }, annotations: fromElsewhere.of(true) });
    },
    marks() {
      this.showMarks();
    },
    "field.server"() {
      this.showMarks();
    },
    "node.hint"(hint) {
      this.assist.showHint(hint);
    },
    "$q.dark.isActive"(isDark) {
      this.view.dispatch({ effects: this.theme.reconfigure(this.themeOf(isDark)) });
    },
  },
  methods: {
    themeOf(isDark) {
      return CM.themes[isDark ? "githubDark" : "vscodeLight"];
    },
    showMarks() {
      this.assist.showMarks(this.field.server, this.marks);
    },
    goTo(start) {
      this.assist.goTo(start);
    },
  },
};
