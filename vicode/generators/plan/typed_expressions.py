"""Typed expression trees with explicit int-to-float conversions."""

import math
from dataclasses import replace

from vicode.model.design import Declaration
from vicode.model.expressions import (
    BOOL,
    FLOAT,
    FUNCTIONS,
    INT,
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
    OutputRef,
    Scope,
    Ternary,
    is_type_only,
    parse_expression,
    walk,
)
from vicode.model.expressions.functions import NUMBER

_NO_SPAN = (0, 0)


class UnsoundDesignError(ValueError):
    """Code was requested for a design that has errors."""


def typed_tree(text: str, scope: Scope, expected: str | None) -> Expr:
    """Parse an expression and convert it to the expected type; None for any.

    Raises:
        UnsoundDesignError: The expression has errors.
    """
    parsed = parse_expression(text, scope, expected)
    if parsed.tree is None or parsed.diagnostics:
        reason = parsed.diagnostics[0].message if parsed.diagnostics else "no tree"
        raise UnsoundDesignError(f"{text!r}: {reason}")
    has_conversions = any(isinstance(node, Ternary | FunctionCall | OutputRef) for node in walk(parsed.tree))
    return as_type(_with_conversions(parsed.tree, scope) if has_conversions else parsed.tree, expected)


def as_type(node: Expr, expected: str | None) -> Expr:
    """Convert an int node to float where a float is expected."""
    if expected != FLOAT or node.type != INT:
        return node
    match node:
        case Number(value=value):
            return replace(node, value=float(value), type=FLOAT)
        case Minus(operand=Number() as operand):
            return replace(node, operand=as_type(operand, FLOAT), type=FLOAT)
        case Ternary(then=then, otherwise=otherwise):
            return replace(node, then=as_type(then, FLOAT), otherwise=as_type(otherwise, FLOAT), type=FLOAT)
        case _:
            return FunctionCall(function="float", arguments=(node,), type=FLOAT, span=node.span)


def _with_conversions(node: Expr, scope: Scope) -> Expr:
    """Insert a conversion at every int operand of a float operation."""
    match node:
        case Not(operand=operand) | Minus(operand=operand):
            return replace(node, operand=_with_conversions(operand, scope))
        case Binary(left=left, right=right):
            return replace(node, left=_with_conversions(left, scope), right=_with_conversions(right, scope))
        case Comparison(operands=operands) | Logic(operands=operands):
            return replace(node, operands=tuple(_with_conversions(operand, scope) for operand in operands))
        case Ternary(test=test, then=then, otherwise=otherwise, type=type_):
            sides = [as_type(_with_conversions(side, scope), type_) for side in (then, otherwise)]
            return replace(node, test=_with_conversions(test, scope), then=sides[0], otherwise=sides[1])
        case FunctionCall(function=function, arguments=arguments, type=type_):
            is_mixed = FUNCTIONS[function].return_type == NUMBER and type_ == FLOAT
            converted = [_with_conversions(argument, scope) for argument in arguments]
            is_float = FLOAT in FUNCTIONS[function].parameter_types
            to_float = [is_mixed or (is_float and _may_be_negative_zero(value)) for value in converted]
            values = (
                as_type(value, FLOAT) if is_to else value for value, is_to in zip(converted, to_float, strict=True)
            )
            return replace(node, arguments=tuple(values))
        case OutputRef(arguments=pairs) if pairs:
            return replace(node, arguments=_converted_arguments(node, scope))
        case _:
            return node


def _may_be_negative_zero(node: Expr) -> bool:
    """Whether a node is or chooses the literal -0, which is -0.0 where a float is expected."""
    match node:
        case Ternary(then=then, otherwise=otherwise):
            return _may_be_negative_zero(then) or _may_be_negative_zero(otherwise)
        case _:
            return isinstance(node, Minus) and literal_value(node) == 0


def _converted_arguments(reference: OutputRef, scope: Scope) -> tuple[tuple[str, Expr], ...]:
    interface = scope.uses[reference.alias]
    output = interface.output(reference.output) if interface else None
    types = {argument.name: scope.type_of(argument) for argument in (output.arguments if output else None) or ()}
    return tuple(
        (name, as_type(_with_conversions(value, scope), types.get(name, value.type)))
        for name, value in reference.arguments or ()
    )


def initial_value(declaration: Declaration, scope: Scope) -> Expr:
    """Return the initial value of a declaration; the default is false, 0 or the first element."""
    type_ = scope.type_of(declaration)
    if declaration.initial and not is_type_only(declaration, scope):
        return typed_tree(declaration.initial, scope, type_)
    if type_ == UNKNOWN:
        raise UnsoundDesignError(f"'{declaration.name}' has an unknown type")
    if type_ == BOOL:
        return Boolean(value=False, span=_NO_SPAN)
    if type_ in (INT, FLOAT):
        return Number(value=0 if type_ == INT else 0.0, type=type_, span=_NO_SPAN)
    return EnumElement(element=scope.enumerations[type_][0], type=type_, span=_NO_SPAN)


def literal_value(node: Expr) -> float | None:
    """Return the value of a literal with an optional sign; None for any other node."""
    match node:
        case Number(value=value):
            return value
        case Minus(operand=operand):
            positive = literal_value(operand)
            return None if positive is None else -positive
        case _:
            return None


def literal_nanoseconds(node: Expr, unit: str) -> int | None:
    """Return a literal time in nanoseconds; None if the node is not a literal."""
    time = literal_value(node)
    if time is None:
        return None
    ns = time * (1e6 if unit == "ms" else 1e9)
    return round(ns) if math.isfinite(ns) else None
