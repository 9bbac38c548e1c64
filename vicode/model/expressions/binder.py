"""Gives every node of a parsed expression its meaning and its type."""

import ast
import math
from collections.abc import Callable
from dataclasses import dataclass, field

from vicode.findings import Span, did_you_mean
from vicode.model.expressions.calls import CallBinder
from vicode.model.expressions.scope import Scope
from vicode.model.expressions.tree import (
    BOOL,
    FLOAT,
    INT,
    UNKNOWN,
    Binary,
    Boolean,
    Comparison,
    ElapsedTime,
    EnumElement,
    Expr,
    Logic,
    Minus,
    Not,
    Number,
    OutputRef,
    StatusFlag,
    Ternary,
    Variable,
)

_BINARY_OPERATORS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.FloorDiv: "//", ast.Mod: "%"}
_COMPARISON_OPERATORS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!="}
_BOOLEANS = {"True": True, "true": True, "False": False, "false": False}
_TIMES = {"state_time": "state", "component_time": "component"}
_STATUSES = frozenset({"action_done", "conflict"})
_EXACT_INT = 2**53


@dataclass
class ExpressionBinder:
    """Binds one expression to a scope, collecting mistakes as (code, message, mend, span)."""

    scope: Scope
    text: str
    diagnostics: list[tuple[str, str, str, Span]] = field(default_factory=list)

    def bind_expected(self, syntax: ast.expr, expected: str | None) -> Expr | None:
        """Bind, and ask for a type where the place has one."""
        node = self.bind(syntax)
        if node is not None and expected is not None:
            self.require_type(node, expected)
        return node

    def bind(self, syntax: ast.expr) -> Expr | None:
        """The typed node of a piece of syntax, None after a mistake that leaves nothing to go on with."""
        bind = _BINDERS.get(type(syntax))
        if bind is None:
            self.report("E302", "this is Python, but not part of expressions", "use a 'code' predicate for it", syntax)
            return None
        return bind(self, syntax)

    def require_type(self, node: Expr, expected: str) -> None:
        """Report a node whose type does not serve as `expected`."""
        if is_assignable(node.type, expected):
            return
        mend = ""
        if expected == BOOL and node.type in (INT, FLOAT):
            mend = "compare it, for example != 0"
        elif expected == INT and node.type == FLOAT:
            mend = "write int(…), floor(…) or round(…)"
        self.report_span("E304", f"expected {expected}, but this is {node.type}", mend, node.span)

    def require_number(self, node: Expr) -> None:
        """Report a node that is no number."""
        if node.type not in (INT, FLOAT, UNKNOWN):
            self.report_span("E304", f"expected a number, but this is {node.type}", "", node.span)

    def get_span(self, syntax: ast.expr | ast.keyword) -> Span:
        """Characters of the text that a piece of syntax covers."""
        lead = len(self.text) - len(self.text.lstrip())
        first, last = syntax.col_offset, syntax.end_col_offset or syntax.col_offset + 1
        if self.text.isascii():
            return (lead + first, lead + last)
        # Python counts bytes of UTF-8; blanks were made one byte each when the text was copied.
        data = "".join(" " if char.isspace() else char for char in self.text).strip().encode()
        return (lead + len(data[:first].decode(errors="ignore")), lead + len(data[:last].decode(errors="ignore")))

    def report(self, code: str, message: str, fix: str, syntax: ast.expr | ast.keyword) -> None:
        """Note a mistake at a piece of syntax."""
        self.report_span(code, message, fix, self.get_span(syntax))

    def report_span(self, code: str, message: str, fix: str, span: Span) -> None:
        """Note a mistake at characters of the text."""
        self.diagnostics.append((code, message, fix, span))

    def _bind_constant(self, syntax: ast.Constant) -> Expr | None:
        value, span = syntax.value, self.get_span(syntax)
        if isinstance(value, bool):
            return Boolean(value=value, span=span)
        if isinstance(value, int) and value <= _EXACT_INT:
            return Number(value=value, type=INT, span=span)
        if isinstance(value, float) and math.isfinite(value):
            return Number(value=value, type=FLOAT, span=span)
        if isinstance(value, int | float) and not isinstance(value, bool):
            self.report("E302", "the number is larger than any that all languages hold", "write a smaller one", syntax)
            return None
        mend = "use an enumeration" if isinstance(value, str) else "write a number"
        self.report("E302", "only numbers, True, False and enumeration elements can be written", mend, syntax)
        return None

    def _bind_name(self, syntax: ast.Name) -> Expr | None:
        name, span = syntax.id, self.get_span(syntax)
        symbol = self.scope.symbols.get(name)
        if symbol is not None:
            return Variable(name=name, kind=symbol.kind, type=symbol.type, span=span)
        if name in _BOOLEANS:
            return Boolean(value=_BOOLEANS[name], span=span)
        if name in _TIMES:
            return ElapsedTime(kind=_TIMES[name], span=span)
        if name in _STATUSES:
            return StatusFlag(name=name, span=span)
        if name in self.scope.uses:
            self.report("E303", f"'{name}' is a component", f"read one of its outputs: {name}.…", syntax)
            return None
        if name in self.scope.enumerations:
            self.report("E303", f"'{name}' is an enumeration", f"write one of its elements: {name}.…", syntax)
            return None
        known = {*self.scope.symbols, *_TIMES, *_STATUSES, *self.scope.uses}
        self.report(
            "E303", f"'{name}' is not declared", did_you_mean(name, known, "declare it, or correct the name"), syntax
        )
        return None

    def _bind_attribute(self, syntax: ast.Attribute) -> Expr | None:
        if not isinstance(syntax.value, ast.Name):
            self.report("E302", "only component.output and Enumeration.element have a dot", "", syntax)
            return None
        owner, name = syntax.value.id, syntax.attr
        if owner in self.scope.uses:
            return self.bind_output(owner, name, syntax)
        if owner in self.scope.enumerations:
            return self._bind_element(owner, name, syntax)
        known = {*self.scope.uses, *self.scope.enumerations}
        mend = did_you_mean(owner, known, f"add it to 'uses', as {owner}: ComponentName")
        self.report("E303", f"'{owner}' is neither a used component nor an enumeration", mend, syntax.value)
        return None

    def _bind_element(self, enumeration: str, name: str, syntax: ast.Attribute) -> Expr | None:
        elements = self.scope.enumerations[enumeration]
        if name in elements:
            return EnumElement(element=name, type=enumeration, span=self.get_span(syntax))
        mend = did_you_mean(name, elements, f"it has {', '.join(elements) or 'none'}")
        self.report("E306", f"'{enumeration}' has no element '{name}'", mend, syntax)
        return None

    def bind_output(self, alias: str, name: str, syntax: ast.Attribute) -> Expr | None:
        """An output read without arguments."""
        interface = self.scope.uses[alias]
        if interface is None:
            return OutputRef(alias=alias, output=name, type=UNKNOWN, span=self.get_span(syntax))
        output = interface.output(name)
        if output is None:
            mend = did_you_mean(
                name, (each.name for each in interface.readable), f"declare it in {interface.component}"
            )
            self.report("E303", f"'{interface.component}' has no output '{name}'", mend, syntax)
            return None
        if output.arguments is not None:
            self.report("E305", f"'{alias}.{name}' is a function", f"call it: {alias}.{name}(…)", syntax)
            return None
        return OutputRef(alias=alias, output=name, type=self.scope.type_of(output), span=self.get_span(syntax))

    def _bind_unary(self, syntax: ast.UnaryOp) -> Expr | None:
        operand = self.bind(syntax.operand)
        if operand is None:
            return None
        if isinstance(syntax.op, ast.Not):
            self.require_type(operand, BOOL)
            return Not(operand=operand, span=self.get_span(syntax))
        if isinstance(syntax.op, ast.USub):
            self.require_number(operand)
            return Minus(operand=operand, type=operand.type, span=self.get_span(syntax))
        self.report("E302", "only 'not' and '-' stand before a value", "leave it out", syntax)
        return operand

    def _bind_binary(self, syntax: ast.BinOp) -> Expr | None:
        operator = _BINARY_OPERATORS.get(type(syntax.op))
        left, right = self.bind(syntax.left), self.bind(syntax.right)
        if operator is None:
            self.report(
                "E302", "only + - * / // % calculate here", "use a listed function or a 'code' predicate", syntax
            )
            return None
        if left is None or right is None:
            return None
        self.require_number(left)
        self.require_number(right)
        ints = left.type == INT and right.type == INT and operator in "+-*"
        return Binary(
            operator=operator, left=left, right=right, type=INT if ints else FLOAT, span=self.get_span(syntax)
        )

    def _bind_logic(self, syntax: ast.BoolOp) -> Expr | None:
        operands = [self.bind_expected(value, BOOL) for value in syntax.values]
        bound = tuple(operand for operand in operands if operand is not None)
        if len(bound) < len(operands):
            return None
        operator = "and" if isinstance(syntax.op, ast.And) else "or"
        return Logic(operator=operator, operands=bound, span=self.get_span(syntax))

    def _bind_comparison(self, syntax: ast.Compare) -> Expr | None:
        values = [self.bind(value) for value in (syntax.left, *syntax.comparators)]
        operators = [_COMPARISON_OPERATORS.get(type(operator)) for operator in syntax.ops]
        if None in operators:
            self.report("E302", "only < <= > >= == != compare here", "", syntax)
            return None
        bound = tuple(value for value in values if value is not None)
        if len(bound) < len(values):
            return None
        names = tuple(operator for operator in operators if operator)
        for operator, left, right in zip(names, bound, bound[1:], strict=False):
            self._require_comparable(operator, left, right)
        return Comparison(operators=names, operands=bound, span=self.get_span(syntax))

    def _require_comparable(self, operator: str, left: Expr, right: Expr) -> None:
        if common_type(left.type, right.type) is None:
            message = f"{left.type} cannot be compared with {right.type}"
            self.report_span("E304", message, "", (left.span[0], right.span[1]))
        elif operator not in ("==", "!=") and left.type not in (INT, FLOAT, UNKNOWN):
            span = (left.span[0], right.span[1])
            self.report_span("E304", f"{left.type} has no order", "compare with == or !=", span)

    def _bind_ternary(self, syntax: ast.IfExp) -> Expr | None:
        test = self.bind_expected(syntax.test, BOOL)
        then, otherwise = self.bind(syntax.body), self.bind(syntax.orelse)
        if test is None or then is None or otherwise is None:
            return None
        type_ = common_type(then.type, otherwise.type)
        if type_ is None:
            self.report("E304", f"one side is {then.type}, the other {otherwise.type}", "give both one type", syntax)
        return Ternary(test=test, then=then, otherwise=otherwise, type=type_ or UNKNOWN, span=self.get_span(syntax))


_BINDERS: dict[type[ast.expr], Callable[..., Expr | None]] = {
    ast.Constant: ExpressionBinder._bind_constant,
    ast.Name: ExpressionBinder._bind_name,
    ast.Attribute: ExpressionBinder._bind_attribute,
    ast.Call: lambda binder, syntax: CallBinder(binder).bind(syntax),
    ast.UnaryOp: ExpressionBinder._bind_unary,
    ast.BinOp: ExpressionBinder._bind_binary,
    ast.BoolOp: ExpressionBinder._bind_logic,
    ast.Compare: ExpressionBinder._bind_comparison,
    ast.IfExp: ExpressionBinder._bind_ternary,
}


def is_assignable(type_: str, expected: str) -> bool:
    """Whether a value of a type may stand where another is expected: an int serves as float."""
    return type_ == expected or UNKNOWN in (type_, expected) or (type_ == INT and expected == FLOAT)


def common_type(left: str, right: str) -> str | None:
    """The type that holds both, None when there is none."""
    if right in (left, UNKNOWN):
        return left
    if left == UNKNOWN:
        return right
    return FLOAT if {left, right} == {INT, FLOAT} else None
