"""Expressions of designs as trees of XABSL, with parentheses where precedence or a reader wants them."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import reduce
from math import pi

from vicode.generators.plan import After, Condition, Holds, UnsoundDesignError
from vicode.generators.xabsl.vocabulary import Vocabulary, number, number_text
from vicode.model.expressions import (
    BOOL,
    FLOAT,
    INT,
    Apply,
    Binary,
    Choice,
    Comparison,
    Done,
    Element,
    Kind,
    Logic,
    Minus,
    Node,
    Not,
    Number,
    Reading,
    Status,
    Time,
    Truth,
    Variable,
)
from vicode.model.xabsl.names import plain_name
from vicode.model.xabsl.sayable import Sayer
from vicode.xabsl import tree
from vicode.xabsl.pieces import read_expression

_CHOICE, _OR, _AND, _COMPARISON, _SUM, _PRODUCT, _SIGN, _ATOM = range(8)
_LEVELS = {
    "||": _OR,
    "&&": _AND,
    "+": _SUM,
    "-": _SUM,
    "*": _PRODUCT,
    "/": _PRODUCT,
    "%": _PRODUCT,
    **dict.fromkeys(("<", "<=", ">", ">=", "==", "!="), _COMPARISON),
}
_ZERO = tree.Number("0")
_FACTORS = {"degrees": 180.0 / pi, "radians": pi / 180.0}


@dataclass(frozen=True, slots=True, kw_only=True)
class Speller:
    """Spells the expressions of one design. `components` are those it uses by alias, the own one under "".

    `asks_done` tells where `done(alias)` is the same as action_done: in the state, or among the common decisions.
    """

    vocabulary: Vocabulary
    components: dict[str, str]
    time_unit: str
    is_xabsl: bool
    asks_done: Callable[[str, str], bool]

    def spell(self, node: Node, state: str = "") -> tree.Expression:
        """The expression of a typed tree; `state` is where a decision asks for it, empty in actions.

        Raises:
            UnsoundDesignError: XABSL cannot say it.
        """
        asks_done = lambda alias: bool(state) and self.asks_done(state, alias)  # noqa: E731 - a partial reads worse
        sayer = Sayer(is_xabsl=self.is_xabsl, constants=self.vocabulary.constants, asks_done=asks_done)
        unsaid = next(sayer.find(node), None)
        if unsaid is not None:
            raise UnsoundDesignError(unsaid.message)
        return self._spell(node)

    def conditions(self, conditions: Sequence[Condition], state: str) -> tuple[tree.Expression, ...]:
        """What a guard asks, each part of it."""
        return tuple(self._condition(each, state) for each in conditions)

    def _condition(self, condition: Condition, state: str) -> tree.Expression:
        match condition:
            case Holds(expression=expression):
                return self.spell(expression, state)
            case After():
                return self._after(condition)
            case _:
                text = condition.body.code.in_language("xabsl")
                found = read_expression(text or "")
                if text is None or found.node is None or found.mistakes:
                    raise UnsoundDesignError("the code of a guard is not written in XABSL")
                return found.node

    def _after(self, after: After) -> tree.Expression:
        since: tree.Expression = tree.Word("state_time")
        if self.time_unit == "ms":
            return _binary(">=", since, self.spell(after.time))
        if isinstance(after.time, Variable):
            # What is divided is exact for whole milliseconds; what is multiplied would not be.
            return _binary(">=", _binary("/", since, tree.Number("1000")), self.spell(after.time))
        ms = (after.ns or 0) / 1e6
        return _binary(">=", since, tree.Number(number_text(ms)))

    def _spell(self, node: Node) -> tree.Expression:
        match node:
            case Number() | Truth():
                return self.vocabulary.literal(node.value, node.type)
            case Element(element=element, type=enumeration):
                return self.vocabulary.element(enumeration, element)
            case Variable():
                return self._variable(node)
            case Time(of=of):
                word = tree.Word("state_time" if of == "state" else "option_time")
                return word if self.time_unit == "ms" else _binary("/", word, tree.Number("1000"))
            case Status() | Done():
                return tree.Word(node.of if isinstance(node, Status) else "action_done")
            case Reading():
                return self._reading(node)
            case _:
                return self._operation(node)

    def _variable(self, variable: Variable) -> tree.Expression:
        own = self.components[""]
        if variable.kind == Kind.CONSTANT:
            return self.vocabulary.constant(variable.name, variable.type)
        if variable.kind == Kind.PARAMETER:
            design = self.vocabulary.project.design(own)
            declared = next(each for each in design.parameters if each.name == variable.name) if design else None
            return tree.Ref(f"@{plain_name(declared) if declared else variable.name}")
        return tree.Ref(self.vocabulary.symbol(own, variable.name))

    def _reading(self, reading: Reading) -> tree.Expression:
        component = self.components[reading.alias]
        name = self.vocabulary.symbol(component, reading.output)
        declared = self.vocabulary.arguments_of(component, reading.output)
        if declared is None:
            return tree.Ref(name)
        names = {each.name: plain_name(each) for each in declared}
        given = dict(reading.arguments or ())
        said = [tree.Argument(tree.Name(names[each]), self._spell(value)) for each, value in given.items()]
        said += self.vocabulary.left_out(declared, given)
        return tree.Function(tree.Name(name), tree.Arguments(said))

    def _operation(self, node: Node) -> tree.Expression:
        match node:
            case Apply():
                return self._apply(node.function, [self._spell(each) for each in node.arguments])
            case Not(operand=operand):
                return negated(self._spell(operand))
            case Minus(operand=operand):
                return _minus(self._spell(operand))
            case Binary(operator=operator, left=left, right=right):
                return _binary(operator, self._spell(left), self._spell(right))
            case Logic(operator=operator, operands=operands):
                sign = "&&" if operator == "and" else "||"
                return joined(sign, [self._spell(operand) for operand in operands])
            case Comparison(operators=operators, operands=operands):
                pairs = zip(operators, operands, operands[1:], strict=False)
                return joined("&&", [self._compare(operator, left, right) for operator, left, right in pairs])
            case Choice(test=test, then=then, otherwise=otherwise, type=type_):
                sides = self._spell(then), self._spell(otherwise)
                if type_ == BOOL and not self.is_xabsl:
                    return _either(self._spell(test), *sides)
                return choice(self._spell(test), *sides)
            case _:
                raise UnsoundDesignError(f"XABSL has no words for {type(node).__name__}")

    def _compare(self, operator: str, left: Node, right: Node) -> tree.Expression:
        if left.type in (INT, FLOAT):
            return _binary(operator, self._spell(left), self._spell(right))
        if left.type == BOOL:
            first, second = self._spell(left), self._spell(right)
            if operator == "==":
                return joined("||", [joined("&&", [first, second]), joined("&&", [negated(first), negated(second)])])
            return joined("||", [joined("&&", [first, negated(second)]), joined("&&", [negated(first), second])])
        return self._compare_elements(operator, left, right)

    def _compare_elements(self, operator: str, left: Node, right: Node) -> tree.Expression:
        """What has an enumeration of itself goes to the left; an element has it only where it is wanted."""
        left, right = self._known(left), self._known(right)
        if not _is_symbol(left) and not (self.is_xabsl and _has_symbol(left)):
            left, right = (right, left) if _is_symbol(right) or not isinstance(left, Choice) else (left, right)
        match left:
            case Element() if isinstance(right, Element):
                is_equal = left.element == right.element
                return tree.Word("true" if is_equal == (operator == "==") else "false")
            case Choice(test=test, then=then, otherwise=otherwise) if not (self.is_xabsl and _has_symbol(left)):
                sides = self._compare(operator, then, right), self._compare(operator, otherwise, right)
                return _either(self._spell(test), *sides)
            case _:
                return _binary(operator, self._spell(left), self._spell(right))

    def _known(self, node: Node) -> Node:
        """A constant of an enumeration as the element that it is."""
        value = self.vocabulary.constants.get(node.name) if isinstance(node, Variable) else None
        if isinstance(value, str) and isinstance(node, Variable) and node.kind == Kind.CONSTANT:
            return Element(element=value, type=node.type, span=node.span)
        return node

    def _apply(self, function: str, given: list[tree.Expression]) -> tree.Expression:
        first = given[0]
        match function:
            case "float":
                return first
            case "abs":
                return choice(_binary("<", first, _ZERO), _minus(first), first)
            case "min" | "max":
                sign = "<" if function == "min" else ">"
                return reduce(lambda best, each: choice(_binary(sign, each, best), each, best), given)
            case "clamp":
                low, high = given[1:]
                return choice(_binary("<", first, low), low, choice(_binary("<", high, first), high, first))
            case "sign":
                below = choice(_binary("<", first, _ZERO), number(-1), _ZERO)
                return choice(_binary(">", first, _ZERO), number(1), below)
            case "is_nan":
                return _binary("!=", first, first)
            case _:
                return _binary("*", first, number(_FACTORS[function]))


def joined(sign: str, operands: Sequence[tree.Expression]) -> tree.Expression:
    """Operands in a row, read from the left as XABSL does."""
    return reduce(lambda left, right: _binary(sign, left, right), operands)


def all_of(tests: Sequence[tree.Expression]) -> tree.Expression:
    """Tests in a row, without parentheses around those that are rows of tests themselves."""
    return joined("&&", [part for test in tests for part in _parts_of(test)])


def _parts_of(test: tree.Expression) -> Iterator[tree.Expression]:
    while isinstance(test, tree.Parentheses):
        test = test.inner
    if isinstance(test, tree.Binary) and test.operator == "&&":
        yield from _parts_of(test.left)
        yield from _parts_of(test.right)
    else:
        yield test


def negated(operand: tree.Expression) -> tree.Expression:
    """What holds when the operand does not."""
    return tree.Unary("!", _at_least(operand, _SIGN))


def choice(test: tree.Expression, then: tree.Expression, otherwise: tree.Expression) -> tree.Expression:
    """`test ? then : otherwise`; what is itself such a choice stands in parentheses."""
    return tree.Conditional(*(_at_least(each, _OR) for each in (test, then, otherwise)))


def _either(test: tree.Expression, then: tree.Expression, otherwise: tree.Expression) -> tree.Expression:
    """A choice between bools, which no original engine reads as such."""
    return joined("||", [joined("&&", [test, then]), joined("&&", [negated(test), otherwise])])


def _minus(operand: tree.Expression) -> tree.Expression:
    has_sign = isinstance(operand, tree.Unary) and operand.operator == "-"
    return tree.Unary("-", _bracketed(operand) if has_sign else _at_least(operand, _SIGN))


def _binary(operator: str, left: tree.Expression, right: tree.Expression) -> tree.Expression:
    level = _LEVELS[operator]
    first = level + 1 if level == _COMPARISON else level
    # That && goes before || need not be known to who reads.
    sides = [_bracketed(each) if level == _OR and _level(each) == _AND else each for each in (left, right)]
    return tree.Binary(operator, _at_least(sides[0], first), _at_least(sides[1], level + 1))


def _at_least(expression: tree.Expression, level: int) -> tree.Expression:
    return expression if _level(expression) >= level else _bracketed(expression)


def _bracketed(expression: tree.Expression) -> tree.Expression:
    return tree.Parentheses(expression)


def _level(expression: tree.Expression) -> int:
    match expression:
        case tree.Conditional():
            return _CHOICE
        case tree.Binary(operator=operator):
            return _LEVELS[operator]
        case tree.Unary():
            return _SIGN
        case _:
            return _ATOM


def _is_symbol(node: Node) -> bool:
    """Whether a tree of an enumeration's type tells the enumeration of itself."""
    return isinstance(node, Reading) or (isinstance(node, Variable) and node.kind != Kind.CONSTANT)


def _has_symbol(node: Node) -> bool:
    """Whether a choice tells its enumeration by one of its sides."""
    match node:
        case Choice(then=then, otherwise=otherwise):
            return _has_symbol(then) or _has_symbol(otherwise)
        case _:
            return _is_symbol(node)
