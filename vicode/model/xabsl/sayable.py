"""What of an expression XABSL cannot say, or would give another result for."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from vicode.model.constants import Value
from vicode.model.expressions import (
    BOOL,
    Apply,
    Binary,
    Choice,
    Comparison,
    Done,
    Logic,
    Minus,
    Node,
    Number,
    Reading,
    Variable,
    children,
    walk,
)

SAID = frozenset(
    ("abs", "min", "max", "clamp", "sign", "float", "is_nan", "degrees", "radians"),
)
"""The functions that can be written with what XABSL has."""

NOT_SAID, OTHER_RESULT = "L701", "L702"
MOST = 1000
"""Written out, an expression may have so many parts."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Unsaid:
    """A part of an expression, the rule it breaks, and what to do."""

    node: Node
    code: str
    message: str
    mend: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Sayer:
    """Judges the expressions of one design. `asks_done` tells whether `done(alias)` can be asked where this stands."""

    is_xabsl: bool
    constants: Mapping[str, Value]
    asks_done: Callable[[str], bool]

    def find(self, tree: Node) -> Iterator[Unsaid]:
        """All that is not sayable in a tree."""
        for node in walk(tree):
            yield from self._find(node)
        if written_size(tree, is_xabsl=self.is_xabsl) > MOST:
            message = "written out for XABSL this is too long: min, max and others are said with ? : there"
            yield Unsaid(node=tree, code=NOT_SAID, message=message, mend="take it apart, with a variable")

    def _find(self, node: Node) -> Iterator[Unsaid]:
        match node:
            case Apply(function=function) if function not in SAID:
                mend = "let a hand-written component calculate it"
                yield Unsaid(node=node, code=NOT_SAID, message=f"XABSL has no {function}", mend=mend)
            case Binary(operator="//"):
                mend = "let a hand-written component calculate it"
                yield Unsaid(node=node, code=NOT_SAID, message="XABSL has no //", mend=mend)
            case Binary(operator="%") if not self.is_xabsl:
                message = "in XABSL % takes whole parts and the sign of the dividend"
                yield Unsaid(node=node, code=OTHER_RESULT, message=message, mend=_MEND)
            case Binary(operator="/", right=right) if not self.is_xabsl and not is_never_zero(right, self.constants):
                message = "in XABSL a division by 0 divides by 0.0000001, and this may be one"
                yield Unsaid(node=node, code=OTHER_RESULT, message=message, mend=f"divide by a constant, or {_MEND}")
            case Reading(alias=alias, output=output, arguments=arguments) if arguments and not self.is_xabsl:
                inner = (each for _name, value in arguments for each in walk(value))
                if any(isinstance(each, Reading) and (each.alias, each.output) == (alias, output) for each in inner):
                    message = f"in XABSL the calls of '{output}' share its arguments: the inner one changes the outer's"
                    mend = "keep the inner value in a variable"
                    yield Unsaid(node=node, code=OTHER_RESULT, message=message, mend=mend)
            case Done(alias=alias) if not self.asks_done(alias):
                message = f"XABSL asks only whether something that the state calls is done, not whether '{alias}' is"
                mend = "ask in decisions of states that call just this, or write action_done"
                yield Unsaid(node=node, code=NOT_SAID, message=message, mend=mend)
            case _:
                pass


_MEND = "say arithmetic: xabsl to have XABSL's results in every language"


def is_never_zero(node: Node, constants: Mapping[str, Value]) -> bool:
    """Whether a divisor is known not to be 0."""
    match node:
        case Number(value=value):
            return value != 0
        case Variable(name=name, kind="constant"):
            return bool(constants.get(name))
        case Minus(operand=operand) | Apply(function="float", arguments=(operand,)):
            return is_never_zero(operand, constants)
        case Choice(then=then, otherwise=otherwise):
            return is_never_zero(then, constants) and is_never_zero(otherwise, constants)
        case _:
            return False


def written_size(node: Node, *, is_xabsl: bool) -> int:
    """About how many parts an expression has in XABSL, where some must be said twice; never much more than MOST."""
    sizes = [written_size(child, is_xabsl=is_xabsl) for child in children(node)]
    match node:
        case Comparison(operands=operands):
            twice = 2 if operands[0].type == BOOL or any(isinstance(each, Choice) for each in operands) else 1
            total = 2 * twice * sum(sizes)
        case Choice(type=type_) if type_ == BOOL and not is_xabsl:
            total = 2 * sizes[0] + sum(sizes)
        case Apply(function="min" | "max"):
            total = sizes[0]
            for size in sizes[1:]:
                total = min(2 * (total + size), 2 * MOST)
        case Apply(function=function) if function not in ("float", "degrees", "radians"):
            total = 3 * sum(sizes)
        case _:
            total = 1 + sum(sizes)
    return min(total, 2 * MOST)


def written_depth(node: Node) -> int:
    """How deep an expression is nested in XABSL at most: chains are, as deep as they are long."""
    below = max((written_depth(child) for child in children(node)), default=0)
    chain = len(children(node)) if isinstance(node, Logic | Comparison | Apply) else 1
    return below + 2 + 2 * chain if children(node) else 1
