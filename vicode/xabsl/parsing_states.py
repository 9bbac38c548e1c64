"""Decision trees and actions, and the states that hold them."""

from vicode.xabsl.cursor import Cursor, SyntaxSlipError
from vicode.xabsl.parsing_expressions import parse_arguments, parse_expression
from vicode.xabsl.tokens import DOC, END, NAME, NUMBER
from vicode.xabsl.tree import (
    Action,
    Actions,
    Assignment,
    Block,
    Call,
    Decision,
    Expression,
    Goto,
    If,
    Name,
    State,
    Stay,
    Tree,
)

_STATE_BEGINS = ("state", "initial", "target")


def parse_state(cursor: Cursor) -> State:
    """The state that begins here.

    Raises:
        SyntaxSlipError: It cannot be read so far that it has a name.
    """
    start = cursor.at
    is_initial = cursor.take("initial")
    is_target = cursor.take("target")
    if not is_initial and cursor.kind == "initial":
        cursor.complain("X651", "initial stands before target", "write initial target state")
        is_initial = cursor.take("initial")
    cursor.expect("state")
    name = cursor.name("of the state")
    cooperation, robots = "", ""
    if cursor.kind in ("capacity", "synchronized"):
        cooperation = cursor.tokens.texts[cursor.skip()]
        if cooperation == "capacity" or cursor.kind == NUMBER:
            robots = cursor.text(NUMBER, f"of robots after {cooperation}")
    cursor.expect("{", f"after state {name.text}")
    decision = _guarded_decision(cursor) if cursor.kind == "decision" else None
    actions = _actions_of_state(cursor, name)
    if cursor.kind == "decision" and decision is None:
        cursor.complain("X604", "decision stands before action", "put it there")
        decision = _guarded_decision(cursor)
    if cursor.kind not in ("}", END):
        cursor.complain("X604", f"something after the actions of state {name.text}", "remove it")
        cursor.leave(inside=0)
    _close(cursor, f"at the end of state {name.text}")
    return State(
        *(name, actions, decision, is_initial, is_target, cooperation, robots),
        at=start,
        to=cursor.at - 1,
    )


def _close(cursor: Cursor, where: str) -> None:
    """Take the closing brace; a file that ends before it ends all that is open."""
    if cursor.kind == END:
        cursor.slip(("}",), where)
    else:
        cursor.expect("}", where)


def _actions_of_state(cursor: Cursor, name: Name) -> Actions:
    if cursor.kind == "action":
        cursor.skip()
        return parse_actions(cursor)
    if cursor.kind == "}":
        cursor.complain("X604", f"state {name.text} has no action", "write action { }, which may be empty")
    else:
        try:
            raise cursor.slip(("action",) if cursor.kind != NAME else ("action", "decision"), f"in state {name.text}")
        except SyntaxSlipError:
            cursor.leave("action", *_STATE_BEGINS, inside=0)
        if cursor.take("action"):
            return parse_actions(cursor)
    return Actions([])


def _guarded_decision(cursor: Cursor) -> Decision | None:
    start, depth = cursor.skip(), cursor.depth
    try:
        return _decision(cursor, start)
    except SyntaxSlipError:
        cursor.depth = depth
        cursor.leave("action", "}", inside=cursor.open_since(start))
        return None


def _decision(cursor: Cursor, start: int) -> Decision:
    cursor.expect("{", "after decision")
    doc, begins_with_else = "", False
    if cursor.kind == DOC and cursor.kinds[cursor.at + 1] == "else":
        doc = cursor.doc()
    if cursor.kind == "else":
        begins_with_else = True
        cursor.skip()
    tree = parse_tree(cursor, is_open=False)
    cursor.expect("}", "at the end of the decision")
    return Decision(tree, begins_with_else, doc, at=start, to=cursor.at - 1)


def parse_tree(cursor: Cursor, *, is_open: bool) -> Tree:
    """The decision tree that begins here; an open one ends without `else`.

    Raises:
        SyntaxSlipError: It cannot be read to its end.
    """
    start, depth = cursor.at, cursor.depth
    cursor.enter()
    tree: Tree
    if cursor.kind == "goto":
        cursor.skip()
        tree = Goto(cursor.name("of a state after goto"), at=start)
        cursor.end("after goto")
    elif cursor.kind == "stay":
        cursor.skip()
        cursor.end("after stay")
        tree = Stay(at=start)
    elif cursor.kind == "{":
        cursor.skip()
        tree = Block(parse_tree(cursor, is_open=is_open), at=start)
        cursor.expect("}", "after one decision")
    else:
        tree = _if(cursor, is_open=is_open)
    tree.to = cursor.at - 1
    cursor.depth = depth
    return tree


def _if(cursor: Cursor, *, is_open: bool) -> If:
    """An `if` with all that follow it by `else if`, read in a row: there may be many."""
    chain: list[If] = []
    last: Tree | None = None
    while True:
        start, doc = cursor.at, cursor.doc()
        if cursor.kind != "if":
            if chain and not doc:
                last = parse_tree(cursor, is_open=is_open)
                break
            raise cursor.slip(("if", "goto", "stay", "{"))
        cursor.skip()
        condition = _condition(cursor)
        chain.append(If(condition, parse_tree(cursor, is_open=False), None, doc, at=start))
        cursor.enter()
        has_doc = cursor.kind == DOC
        if cursor.kinds[cursor.at + has_doc] != "else":
            if not is_open:
                cursor.complain("X604", "an if without else", "say what happens else: else stay;")
                raise SyntaxSlipError
            break
        chain[-1].else_doc = cursor.doc()
        cursor.skip()
        if cursor.kind not in ("if", DOC):
            last = _last_of(cursor, is_open=is_open)
            break
    for each in reversed(chain):
        each.otherwise, last = last, each
        each.to = cursor.at - 1
    return chain[0]


def _last_of(cursor: Cursor, *, is_open: bool) -> Tree:
    if is_open and cursor.kind not in ("{", "if"):
        cursor.complain("X604", "the last else of a common decision stays open", "leave it out: the states go on there")
        raise SyntaxSlipError
    return parse_tree(cursor, is_open=is_open)


def _condition(cursor: Cursor) -> Expression:
    cursor.expect("(", "after if")
    condition = parse_expression(cursor)
    cursor.expect(")", "after the condition")
    return condition


def parse_actions(cursor: Cursor) -> Actions:
    """The actions in the braces that begin here; those that cannot be read are left out.

    Raises:
        SyntaxSlipError: There is no brace, or it is never closed.
    """
    start = cursor.expect("{", "after action")
    actions: list[Action] = []
    while cursor.kind not in ("}", END):
        first, depth = cursor.at, cursor.depth
        try:
            actions.append(_action(cursor))
        except SyntaxSlipError:
            cursor.depth = depth
            cursor.leave(";", inside=cursor.open_since(first))
            cursor.take(";")
    _close(cursor, "at the end of the actions")
    return Actions(actions, at=start, to=cursor.at - 1)


def _action(cursor: Cursor) -> Action:
    name = cursor.name("of a symbol, an option or a basic behavior")
    action: Action
    if cursor.take("="):
        action = Assignment(name, parse_expression(cursor), at=name.at)
        cursor.end("after the value")
    else:
        kind = cursor.tokens.texts[cursor.skip()] if cursor.kind in ("option", "behavior") else ""
        if cursor.kind != "(":
            raise cursor.slip(("=", "("), f"after {name.text}")
        action = Call(name, parse_arguments(cursor), kind, at=name.at)
        cursor.end("after the call")
    action.to = cursor.at - 1
    return action
