"""The form in which C++ is compared: what a compiler makes of it, without the choices of the person who wrote it.

Each operation names the type that it is calculated in, as the language prescribes it: `x / 2` and `x / 2.0` are equal
if `x` is a double, and differ if it is a whole number. Whatever is not understood is compared token by token.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from vicode.cpp_tokens import COMMENT, CppToken, iter_tokens, number_value
from vicode.generators.cpp.symbols import CppSymbols
from vicode.model.expressions import BOOL, FLOAT, INT
from vicode.sync.interpret.cpp_expressions import CppNode, parse_expression, parse_statement, path_of
from vicode.sync.interpret.cpp_source import (
    CppComment,
    CppIf,
    CppSimple,
    CppStatement,
    always_ends,
    split_statements,
)

PlainForm = tuple[object, ...]
_Typed = tuple[str, object]

_LITERAL, _UNKNOWN = "literal", "?"
"""The type of whole numbers as they are written, which is `int`, and of what is not understood."""
_NUMBERS = frozenset({FLOAT, INT, _LITERAL})
_MOST_INT, _MOST_EXACT = 2**31 - 1, 2**53
_MARK = re.compile(r"// </?vicode\b.*")
_COMMENT_SIGNS = re.compile(r"\A/\*+|\*+/\Z|^\s*\*+|^//[/!]?", re.MULTILINE)
_TIMER = ("name", "state_time_ns()")
# Functions of the runtime that give the same as those of the standard library, for the same types.
_SAME = frozenset({"sqrt", "exp", "log", "sin", "cos", "tan", "asin", "acos", "atan", "atan2"})
_RESULTS = {
    **dict.fromkeys((*_SAME, "hypot", "degrees", "radians", "modulo", "floor_divide"), FLOAT),
    **dict.fromkeys(("xabsl_divide", "xabsl_remainder"), FLOAT),
    **dict.fromkeys(("floor", "ceil", "round", "to_int", "nanoseconds"), INT),
    "is_nan": BOOL,
}
# Functions that a design does not name: they are operators whose results are limited.
_OPERATORS = {"add": "+", "subtract": "-", "multiply": "*"}
_OF_ANY_TYPE = frozenset({"abs", "min", "max", "clamp"})


@dataclass(frozen=True, slots=True)
class PlainForms:
    """Brings statements and expressions of one component into the compared form."""

    symbols: CppSymbols

    def block(self, tokens: Sequence[CppToken]) -> tuple[PlainForm, ...]:
        """Return the form of the statements of a block; marks of regions do not count.

        Raises:
            SyntaxError: They are no statements.
        """
        return self.statements(split_statements([token for token in tokens if not is_mark(token)]))

    def statements(self, statements: Sequence[CppStatement]) -> tuple[PlainForm, ...]:
        """Return the form of statements: what is tested after a branch that always ends stands behind it."""
        return tuple(form for each in statements for form in self._statement(each))

    def _statement(self, statement: CppStatement) -> Iterator[PlainForm]:
        match statement:
            case CppComment(tokens=tokens):
                yield ("comment", *comment_words(tokens))
            case CppSimple(tokens=tokens):
                yield self._simple(tokens)
            case CppIf(then=then, otherwise=otherwise, comments=comments):
                notes = comment_words(comments)
                is_last = always_ends(then)
                rest = self.statements(otherwise)
                yield ("if", self._test(statement), self.statements(then), () if is_last else rest, notes)
                yield from rest if is_last else ()

    def _test(self, statement: CppIf) -> object:
        try:
            return self.test(parse_expression(statement.test))
        except SyntaxError:
            return ("tokens", *(token.text for token in statement.test))

    def _simple(self, tokens: Sequence[CppToken]) -> PlainForm:
        try:
            node = parse_statement(tokens)
        except SyntaxError:
            return ("tokens", *(token.text for token in tokens))
        match node:
            case CppNode(kind="return", parts=parts):
                return ("return", *(self.typed(each) for each in parts))
            case CppNode(kind="assign", text=operator, parts=(target, value)):
                return self._assignment(target, operator, value)
            case _:
                return ("do", self.typed(node))

    def _assignment(self, target: CppNode, operator: str, value: CppNode) -> PlainForm:
        type_ = self.symbols.types.get(path_of(target), "")
        if not type_:
            return ("assign", operator, self.typed(target), self.typed(value))
        whole = value if operator == "=" else CppNode("binary", operator[0], (target, value))
        return ("assign", "=", path_of(target), _as(type_, self.typed(whole)))

    def test(self, node: CppNode) -> object:
        """Return the form of an expression as a condition."""
        return _as_test(self.typed(node))

    def typed(self, node: CppNode) -> _Typed:
        """Return the type of an expression and its form."""
        path = path_of(node)
        if path in self.symbols.types:
            return self.symbols.types[path], ("name", path)
        match node:
            case CppNode(kind="number", text=text):
                return _number(text)
            case CppNode(kind="name", text="true" | "false" as text):
                return BOOL, text == "true"
            case CppNode(kind="unary", text=operator, parts=(operand,)):
                return (BOOL, ("!", self.test(operand))) if operator == "!" else _negative(self.typed(operand))
            case _:
                return self._operation(node)

    def _operation(self, node: CppNode) -> _Typed:
        match node:
            case CppNode(kind="binary", text=operator, parts=(left, right)):
                return self._binary(operator, left, right)
            case CppNode(kind="choice", parts=(test, then, otherwise)):
                return _choice(self.test(test), self.typed(then), self.typed(otherwise))
            case CppNode(kind="cast", text=type_, parts=(operand,)):
                return type_, _as(type_, self.typed(operand))
            case CppNode(kind="call", parts=(callee, *arguments)):
                return self._call(path_of(callee), callee, arguments)
            case CppNode(kind=kind, text=text, parts=parts):
                return _UNKNOWN, (kind, text, *(self.typed(each) for each in parts))

    def _binary(self, operator: str, left: CppNode, right: CppNode) -> _Typed:
        if operator in ("&&", "||"):
            operands = [*self._operands(operator, left), *self._operands(operator, right)]
            # A test of the time has no effect and always a result.
            ordered = sorted(operands, key=lambda each: not _is_timer(each)) if operator == "&&" else operands
            return BOOL, (operator, *ordered)
        sides = (self.typed(left), self.typed(right))
        return _calculated(operator, *sides) if operator in ("+", "-", "*", "/", "%") else _compared(operator, *sides)

    def _operands(self, operator: str, node: CppNode) -> list[object]:
        if node.kind == "binary" and node.text == operator:
            return [each for part in node.parts for each in self._operands(operator, part)]
        return [self.test(node)]

    def _call(self, path: str, callee: CppNode, arguments: Sequence[CppNode]) -> _Typed:
        if path == "call" and len(arguments) > 1:
            return self._component_call(arguments)
        given = [self.typed(each) for each in arguments]
        declared = self.symbols.arguments.get(path)
        if declared is not None and len(declared) == len(given):
            values = (_as(type_, value) for (_name, type_), value in zip(declared, given, strict=True))
            return self.symbols.types.get(path, _UNKNOWN), ("call", path, *values)
        found = _function(path, given)
        return found or (_UNKNOWN, ("call", path or self.typed(callee), *given))

    def _component_call(self, arguments: Sequence[CppNode]) -> _Typed:
        target, values, *rest = arguments
        path = path_of(target)
        declared = self.symbols.arguments.get(path) if path in self.symbols.aliases else None
        others = tuple(self.typed(each) for each in rest)
        if declared is None or values.kind != "list" or len(values.parts) > len(declared):
            return _UNKNOWN, ("call", "call", self.typed(target), self.typed(values), *others)
        # Parameters that are not given have their defaults.
        defaults = self.symbols.defaults[path_of(target)][len(values.parts) :]
        nodes = (*values.parts, *(parse_expression(list(iter_tokens(text))) for text in defaults))
        given = (_as(type_, self.typed(value)) for (_name, type_), value in zip(declared, nodes, strict=True))
        return _UNKNOWN, ("call", path_of(target), tuple(given), *others)


def is_mark(token: CppToken) -> bool:
    """Whether a token is a mark of a region."""
    return token.kind == COMMENT and bool(_MARK.fullmatch(token.text))


def comment_words(tokens: Sequence[CppToken]) -> tuple[str, ...]:
    """Return the words of comments in a row; an empty line of a comment is a word."""
    words: list[str] = []
    for token in tokens:
        own = _COMMENT_SIGNS.sub("", token.text).split()
        words += own or ["\n"]
    return tuple(words)


def _number(text: str) -> _Typed:
    value = number_value(text)
    if isinstance(value, float):
        return FLOAT, ("#.", repr(value))
    if value is None:
        return _UNKNOWN, ("number", text)
    return (_LITERAL if value <= _MOST_INT else INT), ("#", value)


def _negative(operand: _Typed) -> _Typed:
    match operand:
        case (type_, ("#", int(value))):
            return type_, ("#", -value)
        case (type_, ("#.", str(value))):
            return type_, ("#.", repr(-float(value)))
        case (type_, form):
            return (type_ if type_ in _NUMBERS else _UNKNOWN), ("-", type_, form)


def _as(type_: str, typed: _Typed) -> object:
    """Return the form of a value as another type."""
    own, form = typed
    if own == type_ or {own, type_} == {INT, _LITERAL}:
        return form
    if type_ == BOOL:
        return _as_test(typed)
    if type_ == FLOAT and own in _NUMBERS:
        return _as_float(form)
    return ("as", type_, own, form)


def _as_float(form: object) -> object:
    match form:
        case ("#", int(value)) if abs(value) <= _MOST_EXACT:
            return ("#.", repr(float(value)))
        case ("?:", _type, test, then, otherwise):
            return ("?:", FLOAT, test, _as_float(then), _as_float(otherwise))
        case _:
            return ("float", form)


def _as_test(typed: _Typed) -> object:
    type_, form = typed
    if type_ == BOOL:
        return form
    if type_ in _NUMBERS:
        return ("!=", *_common(typed, (_LITERAL, ("#", 0))))
    return ("test", type_, form)


def _common(left: _Typed, right: _Typed) -> tuple[str, object, object]:
    """Return the type of a calculation, and both sides as this type."""
    types = {left[0], right[0]}
    if types <= _NUMBERS:
        type_ = FLOAT if FLOAT in types else INT if INT in types else _LITERAL
        return type_, _as(type_, left), _as(type_, right)
    if len(types) == 1 and _UNKNOWN not in types:
        return left[0], left[1], right[1]
    return _UNKNOWN, left, right


def _calculated(operator: str, left: _Typed, right: _Typed) -> _Typed:
    type_, first, second = _common(left, right)
    if type_ not in _NUMBERS:
        return _UNKNOWN, (operator, left, right)
    return type_, (operator, type_, first, second)


def _compared(operator: str, left: _Typed, right: _Typed) -> _Typed:
    return BOOL, (operator, *_common(left, right))


def _choice(test: object, then: _Typed, otherwise: _Typed) -> _Typed:
    type_, first, second = _common(then, otherwise)
    return type_, ("?:", type_, test, first, second)


def _function(path: str, given: Sequence[_Typed]) -> _Typed | None:
    """Return a call of a function of the runtime, or of one of the standard library that gives the same."""
    owner, _colons, name = path.rpartition("::")
    types = {type_ for type_, _form in given}
    if path == "bica::limit" and len(given) == 1:
        return INT, _as(INT, given[0])
    if owner not in ("bica", "std") or not given or not types <= _NUMBERS:
        return None
    if owner == "std":
        name = {"fabs": "abs", "isnan": "is_nan"}.get(name, name)
        is_same = name in (*_SAME, "is_nan") or (name in _OF_ANY_TYPE and _LITERAL not in types)
        if not is_same or (name == "abs" and types != {FLOAT}):
            return None
    if name in _OF_ANY_TYPE and len(types) == 1:
        (type_,) = types
        return type_, (name, type_, *(form for _type, form in given))
    return _function_of_runtime(name, given)


def _function_of_runtime(name: str, given: Sequence[_Typed]) -> _Typed | None:
    floats = [_as(FLOAT, each) for each in given]
    match name, floats:
        case "to_float", [only]:
            return FLOAT, only
        case "divide", [left, right]:
            return _calculated("/", (FLOAT, left), (FLOAT, right))
        case "negate", [_only]:
            return _negative((INT, _as(INT, given[0])))
        case "add" | "subtract" | "multiply", [_left, _right]:
            return _calculated(_OPERATORS[name], *((INT, _as(INT, each)) for each in given))
        case "sign", [_only]:
            return INT, ("sign", *given)
        case _:
            return (_RESULTS[name], (name, *floats)) if name in _RESULTS else None


def _is_timer(form: object) -> bool:
    match form:
        case (">=", str(), left, ("#", int())) if left == _TIMER:
            return True
        case _:
            return False


def called_action(form: PlainForm) -> str:
    """Return the function without arguments that a statement calls; empty for any other statement."""
    match form:
        case ("do", (_type, ("call", str(name)))):
            return name
        case _:
            return ""


def with_actions(forms: Sequence[PlainForm], actions: Mapping[str, tuple[PlainForm, ...]]) -> tuple[PlainForm, ...]:
    """Return statements with the bodies of actions in place of their calls."""
    return tuple(own for form in forms for own in actions.get(called_action(form), (form,)))
