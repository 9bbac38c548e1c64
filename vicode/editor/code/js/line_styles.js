// Highlighted lines, lines with a style, and the report of the line that the user selects.
import * as CM from "nicegui-codemirror";

export function createLineStyles(emit) {
  const highlight = lineField();
  const styles = lineField();
  const reportLine = CM.EditorView.updateListener.of((update) => {
    const isByUser = update.transactions.some((transaction) => transaction.isUserEvent("select"));
    if (emit && update.selectionSet && isByUser) {
      emit("line", update.state.doc.lineAt(update.state.selection.main.head).number);
    }
  });
  return {
    extension: [highlight.field, styles.field, reportLine],
    show(view, first, last, reveal) {
      const doc = view.state.doc;
      const numbers = [];
      for (let line = first; first > 0 && line <= Math.min(last, doc.lines); line += 1) numbers.push([line, "is-highlighted"]);
      const effects = [highlight.set(doc, numbers)];
      if (reveal && numbers.length > 0) {
        effects.push(CM.EditorView.scrollIntoView(doc.line(first).from, { y: "start", yMargin: 24 }));
      }
      view.dispatch({ effects });
    },
    style(view, list) {
      view.dispatch({ effects: styles.set(view.state.doc, list) });
    },
  };
}

function lineField() {
  const replace = CM.StateEffect.define();
  const field = CM.StateField.define({
    create: () => CM.Decoration.none,
    update(lines, transaction) {
      let now = lines.map(transaction.changes);
      for (const effect of transaction.effects) if (effect.is(replace)) now = effect.value;
      return now;
    },
    provide: (of) => CM.EditorView.decorations.from(of),
  });
  return {
    field,
    set(doc, list) {
      const known = list.filter(([line]) => line >= 1 && line <= doc.lines);
      const ranges = known.map(([line, style]) => CM.Decoration.line({ class: style }).range(doc.line(line).from));
      return replace.of(CM.Decoration.set(ranges, true));
    },
  };
}
