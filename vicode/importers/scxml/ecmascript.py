"""Translates conditions and values of SCXML: the part of ECMAScript that designs have, too."""

import re
from collections import Counter
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
    # By place: the last token of the operand that begins there, and how many negations end there.
    ends, closed = _operand_ends(parts), Counter[int]()
    for index, part in enumerate(parts):
        if part == "not":
            closed[ends.get(index, len(parts) - 1)] += 1
    found = list[str]()
    for index, part in enumerate(parts):
        found += [*(["("] if part == "not" else []), part, *[")"] * closed[index]]
    return found


def _operand_ends(parts: list[str]) -> dict[int, int]:
    """The last place of each negation, name, call or bracket, by its first place; of those that end."""
    ends, closing = dict[int, int](), list[int]()
    for index in range(len(parts) - 1, -1, -1):
        if parts[index] == ")":
            closing.append(index)
        elif parts[index] == "(":
            ends[index] = closing.pop() if closing else len(parts) - 1
        else:
            follows = index + 1 < len(parts) and (parts[index] == "not" or parts[index + 1] == "(")
            ends[index] = ends.get(index + 1, len(parts) - 1) if follows else index
    return ends


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
