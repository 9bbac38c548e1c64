"""Agents, namespaces with their symbols and behaviors, and parameters."""

from collections.abc import Collection

from vicode.xabsl.cursor import Cursor, SyntaxSlipError
from vicode.xabsl.tokens import DOC, END, KEYWORDS, NAME, NUMBER, RANGE, STRING
from vicode.xabsl.tree import (
    Agent,
    Behavior,
    Constant,
    Declaration,
    Enumeration,
    Name,
    Namespace,
    Parameter,
    Symbol,
    Type,
)

_DIRECTIONS = ("input", "output", "internal")
_BEGINS = ("float", "bool", "enum", "const", "behavior", *_DIRECTIONS)


def parse_agent(cursor: Cursor, start: int, doc: str) -> Agent:
    """The agent whose word begins here; its description began at `start`.

    Raises:
        SyntaxSlipError: It cannot be read to its end.
    """
    cursor.skip()
    name = cursor.name("of the agent")
    cursor.expect("(", "after the agent's name")
    title = cursor.text(STRING, "with the agent's title")[1:-1]
    cursor.expect(",", "after the title")
    root = cursor.name("of the root option")
    cursor.expect(")", "after the root option")
    cursor.end("after the agent")
    return Agent(name, title, root, doc, at=start, to=cursor.at - 1)


def parse_namespace(cursor: Cursor, start: int, doc: str) -> Namespace:
    """The namespace whose word begins here; declarations that cannot be read are left out.

    Raises:
        SyntaxSlipError: Its beginning or end is missing.
    """
    cursor.skip()
    name = cursor.name("of the namespace")
    title = ""
    if cursor.kind == "{":
        cursor.complain("X604", f"namespace {name.text} has no title", f'write namespace {name.text}("Title")')
    else:
        cursor.expect("(", f"after namespace {name.text}")
        title = cursor.text(STRING, "with the namespace's title")[1:-1]
        cursor.expect(")", "after the title")
    cursor.expect("{", f"after namespace {name.text}")
    declarations: list[Declaration] = []
    while cursor.kind not in ("}", END):
        first = cursor.at
        try:
            declarations.append(_declaration(cursor))
        except SyntaxSlipError:
            _find_next(cursor, first)
    if not cursor.take("}"):
        cursor.slip(("}",), f"at the end of namespace {name.text}")
    return Namespace(name, title, declarations, doc, at=start, to=cursor.at - 1)


def _find_next(cursor: Cursor, first: int) -> None:
    if cursor.at == first:
        cursor.skip()
    cursor.leave(";", DOC, *_BEGINS, inside=cursor.open_since(first))
    cursor.take(";")


def _declaration(cursor: Cursor) -> Declaration:
    start, doc = cursor.at, cursor.doc()
    if cursor.kind == "behavior":
        return _behavior(cursor, start, doc)
    of = _type(cursor)
    if of is not None and of.enum is not None and cursor.kind in ("{", "internal"):
        after = cursor.kinds[cursor.at + 1]
        if cursor.kind == "{" or after == "{":
            return _enumeration(cursor, start, doc, of.enum)
    if cursor.kind == "const" and (of is None or of.text == "float"):
        return _constant(cursor, start, doc, says_float=of is not None)
    if cursor.kind in _DIRECTIONS:
        return _symbol(cursor, start, doc, of)
    if of is not None and cursor.kind == NAME:
        name = cursor.tokens.texts[cursor.at]
        cursor.complain("X604", f"{name} is neither input, output nor internal", "say which")
        return _symbol(cursor, start, doc, of, direction="input")
    raise cursor.slip((*_DIRECTIONS, "const") if of else _BEGINS, "in a namespace" if of is None else "")


def _type(cursor: Cursor) -> Type | None:
    start = cursor.at
    if cursor.kind in ("float", "bool"):
        return Type(cursor.tokens.texts[cursor.skip()], at=start, to=start)
    if cursor.take("enum"):
        enum = cursor.name("of an enumeration after enum")
        return Type("enum", enum, at=start, to=cursor.at - 1)
    return None


def _behavior(cursor: Cursor, start: int, doc: str) -> Behavior:
    cursor.skip()
    name = cursor.name("of the basic behavior")
    cursor.expect("{", f"after behavior {name.text}")
    parameters = parse_parameters(cursor, ())
    cursor.expect("}", f"at the end of behavior {name.text}")
    if cursor.kind == ";":
        cursor.complain("X651", "a ; after a behavior's }", "remove it")
        cursor.skip()
    return Behavior(name, parameters, doc, at=start, to=cursor.at - 1)


def _enumeration(cursor: Cursor, start: int, doc: str, name: Name) -> Enumeration:
    is_internal = cursor.take("internal")
    cursor.expect("{", f"after enum {name.text}")
    elements = [cursor.name("of an element")]
    while cursor.take(","):
        if cursor.kind == "}":
            cursor.complain("X651", "a comma after the last element", "remove it")
            break
        elements.append(cursor.name("of an element"))
    cursor.expect("}", "after the elements")
    cursor.end("after the enumeration")
    return Enumeration(name, elements, is_internal, doc, at=start, to=cursor.at - 1)


def _constant(cursor: Cursor, start: int, doc: str, *, says_float: bool) -> Constant:
    cursor.skip()
    name = cursor.name("of the constant")
    cursor.expect("=", "after the constant's name")
    sign = "-" if cursor.take("-") else ""
    number = sign + cursor.text(NUMBER, "(a constant is a number)")
    unit = _unit(cursor)
    if cursor.kind in ("+", "-", "*", "/", "%"):
        cursor.complain("X604", "a constant is a number, no expression", "write its value")
        raise SyntaxSlipError
    cursor.end("after the constant")
    return Constant(name, number, unit, doc, says_float, at=start, to=cursor.at - 1)


def _symbol(cursor: Cursor, start: int, doc: str, of: Type | None, direction: str = "") -> Symbol:
    direction = direction or cursor.tokens.texts[cursor.skip()]
    name = cursor.name("of the symbol")
    range_, unit = _range(cursor), _unit(cursor)
    parameters = None
    if cursor.kind == "(":
        if direction != "input":
            cursor.complain("X604", "only input symbols have parameters", "remove the parentheses")
        cursor.skip()
        parameters = parse_parameters(cursor, (")",))
        cursor.expect(")", "after the parameters")
    cursor.end(f"after symbol {name.text}")
    return Symbol(direction, name, of, range_, unit, parameters, doc, at=start, to=cursor.at - 1)


def parse_parameters(cursor: Cursor, until: Collection[str]) -> list[Parameter]:
    """The declarations of parameters, up to one of these kinds or a closing brace."""
    parameters: list[Parameter] = []
    while cursor.kind not in until and cursor.kind not in ("}", END):
        start = cursor.at
        try:
            parameters.append(_parameter(cursor))
        except SyntaxSlipError:
            if cursor.kind in until:
                break
            if cursor.at == start:
                cursor.skip()
            cursor.leave(";", *until, inside=cursor.open_since(start))
            cursor.take(";")
    return parameters


def _parameter(cursor: Cursor) -> Parameter:
    start, doc = cursor.at, cursor.doc()
    of = _type(cursor)
    if doc and of is None and cursor.kind in KEYWORDS:
        cursor.complain("X604", "a description stands where none can", "write it as a comment: // …", at=start)
        raise SyntaxSlipError
    if of is None and cursor.kind != NAME:
        raise cursor.slip((NAME, "float", "bool", "enum"), "of a parameter")
    name = cursor.name("of a parameter")
    range_, unit = _range(cursor), _unit(cursor)
    cursor.end(f"after parameter {name.text}")
    return Parameter(name, of, range_, unit, doc, at=start, to=cursor.at - 1)


def _range(cursor: Cursor) -> str:
    return cursor.tokens.texts[cursor.skip()][1:-1] if cursor.kind == RANGE else ""


def _unit(cursor: Cursor) -> str:
    return cursor.tokens.texts[cursor.skip()][1:-1] if cursor.kind == STRING else ""
