"""Parses states with their decision trees and actions."""

from vicode.xabsl.cursor import TokenCursor, XabslSyntaxError
from vicode.xabsl.expression_parser import parse_arguments, parse_expression
from vicode.xabsl.tokens import DOC, END, NAME, NUMBER
from vicode.xabsl.tree import (
    ActionBlockNode,
    ActionNode,
    AssignmentNode,
    BlockNode,
    CallNode,
    DecisionNode,
    DecisionTreeNode,
    ExpressionNode,
    GotoNode,
    IfNode,
    NameNode,
    StateNode,
    StayNode,
)

_STATE_STARTS = ("state", "initial", "target")


def parse_state(cursor: TokenCursor) -> StateNode:
    """Parse a state.

    Raises:
        XabslSyntaxError: The head of the state is malformed.
    """
    start = cursor.position
    is_initial = cursor.accept("initial")
    is_target = cursor.accept("target")
    if not is_initial and cursor.kind == "initial":
        cursor.add_finding("X651", "initial must precede target", "write initial target state")
        is_initial = cursor.accept("initial")
    cursor.expect("state")
    name = cursor.expect_name("for the state")
    cooperation, robots = "", ""
    if cursor.kind in ("capacity", "synchronized"):
        cooperation = cursor.tokens.texts[cursor.advance()]
        if cooperation == "capacity" or cursor.kind == NUMBER:
            robots = cursor.expect_text(NUMBER, f"for the robots after {cooperation}")
    cursor.expect("{", f"after state {name.text}")
    decision = _decision_with_recovery(cursor) if cursor.kind == "decision" else None
    actions = _actions_of_state(cursor, name)
    if cursor.kind == "decision" and decision is None:
        cursor.add_finding("X604", "decision must precede action", "move it before action")
        decision = _decision_with_recovery(cursor)
    if cursor.kind not in ("}", END):
        cursor.add_finding("X604", f"unexpected text after the actions of state {name.text}", "remove it")
        cursor.skip_to(open_braces=0)
    _expect_closing_brace(cursor, f"at the end of state {name.text}")
    return StateNode(
        *(name, actions, decision, is_initial, is_target, cooperation, robots),
        first_token=start,
        last_token=cursor.position - 1,
    )


def _expect_closing_brace(cursor: TokenCursor, where: str) -> None:
    """Consume the closing brace; at the end of the file, report it and continue."""
    if cursor.kind == END:
        cursor.syntax_error(("}",), where)
    else:
        cursor.expect("}", where)


def _actions_of_state(cursor: TokenCursor, name: NameNode) -> ActionBlockNode:
    if cursor.kind == "action":
        cursor.advance()
        return parse_actions(cursor)
    if cursor.kind == "}":
        cursor.add_finding("X604", f"state {name.text} has no action block", "add action { }, which may be empty")
    else:
        try:
            raise cursor.syntax_error(
                ("action",) if cursor.kind != NAME else ("action", "decision"), f"in state {name.text}"
            )
        except XabslSyntaxError:
            cursor.skip_to("action", *_STATE_STARTS, open_braces=0)
        if cursor.accept("action"):
            return parse_actions(cursor)
    return ActionBlockNode([])


def _decision_with_recovery(cursor: TokenCursor) -> DecisionNode | None:
    start, depth = cursor.advance(), cursor.depth
    try:
        return _decision(cursor, start)
    except XabslSyntaxError:
        cursor.depth = depth
        cursor.skip_to("action", "}", open_braces=cursor.open_braces_since(start))
        return None


def _decision(cursor: TokenCursor, start: int) -> DecisionNode:
    cursor.expect("{", "after decision")
    doc, begins_with_else = "", False
    if cursor.kind == DOC and cursor.kinds[cursor.position + 1] == "else":
        doc = cursor.accept_doc()
    if cursor.kind == "else":
        begins_with_else = True
        cursor.advance()
    tree = parse_decision_tree(cursor, is_open=False)
    cursor.expect("}", "at the end of the decision")
    return DecisionNode(tree, begins_with_else, doc, first_token=start, last_token=cursor.position - 1)


def parse_decision_tree(cursor: TokenCursor, *, is_open: bool) -> DecisionTreeNode:
    """Parse a decision tree; an open one ends without `else`.

    Raises:
        XabslSyntaxError: The decision tree is malformed.
    """
    start, depth = cursor.position, cursor.depth
    cursor.increase_depth()
    tree: DecisionTreeNode
    if cursor.kind == "goto":
        cursor.advance()
        tree = GotoNode(cursor.expect_name("for a state after goto"), first_token=start)
        cursor.expect_semicolon("after goto")
    elif cursor.kind == "stay":
        cursor.advance()
        cursor.expect_semicolon("after stay")
        tree = StayNode(first_token=start)
    elif cursor.kind == "{":
        cursor.advance()
        tree = BlockNode(parse_decision_tree(cursor, is_open=is_open), first_token=start)
        cursor.expect("}", "after the decision")
    else:
        tree = _if(cursor, is_open=is_open)
    tree.last_token = cursor.position - 1
    cursor.depth = depth
    return tree


def _if(cursor: TokenCursor, *, is_open: bool) -> IfNode:
    """Parse a chain of `if` and `else if` iteratively: it may be long."""
    chain: list[IfNode] = []
    last: DecisionTreeNode | None = None
    while True:
        start, doc = cursor.position, cursor.accept_doc()
        if cursor.kind != "if":
            if chain and not doc:
                last = parse_decision_tree(cursor, is_open=is_open)
                break
            raise cursor.syntax_error(("if", "goto", "stay", "{"))
        cursor.advance()
        condition = _condition(cursor)
        chain.append(IfNode(condition, parse_decision_tree(cursor, is_open=False), None, doc, first_token=start))
        cursor.increase_depth()
        has_doc = cursor.kind == DOC
        if cursor.kinds[cursor.position + has_doc] != "else":
            if not is_open:
                cursor.add_finding("X604", "an if without else", "add else, for example: else stay;")
                raise XabslSyntaxError
            break
        chain[-1].else_doc = cursor.accept_doc()
        cursor.advance()
        if cursor.kind not in ("if", DOC):
            last = _final_else(cursor, is_open=is_open)
            break
    for node in reversed(chain):
        node.otherwise, last = last, node
        node.last_token = cursor.position - 1
    return chain[0]


def _final_else(cursor: TokenCursor, *, is_open: bool) -> DecisionTreeNode:
    if is_open and cursor.kind not in ("{", "if"):
        cursor.add_finding(
            "X604", "a common decision cannot end in else", "remove the else: the decision of the state follows there"
        )
        raise XabslSyntaxError
    return parse_decision_tree(cursor, is_open=is_open)


def _condition(cursor: TokenCursor) -> ExpressionNode:
    cursor.expect("(", "after if")
    condition = parse_expression(cursor)
    cursor.expect(")", "after the condition")
    return condition


def parse_actions(cursor: TokenCursor) -> ActionBlockNode:
    """Parse a block of actions. Malformed actions are reported and omitted.

    Raises:
        XabslSyntaxError: The opening brace is missing, or unexpected text precedes the closing one.
    """
    start = cursor.expect("{", "after action")
    actions: list[ActionNode] = []
    while cursor.kind not in ("}", END):
        first, depth = cursor.position, cursor.depth
        try:
            actions.append(_action(cursor))
        except XabslSyntaxError:
            cursor.depth = depth
            cursor.skip_to(";", open_braces=cursor.open_braces_since(first))
            cursor.accept(";")
    _expect_closing_brace(cursor, "at the end of the actions")
    return ActionBlockNode(actions, first_token=start, last_token=cursor.position - 1)


def _action(cursor: TokenCursor) -> ActionNode:
    name = cursor.expect_name("for a symbol, an option or a basic behavior")
    action: ActionNode
    if cursor.accept("="):
        action = AssignmentNode(name, parse_expression(cursor), first_token=name.first_token)
        cursor.expect_semicolon("after the value")
    else:
        kind = cursor.tokens.texts[cursor.advance()] if cursor.kind in ("option", "behavior") else ""
        if cursor.kind != "(":
            raise cursor.syntax_error(("=", "("), f"after {name.text}")
        action = CallNode(name, parse_arguments(cursor), kind, first_token=name.first_token)
        cursor.expect_semicolon("after the call")
    action.last_token = cursor.position - 1
    return action
