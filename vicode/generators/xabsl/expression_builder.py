"""Build XABSL expression trees, with parentheses where precedence or readability requires them."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import reduce
from math import pi

from vicode.generators.plan import Condition, ExpressionCondition, TimerCondition, UnsoundDesignError
from vicode.generators.xabsl.name_map import XabslNameMap, format_decimal, number_node
from vicode.model.expressions import (
    BOOL,
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
    ScopeSymbolKind,
    StatusFlag,
    Ternary,
    Variable,
)
from vicode.model.xabsl.expressible import ExpressibilityChecker
from vicode.model.xabsl.names import unqualified_name
from vicode.xabsl import tree
from vicode.xabsl.embedded_code import parse_embedded_expression

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
_ZERO = tree.NumberNode("0")
_FACTORS = {"degrees": 180.0 / pi, "radians": pi / 180.0}


@dataclass(frozen=True, slots=True, kw_only=True)
class XabslExpressionBuilder:
    """Builds the expressions of one design.

    Attributes:
        components: The used components by alias; the component itself has the alias "".
        can_use_action_done: Whether `done(alias)` equals `action_done` in a state (or COMMON).
    """

    name_map: XabslNameMap
    components: dict[str, str]
    time_unit: str
    uses_xabsl_arithmetic: bool
    can_use_action_done: Callable[[str, str], bool]

    def build(self, node: Expr, state: str = "") -> tree.ExpressionNode:
        """Build the expression of a typed tree; `state` is the state of the decision, empty in actions.

        Raises:
            UnsoundDesignError: XABSL cannot express it.
        """
        checker = ExpressibilityChecker(
            has_xabsl_arithmetic=self.uses_xabsl_arithmetic,
            constants=self.name_map.constants,
            is_done_expressible=lambda alias: bool(state) and self.can_use_action_done(state, alias),
        )
        unsupported = next(checker.check(node), None)
        if unsupported is not None:
            raise UnsoundDesignError(unsupported.message)
        return self._build(node)

    def build_conditions(self, conditions: Sequence[Condition], state: str) -> tuple[tree.ExpressionNode, ...]:
        return tuple(self._condition(condition, state) for condition in conditions)

    def _condition(self, condition: Condition, state: str) -> tree.ExpressionNode:
        match condition:
            case ExpressionCondition(expression=expression):
                return self.build(expression, state)
            case TimerCondition():
                return self._timer_condition(condition)
            case _:
                text = condition.code.code.in_language("xabsl")
                embedded = parse_embedded_expression(text or "")
                if text is None or embedded.node is None or embedded.diagnostics:
                    raise UnsoundDesignError("the code of a guard is not written in XABSL")
                return embedded.node

    def _timer_condition(self, after: TimerCondition) -> tree.ExpressionNode:
        since: tree.ExpressionNode = tree.KeywordNode("state_time")
        if self.time_unit == "ms":
            return _binary(">=", since, self.build(after.time))
        if isinstance(after.time, Variable):
            # Dividing whole milliseconds gives the exact comparison; multiplying seconds does not.
            return _binary(">=", _binary("/", since, tree.NumberNode("1000")), self.build(after.time))
        ms = (after.ns or 0) / 1e6
        return _binary(">=", since, tree.NumberNode(format_decimal(ms)))

    def _build(self, node: Expr) -> tree.ExpressionNode:
        match node:
            case Number() | Boolean():
                return self.name_map.literal(node.value, node.type)
            case EnumElement(element=element, type=enumeration):
                return self.name_map.element(enumeration, element)
            case Variable():
                return self._variable(node)
            case ElapsedTime(kind=of):
                word = tree.KeywordNode("state_time" if of == "state" else "option_time")
                return word if self.time_unit == "ms" else _binary("/", word, tree.NumberNode("1000"))
            case StatusFlag() | Done():
                return tree.KeywordNode(node.name if isinstance(node, StatusFlag) else "action_done")
            case OutputRef():
                return self._output_reference(node)
            case _:
                return self._operation(node)

    def _variable(self, variable: Variable) -> tree.ExpressionNode:
        own = self.components[""]
        if variable.kind == ScopeSymbolKind.CONSTANT:
            return self.name_map.constant(variable.name, variable.type)
        if variable.kind == ScopeSymbolKind.PARAMETER:
            design = self.name_map.project.design(own)
            declared = next(item for item in design.parameters if item.name == variable.name) if design else None
            return tree.ReferenceNode(f"@{unqualified_name(declared) if declared else variable.name}")
        return tree.ReferenceNode(self.name_map.symbol_name(own, variable.name))

    def _output_reference(self, reference: OutputRef) -> tree.ExpressionNode:
        component = self.components[reference.alias]
        name = self.name_map.symbol_name(component, reference.output)
        declared = self.name_map.output_arguments(component, reference.output)
        if declared is None:
            return tree.ReferenceNode(name)
        names = {argument.name: unqualified_name(argument) for argument in declared}
        values = dict(reference.arguments or ())
        arguments = [tree.ArgumentNode(tree.NameNode(names[key]), self._build(value)) for key, value in values.items()]
        arguments += self.name_map.missing_arguments(declared, values)
        return tree.FunctionCallNode(tree.NameNode(name), tree.ArgumentListNode(arguments))

    def _operation(self, node: Expr) -> tree.ExpressionNode:
        match node:
            case FunctionCall():
                return self._apply(node.function, [self._build(argument) for argument in node.arguments])
            case Not(operand=operand):
                return negation(self._build(operand))
            case Minus(operand=operand):
                return _negative(self._build(operand))
            case Binary(operator=operator, left=left, right=right):
                return _binary(operator, self._build(left), self._build(right))
            case Logic(operator=operator, operands=operands):
                sign = "&&" if operator == "and" else "||"
                return join_operands(sign, [self._build(operand) for operand in operands])
            case Comparison(operators=operators, operands=operands):
                pairs = zip(operators, operands, operands[1:], strict=False)
                return join_operands("&&", [self._compare(operator, left, right) for operator, left, right in pairs])
            case Ternary(test=test, then=then, otherwise=otherwise, type=type_):
                sides = self._build(then), self._build(otherwise)
                if type_ == BOOL and not self.uses_xabsl_arithmetic:
                    return _boolean_conditional(self._build(test), *sides)
                return conditional(self._build(test), *sides)
            case _:
                raise UnsoundDesignError(f"XABSL cannot express {type(node).__name__}")

    def _compare(self, operator: str, left: Expr, right: Expr) -> tree.ExpressionNode:
        if left.type in (INT, FLOAT):
            return _binary(operator, self._build(left), self._build(right))
        if left.type == BOOL:
            first, second = self._build(left), self._build(right)
            if operator == "==":
                return join_operands(
                    "||",
                    [join_operands("&&", [first, second]), join_operands("&&", [negation(first), negation(second)])],
                )
            return join_operands(
                "||", [join_operands("&&", [first, negation(second)]), join_operands("&&", [negation(first), second])]
            )
        return self._compare_elements(operator, left, right)

    def _compare_elements(self, operator: str, left: Expr, right: Expr) -> tree.ExpressionNode:
        """Put the operand with a declared enumeration on the left; an element gets its type from the other operand."""
        left, right = self._resolve_constant(left), self._resolve_constant(right)
        if not _knows_enumeration(left) and not (self.uses_xabsl_arithmetic and _has_typed_side(left)):
            left, right = (right, left) if _knows_enumeration(right) or not isinstance(left, Ternary) else (left, right)
        match left:
            case EnumElement() if isinstance(right, EnumElement):
                is_equal = left.element == right.element
                return tree.KeywordNode("true" if is_equal == (operator == "==") else "false")
            case Ternary(test=test, then=then, otherwise=otherwise) if not (
                self.uses_xabsl_arithmetic and _has_typed_side(left)
            ):
                sides = self._compare(operator, then, right), self._compare(operator, otherwise, right)
                return _boolean_conditional(self._build(test), *sides)
            case _:
                return _binary(operator, self._build(left), self._build(right))

    def _resolve_constant(self, node: Expr) -> Expr:
        """Replace a constant of an enumeration by its element."""
        value = self.name_map.constants.get(node.name) if isinstance(node, Variable) else None
        if isinstance(value, str) and isinstance(node, Variable) and node.kind == ScopeSymbolKind.CONSTANT:
            return EnumElement(element=value, type=node.type, span=node.span)
        return node

    def _apply(self, function: str, arguments: list[tree.ExpressionNode]) -> tree.ExpressionNode:
        first = arguments[0]
        match function:
            case "float":
                return first
            case "abs":
                return conditional(_binary("<", first, _ZERO), _negative(first), first)
            case "min" | "max":
                sign = "<" if function == "min" else ">"
                return reduce(lambda best, value: conditional(_binary(sign, value, best), value, best), arguments)
            case "clamp":
                low, high = arguments[1:]
                return conditional(_binary("<", first, low), low, conditional(_binary("<", high, first), high, first))
            case "sign":
                below = conditional(_binary("<", first, _ZERO), number_node(-1), _ZERO)
                return conditional(_binary(">", first, _ZERO), number_node(1), below)
            case "is_nan":
                return _binary("!=", first, first)
            case _:
                return _binary("*", first, number_node(_FACTORS[function]))


def join_operands(sign: str, operands: Sequence[tree.ExpressionNode]) -> tree.ExpressionNode:
    """Join operands left-associatively."""
    return reduce(lambda left, right: _binary(sign, left, right), operands)


def conjunction(tests: Sequence[tree.ExpressionNode]) -> tree.ExpressionNode:
    """Join tests by `&&` and flatten nested conjunctions."""
    return join_operands("&&", [part for test in tests for part in _conjuncts(test)])


def _conjuncts(test: tree.ExpressionNode) -> Iterator[tree.ExpressionNode]:
    while isinstance(test, tree.ParenthesizedNode):
        test = test.inner
    if isinstance(test, tree.BinaryNode) and test.operator == "&&":
        yield from _conjuncts(test.left)
        yield from _conjuncts(test.right)
    else:
        yield test


def negation(operand: tree.ExpressionNode) -> tree.ExpressionNode:
    return tree.UnaryNode("!", _parenthesize_below(operand, _SIGN))


def conditional(
    test: tree.ExpressionNode, then: tree.ExpressionNode, otherwise: tree.ExpressionNode
) -> tree.ExpressionNode:
    """Build `test ? then : otherwise`; nested conditionals get parentheses."""
    return tree.ConditionalNode(*(_parenthesize_below(part, _OR) for part in (test, then, otherwise)))


def _boolean_conditional(
    test: tree.ExpressionNode, then: tree.ExpressionNode, otherwise: tree.ExpressionNode
) -> tree.ExpressionNode:
    """Build a conditional between bools from logical operators; the original engines do not support it directly."""
    return join_operands("||", [join_operands("&&", [test, then]), join_operands("&&", [negation(test), otherwise])])


def _negative(operand: tree.ExpressionNode) -> tree.ExpressionNode:
    has_sign = isinstance(operand, tree.UnaryNode) and operand.operator == "-"
    return tree.UnaryNode("-", _parenthesized(operand) if has_sign else _parenthesize_below(operand, _SIGN))


def _binary(operator: str, left: tree.ExpressionNode, right: tree.ExpressionNode) -> tree.ExpressionNode:
    level = _LEVELS[operator]
    first = level + 1 if level == _COMPARISON else level
    # Parentheses make the precedence of && over || explicit.
    sides = [_parenthesized(side) if level == _OR and _level(side) == _AND else side for side in (left, right)]
    return tree.BinaryNode(operator, _parenthesize_below(sides[0], first), _parenthesize_below(sides[1], level + 1))


def _parenthesize_below(expression: tree.ExpressionNode, level: int) -> tree.ExpressionNode:
    return expression if _level(expression) >= level else _parenthesized(expression)


def _parenthesized(expression: tree.ExpressionNode) -> tree.ExpressionNode:
    return tree.ParenthesizedNode(expression)


def _level(expression: tree.ExpressionNode) -> int:
    match expression:
        case tree.ConditionalNode():
            return _CHOICE
        case tree.BinaryNode(operator=operator):
            return _LEVELS[operator]
        case tree.UnaryNode():
            return _SIGN
        case _:
            return _ATOM


def _knows_enumeration(node: Expr) -> bool:
    """Whether an expression determines its enumeration without context."""
    return isinstance(node, OutputRef) or (isinstance(node, Variable) and node.kind != ScopeSymbolKind.CONSTANT)


def _has_typed_side(node: Expr) -> bool:
    """Whether one side of a conditional determines the enumeration."""
    match node:
        case Ternary(then=then, otherwise=otherwise):
            return _has_typed_side(then) or _has_typed_side(otherwise)
        case _:
            return _knows_enumeration(node)
