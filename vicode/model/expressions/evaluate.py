"""Evaluates typed trees with given values, as the generated code does."""

from collections.abc import Callable, Mapping

from vicode.bica import arithmetic
from vicode.model.expressions.tree import (
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

Value = bool | float | str
"""A bool, a number, or the name of an enumeration element."""

_ARITHMETIC_FUNCTIONS = (
    *("clamp", "sign", "floor", "ceil", "sqrt", "exp", "log", "is_nan", "sin", "cos", "tan", "asin", "acos", "atan"),
    *("atan2", "hypot", "degrees", "radians"),
)
_FUNCTIONS: Mapping[str, Callable[..., float]] = {
    **{name: getattr(arithmetic, name) for name in _ARITHMETIC_FUNCTIONS},
    "abs": abs,
    "float": float,
    "min": arithmetic.minimum,
    "max": arithmetic.maximum,
    "int": arithmetic.to_int,
    "round": arithmetic.round_half_even,
}


def _of_floats(function: Callable[[float, float], float]) -> Callable[[float, float], float]:
    """Return a function that converts its arguments to floats: the quotient of large ints differs from that."""
    return lambda a, b: function(float(a), float(b))


_ARITHMETIC: Mapping[str, Callable[[float, float], float]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": _of_floats(arithmetic.divide),
    "//": arithmetic.floor_divide,
    "%": arithmetic.modulo,
}
_XABSL_ARITHMETIC = {**_ARITHMETIC, "/": _of_floats(arithmetic.xabsl_divide), "%": arithmetic.xabsl_remainder}
_COMPARISONS: Mapping[str, Callable[[float, float], bool]] = {
    "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b,
    ">": lambda a, b: a > b,
    ">=": lambda a, b: a >= b,
    "==": lambda a, b: a == b,
    "!=": lambda a, b: a != b,
}


def evaluate(node: Expr, values: Mapping[str, Value], *, xabsl_arithmetic: bool = False) -> Value | None:
    """Evaluate a tree. Return None if the result depends on a value that is not given.

    Args:
        node: A tree without errors.
        values: The values by name, as `read_name` returns them, and those of constants.
        xabsl_arithmetic: Whether the design divides as the XABSL engine does.
    """
    return _Evaluator(values, _XABSL_ARITHMETIC if xabsl_arithmetic else _ARITHMETIC).evaluate(node)


def read_name(node: Expr) -> str:
    """The name under which a node reads a value: `x`, `alias.output`, `done(alias)`, `state_time`.

    Empty for constants, other nodes, and outputs with arguments.
    """
    match node:
        case Variable(name=name, kind=kind) if kind != "constant":
            return name
        case ElapsedTime(kind=of):
            return f"{of}_time"
        case StatusFlag(name=name):
            return name
        case Done(alias=alias):
            return f"done({alias})"
        case OutputRef(alias=alias, output=output, arguments=None):
            return f"{alias}.{output}"
        case _:
            return ""


class _Evaluator:
    def __init__(self, values: Mapping[str, Value], operators: Mapping[str, Callable[[float, float], float]]) -> None:
        self._values, self._operators = values, operators

    def evaluate(self, node: Expr) -> Value | None:
        match node:
            case Number(value=value) | Boolean(value=value):
                return value
            case EnumElement(element=element):
                return element
            case Variable(name=name):
                return self._values.get(name)
            case Ternary():
                return self._evaluate_ternary(node)
            case ElapsedTime() | StatusFlag() | Done() | OutputRef():
                return _as_int(node, self._values.get(read_name(node)), arithmetic.limit)
            case _:
                return _as_int(node, self._evaluate_operation(node), arithmetic.saturate)

    def _evaluate_operation(self, node: Expr) -> Value | None:
        match node:
            case Not(operand=operand):
                value = self.evaluate(operand)
                return None if value is None else not value
            case Minus(operand=operand):
                value = self.evaluate(operand)
                return None if value is None or isinstance(value, str) else -value
            case Binary(operator=operator, left=left, right=right):
                return self._apply(self._operators[operator], (left, right))
            case FunctionCall(function=function, arguments=arguments):
                return self._apply(_FUNCTIONS[function], arguments)
            case Comparison(operators=operators, operands=operands):
                pairs = zip(operators, operands, operands[1:], strict=False)
                return _all([self._compare(_COMPARISONS[operator], a, b) for operator, a, b in pairs])
            case Logic(operator=operator, operands=operands):
                held = [self.evaluate(operand) for operand in operands]
                return _all(held) if operator == "and" else _any(held)
            case _:
                return None

    def _evaluate_ternary(self, node: Ternary) -> Value | None:
        chosen = self.evaluate(node.test)
        return None if chosen is None else self.evaluate(node.then if chosen else node.otherwise)

    def _compare(self, compare: Callable[..., float], *sides: Expr) -> Value | None:
        are_floats = FLOAT in {side.type for side in sides}
        return self._apply(lambda a, b: compare(float(a), float(b)) if are_floats else compare(a, b), sides)

    def _apply(self, function: Callable[..., float], operands: tuple[Expr, ...]) -> Value | None:
        given = [self.evaluate(operand) for operand in operands]
        if None in given:
            return None
        try:
            return function(*given)
        except (OverflowError, TypeError, ValueError):
            # Integers beyond the range of floats, and values of another type than the design declares.
            return None


def _as_int(node: Expr, value: Value | None, limit: Callable[[int], int]) -> Value | None:
    return limit(value) if node.type == INT and isinstance(value, int) else value


def _all(held: list[Value | None]) -> bool | None:
    """Whether all hold; a part that does not hold decides, whatever the unknown ones are."""
    if any(each is not None and not each for each in held):
        return False
    return None if None in held else True


def _any(held: list[Value | None]) -> bool | None:
    if any(each is not None and each for each in held):
        return True
    return None if None in held else False
