"""Translates conditions and values of SCXML: the part of ECMAScript that designs have, too."""

import re
from collections.abc import Callable, Mapping

from vicode.importers.scxml.reader import ScxmlError
from vicode.model.expressions import Comparison, Scope, parse_expression, walk

_TOKEN = re.compile(
    r"(?P<space>\s+)|(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|(?P<name>[A-Za-z_$][\w$]*(?:\.[A-Za-z_$][\w$]*)*)"
    r"|(?P<text>'[^']*'|\"[^\"]*\")|(?P<operator>===|!==|==|!=|<=|>=|&&|\|\||[-+*/%<>!(),?:])",
    re.ASCII,
)
_OPERATORS = {"===": "==", "!==": "!=", "&&": "and", "||": "or", "!": "not"}
_MATH = ("abs", "min", "max", "floor", "ceil", "sqrt", "sin", "cos", "tan", "atan2", "asin", "acos", "atan")
_NAMES = {
    "true": "true",
    "false": "false",
    "Math.PI": "3.141592653589793",
    **{f"Math.{name}": name for name in (*_MATH, "exp", "log", "sign", "hypot")},
}
IN_STATE = re.compile(r"\bIn\s*\(\s*(?:'([^']*)'|\"([^\"]*)\")\s*\)")
_REMAINDER = "the remainder of negative numbers differs from that of designs"


def translate(text: str, names: Mapping[str, str], is_in: Callable[[str], bool], line: int) -> str:
    """The expression of a design; `is_in` answers `In('state')`.

    Raises:
        ScxmlError: A part has no counterpart.
    """
    text = IN_STATE.sub(lambda found: str(is_in(found[1] or found[2] or "")).lower(), text)
    parts, place = list[str](), 0
    while place < len(text):
        found = _TOKEN.match(text, place)
        if found is None:
            raise ScxmlError("S803", f"'{text}': '{text[place]}' is not in the portable subset", line)
        if not found["space"]:
            parts.append(_part(found, text, names, line))
        place = found.end()
    return _join(_bracket_negations(parts))


def _bracket_negations(parts: list[str]) -> list[str]:
    """Put negations into brackets: in ECMAScript, they bind more strongly than comparisons."""
    for index in range(len(parts) - 1, -1, -1):
        if parts[index] == "not":
            end = _operand_end(parts, index + 1)
            parts[index : end + 1] = ["(", "not", *parts[index + 1 : end + 1], ")"]
    return parts


def _operand_end(parts: list[str], start: int) -> int:
    """The place of the last token of a name, call or bracket."""
    end = start
    if start < len(parts) and parts[start] != "(" and start + 1 < len(parts) and parts[start + 1] == "(":
        end = start + 1
    if end < len(parts) and parts[end] == "(":
        depth = 0
        while end < len(parts):
            depth += {"(": 1, ")": -1}.get(parts[end], 0)
            if depth == 0:
                break
            end += 1
    return end


def _join(parts: list[str]) -> str:
    text = " ".join(parts)
    for wide, narrow in (("( ", "("), (" )", ")"), (" ,", ",")):
        text = text.replace(wide, narrow)
    return re.sub(r"\b(?!and\b|or\b|not\b)(\w+) \(", r"\1(", text)


def _part(found: re.Match[str], text: str, names: Mapping[str, str], line: int) -> str:
    part = found[0]
    if found["name"]:
        if part in names or part in _NAMES:
            return names.get(part) or _NAMES[part]
        raise ScxmlError("S803", f"'{text}': unknown name '{part}'", line, "declare it in <datamodel>")
    if found["text"]:
        raise ScxmlError("S803", f"'{text}': designs have no texts", line, "use a number or an enumeration")
    if part in "?:":
        raise ScxmlError("S803", f"'{text}': ? : is not in the portable subset", line, "use <if>")
    if part == "%":
        raise ScxmlError("S803", f"'{text}': {_REMAINDER}", line)
    return _OPERATORS.get(part, part)


def check_expression(text: str, scope: Scope, expected: str, line: int) -> None:
    """Check a translated expression.

    Raises:
        ScxmlError: It has errors.
    """
    parsed = parse_expression(text, scope, expected or None)
    if parsed.tree is None or parsed.diagnostics:
        reason = parsed.diagnostics[0].message if parsed.diagnostics else "not an expression"
        raise ScxmlError("S803", f"'{text}': {reason}", line)
    if any(isinstance(node, Comparison) and len(node.operators) > 1 for node in walk(parsed.tree)):
        raise ScxmlError("S803", f"'{text}': a comparison of a comparison", line, "use && between them")
