"""Translate XABSL expressions to design expressions."""

from collections.abc import Callable
from dataclasses import dataclass

from vicode.importers.design_names import to_design_number
from vicode.xabsl import tree
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.symbol_table import Definition

_OPERATORS = {"&&": "and", "||": "or"}
_KEYWORDS = {"true": "True", "false": "False", "option_time": "component_time"}


@dataclass(frozen=True, slots=True)
class ExpressionTranslator:
    """Translates the expressions of one file.

    Attributes:
        resolve: Returns the definition that a token refers to.
        design_name: Returns the name of a definition in the design.
    """

    tokens: Tokens
    resolve: Callable[[Tokens, int], Definition]
    design_name: Callable[[Definition], str]

    def translate(self, expression: tree.ExpressionNode) -> str:
        match expression:
            case tree.NumberNode(text=text):
                return to_design_number(text)
            case tree.KeywordNode(text=text):
                return _KEYWORDS.get(text, text)
            case tree.ReferenceNode():
                return self._reference(self.resolve(self.tokens, expression.first_token))
            case tree.FunctionCallNode():
                return self._function(expression)
            case tree.ParenthesizedNode(inner=inner):
                return f"({self.translate(inner)})"
            case tree.UnaryNode(operator=operator, operand=operand):
                sign = "not " if operator == "!" else "-"
                return sign + self._operand(operand)
            case tree.BinaryNode(operator=operator, left=left, right=right):
                word = _OPERATORS.get(operator, operator)
                return f"{self._operand(left)} {word} {self._operand(right)}"
            case tree.ConditionalNode(condition=condition, yes=yes, no=no):
                return f"{self._operand(yes)} if {self._operand(condition)} else {self._operand(no)}"

    def translate_arguments(self, arguments: tree.ArgumentListNode) -> tuple[tuple[str, str], ...]:
        """Translate arguments to pairs of parameter name and value."""
        return tuple(
            (self.design_name(self.resolve(self.tokens, argument.name.first_token)), self.translate(argument.value))
            for argument in arguments.items
        )

    def _operand(self, expression: tree.ExpressionNode) -> str:
        """Translate an operand; a conditional gets parentheses, since its parts have another order in Python."""
        text = self.translate(expression)
        return f"({text})" if isinstance(expression, tree.ConditionalNode) else text

    def _reference(self, declared: Definition) -> str:
        """A function without arguments is called with their defaults."""
        return self.design_name(declared) + ("()" if _is_function(declared) else "")

    def _function(self, function: tree.FunctionCallNode) -> str:
        declared = self.resolve(self.tokens, function.name.first_token)
        if not _is_function(declared):
            return self.design_name(declared)
        arguments = ", ".join(f"{name}={value}" for name, value in self.translate_arguments(function.arguments))
        return f"{self.design_name(declared)}({arguments})"


def _is_function(declared: Definition) -> bool:
    return isinstance(declared.node, tree.SymbolNode) and declared.node.parameters is not None
