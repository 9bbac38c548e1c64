// Completion by the server: requests are numbered, and late answers are dropped.
import * as CM from "nicegui-codemirror";
import { toCharacters, toUnits } from "./offsets.js";

const TIMEOUT_MS = 5000;
const WORD = /[A-Za-z_]\w*$/;

export function createCompletion(emit) {
  const pending = new Map();
  let last = 0;

  function request(text, offset) {
    last += 1;
    const number = last;
    return new Promise((resolve) => {
      pending.set(number, resolve);
      setTimeout(() => resolveRequest(number, null), TIMEOUT_MS);
      emit("complete", { number, text, offset });
    });
  }

  function resolveRequest(number, answer) {
    pending.get(number)?.(answer);
    pending.delete(number);
  }

  async function source(context) {
    const before = context.state.sliceDoc(Math.max(0, context.pos - 200), context.pos);
    if (!context.explicit && !WORD.test(before) && !before.endsWith(".")) return null;
    const text = context.state.doc.toString();
    const answer = await request(text, toCharacters(text, context.pos));
    if (!answer || context.aborted || answer.options.length === 0) return null;
    return { from: toUnits(text)(answer.start), options: answer.options.map(optionFor), validFor: /^\w*$/ };
  }

  return {
    extension: CM.EditorState.languageData.of(() => [{ autocomplete: source }]),
    answer: resolveRequest,
    dispose() {
      for (const number of [...pending.keys()]) resolveRequest(number, null);
    },
  };
}

// Names of the design rank above keywords. CodeMirror shows all of it as text, never as HTML.
function optionFor({ label, kind, detail, doc }) {
  return { label, type: kind, detail, info: doc || undefined, boost: kind === "keyword" ? -20 : 20 };
}
