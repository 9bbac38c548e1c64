// Entry point of the code editor extensions: adds completion, marks and line styles to NiceGUI's editor.
import * as CM from "nicegui-codemirror";
import { createCompletion } from "./completion.js";
import { expressionLanguage } from "./expression.js";
import { addExpressionKeys } from "./expression_keys.js";
import { createLineStyles } from "./line_styles.js";
import { createMarks } from "./marks.js";
import { toUnits } from "./offsets.js";

// Describes the keyboard access to screen readers.
const KEY_HINT = "Control+Space lists names; Escape, then Tab leaves the editor";
const EXPRESSION_KEY_HINT = "Control+Space lists names";

/** The extensions of a code editor: completion, marks, line styles and keys; `attach` binds them to its view. */
export function createCodeAssist(options, emit) {
  const completion = createCompletion(emit);
  const marks = createMarks();
  const lines = createLineStyles(options.reportsLine ? emit : null);
  const extensions = [marks.extension, lines.extension, attributesFor(options)];
  if (options.completes) extensions.push(completion.extension);
  if (options.isExpression) extensions.push(expressionLanguage());
  const hint = new CM.Compartment();
  const hintOf = (text) => (text ? CM.placeholder(text) : []);
  extensions.push(hint.of(hintOf(options.hint)));
  let view = null;
  return {
    extensions,
    attach(editor) {
      view = editor;
      // Tab leaves an expression field; in code it indents, unless Escape is pressed before.
      if (options.isExpression) view.setTabFocusMode(true);
      if (options.isExpression) addExpressionKeys(view, { isSingle: options.isSingle });
    },
    showHint: (text) => view?.dispatch({ effects: hint.reconfigure(hintOf(text)) }),
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

/** Extends the editor of a NiceGUI element. */
export async function attachCodeAssist(id, options, emit) {
  const assist = createCodeAssist(options, emit);
  const view = await waitForEditor(id);
  view?.dispatch({ effects: CM.StateEffect.appendConfig.of(assist.extensions) });
  if (view) assist.attach(view);
  return assist;
}

// Returns the editor of an element, which may be mounted later than its extensions; null if the page is gone.
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
    // The page itself is still being mounted.
    return null;
  }
}

function attributesFor(options) {
  const hint = options.isExpression ? EXPRESSION_KEY_HINT : KEY_HINT;
  return CM.EditorView.contentAttributes.of({
    "aria-label": options.label,
    "aria-description": options.completes ? hint : "",
    spellcheck: "false",
    autocapitalize: "off",
    // Read-only editors must be reachable by Tab too, for scrolling.
    tabindex: "0",
  });
}
