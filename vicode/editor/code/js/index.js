// The door of the aid: puts completion, marks and keys into an editor that NiceGUI made.
import * as CM from "nicegui-codemirror";
import { makeCompletion } from "./completion.js";
import { expressionLanguage } from "./expression.js";
import { makeLines } from "./lines.js";
import { makeMarks } from "./marks.js";
import { toUnits } from "./offsets.js";

export async function aidEditor(id, wishes, emit) {
  const view = await editorOf(id);
  const completion = makeCompletion(emit);
  const marks = makeMarks();
  const lines = makeLines(wishes.tellsLines ? emit : null);
  const extensions = [marks.extension, lines.extension, attributesFor(wishes)];
  if (wishes.asks) extensions.push(completion.extension);
  if (wishes.isExpression) extensions.push(expressionLanguage());
  if (wishes.hint) extensions.push(CM.placeholder(wishes.hint));
  view?.dispatch({ effects: CM.StateEffect.appendConfig.of(extensions) });
  // Tab leaves an expression like any other field; in code it indents, and Escape before it makes it leave.
  if (wishes.isExpression) view?.setTabFocusMode(true);
  return {
    showMarks: (text, list) => view && marks.show(view, text, list),
    showLines: (first, last, reveal) => view && lines.show(view, first, last, reveal),
    showStyles: (list) => view && lines.style(view, list),
    goTo(start) {
      if (!view) return;
      const at = toUnits(view.state.doc.toString())(start);
      view.dispatch({ selection: { anchor: Math.min(at, view.state.doc.length) }, scrollIntoView: true });
      view.focus();
    },
    answer: completion.answer,
    dispose: completion.dispose,
  };
}

// The editor of an element; it may be mounted a moment after its aid. Null if its page is gone.
async function editorOf(id) {
  for (let attempt = 0; attempt < 600; attempt += 1) {
    const view = foundEditor(id);
    if (view) return view;
    await new Promise((resolve) => setTimeout(resolve, attempt < 20 ? 10 : 50));
  }
  return null;
}

function foundEditor(id) {
  try {
    return window.getElement?.(id)?.editor;
  } catch {
    // The page itself is being mounted: an address may open it on a transition.
    return null;
  }
}

function attributesFor(wishes) {
  const hint = wishes.isExpression ? "Control+Space lists names" : "Control+Space lists names; Escape, then Tab leaves";
  return CM.EditorView.contentAttributes.of({
    "aria-label": wishes.label,
    "aria-description": wishes.asks ? hint : "",
    spellcheck: "false",
    autocapitalize: "off",
    // One that is only read must be reached by Tab too, to be scrolled.
    tabindex: "0",
  });
}
