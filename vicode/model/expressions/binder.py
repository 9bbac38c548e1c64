"""Name resolution and type checking of expressions."""

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
    TEAM_SIZE,
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
_STATUSES = {"action_done": BOOL, "conflict": BOOL, TEAM_SIZE: INT}
_EXACT_INT = 2**53


@dataclass
class ExpressionBinder:
    """Binds an expression to a scope. Collects diagnostics as (code, message, fix, span)."""

    scope: Scope
    text: str
    diagnostics: list[tuple[str, str, str, Span]] = field(default_factory=list)

    def bind_expected(self, syntax: ast.expr, expected: str | None) -> Expr | None:
        node = self.bind(syntax)
        if node is not None and expected is not None:
            self.require_type(node, expected)
        return node

    def bind(self, syntax: ast.expr) -> Expr | None:
        """Return the typed node for syntax, None after an error."""
        bind = _BINDERS.get(type(syntax))
        if bind is None:
            self.report(
                "E302", "this Python syntax is not supported in expressions", "use a 'code' predicate instead", syntax
            )
            return None
        return bind(self, syntax)

    def require_type(self, node: Expr, expected: str) -> None:
        """Report a node whose type is not assignable to `expected`."""
        if is_assignable(node.type, expected):
            return
        fix = ""
        if expected == BOOL and node.type in (INT, FLOAT):
            fix = "add a comparison, such as != 0"
        elif expected == INT and node.type == FLOAT:
            fix = "convert it with int(…), floor(…) or round(…)"
        self.report_span("E304", f"expected {expected}, found {node.type}", fix, node.span)

    def require_number(self, node: Expr) -> None:
        if node.type not in (INT, FLOAT, UNKNOWN):
            self.report_span("E304", f"expected a number, found {node.type}", "", node.span)

    def get_span(self, syntax: ast.expr | ast.keyword) -> Span:
        lead = len(self.text) - len(self.text.lstrip())
        first, last = syntax.col_offset, syntax.end_col_offset or syntax.col_offset + 1
        if self.text.isascii():
            return (lead + first, lead + last)
        # Python counts UTF-8 bytes; the parser replaced whitespace by spaces of one byte.
        data = "".join(" " if char.isspace() else char for char in self.text).strip().encode()
        return (lead + len(data[:first].decode(errors="ignore")), lead + len(data[:last].decode(errors="ignore")))

    def report(self, code: str, message: str, fix: str, syntax: ast.expr | ast.keyword) -> None:
        self.report_span(code, message, fix, self.get_span(syntax))

    def report_span(self, code: str, message: str, fix: str, span: Span) -> None:
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
            self.report("E302", "this number is too large for some target languages", "use a smaller number", syntax)
            return None
        fix = "use an enumeration" if isinstance(value, str) else "use a number"
        self.report(
            "E302", "unsupported literal: only numbers, True, False and enumeration elements are allowed", fix, syntax
        )
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
            return StatusFlag(name=name, type=_STATUSES[name], span=span)
        if name in self.scope.uses:
            self.report("E303", f"'{name}' is a component", f"use one of its outputs: {name}.…", syntax)
            return None
        if name in self.scope.enumerations:
            self.report("E303", f"'{name}' is an enumeration", f"use one of its elements: {name}.…", syntax)
            return None
        known = {*self.scope.symbols, *_TIMES, *_STATUSES, *self.scope.uses}
        self.report(
            "E303", f"'{name}' is not declared", did_you_mean(name, known, "declare it or correct the name"), syntax
        )
        return None

    def _bind_attribute(self, syntax: ast.Attribute) -> Expr | None:
        if not isinstance(syntax.value, ast.Name):
            self.report("E302", "'.' is allowed only in component.output and Enumeration.element", "", syntax)
            return None
        owner, name = syntax.value.id, syntax.attr
        if owner in self.scope.uses:
            return self.bind_output(owner, name, syntax)
        if owner in self.scope.enumerations:
            return self._bind_element(owner, name, syntax)
        known = {*self.scope.uses, *self.scope.enumerations}
        fix = did_you_mean(owner, known, f"add {owner}: ComponentName to 'uses'")
        self.report("E303", f"'{owner}' is neither a used component nor an enumeration", fix, syntax.value)
        return None

    def _bind_element(self, enumeration: str, name: str, syntax: ast.Attribute) -> Expr | None:
        elements = self.scope.enumerations[enumeration]
        if name in elements:
            return EnumElement(element=name, type=enumeration, span=self.get_span(syntax))
        fix = did_you_mean(
            name, elements, f"use one of {', '.join(elements)}" if elements else "add elements to the enumeration"
        )
        self.report("E306", f"'{enumeration}' has no element '{name}'", fix, syntax)
        return None

    def bind_output(self, alias: str, name: str, syntax: ast.Attribute) -> Expr | None:
        interface = self.scope.uses[alias]
        if interface is None:
            return OutputRef(alias=alias, output=name, type=UNKNOWN, span=self.get_span(syntax))
        output = interface.output(name)
        if output is None:
            fix = did_you_mean(
                name, (output.name for output in interface.readable), f"declare it in {interface.component}"
            )
            self.report("E303", f"'{interface.component}' has no output '{name}'", fix, syntax)
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
        self.report("E302", "unsupported unary operator: only 'not' and '-' are allowed", "remove the operator", syntax)
        return operand

    def _bind_binary(self, syntax: ast.BinOp) -> Expr | None:
        operator = _BINARY_OPERATORS.get(type(syntax.op))
        left, right = self.bind(syntax.left), self.bind(syntax.right)
        if operator is None:
            self.report(
                "E302",
                "unsupported operator: only + - * / // % are allowed",
                "use a built-in function or a 'code' predicate",
                syntax,
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
            self.report("E302", "unsupported comparison: only < <= > >= == != are allowed", "", syntax)
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
            self.report_span("E304", f"{left.type} values are not ordered", "compare with == or !=", span)

    def _bind_ternary(self, syntax: ast.IfExp) -> Expr | None:
        test = self.bind_expected(syntax.test, BOOL)
        then, otherwise = self.bind(syntax.body), self.bind(syntax.orelse)
        if test is None or then is None or otherwise is None:
            return None
        type_ = common_type(then.type, otherwise.type)
        if type_ is None:
            self.report(
                "E304",
                f"the branches have different types: {then.type} and {otherwise.type}",
                "use the same type",
                syntax,
            )
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
    """Return whether a value can be used where `expected` is required. An int is assignable to float."""
    return type_ == expected or UNKNOWN in (type_, expected) or (type_ == INT and expected == FLOAT)


def common_type(left: str, right: str) -> str | None:
    if right in (left, UNKNOWN):
        return left
    if left == UNKNOWN:
        return right
    return FLOAT if {left, right} == {INT, FLOAT} else None
