"""Search and replace in every text of a design: code, expressions and docs."""

from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from time import monotonic

import regex

from vicode.findings import DesignPath
from vicode.model.design import Design
from vicode.model.texts import LocatedText, TextKind, iter_texts, rewrite_text

TIME_LIMIT_S = 1.0
MAX_MATCHES = 2000
_MAX_CONTEXT_LENGTH = 36


@dataclass(frozen=True, slots=True, kw_only=True)
class TextQuery:
    """What is searched for, and where."""

    text: str
    is_pattern: bool = False
    whole_word: bool = False
    match_case: bool = False
    kinds: frozenset[TextKind] = frozenset(TextKind)


@dataclass(frozen=True, slots=True, kw_only=True)
class TextMatch:
    """A place that was found: characters `start` to `end` of a text, and the line around them."""

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
    """All hits in the order of the design; `error` says in words why there are none, or not all."""

    matches: tuple[TextMatch, ...] = ()
    error: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class ReplaceResult:
    """The design with the replacements, how many there were, and a mistake if there is none."""

    design: Design
    count: int = 0
    error: str = ""


class _SearchError(Exception):
    """A mistake of the person who searches, in words."""


@dataclass(slots=True)
class _Search:
    """A pattern with the time that is left for it."""

    pattern: "regex.Pattern[str]"
    until: float = field(default_factory=lambda: monotonic() + TIME_LIMIT_S)

    def matches(self, text: str) -> "Iterator[regex.Match[str]]":
        """The matches that are not empty.

        Raises:
            _MistakeError: It took too long: some patterns try more ways than there is time for.
        """
        # No time left is a very short time: then the first step of a match ends it.
        left = max(0.001, self.until - monotonic())
        try:
            # Other threads go on meanwhile; the limit holds within a single match, too.
            for match in self.pattern.finditer(text, timeout=left, concurrent=True):
                if match.end() > match.start():
                    yield match
        except TimeoutError:
            raise _SearchError("this pattern takes too long: make it simpler") from None


def find_text(design: Design, query: TextQuery) -> TextSearchResult:
    """Every place where a design says what is searched for."""
    if not query.text:
        return TextSearchResult()
    hits: list[TextMatch] = []
    try:
        search = _Search(_compiled(query))
        for placed in _texts(design, query):
            hits += [_hit(placed, *match.span()) for match in search.matches(placed.text)]
            if len(hits) > MAX_MATCHES:
                return TextSearchResult(
                    matches=tuple(hits[:MAX_MATCHES]), error=f"only the first {MAX_MATCHES} are listed"
                )
    except _SearchError as mistake:
        return TextSearchResult(matches=tuple(hits), error=str(mistake))
    return TextSearchResult(matches=tuple(hits))


def replace_matches(
    design: Design, query: TextQuery, replacement: str, only: Collection[tuple[DesignPath, int]] | None = None
) -> ReplaceResult:
    r"""Put a text in the place of every hit, or of those that begin at a character of a path.

    In the replacement of a pattern `\1` and `\g<name>` stand for groups; else it is taken as it is written.
    """
    if not query.text:
        return ReplaceResult(design=design)
    changed, count = design, 0
    try:
        search = _Search(_compiled(query))
        for placed in _texts(design, query):
            wanted = [
                match for match in search.matches(placed.text) if only is None or (placed.path, match.start()) in only
            ]
            if wanted:
                text = _replaced(placed.text, wanted, query, replacement)
                changed = _with_text(changed, placed.path, text)
                count += len(wanted)
    except _SearchError as mistake:
        return ReplaceResult(design=design, error=str(mistake))
    return ReplaceResult(design=changed, count=count)


def _with_text(design: Design, path: DesignPath, text: str) -> Design:
    return rewrite_text(design, path, lambda _old: text)


def _texts(design: Design, query: TextQuery) -> Iterator[LocatedText]:
    return (placed for placed in iter_texts(design) if placed.kind in query.kinds)


def _compiled(query: TextQuery) -> "regex.Pattern[str]":
    source = query.text if query.is_pattern else regex.escape(query.text, special_only=True)
    if query.whole_word:
        source = rf"(?<!\w)(?:{source})(?!\w)"
    flags = regex.MULTILINE | (0 if query.match_case else regex.IGNORECASE)
    try:
        return regex.compile(source, flags)
    except (regex.error, RecursionError, OverflowError) as error:
        raise _SearchError(f"this is no pattern: {getattr(error, 'msg', error)}") from None


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
        raise _SearchError(f"this cannot be put in: {getattr(error, 'msg', error)}") from None


def _hit(placed: LocatedText, start: int, end: int) -> TextMatch:
    text = placed.text
    line_start = text.rfind("\n", 0, start) + 1
    line_end = text.find("\n", end)
    line_end = len(text) if line_end < 0 else line_end
    return TextMatch(
        path=placed.path,
        kind=placed.kind,
        start=start,
        end=end,
        line=text.count("\n", 0, start) + 1,
        before=_shortened(text[line_start:start].lstrip()),
        matched=text[start:end][:200],
        after=text[end:line_end][:120],
    )


def _shortened(text: str) -> str:
    """The end of a text, so that what was found behind it is in view."""
    return text if len(text) <= _MAX_CONTEXT_LENGTH else f"…{text[-_MAX_CONTEXT_LENGTH:]}"
