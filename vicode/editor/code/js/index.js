// The door of the aid: puts completion, marks and keys into an editor that NiceGUI made.
import * as CM from "nicegui-codemirror";
import { createCompletion } from "./completion.js";
import { expressionLanguage } from "./expression.js";
import { createLineStyles } from "./line_styles.js";
import { createMarks } from "./marks.js";
import { toUnits } from "./offsets.js";

export async function attachCodeAssist(id, options, emit) {
  const view = await waitForEditor(id);
  const completion = createCompletion(emit);
  const marks = createMarks();
  const lines = createLineStyles(options.reportsLine ? emit : null);
  const extensions = [marks.extension, lines.extension, attributesFor(options)];
  if (options.completes) extensions.push(completion.extension);
  if (options.isExpression) extensions.push(expressionLanguage());
  if (options.hint) extensions.push(CM.placeholder(options.hint));
  view?.dispatch({ effects: CM.StateEffect.appendConfig.of(extensions) });
  // Tab leaves an expression like any other field; in code it indents, and Escape before it makes it leave.
  if (options.isExpression) view?.setTabFocusMode(true);
  return {
    showMarks: (text, list) => view && marks.show(view, text, list),
    highlightLines: (first, last, reveal) => view && lines.show(view, first, last, reveal),
    setLineStyles: (list) => view && lines.style(view, list),
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
async function waitForEditor(id) {
  for (let attempt = 0; attempt < 600; attempt += 1) {
    const view = findEditor(id);
    if (view) return view;
    await new Promise((resolve) => setTimeout(resolve, attempt < 20 ? 10 : 50));
  }
  return null;
}

function findEditor(id) {
  try {
    return window.getElement?.(id)?.editor;
  } catch {
    // The page itself is being mounted: an address may open it on a transition.
    return null;
  }
}

function attributesFor(options) {
  const hint = options.isExpression ? "Control+Space lists names" : "Control+Space lists names; Escape, then Tab leaves";
  return CM.EditorView.contentAttributes.of({
    "aria-label": options.label,
    "aria-description": options.completes ? hint : "",
    spellcheck: "false",
    autocapitalize: "off",
    // One that is only read must be reached by Tab too, to be scrolled.
    tabindex: "0",
  });
}
