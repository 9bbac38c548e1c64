"""Checks constants against declared ranges. The original compiler ignores ranges."""

import re

from vicode.xabsl import tree
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.symbol_collector import CompileReport
from vicode.xabsl.symbol_table import Definition

_RANGE = re.compile(r"\s*(-?\d+(?:\.\d*)?)\s*\.\.\s*(-?\d+(?:\.\d*)?)\s*")


def parse_range(text: str) -> tuple[float, float] | None:
    """Both ends of a range; None for other text between brackets, often a unit."""
    match = _RANGE.fullmatch(text)
    return (float(match[1]), float(match[2])) if match else None


def check_range(report: CompileReport, tokens: Tokens, value: tree.ExpressionNode, definition: Definition) -> None:
    """Report a constant outside the range of the symbol or parameter that receives it."""
    assert isinstance(definition.node, tree.SymbolNode | tree.ParameterNode)
    number = _constant_value(value)
    ends = parse_range(definition.node.range) if number is not None else None
    if number is not None and ends is not None and not ends[0] <= number <= ends[1]:
        message = f"{number:g} is outside the range [{definition.node.range}] of {definition.name}"
        report.add_finding(tokens, value.first_token, "X646", message, "change the number or the range")


def _constant_value(value: tree.ExpressionNode) -> float | None:
    match value:
        case tree.NumberNode(text=text):
            return float(text)
        case tree.ParenthesizedNode(inner=inner):
            return _constant_value(inner)
        case tree.UnaryNode(operator="-", operand=operand):
            number = _constant_value(operand)
            return None if number is None else -number
    return None
