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
    Apply,
    Binary,
    Choice,
    Comparison,
    Element,
    Logic,
    Minus,
    Node,
    Not,
    Number,
    Reading,
    Scope,
    Truth,
    parse_expression,
)
from vicode.model.expressions.functions import NUMBER

_NOWHERE = (0, 0)


class UnsoundDesignError(ValueError):
    """A design with mistakes was to be generated; check it first."""


def tree_of(text: str, scope: Scope, expected: str) -> Node:
    """The tree of an expression with the type of its place.

    Raises:
        UnsoundDesignError: The expression has mistakes.
    """
    parsed = parse_expression(text, scope, expected)
    if parsed.tree is None or parsed.mistakes:
        reason = parsed.mistakes[0].message if parsed.mistakes else "no tree"
        raise UnsoundDesignError(f"{text!r}: {reason}")
    return as_type(_settled(parsed.tree, scope), expected)


def as_type(node: Node, expected: str) -> Node:
    """The node, or where an int stands for a float its conversion."""
    if expected != FLOAT or node.type != INT:
        return node
    match node:
        case Number(value=value):
            return replace(node, value=float(value), type=FLOAT)
        case Minus(operand=Number() as operand):
            return replace(node, operand=as_type(operand, FLOAT), type=FLOAT)
        case Choice(then=then, otherwise=otherwise):
            return replace(node, then=as_type(then, FLOAT), otherwise=as_type(otherwise, FLOAT), type=FLOAT)
        case _:
            return Apply(function="float", arguments=(node,), type=FLOAT, span=node.span)


def _settled(node: Node, scope: Scope) -> Node:
    """The same tree with every int converted where the node above it works on floats."""
    match node:
        case Not(operand=operand) | Minus(operand=operand):
            return replace(node, operand=_settled(operand, scope))
        case Binary(left=left, right=right):
            return replace(node, left=_settled(left, scope), right=_settled(right, scope))
        case Comparison(operands=operands) | Logic(operands=operands):
            return replace(node, operands=tuple(_settled(operand, scope) for operand in operands))
        case Choice(test=test, then=then, otherwise=otherwise, type=type_):
            sides = [as_type(_settled(side, scope), type_) for side in (then, otherwise)]
            return replace(node, test=_settled(test, scope), then=sides[0], otherwise=sides[1])
        case Apply(function=function, arguments=arguments, type=type_):
            is_mixed = FUNCTIONS[function].gives == NUMBER and type_ == FLOAT
            settled = (_settled(argument, scope) for argument in arguments)
            return replace(node, arguments=tuple(as_type(each, FLOAT) if is_mixed else each for each in settled))
        case Reading(arguments=pairs) if pairs:
            return replace(node, arguments=_settled_arguments(node, scope))
        case _:
            return node


def _settled_arguments(reading: Reading, scope: Scope) -> tuple[tuple[str, Node], ...]:
    interface = scope.uses[reading.alias]
    output = interface.output(reading.output) if interface else None
    types = {each.name: scope.type_of(each) for each in (output.arguments if output else None) or ()}
    return tuple(
        (name, as_type(_settled(value, scope), types.get(name, value.type))) for name, value in reading.arguments or ()
    )


def initial_of(declaration: Declaration, scope: Scope) -> Node:
    """The first value of a declaration, of its type; where none is given false, 0 or the first element."""
    type_ = scope.type_of(declaration)
    if declaration.initial:
        return tree_of(declaration.initial, scope, type_)
    if type_ == UNKNOWN:
        raise UnsoundDesignError(f"'{declaration.name}' has an unknown type")
    if type_ == BOOL:
        return Truth(value=False, span=_NOWHERE)
    if type_ in (INT, FLOAT):
        return Number(value=0 if type_ == INT else 0.0, type=type_, span=_NOWHERE)
    return Element(element=scope.enumerations[type_][0], type=type_, span=_NOWHERE)


def literal_of(node: Node) -> float | None:
    """The number that a node is written as, None when it is no plain number."""
    match node:
        case Number(value=value):
            return value
        case Minus(operand=operand):
            positive = literal_of(operand)
            return None if positive is None else -positive
        case _:
            return None


def nanoseconds_of(node: Node, unit: str) -> int | None:
    """A literal time in nanoseconds, None when it is not known before it runs."""
    time = literal_of(node)
    if time is None:
        return None
    ns = time * (1e6 if unit == "ms" else 1e9)
    return round(ns) if math.isfinite(ns) else None
