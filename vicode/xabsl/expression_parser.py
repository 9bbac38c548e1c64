"""Parses expressions with the precedence of the original: unary, * / %, + -, comparisons, &&, ||, ? :."""

from vicode.xabsl.cursor import TokenCursor, XabslSyntaxError
from vicode.xabsl.tokens import NAME, NUMBER
from vicode.xabsl.tree import (
    ArgumentListNode,
    ArgumentNode,
    BinaryNode,
    ConditionalNode,
    ExpressionNode,
    FunctionCallNode,
    KeywordNode,
    NameNode,
    NumberNode,
    ParenthesizedNode,
    ReferenceNode,
    UnaryNode,
)

_COMPARISON = 3
_PRECEDENCE = {
    "||": 1,
    "&&": 2,
    **dict.fromkeys(("<", ">", "<=", ">=", "==", "!="), _COMPARISON),
    "+": 4,
    "-": 4,
    "*": 5,
    "/": 5,
    "%": 5,
}
_KEYWORD_OPERANDS = frozenset(("true", "false", "state_time", "option_time", "action_done", "conflict"))
_UNARY_OPERATORS = frozenset("-!")


def parse_expression(cursor: TokenCursor) -> ExpressionNode:
    """Parse an expression.

    Raises:
        XabslSyntaxError: There is no expression, or it is malformed.
    """
    start = cursor.position
    cursor.increase_depth()
    condition = _binary(cursor, 1)
    if cursor.kind == "?":
        cursor.advance()
        yes = parse_expression(cursor)
        cursor.expect(":", "between the two values")
        first = cursor.position
        no = parse_expression(cursor)
        if isinstance(no, ConditionalNode):
            cursor.add_finding("X651", "a ? : in the last branch of another", "put it in parentheses", token=first)
        condition = ConditionalNode(condition, yes, no, first_token=start, last_token=cursor.position - 1)
    cursor.depth -= 1
    return condition


def _binary(cursor: TokenCursor, least: int) -> ExpressionNode:
    start, depth = cursor.position, cursor.depth
    left = _unary(cursor)
    while (power := _PRECEDENCE.get(cursor.kind, 0)) >= least:
        operator, sign = cursor.kind, cursor.advance()
        # A chain of operators is nested to the left, so its length counts as depth.
        cursor.increase_depth()
        left = BinaryNode(
            operator,
            left,
            _binary(cursor, power + 1),
            operator_token=sign,
            first_token=start,
            last_token=cursor.position - 1,
        )
        if power == _COMPARISON and _PRECEDENCE.get(cursor.kind) == _COMPARISON:
            cursor.add_finding("X604", "comparisons cannot be chained", "join two comparisons with &&")
            raise XabslSyntaxError
    cursor.depth = depth
    return left


def _unary(cursor: TokenCursor) -> ExpressionNode:
    kind = cursor.kind
    if kind not in _UNARY_OPERATORS:
        return _operand(cursor, kind)
    start = cursor.advance()
    cursor.increase_depth()
    operand = _unary(cursor)
    cursor.depth -= 1
    return UnaryNode(kind, operand, first_token=start, last_token=cursor.position - 1)


def _operand(cursor: TokenCursor, kind: str) -> ExpressionNode:
    start = cursor.position
    if kind == NAME:
        text = cursor.tokens.texts[cursor.advance()]
        if cursor.kind != "(":
            return ReferenceNode(text, first_token=start, last_token=start)
        arguments = parse_arguments(cursor)
        return FunctionCallNode(
            NameNode(text, first_token=start, last_token=start),
            arguments,
            first_token=start,
            last_token=cursor.position - 1,
        )
    if kind == NUMBER:
        cursor.advance()
        return _number(cursor, start)
    if kind in _KEYWORD_OPERANDS:
        cursor.advance()
        return KeywordNode(kind, first_token=start, last_token=start)
    if kind == "(":
        cursor.advance()
        inner = parse_expression(cursor)
        cursor.expect(")", "after the expression")
        return ParenthesizedNode(inner, first_token=start, last_token=cursor.position - 1)
    raise cursor.syntax_error(("an expression",))


def _number(cursor: TokenCursor, start: int) -> NumberNode:
    text, next_text = cursor.tokens.texts[start], cursor.tokens.texts[cursor.position]
    is_joined = cursor.tokens.starts[start] + len(text) == cursor.tokens.starts[cursor.position]
    if cursor.kind == NAME and is_joined:
        fix = "write it without an exponent" if next_text[0] in "eE" else "write a space or an operator between them"
        cursor.add_finding("X604", f"a number is followed directly by {next_text[:20]}", fix)
        cursor.advance()
    return NumberNode(text, first_token=start, last_token=start)


def parse_arguments(cursor: TokenCursor) -> ArgumentListNode:
    """Parse a list of named arguments in parentheses.

    Raises:
        XabslSyntaxError: The list is malformed.
    """
    start = cursor.expect("(")
    arguments: list[ArgumentNode] = []
    ends_with_comma = False
    while cursor.kind != ")":
        name = cursor.expect_name("for a parameter")
        if cursor.kind != "=":
            cursor.add_finding(
                "X604", f"an argument without the name of its parameter: {name.text}", "write parameter = value"
            )
            raise XabslSyntaxError
        cursor.advance()
        value = parse_expression(cursor)
        arguments.append(ArgumentNode(name, value, first_token=name.first_token, last_token=cursor.position - 1))
        ends_with_comma = cursor.accept(",")
        if not ends_with_comma:
            break
    cursor.expect(")", "after the parameters")
    return ArgumentListNode(arguments, ends_with_comma, first_token=start, last_token=cursor.position - 1)
