"""Reads generated Python back as expressions of the design."""

import ast
from dataclasses import dataclass, field

from vicode.model.design import Design, Guard
from vicode.model.expressions import BOOL, FLOAT, INT
from vicode.model.names import python_attribute_name
from vicode.model.project import WORLD, Project
from vicode.model.python_parser import parse_single_expression
from vicode.sync.interpret.equivalent_expressions import CONVERSIONS, compare_numbers, plain_comparison
from vicode.sync.interpret.expression_merge import merge_expression

_OPERATORS: dict[str, type[ast.operator]] = {
    "divide": ast.Div,
    "xabsl_divide": ast.Div,
    "floor_divide": ast.FloorDiv,
    "modulo": ast.Mod,
    "xabsl_remainder": ast.Mod,
}
_FUNCTIONS = {"to_int": "int", "round_half_even": "round"}


@dataclass(frozen=True, slots=True, kw_only=True)
class ExpressionReader:
    """Reads the Python expressions of one component.

    The result may be wrong: it is used only if the code generated from it is the code that was read.
    """

    design: Design
    project: Project
    inputs: dict[str, tuple[str, str]] = field(default_factory=dict)

    @classmethod
    def of(cls, project: Project, design: Design) -> "ExpressionReader":
        inputs = {}
        for use in design.uses:
            interface = project.interface(use.component)
            if interface is not None and interface.implementation == WORLD:
                for output in interface.outputs:
                    inputs[python_attribute_name(output.xabsl_name or output.name)] = (use.alias, output.name)
        return cls(design=design, project=project, inputs=inputs)

    def read(self, node: ast.expr) -> str:
        """Return the expression of the design."""
        return ast.unparse(self.convert(node))

    def convert(self, node: ast.expr) -> ast.expr:
        """Return the syntax tree of the expression of the design, independent of the given one."""
        converted: ast.expr = _Conversion(self).visit(parse_single_expression(ast.unparse(node)))
        return converted

    def read_change(self, text: str, old: ast.expr | None, new: ast.expr) -> list[str]:
        """Return possible texts for a changed expression, the one that keeps most of the old text first."""
        converted = self.convert(new)
        merged = merge_expression(text, self.convert(old), converted) if old is not None else ""
        compared = (ast.unparse(each) for each in compare_numbers(converted))
        return list(dict.fromkeys(each for each in (merged, ast.unparse(converted), *compared) if each))

    def read_guard(self, test: ast.expr) -> "PythonGuard":
        """Split a test into the parts of a guard."""
        values = test.values if isinstance(test, ast.BoolOp) and isinstance(test.op, ast.And) else [test]
        rest: list[ast.expr] = []
        after, has_code = "", False
        for value in values:
            time = self._read_timer(value)
            if time and not after and not rest:
                after = time
            elif _is_predicate_call(value):
                has_code = True
            else:
                rest.append(value)
        when = None if not rest else rest[0] if len(rest) == 1 else ast.BoolOp(op=ast.And(), values=rest)
        return PythonGuard(after=after, when=when, has_code=has_code)

    def _read_timer(self, node: ast.expr) -> str:
        """Return the time of a test of the time in the state; empty for any other test."""
        match node:
            case ast.Compare(left=left, ops=[ast.GtE()], comparators=[limit]) if (
                ast.unparse(left) == "self.root.now_ns - self._entered_ns"
            ):
                pass
            case _:
                return ""
        match limit:
            case ast.Constant(value=int() | float() as ns):
                return f"{ns / (1e6 if self.design.time_unit == 'ms' else 1e9):.12g}"
            case ast.Call(func=ast.Name(id="round"), args=[ast.BinOp(left=time, op=ast.Mult(), right=ast.Constant())]):
                return self.read(time)
            case _:
                return ""


@dataclass(frozen=True, slots=True, kw_only=True)
class PythonGuard:
    """A test that was read: the expression is still Python."""

    after: str
    when: ast.expr | None
    has_code: bool

    def as_guard(self, old: Guard, when: str) -> Guard:
        """Return a guard with the code of another one if this test calls it."""
        return Guard(when=when, after=self.after, code=old.code if self.has_code else None)


def _is_predicate_call(node: ast.expr) -> bool:
    match node:
        case ast.Call(func=ast.Attribute(value=ast.Name(id="self"), attr=name), args=[], keywords=[]):
            return name.startswith("_when_")
        case _:
            return False


class _Conversion(ast.NodeTransformer):
    """Converts a Python expression in place."""

    def __init__(self, reader: ExpressionReader) -> None:
        project = reader.project
        self._inputs, self._aliases = reader.inputs, {use.alias for use in reader.design.uses}
        enumerations = {item.name for item in project.enumerations}
        self._declared = {item.name for item in project.constants} | enumerations
        self._types = {BOOL, INT, FLOAT} | enumerations
        self._is_ms = reader.design.time_unit == "ms"

    def visit_Name(self, node: ast.Name) -> ast.AST:
        name = node.id
        # A name that collides in the module has underscores at its end.
        while name.endswith("_") and name not in self._declared:
            name = name[:-1]
        return ast.Name(id=name if name in self._declared else node.id)

    def visit_Attribute(self, node: ast.Attribute) -> ast.AST:
        match node:
            case ast.Attribute(value=ast.Attribute(value=ast.Name(id="self"), attr=alias), attr="is_done") if (
                alias in self._aliases
            ):
                return ast.Call(func=ast.Name(id="done"), args=[ast.Name(id=alias)], keywords=[])
            case ast.Attribute(value=ast.Attribute(value=ast.Name(id="self"), attr="world"), attr=name) if (
                name in self._inputs
            ):
                alias, output = self._inputs[name]
                return ast.Attribute(value=ast.Name(id=alias), attr=output)
            case ast.Attribute(attr="size") if ast.unparse(node) == "self.root.team.size":
                return ast.Name(id="team_size")
            case ast.Attribute(value=ast.Name(id="self"), attr=name):
                return ast.Name(id=name)
        return self.generic_visit(node)

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        if self._is_ms and ast.unparse(node.right) == "1000000.0":
            match ast.unparse(node.left):
                case "self.root.now_ns - self._entered_ns":
                    return ast.Name(id="state_time")
                case "self.root.now_ns - self._started_ns":
                    return ast.Name(id="component_time")
        return self.generic_visit(node)

    def visit_Compare(self, node: ast.Compare) -> ast.AST:
        self.generic_visit(node)
        return plain_comparison(node)

    def visit_Call(self, node: ast.Call) -> ast.AST:
        is_input = len(node.args) == 1 and ast.unparse(node.args[0]).startswith("self.world.")
        self.generic_visit(node)
        match node:
            case ast.Call(func=ast.Name(id=name), args=[only], keywords=[]) if is_input and name in self._types:
                return only
            case ast.Call(func=function, args=[only], keywords=[]) if ast.unparse(function) in CONVERSIONS:
                return only
            case ast.Call(func=ast.Attribute(value=ast.Name(id="arithmetic"), attr=name), args=[left, right]) if (
                name in _OPERATORS
            ):
                return ast.BinOp(left=left, op=_OPERATORS[name](), right=right)
            case ast.Call(func=ast.Attribute(value=ast.Name(id="arithmetic"), attr=name)):
                return ast.Call(func=ast.Name(id=_FUNCTIONS.get(name, name)), args=node.args, keywords=[])
            case ast.Call(func=ast.Name(id="_ask"), args=[function]):
                keywords = [ast.keyword(arg=each.arg, value=_lambda_body(each.value)) for each in node.keywords]
                return ast.Call(func=function, args=[], keywords=keywords)
        return node


def _lambda_body(node: ast.expr) -> ast.expr:
    return node.body if isinstance(node, ast.Lambda) else node
