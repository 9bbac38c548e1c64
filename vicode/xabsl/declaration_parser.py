"""Parses agents, namespaces with their symbols and basic behaviors, and parameters."""

from collections.abc import Collection

from vicode.xabsl.cursor import TokenCursor, XabslSyntaxError
from vicode.xabsl.tokens import DOC, END, KEYWORDS, NAME, NUMBER, RANGE, STRING
from vicode.xabsl.tree import (
    AgentNode,
    BehaviorNode,
    ConstantNode,
    DeclarationNode,
    EnumerationNode,
    NameNode,
    NamespaceNode,
    ParameterNode,
    SymbolNode,
    TypeNode,
)

_DIRECTIONS = ("input", "output", "internal")
_DECLARATION_STARTS = ("float", "bool", "enum", "const", "behavior", *_DIRECTIONS)


def parse_agent(cursor: TokenCursor, start: int, doc: str) -> AgentNode:
    """Parse an agent from its keyword; `start` is its first token, which may be the description.

    Raises:
        XabslSyntaxError: The agent is malformed.
    """
    cursor.advance()
    name = cursor.expect_name("for the agent")
    cursor.expect("(", "after the agent's name")
    title = cursor.expect_text(STRING, "for the agent's title")[1:-1]
    cursor.expect(",", "after the title")
    root = cursor.expect_name("for the root option")
    cursor.expect(")", "after the root option")
    cursor.expect_semicolon("after the agent")
    return AgentNode(name, title, root, doc, first_token=start, last_token=cursor.position - 1)


def parse_namespace(cursor: TokenCursor, start: int, doc: str) -> NamespaceNode:
    """Parse a namespace from its keyword. Malformed declarations are reported and omitted.

    Raises:
        XabslSyntaxError: The head of the namespace is malformed.
    """
    cursor.advance()
    name = cursor.expect_name("for the namespace")
    title = ""
    if cursor.kind == "{":
        cursor.add_finding("X604", f"namespace {name.text} has no title", f'write namespace {name.text}("Title")')
    else:
        cursor.expect("(", f"after namespace {name.text}")
        title = cursor.expect_text(STRING, "for the namespace's title")[1:-1]
        cursor.expect(")", "after the title")
    cursor.expect("{", f"after namespace {name.text}")
    declarations: list[DeclarationNode] = []
    while cursor.kind not in ("}", END):
        first = cursor.position
        try:
            declarations.append(_declaration(cursor))
        except XabslSyntaxError:
            _recover(cursor, first)
    if not cursor.accept("}"):
        cursor.syntax_error(("}",), f"at the end of namespace {name.text}")
    return NamespaceNode(name, title, declarations, doc, first_token=start, last_token=cursor.position - 1)


def _recover(cursor: TokenCursor, first: int) -> None:
    if cursor.position == first:
        cursor.advance()
    cursor.skip_to(";", DOC, *_DECLARATION_STARTS, open_braces=cursor.open_braces_since(first))
    cursor.accept(";")


def _declaration(cursor: TokenCursor) -> DeclarationNode:
    start, doc = cursor.position, cursor.accept_doc()
    if cursor.kind == "behavior":
        return _behavior(cursor, start, doc)
    type_node = _type(cursor)
    if type_node is not None and type_node.enum is not None and cursor.kind in ("{", "internal"):
        after = cursor.kinds[cursor.position + 1]
        if cursor.kind == "{" or after == "{":
            return _enumeration(cursor, start, doc, type_node.enum)
    if cursor.kind == "const" and (type_node is None or type_node.text == "float"):
        return _constant(cursor, start, doc, has_float_keyword=type_node is not None)
    if cursor.kind in _DIRECTIONS:
        return _symbol(cursor, start, doc, type_node)
    if type_node is not None and cursor.kind == NAME:
        name = cursor.tokens.texts[cursor.position]
        cursor.add_finding(
            "X604", f"{name} is neither input, output nor internal", "write input, output or internal before the name"
        )
        return _symbol(cursor, start, doc, type_node, direction="input")
    raise cursor.syntax_error(
        (*_DIRECTIONS, "const") if type_node else _DECLARATION_STARTS, "in a namespace" if type_node is None else ""
    )


def _type(cursor: TokenCursor) -> TypeNode | None:
    start = cursor.position
    if cursor.kind in ("float", "bool"):
        return TypeNode(cursor.tokens.texts[cursor.advance()], first_token=start, last_token=start)
    if cursor.accept("enum"):
        enum = cursor.expect_name("for an enumeration after enum")
        return TypeNode("enum", enum, first_token=start, last_token=cursor.position - 1)
    return None


def _behavior(cursor: TokenCursor, start: int, doc: str) -> BehaviorNode:
    cursor.advance()
    name = cursor.expect_name("for the basic behavior")
    cursor.expect("{", f"after behavior {name.text}")
    parameters = parse_parameters(cursor, ())
    cursor.expect("}", f"at the end of behavior {name.text}")
    if cursor.kind == ";":
        cursor.add_finding("X651", "a ; after the } of a behavior", "remove it")
        cursor.advance()
    return BehaviorNode(name, parameters, doc, first_token=start, last_token=cursor.position - 1)


def _enumeration(cursor: TokenCursor, start: int, doc: str, name: NameNode) -> EnumerationNode:
    is_internal = cursor.accept("internal")
    cursor.expect("{", f"after enum {name.text}")
    elements = [cursor.expect_name("for an element")]
    while cursor.accept(","):
        if cursor.kind == "}":
            cursor.add_finding("X651", "a comma after the last element", "remove it", token=cursor.position - 1)
            break
        elements.append(cursor.expect_name("for an element"))
    cursor.expect("}", "after the elements")
    cursor.expect_semicolon("after the enumeration")
    return EnumerationNode(name, elements, is_internal, doc, first_token=start, last_token=cursor.position - 1)


def _constant(cursor: TokenCursor, start: int, doc: str, *, has_float_keyword: bool) -> ConstantNode:
    cursor.advance()
    name = cursor.expect_name("for the constant")
    cursor.expect("=", "after the constant's name")
    sign = "-" if cursor.accept("-") else ""
    number = sign + cursor.expect_text(NUMBER, "for the value of the constant")
    unit = _unit(cursor)
    if cursor.kind in ("+", "-", "*", "/", "%"):
        cursor.add_finding(
            "X604", "the value of a constant is a number, not an expression", "write the resulting number"
        )
        raise XabslSyntaxError
    cursor.expect_semicolon("after the constant")
    return ConstantNode(name, number, unit, doc, has_float_keyword, first_token=start, last_token=cursor.position - 1)


def _symbol(cursor: TokenCursor, start: int, doc: str, type_node: TypeNode | None, direction: str = "") -> SymbolNode:
    direction = direction or cursor.tokens.texts[cursor.advance()]
    name = cursor.expect_name("for the symbol")
    range_, unit = _range(cursor), _unit(cursor)
    parameters = None
    if cursor.kind == "(":
        if direction != "input":
            cursor.add_finding("X604", "only input symbols have parameters", "remove the parentheses")
        cursor.advance()
        parameters = parse_parameters(cursor, (")",))
        cursor.expect(")", "after the parameters")
    cursor.expect_semicolon(f"after symbol {name.text}")
    return SymbolNode(
        direction, name, type_node, range_, unit, parameters, doc, first_token=start, last_token=cursor.position - 1
    )


def parse_parameters(cursor: TokenCursor, until: Collection[str]) -> list[ParameterNode]:
    """Parse declarations of parameters up to a token of the kinds `until`, or a closing brace."""
    parameters: list[ParameterNode] = []
    while cursor.kind not in until and cursor.kind not in ("}", END):
        start = cursor.position
        try:
            parameters.append(_parameter(cursor))
        except XabslSyntaxError:
            if cursor.kind in until:
                break
            if cursor.position == start:
                cursor.advance()
            cursor.skip_to(";", *until, open_braces=cursor.open_braces_since(start))
            cursor.accept(";")
    return parameters


def _parameter(cursor: TokenCursor) -> ParameterNode:
    start, doc = cursor.position, cursor.accept_doc()
    type_node = _type(cursor)
    if doc and type_node is None and cursor.kind in KEYWORDS:
        cursor.add_finding("X604", "a description is not allowed here", "write it as a comment: // …", token=start)
        raise XabslSyntaxError
    if type_node is None and cursor.kind != NAME:
        raise cursor.syntax_error((NAME, "float", "bool", "enum"), "for a parameter")
    name = cursor.expect_name("for a parameter")
    range_, unit = _range(cursor), _unit(cursor)
    cursor.expect_semicolon(f"after parameter {name.text}")
    return ParameterNode(name, type_node, range_, unit, doc, first_token=start, last_token=cursor.position - 1)


def _range(cursor: TokenCursor) -> str:
    return cursor.tokens.texts[cursor.advance()][1:-1] if cursor.kind == RANGE else ""


def _unit(cursor: TokenCursor) -> str:
    return cursor.tokens.texts[cursor.advance()][1:-1] if cursor.kind == STRING else ""
