"""The portable subset of hand-written Python: statements that every language can express.

Assignments to variables and outputs, calls of outputs with arguments, `if`, and `return`. Expressions are those of
designs, so they have the meaning of docs/semantics.md.
"""

import ast
from collections.abc import Iterable, Sequence
from copy import deepcopy
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

from vicode.model.expressions import BOOL, Scope, ScopeSymbolKind, parse_expression
from vicode.model.python_parser import parse_module
from vicode.model.snippets import PythonSnippet

Role = Literal["action", "predicate"]
_MODULES = ("arithmetic", "math")
_TIMES = ("state_time", "component_time", "action_done", "conflict")
_OPERATORS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.FloorDiv: "//", ast.Mod: "%"}


@dataclass(frozen=True, slots=True, kw_only=True)
class PortableAssign:
    """Sets a variable or output, or with a dot a variable of a used component; `value` is an expression."""

    target: str
    value: str


@dataclass(frozen=True, slots=True, kw_only=True)
class PortableCall:
    """Calls an output with arguments."""

    call: str


@dataclass(frozen=True, slots=True, kw_only=True)
class PortableReturn:
    """Ends the code; `value` is "" in actions."""

    value: str


@dataclass(frozen=True, slots=True, kw_only=True)
class PortableIf:
    """Runs one of two lists of statements."""

    test: str
    then: "tuple[PortableStatement, ...]"
    otherwise: "tuple[PortableStatement, ...]"


PortableStatement = PortableAssign | PortableCall | PortableReturn | PortableIf


@dataclass(frozen=True, slots=True, kw_only=True)
class NotPortable:
    """The first statement outside the subset: its line, from 1, and why."""

    line: int
    reason: str


@lru_cache(maxsize=4096)
def parse_portable(text: str, role: Role, scope: Scope) -> tuple[PortableStatement, ...] | NotPortable:
    """Read hand-written Python as portable statements."""
    snippet = PythonSnippet.from_text(text, role)
    try:
        tree = parse_module(snippet.source)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return NotPortable(line=1, reason="it is not valid Python")
    function = tree.body[0]
    assert isinstance(function, ast.FunctionDef)
    try:
        return tuple(_Reader(role, scope).statements(function.body))
    except _NotPortableError as error:
        return NotPortable(line=max(1, error.node.lineno - 2), reason=error.reason)
    except RecursionError:
        return NotPortable(line=1, reason="it is nested too deeply")


def always_returns(statements: Sequence[PortableStatement]) -> bool:
    """Whether the end of the statements is not reached."""
    match statements[-1:]:
        case [PortableReturn()]:
            return True
        case [PortableIf(then=then, otherwise=otherwise)]:
            return always_returns(then) and always_returns(otherwise)
        case _:
            return False


class _NotPortableError(Exception):
    def __init__(self, node: ast.stmt, reason: str) -> None:
        self.node, self.reason = node, reason


@dataclass(frozen=True, slots=True)
class _Reader:
    role: Role
    scope: Scope

    def statements(self, body: Iterable[ast.stmt]) -> list[PortableStatement]:
        statements: list[PortableStatement] = []
        for node in body:
            is_string = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
            if not isinstance(node, ast.Pass) and not is_string:
                statements.append(self._statement(node))
        return statements

    def _statement(self, node: ast.stmt) -> PortableStatement:
        match node:
            case ast.Assign(targets=[target], value=value):
                return self._assign(node, target, value)
            case ast.AugAssign(target=target, op=op, value=value) if type(op) in _OPERATORS:
                joined = ast.BinOp(left=target, op=op, right=value)
                return self._assign(node, target, joined)
            case ast.Expr(value=ast.Call() as call):
                return PortableCall(call=self._expression(node, call, None))
            case ast.Return(value=None) if self.role == "action":
                return PortableReturn(value="")
            case ast.Return(value=ast.expr() as value) if self.role == "predicate":
                return PortableReturn(value=self._expression(node, value, BOOL))
            case ast.If(test=test, body=body, orelse=otherwise):
                return PortableIf(
                    test=self._expression(node, test, BOOL),
                    then=tuple(self.statements(body)),
                    otherwise=tuple(self.statements(otherwise)),
                )
            case _:
                raise _NotPortableError(node, f"'{_first_line(node)}' is outside the portable subset")

    def _assign(self, node: ast.stmt, target: ast.expr, value: ast.expr) -> PortableAssign:
        name = _design_text(_Converter(self.scope).visit(deepcopy(target))) if _is_member(target) else ""
        declaration = self.scope.find_assignable(name) if name else None
        if declaration is None:
            shown = ast.unparse(target)
            raise _NotPortableError(node, f"'{shown}' is no variable or output of the design")
        return PortableAssign(target=name, value=self._expression(node, value, self.scope.type_of(declaration)))

    def _expression(self, node: ast.stmt, syntax: ast.expr, expected: str | None) -> str:
        converter = _Converter(self.scope)
        # A copy: the statement is shown in messages.
        text = _design_text(converter.visit(deepcopy(syntax)))
        if converter.problem:
            raise _NotPortableError(node, converter.problem)
        parsed = parse_expression(text, self.scope, expected)
        if parsed.diagnostics:
            raise _NotPortableError(node, f"'{_first_line(node)}': {parsed.diagnostics[0].message}")
        return text


class _Converter(ast.NodeTransformer):
    """Replaces the Python names of values by those of expressions: `self.x` by `x`."""

    def __init__(self, scope: Scope) -> None:
        self.scope, self.problem = scope, ""

    def visit_Attribute(self, node: ast.Attribute) -> ast.expr:
        match node:
            case ast.Attribute(value=ast.Name(id="self"), attr=name):
                symbol = self.scope.symbols.get(name)
                is_own = symbol is not None and symbol.kind != ScopeSymbolKind.CONSTANT
                if not (is_own or name in self.scope.uses or name in _TIMES):
                    self.problem = self.problem or f"'self.{name}' is not declared in the design"
                return ast.Name(id=name, ctx=ast.Load())
            case ast.Attribute(value=ast.Attribute(value=ast.Name(id="self"), attr=alias), attr="is_done"):
                return ast.Call(func=ast.Name(id="done", ctx=ast.Load()), args=[ast.Name(id=alias)], keywords=[])
            case ast.Attribute(value=ast.Name(id=name)) if name in self.scope.enumerations:
                return node
            case _:
                self.generic_visit(node)
                return node

    def visit_Call(self, node: ast.Call) -> ast.expr:
        match node.func:
            case ast.Attribute(value=ast.Name(id=module), attr=name) if module in _MODULES:
                node.func = ast.Name(id=name, ctx=ast.Load())
            case ast.Name():
                pass
            case _:
                node.func = self.visit(node.func)
        node.args = [self.visit(argument) for argument in node.args]
        node.keywords = [self.visit(keyword) for keyword in node.keywords]
        return node

    def visit_Name(self, node: ast.Name) -> ast.expr:
        symbol = self.scope.symbols.get(node.id)
        if symbol is None or symbol.kind != ScopeSymbolKind.CONSTANT:
            self.problem = self.problem or f"'{node.id}' is not declared in the design"
        return node

    def visit_Compare(self, node: ast.Compare) -> ast.expr:
        self.generic_visit(node)
        same = {ast.Is: ast.Eq, ast.IsNot: ast.NotEq}
        node.ops = [same.get(type(operator), type(operator))() for operator in node.ops]
        return node


def _is_member(node: ast.expr) -> bool:
    match node:
        case ast.Attribute(value=ast.Name(id="self")):
            return True
        case ast.Attribute(value=ast.Attribute(value=ast.Name(id="self"))):
            return True
        case _:
            return False


def _design_text(node: ast.AST) -> str:
    return ast.unparse(ast.fix_missing_locations(node))


def _first_line(node: ast.stmt) -> str:
    return ast.unparse(node).partition("\n")[0]
