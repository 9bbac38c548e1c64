"""Prints typed expression trees as JavaScript.

Stored ints are numbers, which are exact within ±2**53. An expression of ints of which a part may leave this range is
calculated with BigInt, and converted where it is stored or becomes a float.
"""

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from typing import Self

from vicode.generators.javascript.names import escape
from vicode.generators.plan import (
    ComponentPlan,
    Condition,
    ExpressionCondition,
    FunctionPlan,
    IntRanges,
    TimerCondition,
    UnsoundDesignError,
    literal_value,
)
from vicode.model.expressions import (
    INT,
    TEAM_SIZE,
    Binary,
    Boolean,
    Comparison,
    Done,
    ElapsedTime,
    EnumElement,
    Expr,
    FunctionCall,
    Logic,
    Minus,
    Not,
    Number,
    OutputRef,
    ScopeSymbolKind,
    StatusFlag,
    Ternary,
    Variable,
    walk,
)

_CHOICE, _OR, _AND, _EQUAL, _RELATION, _SUM, _PRODUCT, _UNARY, _ATOM = range(9)
_NAMES = {"int": "toInt", "min": "minimum", "max": "maximum", "is_nan": "isNan"}
_SAME_TYPE = frozenset({"abs", "min", "max", "clamp"})
_OPERATORS = {"//": "floorDivide", "%": "modulo"}
_XABSL_OPERATORS = {"/": "xabslDivide", "//": "floorDivide", "%": "xabslModulo"}
_EQUALITY = {"==": "===", "!=": "!=="}


@dataclass(frozen=True, slots=True)
class Printed:
    """An expression and the level of its outermost operator."""

    text: str
    level: int = _ATOM

    def at(self, level: int) -> str:
        """The text as an operand, which needs brackets if it binds weaker."""
        return self.text if self.level >= level else f"({self.text})"


@dataclass(frozen=True, slots=True, kw_only=True)
class JavaScriptExpressionPrinter:
    """Prints the expressions of one component.

    Attributes:
        functions: Outputs with arguments by alias and name.
        inputs: Outputs of components that the world provides, by alias and name.
        declarations: What stands before the names of constants and enumerations.
    """

    ranges: IntRanges
    time_unit: str = "s"
    uses_xabsl_arithmetic: bool = False
    functions: Mapping[tuple[str, str], FunctionPlan] = field(default_factory=dict)
    inputs: Collection[tuple[str, str]] = ()
    declarations: str = "declarations."

    @classmethod
    def of_component(cls, component: ComponentPlan) -> Self:
        return cls(
            ranges=component.ranges,
            time_unit=component.time_unit,
            uses_xabsl_arithmetic=component.arithmetic == "xabsl",
            functions={(use.alias, item.result.name): item for use in component.uses for item in use.functions},
            inputs={(use.alias, value.name) for use in component.uses for value in use.inputs},
        )

    def stored(self, node: Expr) -> str:
        """A value that is stored or passed: ints are numbers within ±2**53."""
        return f"bica.limit({self._big(node)})" if self._is_big(node) else self.print(node).text

    def guard(self, conditions: tuple[Condition, ...]) -> str:
        pieces = [self._condition(condition) for condition in conditions]
        return pieces[0].text if len(pieces) == 1 else " && ".join(piece.at(_AND) for piece in pieces)

    def _condition(self, condition: Condition) -> Printed:
        match condition:
            case ExpressionCondition(expression=expression):
                return self.print(expression)
            case TimerCondition(ns=int(ns)):
                return Printed(f"this.$stateNs >= {ns:_}", _RELATION)
            case TimerCondition(time=time):
                unit = "1e6" if self.time_unit == "ms" else "1e9"
                return Printed(f"this.$stateNs >= bica.nanoseconds({self.print(time).text}, {unit})", _RELATION)
            case _:
                raise UnsoundDesignError("a guard is written as code")

    def print(self, node: Expr) -> Printed:
        """Print a tree; an int or a float becomes a number."""
        return Printed(f"bica.toNumber({self._big(node)})") if self._is_big(node) else self._print_small(node)

    def _print_small(self, node: Expr) -> Printed:
        match node:
            case Number(value=value):
                return Printed(_number(value))
            case Boolean(value=value):
                return Printed("true" if value else "false")
            case EnumElement(element=element, type=enumeration):
                return Printed(f"{self.declarations}{escape(enumeration)}.{escape(element)}")
            case OutputRef():
                return self._output(node)
            case Variable() | ElapsedTime() | Done() | StatusFlag():
                return self._own_value(node)
            case _:
                return self._operation(node)

    def _own_value(self, node: Variable | ElapsedTime | Done | StatusFlag) -> Printed:
        match node:
            case Variable(name=name, kind=kind):
                owner = self.declarations if kind == ScopeSymbolKind.CONSTANT else "this."
                return Printed(f"{owner}{escape(name)}")
            case ElapsedTime(kind=of):
                return Printed(f"this.${of}Ns / {'1e6' if self.time_unit == 'ms' else '1e9'}", _PRODUCT)
            case Done(alias=alias):
                return Printed(f"this.{escape(alias)}.$done")
            case StatusFlag(name=name):
                # One robot: designs with cooperative states are refused.
                return Printed({TEAM_SIZE: "1", "action_done": "this.$actionDone"}.get(name, "false"))

    def _output(self, node: OutputRef) -> Printed:
        text = f"this.{escape(node.alias)}.{escape(node.output)}"
        if node.arguments is not None:
            given = dict(node.arguments)
            if self.uses_xabsl_arithmetic and any(_calls(value, node) for value in given.values()):
                raise UnsoundDesignError(f"a call of '{node.output}' contains another one, with the rules of XABSL")
            declared = self.functions[node.alias, node.output].arguments
            values = (f"{escape(each.name)}: {self.stored(given.get(each.name, each.initial))}" for each in declared)
            text = f"{text}({{ {', '.join(values)} }})"
        is_input = node.type == INT and (node.alias, node.output) in self.inputs
        return Printed(f"bica.limit({text})" if is_input or self.ranges.is_external(node) else text)

    def _operation(self, node: Expr) -> Printed:
        match node:
            case Not(operand=operand):
                return Printed(f"!{self.print(operand).at(_UNARY)}", _UNARY)
            case Minus(operand=operand):
                return self._minus(node, operand)
            case Binary(operator=operator, left=left, right=right):
                return self._binary(node, operator, self.print(left), self.print(right))
            case Comparison(operators=operators, operands=operands):
                return self._comparison(operators, operands)
            case Logic(operator=operator, operands=operands):
                level, sign = (_AND, " && ") if operator == "and" else (_OR, " || ")
                return Printed(sign.join(self.print(operand).at(level + 1) for operand in operands), level)
            case Ternary(test=test, then=then, otherwise=otherwise):
                sides = f"{self.print(then).at(_OR)} : {self.print(otherwise).at(_CHOICE)}"
                return Printed(f"{self.print(test).at(_OR)} ? {sides}", _CHOICE)
            case FunctionCall(function="float", arguments=(argument,)):
                return self.print(argument)
            case FunctionCall(function=function, arguments=arguments):
                values = ", ".join(self.print(argument).text for argument in arguments)
                return Printed(f"bica.{_NAMES.get(function, function)}({values})")
            case _:
                raise AssertionError(f"unexpected expression node: {node}")

    def _minus(self, node: Expr, operand: Expr) -> Printed:
        if literal_value(operand):
            return Printed(f"-{self.print(operand).at(_ATOM)}", _UNARY)
        if node.type == INT:
            # No int is -0.
            return Printed(f"0 - {self.print(operand).at(_PRODUCT)}", _SUM)
        inner = self.print(operand)
        return Printed(f"-{inner.at(_ATOM)}", _UNARY)

    def _binary(self, node: Expr, operator: str, left: Printed, right: Printed) -> Printed:
        function = (_XABSL_OPERATORS if self.uses_xabsl_arithmetic else _OPERATORS).get(operator)
        if function:
            return Printed(f"bica.{function}({left.text}, {right.text})")
        level = _SUM if operator in "+-" else _PRODUCT
        text = f"{left.at(level)} {operator} {right.at(level + 1)}"
        # The sum turns -0 into 0.
        return Printed(f"{text} + 0", _SUM) if operator == "*" and node.type == INT else Printed(text, level)

    def _comparison(self, operators: tuple[str, ...], operands: tuple[Expr, ...]) -> Printed:
        printed = [self._compared(operands, index) for index in range(len(operands))]
        signs = [_EQUALITY.get(operator, operator) for operator in operators]
        if len(signs) == 1:
            level = _EQUAL if operators[0] in _EQUALITY else _RELATION
            return Printed(f"{printed[0].at(level + 1)} {signs[0]} {printed[1].at(level + 1)}", level)
        if all(isinstance(operand, Number | Variable) for operand in operands[1:-1]):
            pairs = zip(printed, signs, printed[1:], strict=False)
            return Printed(" && ".join(f"{a.at(_SUM)} {sign} {b.at(_SUM)}" for a, sign, b in pairs), _AND)
        links = (
            f"[(a, b) => a {sign} b, () => {operand.text}]" for sign, operand in zip(signs, printed[1:], strict=True)
        )
        return Printed(f"bica.chain({printed[0].text}, {', '.join(links)})")

    def _compared(self, operands: tuple[Expr, ...], index: int) -> Printed:
        """An operand of a comparison; ints are compared exactly, an int and a float as doubles."""
        are_ints = all(operand.type == INT for operand in operands)
        if are_ints and any(map(self._is_big, operands)):
            return Printed(self._big(operands[index]), _CHOICE)
        if not are_ints and len(operands) > 2 and any(map(self._is_big, operands)):
            raise UnsoundDesignError("a chain of comparisons contains floats and ints beyond ±2^53")
        return self.print(operands[index])

    # Ints beyond ±2**53

    def _is_big(self, node: Expr) -> bool:
        """Whether an int, or an int that it is calculated from, may lie beyond ±2**53."""
        if node.type != INT:
            return False
        return not self.ranges.is_storable(node) or any(self._is_big(part) for part in _int_parts(node))

    def _big(self, node: Expr) -> str:
        """Print an int as a BigInt."""
        text = self._big_operation(node)
        return f"bica.saturate({text})" if self.ranges.may_overflow(node) else text

    def _big_operation(self, node: Expr) -> str:
        match node:
            case Number(value=value):
                return f"{value}n"
            case Minus(operand=operand):
                return f"(-{self._big(operand)})"
            case Binary(operator=operator, left=left, right=right) if operator in "+-*":
                return f"({self._big(left)} {operator} {self._big(right)})"
            case Ternary(test=test, then=then, otherwise=otherwise):
                return f"({self.print(test).at(_OR)} ? {self._big(then)} : {self._big(otherwise)})"
            case FunctionCall(function=function, arguments=arguments) if function in _SAME_TYPE:
                return f"bica.{_NAMES.get(function, function)}({', '.join(map(self._big, arguments))})"
            case _:
                return f"bica.toBig({self.print(node).text})"


def _calls(value: Expr, function: OutputRef) -> bool:
    outputs = (node for node in walk(value) if isinstance(node, OutputRef))
    return any((each.alias, each.output) == (function.alias, function.output) for each in outputs)


def _int_parts(node: Expr) -> tuple[Expr, ...]:
    match node:
        case Minus(operand=operand):
            return (operand,)
        case Binary(left=left, right=right):
            return (left, right)
        case Ternary(then=then, otherwise=otherwise):
            return (then, otherwise)
        case FunctionCall(function=function, arguments=arguments) if function in _SAME_TYPE:
            return arguments
        case _:
            return ()


def _number(value: float) -> str:
    return "1e999" if math.isinf(value) else repr(value).removesuffix(".0")
