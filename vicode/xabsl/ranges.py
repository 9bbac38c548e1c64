"""Numbers outside the range that was declared; the original never looked at ranges."""

import re

from vicode.xabsl import tree
from vicode.xabsl.declared import Declared
from vicode.xabsl.declaring import Report
from vicode.xabsl.lexer import Tokens

_RANGE = re.compile(r"\s*(-?\d+(?:\.\d*)?)\s*\.\.\s*(-?\d+(?:\.\d*)?)\s*")


def range_of(text: str) -> tuple[float, float] | None:
    """Both ends of a range; None for what else is written between brackets, often a unit."""
    found = _RANGE.fullmatch(text)
    return (float(found[1]), float(found[2])) if found else None


def look_at_range(report: Report, tokens: Tokens, value: tree.Expression, declared: Declared) -> None:
    """Tell of a number that is given to something outside its range."""
    assert isinstance(declared.node, tree.Symbol | tree.Parameter)
    number = _number(value)
    ends = range_of(declared.node.range) if number is not None else None
    if number is not None and ends is not None and not ends[0] <= number <= ends[1]:
        message = f"{number:g} is outside [{declared.node.range}] of {declared.name}"
        report.complain(tokens, value.at, "X646", message, "mend the number or the range")


def _number(value: tree.Expression) -> float | None:
    match value:
        case tree.Number(text=text):
            return float(text)
        case tree.Parentheses(inner=inner):
            return _number(inner)
        case tree.Unary(operator="-", operand=operand):
            number = _number(operand)
            return None if number is None else -number
    return None
