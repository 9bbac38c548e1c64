// Marks under characters, which move with the text while the user types, and their messages as tooltips.
import * as CM from "nicegui-codemirror";
import { toUnits } from "./offsets.js";

export function createMarks() {
  const replace = CM.StateEffect.define();
  const field = CM.StateField.define({
    create: () => CM.Decoration.none,
    update(marks, transaction) {
      let now = marks.map(transaction.changes);
      for (const effect of transaction.effects) if (effect.is(replace)) now = effect.value;
      return now;
    },
    provide: (of) => CM.EditorView.decorations.from(of),
  });
  const hover = CM.hoverTooltip((view, at) => tooltipAt(view.state.field(field), at));
  return {
    extension: [field, hover],
    show(view, text, list) {
      const doc = view.state.doc;
      // The text has changed since; its marks will follow.
      if (doc.toString() !== text) return;
      view.dispatch({ effects: replace.of(decorationsFor(text, list)) });
      view.contentDOM.setAttribute("aria-invalid", String(list.some((mark) => mark.severity === "error")));
    },
  };
}

function decorationsFor(text, list) {
  const unit = toUnits(text);
  const ranges = [];
  for (const mark of list) {
    let from = unit(mark.start);
    let to = unit(mark.end);
    // An empty range, such as at the end of the text, marks the character before it.
    if (from === to) from > 0 ? (from -= 1) : (to = Math.min(1, text.length));
    if (from === to) continue;
    const style = `squiggle ${mark.severity}`;
    ranges.push(CM.Decoration.mark({ class: style, message: mark.message, severity: mark.severity }).range(from, to));
  }
  return CM.Decoration.set(ranges, true);
}

function tooltipAt(marks, at) {
  const messages = [];
  let from = at;
  marks.between(at, at, (start, _end, mark) => {
    messages.push(mark.spec);
    from = Math.min(from, start);
  });
  if (messages.length === 0) return null;
  return {
    pos: from,
    above: true,
    create() {
      const dom = document.createElement("div");
      dom.className = "squiggle-tip";
      for (const { severity, message } of messages) {
        const line = dom.appendChild(document.createElement("div"));
        line.className = severity;
        line.textContent = message;
      }
      return { dom };
    },
  };
}
