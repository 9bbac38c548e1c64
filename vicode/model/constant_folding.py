"""Evaluation of constants and initial values at generation time."""

from collections.abc import Callable, Mapping
from functools import lru_cache
from types import MappingProxyType

from vicode.bica import arithmetic
from vicode.model.design import Declaration
from vicode.model.expressions import (
    UNKNOWN,
    Binary,
    Boolean,
    Comparison,
    EnumElement,
    Expr,
    FunctionCall,
    Logic,
    Minus,
    Not,
    Number,
    Scope,
    Ternary,
    Variable,
    build_scope,
    parse_expression,
)
from vicode.model.project import Enumeration, Project

ConstantValue = bool | float | str
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
_ARITHMETIC: Mapping[str, Callable[[float, float], float]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": arithmetic.divide,
    "//": arithmetic.floor_divide,
    "%": arithmetic.modulo,
}
_COMPARISONS: Mapping[str, Callable[[float, float], bool]] = {
    "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b,
    ">": lambda a, b: a > b,
    ">=": lambda a, b: a >= b,
    "==": lambda a, b: a == b,
    "!=": lambda a, b: a != b,
}


def evaluate_constants(project: Project) -> Mapping[str, ConstantValue]:
    """Evaluate the constants in order, each using the previous ones. Invalid constants are omitted."""
    return _evaluate_declarations(project.constants, project.enumerations)


# Constants are evaluated after every edit, but rarely change.
@lru_cache(maxsize=64)
def _evaluate_declarations(
    constants: tuple[Declaration, ...], enumerations: tuple[Enumeration, ...]
) -> Mapping[str, ConstantValue]:
    values: dict[str, ConstantValue] = {}
    for index, constant in enumerate(constants):
        scope = build_scope(Project(name="", constants=constants[:index], enumerations=enumerations), None)
        value = evaluate_initial_value(constant.initial, scope.type_of(constant), scope, values)
        if value is not None:
            values[constant.name] = value
    return MappingProxyType(values)


def evaluate_initial_value(
    text: str, type_: str, scope: Scope, constants: Mapping[str, ConstantValue]
) -> ConstantValue | None:
    """Evaluate an expression. Without a value it is false, 0 or the first element. Return None if it is unknown."""
    if not text or text in scope.enumerations:
        return zero_value(type_, scope)
    parsed = parse_expression(text, scope, type_)
    return None if parsed.tree is None or parsed.diagnostics else evaluate(parsed.tree, constants)


def zero_value(type_: str, scope: Scope) -> ConstantValue | None:
    """Return the default value of a type: false, 0 or the first element."""
    if type_ in scope.enumerations:
        return next(iter(scope.enumerations[type_]), None)
    return None if type_ == UNKNOWN else False if type_ == "bool" else 0.0


def evaluate(node: Expr, constants: Mapping[str, ConstantValue]) -> ConstantValue | None:
    """Evaluate a tree of literals and constants. Return None if the value is known only at run time."""
    match node:
        case Number(value=value) | Boolean(value=value):
            return value
        case EnumElement(element=element):
            return element
        case Variable(name=name, kind="constant"):
            return constants.get(name)
        case Ternary(test=test, then=then, otherwise=otherwise):
            chosen = evaluate(test, constants)
            return None if chosen is None else evaluate(then if chosen else otherwise, constants)
        case _:
            return _evaluate_operation(node, constants)


def _evaluate_operation(node: Expr, constants: Mapping[str, ConstantValue]) -> ConstantValue | None:
    match node:
        case Not(operand=operand):
            value = evaluate(operand, constants)
            return None if value is None else not value
        case Minus(operand=operand):
            value = evaluate(operand, constants)
            return None if value is None or isinstance(value, str) else -value
        case Binary(operator=operator, left=left, right=right):
            return _apply(_ARITHMETIC[operator], (left, right), constants)
        case FunctionCall(function=function, arguments=arguments):
            return _apply(_FUNCTIONS[function], arguments, constants)
        case Comparison(operators=operators, operands=operands):
            pairs = zip(operators, operands, operands[1:], strict=False)
            return _all_true([_apply(_COMPARISONS[operator], (a, b), constants) for operator, a, b in pairs])
        case Logic(operator=operator, operands=operands):
            values = [evaluate(operand, constants) for operand in operands]
            return None if None in values else all(values) if operator == "and" else any(values)
        case _:
            return None


def _all_true(values: list[ConstantValue | None]) -> bool | None:
    return None if None in values else all(values)


def _apply(
    function: Callable[..., float], operands: tuple[Expr, ...], constants: Mapping[str, ConstantValue]
) -> ConstantValue | None:
    values = [evaluate(operand, constants) for operand in operands]
    if None in values:
        return None
    try:
        return function(*values)
    except OverflowError:
        return None
