// Syntax highlighting of expressions: a subset of Python, so that pure Python constructs are not highlighted.
import * as CM from "nicegui-codemirror";

const KEYWORDS = /^(and|or|not|if|else)\b/;
const BOOLEANS = /^(True|False|true|false)\b/;

export function expressionLanguage() {
  return CM.StreamLanguage.define({
    name: "expression",
    token(stream) {
      if (stream.eatSpace()) return null;
      if (stream.match(KEYWORDS)) return "keyword";
      if (stream.match(BOOLEANS)) return "atom";
      if (stream.match(/^\d+\.?\d*([eE][+-]?\d+)?/)) return "number";
      if (stream.match(/^[A-Za-z_]\w*(?=\s*\()/)) return "variableName.function";
      if (stream.match(/^[A-Za-z_]\w*(?=\s*\.)/)) return "propertyName";
      if (stream.match(/^[A-Za-z_]\w*/)) return "variableName";
      if (stream.match(/^([<>!=]=|\/\/|[-+*/%<>=])/)) return "operator";
      stream.next();
      return null;
    },
  });
}
