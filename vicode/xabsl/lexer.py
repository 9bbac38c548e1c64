"""Splits a text into tokens. Comments are kept apart, so that the printer can restore them."""

import re
from bisect import bisect_right
from dataclasses import dataclass, field
from functools import cached_property

from vicode.findings import Finding, SourceLocation, get_rule
from vicode.xabsl.tokens import DOC, END, HEADER, KEYWORDS, NAME, NUMBER, RANGE, STRING, TOKEN_PATTERN

_KINDS = {
    "name": NAME,
    "number": NUMBER,
    "string": STRING,
    "open": STRING,
    "range": RANGE,
    "doc": DOC,
    "initial": HEADER,
}
_BLANK_LINE = re.compile(r"\n[ \t\r]*\n\s*")
_LINE_END = re.compile(r"\r*\n|\r")
_COMMENTS = ("line", "block", "initial", "doc")


_TOKEN_ERRORS = {
    "line": ("X651", "a comment at the end of a file without a line break", "end the line"),
    "/**/": (
        "X651",
        "the original compiler reads /**/ as the start of a description",
        "write a space between the asterisks: /* */",
    ),
    "initial": ("X651", "a comment that starts with /*** is allowed only at the start of a file", "start it with /*"),
    "name": ("X651", "the original compiler reads {}- as one name", "write a space: {} -"),
    "close": ("X603", "*/ without a matching /*", "remove it"),
    "/*": ("X602", "a comment that is never closed", "end it with */"),
    "open": ("X601", "a string that is never closed", 'end it with "'),
    "[": ("X601", "a range that is never closed", "end it with ]"),
    "&": ("X601", "a single & is not an operator", "write &&"),
}
"""Findings about invalid tokens: code, message and fix."""


@dataclass(slots=True)
class Comment:
    """A comment with its delimiters, not a description.

    Attributes:
        own_line: Whether it is the first text in its line.
        span: The offsets of its start and end in the text of the file.
    """

    text: str
    own_line: bool
    after_blank_line: bool = field(default=False, compare=False)
    span: tuple[int, int] = field(default=(0, 0), compare=False)


@dataclass
class Tokens:
    """The tokens of a file in parallel lists, which are fastest to iterate over. The last token is the end of the file.

    The kind of a keyword, operator or punctuation mark is its text. `comments` precede the token of the given number.
    """

    file: str
    text: str
    kinds: list[str] = field(default_factory=list)
    texts: list[str] = field(default_factory=list)
    starts: list[int] = field(default_factory=list)
    comments: dict[int, list[Comment]] = field(default_factory=dict)

    @cached_property
    def _line_starts(self) -> list[int]:
        return [0, *(match.end() for match in re.finditer("\n", self.text))]

    def location_at(self, start: int, length: int = 1) -> SourceLocation:
        """The location of a range of characters."""
        line = self.line_at(start)
        end = self._line_starts[line] - 1 if line < len(self._line_starts) else len(self.text)
        # A range of several lines is cut at the end of its first line.
        length = max(1, min(length, end - start))
        return SourceLocation(file=self.file, line=line, column=start - self._line_starts[line - 1] + 1, length=length)

    @cached_property
    def after_blank_lines(self) -> frozenset[int]:
        """Offsets of the first character after each empty line."""
        return frozenset(match.end() for match in _BLANK_LINE.finditer(self.text))

    def line_at(self, start: int) -> int:
        """The 1-based line of a character."""
        return bisect_right(self._line_starts, start)

    def location(self, number: int) -> SourceLocation:
        """The location of a token."""
        return self.location_at(self.starts[number], len(self.texts[number]))


def tokenize(text: str, file: str) -> tuple[Tokens, list[Finding]]:
    """Split a text into tokens; returns them with the findings about its characters."""
    tokens, invalid = Tokens(file, text), list[tuple[str, str, int]]()
    kinds, texts, starts = tokens.kinds, tokens.texts, tokens.starts
    for match in TOKEN_PATTERN.finditer(text):
        group = match.lastgroup or END
        word, start = match[group], match.start(group)
        kind = word if group == "own" or word in KEYWORDS else _KINDS.get(group, "")
        is_empty = (kind == DOC and not word[3:-2].strip()) or (kind == HEADER and not word[4:-2].strip())
        if not kind or is_empty or (group == "initial" and kinds):
            if group == "end":
                break
            if group != "doc" and (kinds or not is_empty):
                invalid.append((group, word, start))
            if group in _COMMENTS:
                _add_comment(tokens, word, start)
            elif text.startswith("/*", start):
                # An unclosed comment extends to the end of the file.
                break
            if word != "&":
                continue
            kind = "&&"
        if kind == DOC and kinds and kinds[-1] == DOC:
            # Of several descriptions in a row the last one counts; the others become comments.
            between = tokens.comments.pop(len(kinds), [])
            kinds.pop()
            _add_comment(tokens, texts.pop(), starts.pop())
            tokens.comments[len(kinds)] += between
        if group == "open" or (group == "name" and kind is word and text.startswith("-", start + len(word))):
            invalid.append((group, word, start))
        kinds.append(kind)
        texts.append(word)
        starts.append(start)
    kinds.append(END)
    texts.append("")
    starts.append(len(text))
    return tokens, [finding for token in invalid for finding in _token_findings(tokens, *token)]


def plain_line_ends(text: str) -> str:
    """The text with a line feed for each line end, also where several carriage returns precede it."""
    return _LINE_END.sub("\n", text)


def _add_comment(tokens: Tokens, word: str, start: int) -> None:
    line = tokens.text.rfind("\n", 0, start) + 1
    is_first = not tokens.text[line:start].strip()
    text = plain_line_ends(word.rstrip())
    # A line comment ends at a line feed; a carriage return in it is a space.
    text = text.replace("\n", " ") if text.startswith("//") else text
    span = (start, start + len(word.rstrip()))
    comment = Comment(text, is_first, start in tokens.after_blank_lines, span=span)
    tokens.comments.setdefault(len(tokens.kinds), []).append(comment)


def _token_findings(tokens: Tokens, group: str, word: str, start: int) -> list[Finding]:
    """Findings about a token that is invalid here or in the original compiler."""
    text = tokens.text
    if group == "line" and start + len(word) < len(text):
        return []
    if group == "bad":
        group = "/*" if text.startswith("/*", start) else word
    elif group == "block":
        group = word
    if group not in _TOKEN_ERRORS and group.startswith("/*"):
        return []
    shown = word if word.isprintable() else f"U+{ord(word[0]):04X}"
    code, message, fix = _TOKEN_ERRORS.get(group, ("X601", "unexpected character {}", "remove it"))
    location = tokens.location_at(start, len(word))
    return [Finding(rule=get_rule(code), message=message.format(shown), fix=fix.format(shown), location=location)]
