"""Expressions that a person may write in place of generated ones, as the one form that is compared.

Each rule keeps the value for the types that designs have: numbers are finite or nan, and tests are of type bool.
"""

import ast
from collections.abc import Collection, Iterator, Sequence

_CALLS = {"round": "round_half_even", "int": "to_int"}
"""Functions of Python, and those of the runtime that generated code calls."""

CONVERSIONS = frozenset({"float", "arithmetic.limit", "arithmetic.saturate"})
"""Functions that a design does not name: the type of the value and the place where it is used imply them."""


def plain_code(node: ast.AST) -> str:
    """Return the text of a syntax tree in the compared form; the tree is changed."""
    return ast.unparse(ast.fix_missing_locations(_PlainForm().visit(node)))


def plain_comparison(node: ast.Compare) -> ast.expr:
    """Return a comparison without `is` and `in`, which expressions of a design do not have."""
    match node:
        case ast.Compare(left=left, ops=[ast.Is()], comparators=[ast.Constant(value=bool(value))]):
            return left if value else ast.UnaryOp(op=ast.Not(), operand=left)
        case ast.Compare(left=left, ops=[ast.IsNot()], comparators=[ast.Constant(value=bool(value))]):
            return ast.UnaryOp(op=ast.Not(), operand=left) if value else left
        case ast.Compare(
            left=left,
            ops=[ast.In() | ast.NotIn() as operator],
            comparators=[ast.Tuple(elts=values) | ast.List(elts=values) | ast.Set(elts=values)],
        ) if values and all(map(_is_plain, (left, *values))):
            return _either(left, values, is_in=isinstance(operator, ast.In))
        case _:
            return node


def compare_numbers(test: ast.expr) -> Iterator[ast.expr]:
    """Yield forms of a test in which operands are compared with 0: all of them, and each one."""
    operands = [ast.unparse(each) for each in _operands(test)]
    for compared in dict.fromkeys((tuple(operands), *((operand,) for operand in operands))):
        if compared:
            yield _with_comparisons(test, compared)


def _operands(test: ast.expr) -> Iterator[ast.expr]:
    """Yield the parts of a test that are no comparisons."""
    match test:
        case ast.BoolOp(values=values):
            for value in values:
                yield from _operands(value)
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            yield from _operands(operand)
        case ast.Name() | ast.Attribute() | ast.BinOp() | ast.Call():
            yield test


def _with_comparisons(test: ast.expr, compared: Collection[str]) -> ast.expr:
    match test:
        case ast.BoolOp(op=operator, values=values):
            return ast.BoolOp(op=operator, values=[_with_comparisons(value, compared) for value in values])
        case ast.UnaryOp(op=ast.Not(), operand=operand) if ast.unparse(operand) in compared:
            return ast.Compare(left=operand, ops=[ast.Eq()], comparators=[ast.Constant(value=0)])
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return ast.UnaryOp(op=ast.Not(), operand=_with_comparisons(operand, compared))
        case _ if ast.unparse(test) in compared:
            return ast.Compare(left=test, ops=[ast.NotEq()], comparators=[ast.Constant(value=0)])
        case _:
            return test


class _PlainForm(ast.NodeTransformer):
    """Numbers by value, without conversions that change no value; tests without comparisons with True, False and 0."""

    def visit_Constant(self, node: ast.Constant) -> ast.Constant:
        is_whole = isinstance(node.value, float) and node.value.is_integer()
        return ast.Constant(value=int(node.value)) if is_whole and isinstance(node.value, float) else node

    def visit_Call(self, node: ast.Call) -> ast.AST:
        self.generic_visit(node)
        match node:
            case ast.Call(func=function, args=[only], keywords=[]) if ast.unparse(
                function
            ) in CONVERSIONS and not isinstance(only, ast.Constant):
                return only
            case ast.Call(func=ast.Name(id="float"), args=[ast.Constant(value=int()) as only], keywords=[]):
                return only
            case ast.Call(func=ast.Name(id="round" | "int" as name), args=[_only], keywords=[]):
                node.func = ast.Attribute(value=ast.Name(id="arithmetic"), attr=_CALLS[name])
        return node

    def visit_Assign(self, node: ast.Assign) -> ast.AST:
        self.generic_visit(node)
        match node:
            case ast.Assign(targets=[target], value=ast.BinOp(left=left, op=operator, right=right)) if (
                isinstance(target, ast.Attribute) and _is_plain(target) and ast.unparse(target) == ast.unparse(left)
            ):
                return ast.AugAssign(target=target, op=operator, value=right)
        return node

    def visit_Compare(self, node: ast.Compare) -> ast.AST:
        self.generic_visit(node)
        return plain_comparison(node)

    def visit_If(self, node: ast.If) -> ast.AST:
        self.generic_visit(node)
        node.test = _as_test(node.test)
        return node

    def visit_IfExp(self, node: ast.IfExp) -> ast.AST:
        self.generic_visit(node)
        node.test = _as_test(node.test)
        return node

    def visit_BoolOp(self, node: ast.BoolOp) -> ast.AST:
        self.generic_visit(node)
        values: list[ast.expr] = []
        for value in node.values:
            is_same = isinstance(value, ast.BoolOp) and type(value.op) is type(node.op)
            values += value.values if is_same and isinstance(value, ast.BoolOp) else [value]
        return ast.BoolOp(op=node.op, values=values)


def _as_test(node: ast.expr) -> ast.expr:
    """Return a test of which only the truth counts: a number is true if it is not 0."""
    match node:
        case ast.Compare(left=left, ops=[ast.NotEq()], comparators=[ast.Constant(value=int(value))]) if (
            value == 0 and value is not False
        ):
            return left
        case ast.Compare(left=left, ops=[ast.Eq()], comparators=[ast.Constant(value=int(value))]) if (
            value == 0 and value is not False
        ):
            return ast.UnaryOp(op=ast.Not(), operand=left)
        case ast.BoolOp(op=operator, values=values):
            return ast.BoolOp(op=operator, values=[_as_test(value) for value in values])
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return ast.UnaryOp(op=ast.Not(), operand=_as_test(operand))
        case _:
            return node


def _is_plain(node: ast.expr) -> bool:
    """Whether an expression has no effect and can be evaluated twice."""
    return isinstance(node, ast.Name | ast.Constant) or (isinstance(node, ast.Attribute) and _is_plain(node.value))


def _either(left: ast.expr, values: Sequence[ast.expr], *, is_in: bool) -> ast.expr:
    operator: ast.cmpop = ast.Eq() if is_in else ast.NotEq()
    tests: list[ast.expr] = [ast.Compare(left=left, ops=[operator], comparators=[value]) for value in values]
    return tests[0] if len(tests) == 1 else ast.BoolOp(op=ast.Or() if is_in else ast.And(), values=tests)
