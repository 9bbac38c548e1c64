"""Expressions of XABSL in the words of designs."""

from collections.abc import Callable
from dataclasses import dataclass

from vicode.importers.names import plain_number
from vicode.xabsl import tree
from vicode.xabsl.declared import Declared
from vicode.xabsl.lexer import Tokens

_OPERATORS = {"&&": "and", "||": "or"}
_WORDS = {"true": "True", "false": "False", "option_time": "component_time"}


@dataclass(frozen=True, slots=True)
class Wording:
    """Spells the expressions of one file; `meaning` tells what a word there means, `name` how a design says it."""

    tokens: Tokens
    meaning: Callable[[Tokens, int], Declared]
    name: Callable[[Declared], str]

    def spell(self, expression: tree.Expression) -> str:
        """An expression as a design's text."""
        match expression:
            case tree.Number(text=text):
                return plain_number(text)
            case tree.Word(text=text):
                return _WORDS.get(text, text)
            case tree.Ref():
                return self.name(self.meaning(self.tokens, expression.at))
            case tree.Function():
                return self._function(expression)
            case tree.Parentheses(inner=inner):
                return f"({self.spell(inner)})"
            case tree.Unary(operator=operator, operand=operand):
                sign = "not " if operator == "!" else "-"
                return sign + self._operand(operand)
            case tree.Binary(operator=operator, left=left, right=right):
                word = _OPERATORS.get(operator, operator)
                return f"{self._operand(left)} {word} {self._operand(right)}"
            case tree.Conditional(condition=condition, yes=yes, no=no):
                return f"{self._operand(yes)} if {self._operand(condition)} else {self._operand(no)}"

    def arguments(self, given: tree.Arguments) -> tuple[tuple[str, str], ...]:
        """Parameters by the names of designs, with their values, as written."""
        return tuple(
            (self.name(self.meaning(self.tokens, each.name.at)), self.spell(each.value)) for each in given.given
        )

    def _operand(self, expression: tree.Expression) -> str:
        """Python reads a condition the other way round, so one inside another expression is set in parentheses."""
        text = self.spell(expression)
        return f"({text})" if isinstance(expression, tree.Conditional) else text

    def _function(self, function: tree.Function) -> str:
        declared = self.meaning(self.tokens, function.name.at)
        if not isinstance(declared.node, tree.Symbol) or declared.node.parameters is None:
            return self.name(declared)
        given = ", ".join(f"{name}={value}" for name, value in self.arguments(function.arguments))
        return f"{self.name(declared)}({given})"
