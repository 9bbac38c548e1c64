"""Reads C++ expressions back as expressions of the design."""

import ast
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from vicode.cpp_tokens import CppToken, number_value
from vicode.generators.cpp.symbols import CppSymbols
from vicode.model.design import Guard
from vicode.model.expressions import FLOAT, INT
from vicode.sync.interpret.cpp_expressions import CppNode, parse_expression, path_of
from vicode.sync.interpret.cpp_plain_forms import PlainForms
from vicode.sync.interpret.expression_merge import merge_expression

_OPERATORS: dict[str, Callable[[], ast.operator]] = {
    "+": ast.Add,
    "-": ast.Sub,
    "*": ast.Mult,
    "/": ast.Div,
    "%": ast.Mod,
    "divide": ast.Div,
    "xabsl_divide": ast.Div,
    "add": ast.Add,
    "subtract": ast.Sub,
    "multiply": ast.Mult,
    "floor_divide": ast.FloorDiv,
    "modulo": ast.Mod,
    "xabsl_remainder": ast.Mod,
}
_COMPARISONS: dict[str, Callable[[], ast.cmpop]] = {
    "==": ast.Eq,
    "!=": ast.NotEq,
    "<": ast.Lt,
    ">": ast.Gt,
    "<=": ast.LtE,
    ">=": ast.GtE,
}
_FUNCTIONS = {"to_int": "int", "fabs": "abs", "isnan": "is_nan"}
_OPENING = re.compile(r"(?:\A|\b(?:and|or) )\(")
_NANOSECONDS = "state_time_ns()"


class UnreadableError(Exception):
    """Code that the design cannot express; the message names it."""


@dataclass(frozen=True, slots=True)
class CppGuard:
    """A test that was read: the time, the rest as an expression of the design, and the function with code."""

    after: str = ""
    when: ast.expr | None = None
    code: str = ""


@dataclass(frozen=True, slots=True)
class CppExpressionReader:
    """Reads the expressions of one component.

    The result may be wrong: it is used only if the code generated from it is the code that was read.
    """

    symbols: CppSymbols
    time_unit: str

    def read_value(self, text: str, old: Sequence[CppToken] | CppNode, new: CppNode) -> str:
        """Return an expression as it was changed; keeps the rest of the text of the old one."""
        try:
            before = self.convert(old if isinstance(old, CppNode) else parse_expression(old))
        except (SyntaxError, UnreadableError):
            return self.text_of(new)
        return _merged(text, before, self.convert(new))

    def text_of(self, node: CppNode) -> str:
        """Return the text of an expression of the design."""
        return _text(self.convert(node))

    def read_guard(self, tokens: Sequence[CppToken]) -> CppGuard:
        """Split a test into the parts of a guard."""
        try:
            operands = _operands("&&", parse_expression(tokens))
        except SyntaxError:
            raise UnreadableError(_shown(tokens)) from None
        after, code = "", ""
        rest: list[CppNode] = []
        for operand in operands:
            time, path = self._read_timer(operand), path_of(operand)
            if time and not after:
                after = time
            elif path.startswith("when_") and not code:
                code = path.removesuffix("()")
            else:
                rest.append(operand)
        tests = [self.convert_test(each) for each in rest]
        when = None if not tests else tests[0] if len(tests) == 1 else ast.BoolOp(op=ast.And(), values=tests)
        return CppGuard(after, when, code)

    def _read_timer(self, node: CppNode) -> str:
        """Return the time of a test of the time in the state; empty for any other test."""
        unit = 1e6 if self.time_unit == "ms" else 1e9
        match node:
            case CppNode(kind="binary", text=">=", parts=(left, CppNode(kind="number", text=text))) if (
                path_of(left) == _NANOSECONDS
            ):
                value = number_value(text)
                return f"{value / unit:.12g}" if isinstance(value, int) else ""
            case CppNode(kind="binary", text=">=", parts=(left, CppNode(kind="call", parts=(callee, product)))) if (
                path_of(left) == _NANOSECONDS and path_of(callee) == "bica::nanoseconds" and product.text == "*"
            ):
                return self.text_of(product.parts[0])
            case _:
                return ""

    def convert_test(self, node: CppNode) -> ast.expr:
        """Return a condition of the design: numbers are compared with 0."""
        match node:
            case CppNode(kind="binary", text="&&" | "||" as operator):
                values = [self.convert_test(each) for each in _operands(operator, node)]
                return ast.BoolOp(op=ast.And() if operator == "&&" else ast.Or(), values=values)
            case CppNode(kind="unary", text="!", parts=(operand,)):
                return ast.UnaryOp(op=ast.Not(), operand=self.convert_test(operand))
            case _:
                converted = self.convert(node)
                if PlainForms(self.symbols).typed(node)[0] in (FLOAT, INT):
                    return ast.Compare(left=converted, ops=[ast.NotEq()], comparators=[ast.Constant(value=0)])
                return converted

    def convert(self, node: CppNode) -> ast.expr:
        """Return the syntax tree of an expression of the design.

        Raises:
            UnreadableError: The design has no such expression.
        """
        path = path_of(node)
        if text := self.symbols.texts.get(path):
            return ast.parse(text, mode="eval").body
        match node:
            case CppNode(kind="number" | "name", text=text) if (value := _constant(text)) is not None:
                return ast.Constant(value=value)
            case CppNode(kind="unary", text="-", parts=(operand,)):
                return ast.UnaryOp(op=ast.USub(), operand=self.convert(operand))
            case CppNode(kind="binary", text="&&" | "||") | CppNode(kind="unary", text="!"):
                return self.convert_test(node)
            case CppNode(kind="binary", text=operator, parts=(left, right)):
                return self._binary(operator, left, right)
            case CppNode(kind="choice", parts=(test, then, otherwise)):
                return ast.IfExp(test=self.convert_test(test), body=self.convert(then), orelse=self.convert(otherwise))
            case CppNode(kind="cast", text="float" | "int", parts=(operand,)):
                return self.convert(operand)
            case CppNode(kind="call", parts=(callee, *arguments)):
                return self._call(path_of(callee), arguments)
            case _:
                raise UnreadableError(path or node.text or node.kind)

    def _binary(self, operator: str, left: CppNode, right: CppNode) -> ast.expr:
        if operator in _COMPARISONS:
            return ast.Compare(
                left=self.convert(left), ops=[_COMPARISONS[operator]()], comparators=[self.convert(right)]
            )
        name = "state_time()_in_ms" if _is_nanoseconds(left, "state_time_ns()") else ""
        name = "component_time()_in_ms" if _is_nanoseconds(left, "component_time_ns()") else name
        if name in self.symbols.texts and operator == "/" and right.text == "1e6":
            return ast.Name(id=self.symbols.texts[name])
        return ast.BinOp(left=self.convert(left), op=_OPERATORS[operator](), right=self.convert(right))

    def _call(self, path: str, arguments: Sequence[CppNode]) -> ast.expr:
        declared = self.symbols.arguments.get(path)
        if declared is not None and path in self.symbols.texts and len(declared) == len(arguments):
            function = ast.parse(self.symbols.texts[path], mode="eval").body
            given = zip(declared, arguments, strict=True)
            keywords = [ast.keyword(arg=name, value=self.convert(value)) for (name, _type), value in given]
            return ast.Call(func=function, args=[], keywords=keywords)
        owner, _colons, name = path.rpartition("::")
        if owner not in ("bica", "std") or not arguments:
            raise UnreadableError(path or "a call")
        values = [self.convert(each) for each in arguments]
        if name in ("to_float", "limit") and len(values) == 1:
            return values[0]
        if name == "negate" and len(values) == 1:
            return ast.UnaryOp(op=ast.USub(), operand=values[0])
        if name in _OPERATORS and len(values) == 2:
            return ast.BinOp(left=values[0], op=_OPERATORS[name](), right=values[1])
        return ast.Call(func=ast.Name(id=_FUNCTIONS.get(name, name)), args=values, keywords=[])


def changed_guard(reader: CppExpressionReader, old: Guard, before: Sequence[CppToken], read: CppGuard) -> Guard:
    """Return a guard as it was changed; keeps what says the same."""
    try:
        was = reader.read_guard(before)
    except UnreadableError:
        was = CppGuard()
    if read.code and read.code != was.code:
        raise UnreadableError(read.code)
    if read.when is None:
        when = ""
    elif was.when is None:
        when = _text(read.when)
    else:
        when = _merged(old.when, was.when, read.when)
    after = old.after if read.after == was.after else read.after
    return Guard(when=when, after=after, code=old.code if read.code else None)


def new_guard(read: CppGuard) -> Guard:
    """Return the guard of a new decision."""
    if read.code:
        raise UnreadableError(read.code)
    when = _text(read.when) if read.when is not None else ""
    return Guard(when=when, after=read.after)


def _merged(text: str, old: ast.expr, new: ast.expr) -> str:
    """The text of the design with the difference of two trees; trees that say the same leave it."""
    if ast.dump(old) == ast.dump(new):
        return text
    merged = merge_expression(text, old, ast.fix_missing_locations(new))
    return _without_brackets(merged, text) if merged else _text(new)


def _text(node: ast.expr) -> str:
    return _without_brackets(ast.unparse(ast.fix_missing_locations(node)), "")


def _without_brackets(text: str, old: str) -> str:
    """Remove brackets around comparisons and negations joined by `and` or `or` that the old text does not have."""
    for found in reversed(list(_OPENING.finditer(text))):
        start = found.end()
        end = _closing(text, start)
        inner = text[start:end]
        if f"({inner})" in old or not re.match(r"\Z| and | or ", text[end + 1 :]):
            continue
        if isinstance(ast.parse(inner, mode="eval").body, ast.Compare | ast.UnaryOp):
            text = f"{text[: start - 1]}{inner}{text[end + 1 :]}"
    return text


def _closing(text: str, start: int) -> int:
    """The place of the bracket that closes the one before a place."""
    depth = 1
    for at in range(start, len(text)):
        depth += (text[at] == "(") - (text[at] == ")")
        if depth == 0:
            return at
    return len(text)


def _operands(operator: str, node: CppNode) -> list[CppNode]:
    if node.kind == "binary" and node.text == operator:
        return [each for part in node.parts for each in _operands(operator, part)]
    return [node]


def _constant(text: str) -> bool | int | float | None:
    return {"true": True, "false": False}.get(text, number_value(text))


def _is_nanoseconds(node: CppNode, name: str) -> bool:
    match node:
        case CppNode(kind="call", parts=(callee, argument)):
            return path_of(callee) == "bica::to_float" and path_of(argument) == name
        case _:
            return False


def _shown(tokens: Sequence[CppToken]) -> str:
    return " ".join(token.text for token in tokens)
