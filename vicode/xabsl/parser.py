"""Recursive-descent parser from text to a syntax tree. After an error it resumes at the next action, state or item."""

from dataclasses import dataclass

from vicode.findings import Finding
from vicode.xabsl.cursor import TokenCursor, XabslSyntaxError
from vicode.xabsl.declaration_parser import parse_agent, parse_namespace, parse_parameters
from vicode.xabsl.lexer import Tokens, plain_line_ends, tokenize
from vicode.xabsl.state_parser import parse_actions, parse_decision_tree, parse_state
from vicode.xabsl.tokens import DOC, END, HEADER, STRING
from vicode.xabsl.tree import (
    ActionBlockNode,
    AgentNode,
    DecisionTreeNode,
    FileNode,
    IncludeNode,
    NamespaceNode,
    OptionNode,
    StateNode,
)

_TOP_LEVEL_KEYWORDS = ("include", "option", "namespace", "agent")
_STATE_STARTS = frozenset(("state", "initial", "target"))


@dataclass(slots=True)
class ParsedFile:
    """A parsed file: syntax tree, tokens and findings."""

    file: FileNode
    tokens: Tokens
    findings: list[Finding]


def parse(text: str, file: str = "") -> ParsedFile:
    """Parse a file; `file` is its name in messages. Never raises: malformed parts are omitted and reported."""
    tokens, findings = tokenize(text, file)
    cursor = TokenCursor(tokens)
    result = FileNode(comments=tokens.comments)
    if cursor.kind == HEADER:
        result.header = plain_line_ends(tokens.texts[cursor.advance()][4:-2]).strip()
    while cursor.kind != END:
        start = cursor.position
        try:
            _item(cursor, result)
        except XabslSyntaxError:
            cursor.depth = 0
            _recover(cursor, start)
    result.after_blank_lines = frozenset(
        number for number, start in enumerate(tokens.starts) if start in tokens.after_blank_lines
    )
    return ParsedFile(result, tokens, findings + cursor.findings)


def _recover(cursor: TokenCursor, start: int) -> None:
    """Skip to the next keyword that starts a top-level item."""
    if cursor.position == start:
        cursor.advance()
    cursor.skip_to(*_TOP_LEVEL_KEYWORDS, DOC, open_braces=cursor.open_braces_since(start))
    while cursor.kind == "}":
        cursor.advance()
        cursor.skip_to(*_TOP_LEVEL_KEYWORDS, DOC, open_braces=0)


def _item(cursor: TokenCursor, result: FileNode) -> None:
    start, doc = cursor.position, cursor.accept_doc()
    match cursor.kind:
        case "include" if not doc:
            include = _include(cursor)
            if result.body:
                cursor.add_finding(
                    "X604", "an include after a definition", "move it to the start of the file", token=start
                )
            result.includes.append(include)
        case "option":
            result.body.append(_option(cursor, start, doc))
        case "namespace":
            result.body.append(parse_namespace(cursor, start, doc))
        case "agent":
            result.body.append(parse_agent(cursor, start, doc))
        case _:
            if doc:
                raise cursor.syntax_error(_TOP_LEVEL_KEYWORDS[1:], "after the description")
            raise cursor.syntax_error(_TOP_LEVEL_KEYWORDS)
    _check_single_definition(cursor, result.body, start)


def _check_single_definition(
    cursor: TokenCursor, body: list[OptionNode | NamespaceNode | AgentNode], start: int
) -> None:
    if len(body) > 1 and not all(isinstance(item, AgentNode) for item in body):
        message = "a second definition in this file: a file defines one option, one namespace, or agents"
        cursor.add_finding("X610", message, "move it to a separate file", token=start)


def _include(cursor: TokenCursor) -> IncludeNode:
    start = cursor.advance()
    path = cursor.expect_text(STRING, "for the path after include")[1:-1]
    cursor.expect_semicolon("after include")
    return IncludeNode(path, first_token=start, last_token=cursor.position - 1)


def _option(cursor: TokenCursor, start: int, doc: str) -> OptionNode:
    cursor.advance()
    name = cursor.expect_name("for the option")
    cursor.expect("{", f"after option {name.text}")
    parameters = parse_parameters(cursor, _STATE_STARTS | {"common"})
    decision, actions = _common(cursor)
    states: list[StateNode] = []
    while cursor.kind not in ("}", END):
        first, depth = cursor.position, cursor.depth
        try:
            if cursor.kind not in _STATE_STARTS:
                raise cursor.syntax_error(("state", "initial", "target"), f"in option {name.text}")
            states.append(parse_state(cursor))
        except XabslSyntaxError:
            cursor.depth = depth
            if cursor.position == first:
                cursor.advance()
            cursor.skip_to(*_STATE_STARTS, "}", open_braces=cursor.open_braces_since(first))
    option = OptionNode(name, parameters, states, decision, actions, doc, first_token=start, last_token=cursor.position)
    if not states and cursor.kind == "}":
        cursor.add_finding("X604", f"option {name.text} has no state", "add a state", token=name.first_token)
    if not cursor.accept("}"):
        cursor.syntax_error(("}",), f"at the end of option {name.text}")
    return option


def _common(cursor: TokenCursor) -> tuple[DecisionTreeNode | None, ActionBlockNode | None]:
    decision: DecisionTreeNode | None = None
    actions: ActionBlockNode | None = None
    while cursor.kind == "common":
        start, depth = cursor.advance(), cursor.depth
        try:
            if cursor.accept("decision"):
                cursor.expect("{", "after common decision")
                decision = parse_decision_tree(cursor, is_open=True)
                cursor.expect("}", "at the end of the common decision")
            else:
                cursor.expect("action", "after common")
                actions = parse_actions(cursor)
        except XabslSyntaxError:
            cursor.depth = depth
            cursor.skip_to("common", *_STATE_STARTS, "}", open_braces=cursor.open_braces_since(start))
    return decision, actions
