"""Text to a syntax tree: recursive descent, which after a mistake goes on with the next action, state or item."""

from dataclasses import dataclass

from vicode.findings import Finding
from vicode.xabsl.cursor import Cursor, SyntaxSlipError
from vicode.xabsl.lexer import Tokens, tokenize
from vicode.xabsl.parsing_declarations import parse_agent, parse_namespace, parse_parameters
from vicode.xabsl.parsing_states import parse_actions, parse_state, parse_tree
from vicode.xabsl.tokens import DOC, END, INITIAL, STRING
from vicode.xabsl.tree import Actions, Agent, File, Include, Namespace, Option, State, Tree

_TOP = ("include", "option", "namespace", "agent")
_STATE_BEGINS = frozenset(("state", "initial", "target"))


@dataclass(slots=True)
class Parsed:
    """A file that was read: what is in it, where, and what is wrong with it."""

    file: File
    tokens: Tokens
    findings: list[Finding]


def parse(text: str, file: str = "") -> Parsed:
    """Read a file; `file` is its name in messages. Never raises: what cannot be read is left out and told."""
    tokens, findings = tokenize(text, file)
    cursor = Cursor(tokens)
    result = File(comments=tokens.comments)
    if cursor.kind == INITIAL:
        result.initial = tokens.texts[cursor.skip()][4:-2].strip()
    while cursor.kind != END:
        start = cursor.at
        try:
            _item(cursor, result)
        except SyntaxSlipError:
            cursor.depth = 0
            _find_next(cursor, start)
    result.blanks = frozenset(number for number, start in enumerate(tokens.starts) if start in tokens.after_blanks)
    return Parsed(result, tokens, findings + cursor.findings)


def _find_next(cursor: Cursor, start: int) -> None:
    """Go to the next word that begins something, on the level of the file if braces can be believed."""
    if cursor.at == start:
        cursor.skip()
    cursor.leave(*_TOP, DOC, inside=cursor.open_since(start))
    while cursor.kind == "}":
        cursor.skip()
        cursor.leave(*_TOP, DOC, inside=0)


def _item(cursor: Cursor, result: File) -> None:
    start, doc = cursor.at, cursor.doc()
    match cursor.kind:
        case "include" if not doc:
            include = _include(cursor)
            if result.body:
                cursor.complain("X604", "an include after what the file defines", "put it first", at=start)
            result.includes.append(include)
        case "option":
            result.body.append(_option(cursor, start, doc))
        case "namespace":
            result.body.append(parse_namespace(cursor, start, doc))
        case "agent":
            result.body.append(parse_agent(cursor, start, doc))
        case _:
            if doc:
                raise cursor.slip(_TOP[1:], "after the description")
            raise cursor.slip(_TOP)
    _look_at_company(cursor, result.body, start)


def _look_at_company(cursor: Cursor, body: list[Option | Namespace | Agent], start: int) -> None:
    if len(body) > 1 and not all(isinstance(each, Agent) for each in body):
        message = "a second thing in a file, which defines one option, one namespace, or agents"
        cursor.complain("X610", message, "give it a file of its own", at=start)


def _include(cursor: Cursor) -> Include:
    start = cursor.skip()
    path = cursor.text(STRING, "with a path after include")[1:-1]
    cursor.end("after include")
    return Include(path, at=start, to=cursor.at - 1)


def _option(cursor: Cursor, start: int, doc: str) -> Option:
    cursor.skip()
    name = cursor.name("of the option")
    cursor.expect("{", f"after option {name.text}")
    parameters = parse_parameters(cursor, _STATE_BEGINS | {"common"})
    decision, actions = _common(cursor)
    states: list[State] = []
    while cursor.kind not in ("}", END):
        first, depth = cursor.at, cursor.depth
        try:
            if cursor.kind not in _STATE_BEGINS:
                raise cursor.slip(("state", "initial", "target"), f"in option {name.text}")
            states.append(parse_state(cursor))
        except SyntaxSlipError:
            cursor.depth = depth
            if cursor.at == first:
                cursor.skip()
            cursor.leave(*_STATE_BEGINS, "}", inside=cursor.open_since(first))
    option = Option(name, parameters, states, decision, actions, doc, at=start, to=cursor.at)
    if not states and cursor.kind == "}":
        cursor.complain("X604", f"option {name.text} has no state", "an option has at least one", at=name.at)
    if not cursor.take("}"):
        cursor.slip(("}",), f"at the end of option {name.text}")
    return option


def _common(cursor: Cursor) -> tuple[Tree | None, Actions | None]:
    decision: Tree | None = None
    actions: Actions | None = None
    while cursor.kind == "common":
        start, depth = cursor.skip(), cursor.depth
        try:
            if cursor.take("decision"):
                cursor.expect("{", "after common decision")
                decision = parse_tree(cursor, is_open=True)
                cursor.expect("}", "at the end of the common decision")
            else:
                cursor.expect("action", "after common")
                actions = parse_actions(cursor)
        except SyntaxSlipError:
            cursor.depth = depth
            cursor.leave("common", *_STATE_BEGINS, "}", inside=cursor.open_since(start))
    return decision, actions
