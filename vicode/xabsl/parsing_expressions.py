"""Expressions, by the precedence that the original has: unary, * / %, + -, comparisons, &&, ||, ? :."""

from vicode.xabsl.cursor import Cursor, SyntaxSlipError
from vicode.xabsl.tokens import NAME, NUMBER
from vicode.xabsl.tree import (
    Argument,
    Arguments,
    Binary,
    Conditional,
    Expression,
    Function,
    Name,
    Number,
    Parentheses,
    Ref,
    Unary,
    Word,
)

_COMPARISON = 3
_POWERS = {
    "||": 1,
    "&&": 2,
    **dict.fromkeys(("<", ">", "<=", ">=", "==", "!="), _COMPARISON),
    "+": 4,
    "-": 4,
    "*": 5,
    "/": 5,
    "%": 5,
}
_WORDS = frozenset(("true", "false", "state_time", "option_time", "action_done", "conflict"))
_SIGNS = frozenset("-!")


def parse_expression(cursor: Cursor) -> Expression:
    """The expression that begins here.

    Raises:
        SyntaxSlipError: There is none, or it is not one to its end.
    """
    start = cursor.at
    cursor.enter()
    condition = _binary(cursor, 1)
    if cursor.kind == "?":
        cursor.skip()
        yes = parse_expression(cursor)
        cursor.expect(":", "between the two values")
        first = cursor.at
        no = parse_expression(cursor)
        if isinstance(no, Conditional):
            cursor.complain("X651", "a condition in the last branch of another", "put it in parentheses", at=first)
        condition = Conditional(condition, yes, no, at=start, to=cursor.at - 1)
    cursor.depth -= 1
    return condition


def _binary(cursor: Cursor, least: int) -> Expression:
    start, depth = cursor.at, cursor.depth
    left = _unary(cursor)
    while (power := _POWERS.get(cursor.kind, 0)) >= least:
        operator, sign = cursor.kind, cursor.skip()
        # A chain is nested to the left, as deep as it is long.
        cursor.enter()
        left = Binary(operator, left, _binary(cursor, power + 1), sign=sign, at=start, to=cursor.at - 1)
        if power == _COMPARISON and _POWERS.get(cursor.kind) == _COMPARISON:
            cursor.complain("X604", "comparisons cannot be chained", "join two of them by &&")
            raise SyntaxSlipError
    cursor.depth = depth
    return left


def _unary(cursor: Cursor) -> Expression:
    kind = cursor.kind
    if kind not in _SIGNS:
        return _operand(cursor, kind)
    start = cursor.skip()
    cursor.enter()
    operand = _unary(cursor)
    cursor.depth -= 1
    return Unary(kind, operand, at=start, to=cursor.at - 1)


def _operand(cursor: Cursor, kind: str) -> Expression:
    start = cursor.at
    if kind == NAME:
        text = cursor.tokens.texts[cursor.skip()]
        if cursor.kind != "(":
            return Ref(text, at=start, to=start)
        arguments = parse_arguments(cursor)
        return Function(Name(text, at=start, to=start), arguments, at=start, to=cursor.at - 1)
    if kind == NUMBER:
        cursor.skip()
        return _number(cursor, start)
    if kind in _WORDS:
        cursor.skip()
        return Word(kind, at=start, to=start)
    if kind == "(":
        cursor.skip()
        inner = parse_expression(cursor)
        cursor.expect(")", "after the expression")
        return Parentheses(inner, at=start, to=cursor.at - 1)
    raise cursor.slip(("an expression",))


def _number(cursor: Cursor, start: int) -> Number:
    text, next_text = cursor.tokens.texts[start], cursor.tokens.texts[cursor.at]
    is_joined = cursor.tokens.starts[start] + len(text) == cursor.tokens.starts[cursor.at]
    if cursor.kind == NAME and is_joined:
        mend = "write it without exponent" if next_text[0] in "eE" else "write a blank or an operator between"
        cursor.complain("X604", f"a number cannot go on with {next_text[:20]}", mend)
        cursor.skip()
    return Number(text, at=start, to=start)


def parse_arguments(cursor: Cursor) -> Arguments:
    """What is given in the parentheses that begin here, by name.

    Raises:
        SyntaxSlipError: They are not closed, or hold something else.
    """
    start = cursor.expect("(")
    given: list[Argument] = []
    ends_with_comma = False
    while cursor.kind != ")":
        name = cursor.name("of a parameter")
        if cursor.kind != "=":
            cursor.complain(
                "X604", f"a value without the name of its parameter: {name.text}", "write parameter = value"
            )
            raise SyntaxSlipError
        cursor.skip()
        value = parse_expression(cursor)
        given.append(Argument(name, value, at=name.at, to=cursor.at - 1))
        ends_with_comma = cursor.take(",")
        if not ends_with_comma:
            break
    cursor.expect(")", "after the parameters")
    return Arguments(given, ends_with_comma, at=start, to=cursor.at - 1)
