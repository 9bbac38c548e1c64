"""Search and replace in the texts of a design: code, expressions and docs."""

from collections.abc import Collection, Iterator
from dataclasses import dataclass, field, replace
from time import monotonic

import regex

from vicode.findings import DesignPath
from vicode.model.design import Design
from vicode.model.lowering import find_origin, is_lowered, source_path
from vicode.model.texts import LocatedText, TextKind, iter_texts, rewrite_text

TIME_LIMIT_S = 1.0
MAX_MATCHES = 2000
SEARCH_TIMEOUT = "the search took too long: simplify the pattern"
_MAX_CONTEXT_LENGTH = 36


@dataclass(frozen=True, slots=True, kw_only=True)
class TextQuery:
    """A text or regular expression, and the kinds of texts to search."""

    text: str
    is_pattern: bool = False
    whole_word: bool = False
    match_case: bool = False
    kinds: frozenset[TextKind] = frozenset(TextKind)


@dataclass(frozen=True, slots=True, kw_only=True)
class TextMatch:
    """A match: the characters `start` to `end` of a text, and the line around them."""

    path: DesignPath
    kind: TextKind
    start: int
    end: int
    line: int
    before: str
    matched: str
    after: str


@dataclass(frozen=True, slots=True, kw_only=True)
class TextSearchResult:
    """All matches in the order of the design; `error` is why there are none, or not all."""

    matches: tuple[TextMatch, ...] = ()
    error: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class ReplaceResult:
    """The design with `count` replacements, or the error message."""

    design: Design
    count: int = 0
    error: str = ""


class _SearchError(Exception):
    """An invalid query, with a message for the user."""


@dataclass(slots=True)
class _Search:
    """A compiled pattern with a deadline."""

    pattern: "regex.Pattern[str]"
    until: float = field(default_factory=lambda: monotonic() + TIME_LIMIT_S)

    def matches(self, text: str) -> "Iterator[regex.Match[str]]":
        """The non-empty matches.

        Raises:
            _SearchError: The deadline has passed; some patterns backtrack exponentially.
        """
        # The timeout must be positive.
        left = max(0.001, self.until - monotonic())
        try:
            # `concurrent` releases the GIL; the timeout also interrupts a single match.
            for match in self.pattern.finditer(text, timeout=left, concurrent=True):
                if match.end() > match.start():
                    yield match
        except TimeoutError:
            raise _SearchError(SEARCH_TIMEOUT) from None


def find_text(design: Design, query: TextQuery) -> TextSearchResult:
    if not query.text:
        return TextSearchResult()
    matches: list[TextMatch] = []
    try:
        search = _Search(_compiled(query))
        for located in _texts(design, query):
            matches += [_make_match(located, *match.span()) for match in search.matches(located.text)]
            if len(matches) > MAX_MATCHES:
                error = f"only the first {MAX_MATCHES} matches are listed"
                return TextSearchResult(matches=tuple(matches[:MAX_MATCHES]), error=error)
    except _SearchError as invalid:
        return TextSearchResult(matches=tuple(matches), error=str(invalid))
    return TextSearchResult(matches=tuple(matches))


def replace_matches(
    design: Design, query: TextQuery, replacement: str, only: Collection[tuple[DesignPath, int]] | None = None
) -> ReplaceResult:
    r"""Replace all matches, or `only` those that start at given offsets of given paths.

    The replacement of a regular expression may refer to groups as `\1` and `\g<name>`.
    """
    if not query.text:
        return ReplaceResult(design=design)
    changed, count = design, 0
    try:
        search = _Search(_compiled(query))
        for located in _texts(design, query):
            wanted = [
                match for match in search.matches(located.text) if only is None or (located.path, match.start()) in only
            ]
            if wanted:
                text = _replaced(located.text, wanted, query, replacement)
                changed = _with_text(changed, located.path, text)
                count += len(wanted)
    except _SearchError as invalid:
        return ReplaceResult(design=design, error=str(invalid))
    return ReplaceResult(design=changed, count=count)


def _with_text(design: Design, path: DesignPath, text: str) -> Design:
    return rewrite_text(design, path, lambda _old: text)


def _texts(design: Design, query: TextQuery) -> Iterator[LocatedText]:
    """The texts of the file: of what is derived from a construct, only the commands, which are at the construct."""
    is_plain = not is_lowered(design)
    for located in iter_texts(design):
        if located.kind not in query.kinds:
            continue
        if is_plain or not find_origin(design, located.path):
            yield located
        elif located.path[2:3] == ("modulates",):
            yield replace(located, path=source_path(design, located.path))


def _compiled(query: TextQuery) -> "regex.Pattern[str]":
    source = query.text if query.is_pattern else regex.escape(query.text, special_only=True)
    if query.whole_word:
        source = rf"(?<!\w)(?:{source})(?!\w)"
    flags = regex.MULTILINE | (0 if query.match_case else regex.IGNORECASE)
    try:
        return regex.compile(source, flags)
    except (regex.error, RecursionError, OverflowError) as error:
        raise _SearchError(f"invalid pattern: {getattr(error, 'msg', error)}") from None


def _replaced(text: str, matches: "list[regex.Match[str]]", query: TextQuery, replacement: str) -> str:
    parts, end = [], 0
    for match in matches:
        parts += [text[end : match.start()], _expanded(match, query, replacement)]
        end = match.end()
    return "".join((*parts, text[end:]))


def _expanded(match: "regex.Match[str]", query: TextQuery, replacement: str) -> str:
    if not query.is_pattern:
        return replacement
    try:
        return str(match.expand(replacement))
    except (regex.error, IndexError, KeyError, ValueError) as error:
        raise _SearchError(f"invalid replacement: {getattr(error, 'msg', error)}") from None


def _make_match(located: LocatedText, start: int, end: int) -> TextMatch:
    text = located.text
    line_start = text.rfind("\n", 0, start) + 1
    line_end = text.find("\n", end)
    line_end = len(text) if line_end < 0 else line_end
    return TextMatch(
        path=located.path,
        kind=located.kind,
        start=start,
        end=end,
        line=text.count("\n", 0, start) + 1,
        before=_shortened(text[line_start:start].lstrip()),
        matched=text[start:end][:200],
        after=text[end:line_end][:120],
    )


def _shortened(text: str) -> str:
    """The end of a text, so that the match after it stays visible."""
    return text if len(text) <= _MAX_CONTEXT_LENGTH else f"…{text[-_MAX_CONTEXT_LENGTH:]}"
