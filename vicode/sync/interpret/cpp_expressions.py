"""Parses the C++ expressions and simple statements that generated code consists of."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from vicode.cpp_tokens import COMMENT, NUMBER, STRING, WORD, CppToken

_WORDS = {"and": "&&", "or": "||", "not": "!", "not_eq": "!="}
_LEVELS = {
    "||": 1,
    "&&": 2,
    "==": 3,
    "!=": 3,
    "<": 4,
    ">": 4,
    "<=": 4,
    ">=": 4,
    "+": 5,
    "-": 5,
    "*": 6,
    "/": 6,
    "%": 6,
}
_ASSIGNMENTS = frozenset({"=", "+=", "-=", "*=", "/="})
_CASTS = {"double": "float", "std::int64_t": "int", "int64_t": "int", "bool": "bool"}
"""Types that a value may be converted to, and their names in designs."""
_ARGUMENT_NAME = re.compile(r"/\*\w+=\*/")


@dataclass(frozen=True, slots=True)
class CppNode:
    """A node of a syntax tree: its kind, its operator, name or literal, and its operands.

    Kinds: number, text, name, member, call, list, unary, binary, choice, cast; of statements: assign, return.
    """

    kind: str
    text: str = ""
    parts: "tuple[CppNode, ...]" = ()


def parse_statement(tokens: Sequence[CppToken]) -> CppNode:
    """Parse an assignment, a `return`, or an expression, with or without its semicolon.

    Raises:
        SyntaxError: It is another statement, or contains a comment.
    """
    words = [token for token in tokens if not is_argument_name(token)]
    if words and words[-1].text == ";":
        words = words[:-1]
    if words and words[0].text == "return":
        rest = words[1:]
        return CppNode("return", "", (parse_expression(rest),) if rest else ())
    if len(words) > 1 and words[0].text in ("++", "--"):
        return CppNode("assign", f"{words[0].text[0]}=", (parse_expression(words[1:]), CppNode("number", "1")))
    if len(words) > 1 and words[-1].text in ("++", "--"):
        return CppNode("assign", f"{words[-1].text[0]}=", (parse_expression(words[:-1]), CppNode("number", "1")))
    at = next((at for at, token in enumerate(words) if token.text in _ASSIGNMENTS), -1)
    if at > 0:
        return CppNode("assign", words[at].text, (parse_expression(words[:at]), parse_expression(words[at + 1 :])))
    return parse_expression(words)


def parse_expression(tokens: Sequence[CppToken]) -> CppNode:
    """Parse an expression.

    Raises:
        SyntaxError: It is not one that generated code may contain.
    """
    parser = _Parser([token for token in tokens if not is_argument_name(token)])
    node = parser.expression()
    if parser.word:
        raise SyntaxError(f"unexpected {parser.word}")
    return node


def is_argument_name(token: CppToken) -> bool:
    """Whether a token is a comment with the name of a parameter, which is generated."""
    return token.kind == COMMENT and bool(_ARGUMENT_NAME.fullmatch(token.text))


class _Parser:
    def __init__(self, tokens: Sequence[CppToken]) -> None:
        self._tokens, self._at = tokens, 0

    @property
    def word(self) -> str:
        """The next token; empty at the end."""
        if self._at >= len(self._tokens):
            return ""
        text = self._tokens[self._at].text
        return _WORDS.get(text, text)

    def expression(self) -> CppNode:
        test = self._binary(1)
        if self.word != "?":
            return test
        self._take("?")
        then = self.expression()
        self._take(":")
        return CppNode("choice", "", (test, then, self.expression()))

    def _binary(self, level: int) -> CppNode:
        left = self._unary()
        while (own := _LEVELS.get(self.word, 0)) >= level:
            operator = self._take()
            left = CppNode("binary", operator, (left, self._binary(own + 1)))
        return left

    def _unary(self) -> CppNode:
        if self.word in ("!", "-"):
            return CppNode("unary", self._take(), (self._unary(),))
        return self._postfix(self._primary())

    def _primary(self) -> CppNode:
        kind = self._tokens[self._at].kind if self.word else ""
        if kind in (NUMBER, STRING):
            return CppNode("number" if kind == NUMBER else "text", self._take())
        if self.word == "(":
            return self._in_brackets()
        if self.word == "static_cast":
            self._take()
            self._take("<")
            type_ = self._path()
            self._take(">")
            return CppNode("cast", _cast(type_), self._list("(", ")", self.expression, count=1))
        if kind == WORD or self.word == "::":
            path = self._path()
            if path == "this" and self.word == "->":
                self._take()
                return CppNode("name", self._path())
            if path in _CASTS and self.word in ("(", "{"):
                closing = ")" if self.word == "(" else "}"
                return CppNode("cast", _CASTS[path], self._list(self.word, closing, self.expression, count=1))
            return CppNode("name", path)
        raise SyntaxError(f"unexpected {self.word or 'end'}")

    def _in_brackets(self) -> CppNode:
        start = self._at
        self._take("(")
        if self.word in ("double", "std", "int64_t", "bool"):
            type_ = self._path()
            if type_ in _CASTS and self.word == ")":
                self._take()
                return CppNode("cast", _CASTS[type_], (self._unary(),))
            self._at = start
            self._take("(")
        node = self.expression()
        self._take(")")
        return node

    def _postfix(self, node: CppNode) -> CppNode:
        while self.word in (".", "("):
            if self.word == ".":
                self._take()
                node = CppNode("member", self._path(), (node,))
            else:
                node = CppNode("call", "", (node, *self._list("(", ")", self._argument)))
        return node

    def _argument(self) -> CppNode:
        return CppNode("list", "", self._list("{", "}", self._argument)) if self.word == "{" else self.expression()

    def _list(self, opening: str, closing: str, item: Callable[[], CppNode], count: int = -1) -> tuple[CppNode, ...]:
        self._take(opening)
        items: list[CppNode] = []
        while self.word != closing:
            items.append(item())
            if self.word != closing:
                self._take(",")
        self._take(closing)
        if count >= 0 and len(items) != count:
            raise SyntaxError(f"{count} operands expected")
        return tuple(items)

    def _path(self) -> str:
        parts = [self._take()] if self.word == "::" else []
        parts.append(self._name())
        while self.word == "::":
            parts += [self._take(), self._name()]
        return "".join(parts)

    def _name(self) -> str:
        if not self.word or self._tokens[self._at].kind != WORD:
            raise SyntaxError(f"unexpected {self.word or 'end'}")
        return self._take()

    def _take(self, expected: str = "") -> str:
        word = self.word
        if not word or (expected and word != expected):
            raise SyntaxError(f"{expected or 'more'} expected, not {word or 'the end'}")
        self._at += 1
        return word


def _cast(type_: str) -> str:
    if type_ not in _CASTS:
        raise SyntaxError(f"a conversion to {type_}")
    return _CASTS[type_]


def path_of(node: CppNode) -> str:
    """Return the text of a name with its owners, and of a call without arguments; empty for any other node."""
    match node:
        case CppNode(kind="name", text=text):
            return text
        case CppNode(kind="member", text=text, parts=(owner,)):
            path = path_of(owner)
            return f"{path}.{text}" if path else ""
        case CppNode(kind="call", parts=(callee,)):
            path = path_of(callee)
            return f"{path}()" if path else ""
        case _:
            return ""
