// Keys of expression fields: Tab accepts a completion, and Enter ends the input of a single expression.
import * as CM from "nicegui-codemirror";

// In the capture phase: CodeMirror's own keys have a higher precedence than those of extensions.
export function addExpressionKeys(view, { isSingle }) {
  view.contentDOM.addEventListener(
    "keydown",
    (event) => {
      if (!event.isTrusted || event.isComposing) return;
      if (event.shiftKey || event.ctrlKey || event.altKey || event.metaKey) return;
      if (event.key === "Tab" && acceptCompletion(view)) stop(event);
      if (event.key === "Enter" && isSingle) {
        stop(event);
        if (!acceptCompletion(view)) view.contentDOM.blur();
      }
    },
    true,
  );
}

// CodeMirror accepts with Enter, but inserts a line break while the list has only just opened.
function acceptCompletion(view) {
  if (view.dom.querySelector(".cm-tooltip-autocomplete") === null) return false;
  const { lines } = view.state.doc;
  const enter = { key: "Enter", keyCode: 13, bubbles: true, cancelable: true };
  view.contentDOM.dispatchEvent(new KeyboardEvent("keydown", enter));
  if (view.state.doc.lines === lines) return true;
  CM.undo(view);
  return false;
}

function stop(event) {
  event.preventDefault();
  event.stopImmediatePropagation();
}
