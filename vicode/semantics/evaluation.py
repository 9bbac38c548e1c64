"""Evaluates expressions: order, laziness and types as in the section "Arithmetic"."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Protocol

from vicode.model.expressions import (
    FLOAT,
    INT,
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
    StatusFlag,
    Ternary,
    Variable,
)
from vicode.semantics.values import (
    COMPARISONS,
    FUNCTIONS,
    OPERATORS,
    RESULTING_INTS,
    STORED_INTS,
    XABSL_OPERATORS,
    Value,
    as_type,
    limited,
)

GivenArguments = tuple[tuple[str, Callable[[str], Value]], ...]
"""Names of arguments, and functions that evaluate them as a type."""


class ComponentReader(Protocol):
    """What an expression of a component reads, apart from its own values."""

    @property
    def has_xabsl_rules(self) -> bool: ...

    def note_large_int(self) -> None:
        """Remember that a result was beyond ±2^53."""
        ...

    def read_time(self, kind: str) -> float:
        """Return the time in the state or since the restart, in the unit of the design."""
        ...

    def read_status(self, name: str) -> Value:
        """Return `action_done`, `conflict` or `team_size`."""
        ...

    def is_done(self, alias: str) -> bool: ...

    def read_output(self, alias: str, name: str) -> Value: ...

    def call_output(self, alias: str, name: str, given: GivenArguments) -> Value: ...


def evaluate(node: Expr, type_: str, values: Mapping[str, Value], reader: ComponentReader | None = None) -> Value:
    """Evaluate a tree without errors.

    Args:
        node: The tree.
        type_: The type of the result; the type of the node, or float for an int.
        values: Constants, parameters, outputs and variables by name.
        reader: Reads everything else; constants and initial values need none.
    """
    return _Evaluation(values, reader).evaluate_as(node, type_)


@dataclass(frozen=True, slots=True)
class _Evaluation:
    values: Mapping[str, Value]
    reader: ComponentReader | None

    def evaluate_as(self, node: Expr, type_: str) -> Value:
        """Evaluate an operand of a type; an int literal in the place of a float is a float, so that -0 is -0.0."""
        match node:
            case Minus(operand=Number(value=value)):
                return as_type(-as_type(value, type_), type_)  # type: ignore[operator]
            case Ternary(test=test, then=then, otherwise=otherwise):
                return self.evaluate_as(then if self.evaluate(test) else otherwise, type_)
            case _:
                return as_type(self.evaluate(node), type_)

    def evaluate(self, node: Expr) -> Value:
        return as_type(self._value(node), node.type)

    def _value(self, node: Expr) -> Value:
        match node:
            case Number(value=value) | Boolean(value=value):
                return value
            case EnumElement(element=element, type=type_):
                return f"{type_}.{element}"
            case Variable(name=name):
                return self.values[name]
            case ElapsedTime() | StatusFlag() | Done() | OutputRef():
                assert self.reader is not None
                read = self._read(node, self.reader)
                # "Ints": hand-written components and the world may provide larger ones.
                return limited(read, STORED_INTS) if node.type == INT else read
            case _:
                return self._operate(node)

    def _read(self, node: ElapsedTime | StatusFlag | Done | OutputRef, reader: ComponentReader) -> Value:
        match node:
            case ElapsedTime(kind=kind):
                return reader.read_time(kind)
            case StatusFlag(name=name):
                return reader.read_status(name)
            case Done(alias=alias):
                return reader.is_done(alias)
            case OutputRef(alias=alias, output=output, arguments=None):
                return reader.read_output(alias, output)
            case OutputRef(alias=alias, output=output, arguments=pairs):
                given = tuple((name, partial(self.evaluate_as, argument)) for name, argument in pairs or ())
                return reader.call_output(alias, output, given)

    def _operate(self, node: Not | Logic | Comparison | Ternary | Minus | Binary | FunctionCall) -> Value:
        match node:
            case Not(operand=operand):
                return not self.evaluate(operand)
            case Comparison(operators=operators, operands=operands):
                return self._compare(operators, operands)
            case Logic(operator=operator, operands=operands):
                # Both end at the first operand that decides.
                held = map(self.evaluate, operands)
                return all(held) if operator == "and" else any(held)
            case Ternary(type=type_):
                return self.evaluate_as(node, type_)
            case _:
                exact = self._calculate(node)
                return self._limit_result(exact) if node.type == INT else exact

    def _limit_result(self, exact: Value) -> int:
        if self.reader is not None and limited(exact, STORED_INTS) != exact:
            self.reader.note_large_int()
        return limited(exact, RESULTING_INTS)

    def _calculate(self, node: Minus | Binary | FunctionCall) -> Value:
        match node:
            case Minus(operand=operand):
                return -self._number(operand)
            case Binary(operator=operator, left=left, right=right):
                is_xabsl = self.reader is not None and self.reader.has_xabsl_rules
                operators = XABSL_OPERATORS if is_xabsl else OPERATORS
                return operators[operator](self._number(left), self._number(right))
            case FunctionCall(function=function, arguments=arguments, type=type_):
                is_mixed = type_ == FLOAT
                return FUNCTIONS[function](
                    *(self._number(each, FLOAT if is_mixed else each.type) for each in arguments)
                )

    def _number(self, node: Expr, type_: str = "") -> float:
        value = self.evaluate_as(node, type_ or node.type)
        assert not isinstance(value, str)
        return value

    def _compare(self, operators: tuple[str, ...], operands: tuple[Expr, ...]) -> bool:
        """Compare neighbors until one comparison fails; each operand is evaluated at most once."""
        left = self.evaluate(operands[0])
        for operator, before, operand in zip(operators, operands, operands[1:], strict=False):
            right = self.evaluate(operand)
            # An int is compared with a float as a double.
            type_ = FLOAT if FLOAT in (before.type, operand.type) else before.type
            if not COMPARISONS[operator](as_type(left, type_), as_type(right, type_)):  # type: ignore[arg-type]
                return False
            left = right
        return True
