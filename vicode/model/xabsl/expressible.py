"""Checks whether XABSL supports an expression with the same result."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from vicode.model.constant_folding import ConstantValue
from vicode.model.expressions import (
    BOOL,
    TEAM_SIZE,
    Binary,
    Comparison,
    Done,
    Expr,
    FunctionCall,
    Logic,
    Minus,
    Number,
    OutputRef,
    StatusFlag,
    Ternary,
    Variable,
    children,
    walk,
)

SUPPORTED_FUNCTIONS = frozenset(
    ("abs", "min", "max", "clamp", "sign", "float", "is_nan", "degrees", "radians"),
)
"""The functions that can be expanded in XABSL."""

UNSUPPORTED, DIFFERENT_RESULT = "L701", "L702"
MAX_SIZE = 4000
"""Maximum number of nodes of an expanded expression."""


@dataclass(frozen=True, slots=True, kw_only=True)
class UnsupportedExpression:
    """A part of an expression that XABSL does not support, with code, message and fix."""

    node: Expr
    code: str
    message: str
    fix: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ExpressibilityChecker:
    """Checks expressions. `is_done_expressible` returns whether the context supports `done(alias)`."""

    has_xabsl_arithmetic: bool
    constants: Mapping[str, ConstantValue]
    is_done_expressible: Callable[[str], bool]

    def check(self, tree: Expr) -> Iterator[UnsupportedExpression]:
        for node in walk(tree):
            yield from self._check_node(node)
        if expanded_size(tree, has_xabsl_arithmetic=self.has_xabsl_arithmetic) > MAX_SIZE:
            message = "this expression is too long in XABSL, where functions such as min and max are expanded with ? :"
            yield UnsupportedExpression(node=tree, code=UNSUPPORTED, message=message, fix="split it with a variable")

    def _check_node(self, node: Expr) -> Iterator[UnsupportedExpression]:
        match node:
            case FunctionCall(function=function) if function not in SUPPORTED_FUNCTIONS:
                fix = "compute it in a hand-written component"
                yield UnsupportedExpression(
                    node=node, code=UNSUPPORTED, message=f"XABSL does not support '{function}'", fix=fix
                )
            case Binary(operator="//"):
                fix = "compute it in a hand-written component"
                yield UnsupportedExpression(node=node, code=UNSUPPORTED, message="XABSL does not support '//'", fix=fix)
            case Binary(operator="%") if not self.has_xabsl_arithmetic:
                message = "XABSL evaluates % with integers and the sign of the dividend"
                yield UnsupportedExpression(node=node, code=DIFFERENT_RESULT, message=message, fix=_ARITHMETIC_FIX)
            case Binary(operator="/", right=right) if not self.has_xabsl_arithmetic and not is_never_zero(
                right, self.constants
            ):
                message = "the divisor may be 0, and XABSL replaces a divisor of 0 by 0.0000001"
                yield UnsupportedExpression(
                    node=node, code=DIFFERENT_RESULT, message=message, fix=f"divide by a constant, or {_ARITHMETIC_FIX}"
                )
            case OutputRef(alias=alias, output=output, arguments=arguments) if (
                arguments and not self.has_xabsl_arithmetic
            ):
                inner = (each for _name, value in arguments for each in walk(value))
                if any(isinstance(each, OutputRef) and (each.alias, each.output) == (alias, output) for each in inner):
                    message = f"nested calls of '{output}' share their arguments in XABSL"
                    fix = "store the inner value in a variable"
                    yield UnsupportedExpression(node=node, code=DIFFERENT_RESULT, message=message, fix=fix)
            case StatusFlag(name=name) if name == TEAM_SIZE:
                message = "XABSL does not know how many robots of the team are alive"
                fix = "read it from an output of a component of the world, which the robot sets"
                yield UnsupportedExpression(node=node, code=UNSUPPORTED, message=message, fix=fix)
            case Done(alias=alias) if not self.is_done_expressible(alias):
                message = f"XABSL supports 'done({alias})' only in states that call no other component"
                fix = "use it in states that call only this component, or use action_done"
                yield UnsupportedExpression(node=node, code=UNSUPPORTED, message=message, fix=fix)
            case _:
                pass


_ARITHMETIC_FIX = "set arithmetic: xabsl to use the arithmetic of XABSL in every language"


def is_never_zero(node: Expr, constants: Mapping[str, ConstantValue]) -> bool:
    """Return whether a divisor is known not to be 0."""
    match node:
        case Number(value=value):
            return value != 0
        case Variable(name=name, kind="constant"):
            return bool(constants.get(name))
        case Minus(operand=operand) | FunctionCall(function="float", arguments=(operand,)):
            return is_never_zero(operand, constants)
        case Ternary(then=then, otherwise=otherwise):
            return is_never_zero(then, constants) and is_never_zero(otherwise, constants)
        case _:
            return False


def expanded_size(node: Expr, *, has_xabsl_arithmetic: bool) -> int:
    """Estimate the number of nodes in XABSL, where some operands are repeated; at most 2 * MAX_SIZE."""
    sizes = [expanded_size(child, has_xabsl_arithmetic=has_xabsl_arithmetic) for child in children(node)]
    match node:
        case Comparison(operands=operands):
            twice = 2 if operands[0].type == BOOL or any(isinstance(each, Ternary) for each in operands) else 1
            total = 2 * twice * sum(sizes)
        case Ternary(type=type_) if type_ == BOOL and not has_xabsl_arithmetic:
            total = 2 * sizes[0] + sum(sizes)
        case FunctionCall(function="min" | "max"):
            total = sizes[0]
            for size in sizes[1:]:
                total = min(2 * (total + size), 2 * MAX_SIZE)
        case FunctionCall(function=function) if function not in ("float", "degrees", "radians"):
            total = 3 * sum(sizes)
        case _:
            total = 1 + sum(sizes)
    return min(total, 2 * MAX_SIZE)


def expanded_depth(node: Expr) -> int:
    """Return an upper bound of the nesting depth in XABSL, where chains are nested."""
    below = max((expanded_depth(child) for child in children(node)), default=0)
    chain = len(children(node)) if isinstance(node, Logic | Comparison | FunctionCall) else 1
    return below + 2 + 2 * chain if children(node) else 1
