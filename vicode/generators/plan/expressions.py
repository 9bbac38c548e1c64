"""Typed trees for a plan: of the type that their place asks for, so that no language has to convert."""

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
    parse_expression,
)
from vicode.model.expressions.functions import NUMBER

_NO_SPAN = (0, 0)


class UnsoundDesignError(ValueError):
    """A design with mistakes was to be generated; check it first."""


def typed_tree(text: str, scope: Scope, expected: str) -> Expr:
    """The tree of an expression with the type of its place.

    Raises:
        UnsoundDesignError: The expression has mistakes.
    """
    parsed = parse_expression(text, scope, expected)
    if parsed.tree is None or parsed.diagnostics:
        reason = parsed.diagnostics[0].message if parsed.diagnostics else "no tree"
        raise UnsoundDesignError(f"{text!r}: {reason}")
    return as_type(_with_conversions(parsed.tree, scope), expected)


def as_type(node: Expr, expected: str) -> Expr:
    """The node, or where an int stands for a float its conversion."""
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
    """The same tree with every int converted where the node above it works on floats."""
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
            settled = (_with_conversions(argument, scope) for argument in arguments)
            return replace(node, arguments=tuple(as_type(each, FLOAT) if is_mixed else each for each in settled))
        case OutputRef(arguments=pairs) if pairs:
            return replace(node, arguments=_converted_arguments(node, scope))
        case _:
            return node


def _converted_arguments(reading: OutputRef, scope: Scope) -> tuple[tuple[str, Expr], ...]:
    interface = scope.uses[reading.alias]
    output = interface.output(reading.output) if interface else None
    types = {each.name: scope.type_of(each) for each in (output.arguments if output else None) or ()}
    return tuple(
        (name, as_type(_with_conversions(value, scope), types.get(name, value.type)))
        for name, value in reading.arguments or ()
    )


def initial_value(declaration: Declaration, scope: Scope) -> Expr:
    """The first value of a declaration, of its type; where none is given false, 0 or the first element."""
    type_ = scope.type_of(declaration)
    if declaration.initial:
        return typed_tree(declaration.initial, scope, type_)
    if type_ == UNKNOWN:
        raise UnsoundDesignError(f"'{declaration.name}' has an unknown type")
    if type_ == BOOL:
        return Boolean(value=False, span=_NO_SPAN)
    if type_ in (INT, FLOAT):
        return Number(value=0 if type_ == INT else 0.0, type=type_, span=_NO_SPAN)
    return EnumElement(element=scope.enumerations[type_][0], type=type_, span=_NO_SPAN)


def literal_value(node: Expr) -> float | None:
    """The number that a node is written as, None when it is no plain number."""
    match node:
        case Number(value=value):
            return value
        case Minus(operand=operand):
            positive = literal_value(operand)
            return None if positive is None else -positive
        case _:
            return None


def literal_nanoseconds(node: Expr, unit: str) -> int | None:
    """A literal time in nanoseconds, None when it is not known before it runs."""
    time = literal_value(node)
    if time is None:
        return None
    ns = time * (1e6 if unit == "ms" else 1e9)
    return round(ns) if math.isfinite(ns) else None
