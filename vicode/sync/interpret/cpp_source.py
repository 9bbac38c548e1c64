"""Splits a C++ file into functions and the rest, and the body of a function into statements."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby, pairwise

from vicode.cpp_tokens import COMMENT, DIRECTIVE, WORD, CppToken, iter_tokens

Tokens = Sequence[CppToken]
PAIRS = {"(": ")", "{": "}", "[": "]"}
"""The brackets, by the one that opens."""
_TYPES = frozenset({"class", "struct", "union", "enum"})
_COMPOUND = frozenset({"for", "while", "do", "switch", "try"})


@dataclass(frozen=True, slots=True, kw_only=True)
class CppItem:
    """A function, or anything else at the level of a namespace.

    Attributes:
        name: The name and the parameters of a function; empty for other items.
        tokens: All tokens, with the comments above and behind it.
        head: The tokens before the body.
        body: The tokens between the braces.
        start: Where the text of the item starts: at the end of the item before.
        end: Where it ends.
    """

    name: str = ""
    tokens: tuple[CppToken, ...]
    head: tuple[CppToken, ...] = ()
    body: tuple[CppToken, ...] = ()
    start: int
    end: int

    @property
    def short_name(self) -> str:
        """The name without class and parameters."""
        return self.name.partition("(")[0].rpartition("::")[2]


def split_items(text: str) -> tuple[CppItem, ...]:
    """Split a file; together, the items have the whole text except spaces at its end.

    Raises:
        SyntaxError: Brackets do not match.
    """
    tokens = tuple(iter_tokens(text))
    items: list[CppItem] = []
    at = 0
    while at < len(tokens):
        first = at
        while at < len(tokens) and tokens[at].kind == COMMENT:
            at += 1
        head, end = _item_end(tokens, at)
        while end < len(tokens) and tokens[end].kind == COMMENT and _is_same_line(text, tokens[end - 1], tokens[end]):
            end += 1
        items.append(_item(tokens, (first, at, head, end), items[-1].end if items else 0))
        at = end
    return tuple(items)


def _item(tokens: Tokens, places: tuple[int, int, int, int], start: int) -> CppItem:
    first, at, head, end = places
    own = tuple(tokens[first:end])
    close = own[-1].end if own else start
    if head < 0:
        return CppItem(tokens=own, start=start, end=close)
    signature = tuple(tokens[at:head])
    last = matching(tokens, head)
    return CppItem(
        name=_function_name(signature),
        tokens=own,
        head=signature,
        body=tuple(tokens[head + 1 : last]),
        start=start,
        end=close,
    )


def _item_end(tokens: Tokens, at: int) -> tuple[int, int]:
    """The brace that opens the body of a function (-1: no function), and the end of an item."""
    if at >= len(tokens):
        return -1, at
    first = tokens[at]
    if first.kind == DIRECTIVE or first.text in ("}", "BICA_BEGIN", "BICA_END"):
        return -1, at + 1
    is_type = is_value = has_parameters = False
    index = at
    while index < len(tokens):
        text = tokens[index].text
        is_type = is_type or (text in _TYPES and not has_parameters)
        is_value = is_value or (text == "=" and not has_parameters)
        if text == ";":
            return -1, index + 1
        if text == "{":
            if first.text in ("namespace", "extern") or (first.text == "inline" and tokens[at + 1].text == "namespace"):
                return -1, index + 1
            is_member = tokens[index - 1].kind == WORD and _has_initializers(tokens[at:index])
            if has_parameters and not is_type and not is_value and not is_member:
                return index, matching(tokens, index) + 1
        if text in PAIRS:
            has_parameters = has_parameters or text == "("
            index = matching(tokens, index)
        elif text in PAIRS.values():
            raise SyntaxError(f"unexpected {text}")
        index += 1
    raise SyntaxError("the last declaration does not end")


def _has_initializers(tokens: Tokens) -> bool:
    """Whether a constructor initializes its members before its body."""
    texts = [token.text for token in tokens]
    return any(pair == (")", ":") for pair in pairwise(texts))


def _function_name(head: Tokens) -> str:
    texts = [token.text for token in head if token.kind != COMMENT]
    opening = texts.index("(")
    start = opening
    while start > 0 and (texts[start - 1] in ("::", "~") or start == opening or texts[start] == "::"):
        start -= 1
    closing = matching(head, next(at for at, token in enumerate(head) if token.text == "("))
    parameters = " ".join(token.text for token in head[: closing + 1] if token.kind != COMMENT).partition(" ( ")[2]
    return "".join(texts[start:opening]) + "(" + parameters


def matching(tokens: Tokens, at: int) -> int:
    """Return the index of the bracket that closes the one at an index.

    Raises:
        SyntaxError: There is none.
    """
    expected: list[str] = []
    for index in range(at, len(tokens)):
        text = tokens[index].text
        if text in PAIRS:
            expected.append(PAIRS[text])
        elif text in PAIRS.values():
            if expected.pop() != text:
                raise SyntaxError(f"unexpected {text}")
            if not expected:
                return index
    raise SyntaxError("a bracket is not closed")


def _is_same_line(text: str, before: CppToken, token: CppToken) -> bool:
    return "\n" not in text[before.end : token.start]


@dataclass(frozen=True, slots=True)
class CppComment:
    """Comments in a row, above the next statement."""

    tokens: tuple[CppToken, ...]


@dataclass(frozen=True, slots=True)
class CppSimple:
    """A statement that is not read any further: up to its semicolon, or with its blocks."""

    tokens: tuple[CppToken, ...]


@dataclass(frozen=True, slots=True)
class CppIf:
    """An `if` without an initialization; `comments` stand between its parts."""

    tokens: tuple[CppToken, ...]
    test: tuple[CppToken, ...]
    then: "tuple[CppStatement, ...]"
    otherwise: "tuple[CppStatement, ...]"
    comments: tuple[CppToken, ...] = ()


CppStatement = CppComment | CppSimple | CppIf


@dataclass(slots=True)
class _Statements:
    """Reads the statements of a sequence of tokens."""

    tokens: Tokens
    at: int = 0

    def read_all(self) -> Iterator[CppStatement]:
        while self.at < len(self.tokens):
            yield self._next()

    def _next(self) -> CppStatement:
        start, token = self.at, self.tokens[self.at]
        if token.kind == COMMENT:
            while self.at < len(self.tokens) and self.tokens[self.at].kind == COMMENT:
                self.at += 1
            return CppComment(tuple(self.tokens[start : self.at]))
        if token.kind == DIRECTIVE:
            self.at += 1
        elif token.text == "if" and (found := self._if()) is not None:
            return found
        elif token.text in (*_COMPOUND, "if", "else"):
            self._skip_compound()
        elif token.text == "{":
            self.at = matching(self.tokens, self.at) + 1
        else:
            self._skip_to_semicolon()
        return CppSimple(tuple(self.tokens[start : self.at]))

    def _skip_to_semicolon(self) -> None:
        while self.at < len(self.tokens):
            text = self.tokens[self.at].text
            if text in PAIRS:
                self.at = matching(self.tokens, self.at)
            self.at += 1
            if text == ";":
                return
        raise SyntaxError("a statement has no semicolon")

    def _skip_compound(self) -> None:
        """Skip the keyword with its conditions, its statement, and what continues it."""
        is_do = self.tokens[self.at].text == "do"
        self.at += 1
        while self.at < len(self.tokens) and self.tokens[self.at].text in ("(", "constexpr"):
            self.at = (matching(self.tokens, self.at) if self.tokens[self.at].text == "(" else self.at) + 1
        if self.at >= len(self.tokens):
            raise SyntaxError("a statement has no body")
        self._next()
        if is_do:
            self._skip_to_semicolon()
        elif self.at < len(self.tokens) and self.tokens[self.at].text in ("else", "catch"):
            self._skip_compound()

    def _if(self) -> CppIf | None:
        """Read an `if`; None, without a step, if it has an initialization or is a constant expression."""
        start = self.at
        if self.at + 1 >= len(self.tokens) or self.tokens[self.at + 1].text != "(":
            return None
        closing = matching(self.tokens, self.at + 1)
        test = self.tokens[self.at + 2 : closing]
        if any(token.text == ";" for token in test):
            return None
        comments: list[CppToken] = []
        self.at = closing + 1
        then = self._branch(comments)
        otherwise: tuple[CppStatement, ...] = ()
        at = self.at
        while at < len(self.tokens) and self.tokens[at].kind == COMMENT:
            at += 1
        if at < len(self.tokens) and self.tokens[at].text == "else":
            comments += self.tokens[self.at : at]
            self.at = at + 1
            otherwise = self._branch(comments)
        own = tuple(self.tokens[start : self.at])
        return CppIf(own, tuple(test), then, otherwise, tuple(comments))

    def _branch(self, comments: list[CppToken]) -> tuple[CppStatement, ...]:
        while self.at < len(self.tokens) and self.tokens[self.at].kind == COMMENT:
            comments.append(self.tokens[self.at])
            self.at += 1
        if self.at >= len(self.tokens):
            raise SyntaxError("an 'if' has no statement")
        if self.tokens[self.at].text != "{":
            return (self._next(),)
        closing = matching(self.tokens, self.at)
        inner = split_statements(self.tokens[self.at + 1 : closing])
        self.at = closing + 1
        return inner


def split_statements(tokens: Tokens) -> tuple[CppStatement, ...]:
    """Split the tokens of a block.

    Raises:
        SyntaxError: They are no statements.
    """
    return tuple(_Statements(tokens).read_all())


def always_ends(statements: Sequence[CppStatement]) -> bool:
    """Whether the end of statements is not reached."""
    match [each for each in statements if not isinstance(each, CppComment)][-1:]:
        case [CppSimple(tokens=tokens)]:
            return tokens[0].text == "return"
        case [CppIf(then=then, otherwise=otherwise)]:
            return bool(otherwise) and always_ends(then) and always_ends(otherwise)
        case _:
            return False


def group_by_function(items: Sequence[CppItem]) -> dict[str, CppItem]:
    """Return the functions by name.

    Raises:
        SyntaxError: Two functions have one name.
    """
    named = [item for item in items if item.name]
    for name, group in groupby(sorted(item.name for item in named)):
        if len(list(group)) > 1:
            raise SyntaxError(f"two functions {name}")
    return {item.name: item for item in named}
