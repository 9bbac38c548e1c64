"""The search index of a library: states, transitions, components, declarations and commands, and their ranking."""

import heapq
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from re import Pattern

from vicode.editor.session.library import Library
from vicode.editor.session.search.fuzzy_match import Alignment, align, subsequence_pattern
from vicode.editor.session.workspace import Workspace
from vicode.editor.view import ItemKind, ItemRef, transition_label
from vicode.model.decision_keys import transition_key
from vicode.model.design import COMMON, Declaration, Design, Transition
from vicode.model.traversal import iter_transitions

MAX_RESULTS = 50
_MAX_QUERY_LENGTH, _MAX_WORDS = 100, 6
# The weight of the alignment score relative to the quick score.
_ALIGNMENT_WEIGHT = 30.0

_SAME_DESIGN_BONUS, _LENGTH_PENALTY = 12.0, 0.2
_WHOLE, _AT_START, _AT_WORD, _INSIDE, _SPREAD = 130.0, 100.0, 80.0, 45.0, 40.0
# A word start in the context ranks above letters spread over the title, a match inside a word of the context below.
_CONTEXT_WORD, _CONTEXT_INSIDE = 72.0, 20.0


class SearchKind(StrEnum):
    """The kind of an item, as shown to users."""

    COMMAND = "command"
    COMPONENT = "component"
    STATE = "state"
    USE = "used component"
    DECLARATION = "declaration"
    TRANSITION = "transition"
    FRAME = "frame"
    NOTE = "note"


_WEIGHTS = {
    SearchKind.COMPONENT: 8.0,
    SearchKind.STATE: 6.0,
    SearchKind.COMMAND: 4.0,
    SearchKind.USE: 2.0,
    SearchKind.DECLARATION: 1.0,
}


@dataclass(frozen=True, slots=True, kw_only=True)
class SearchTarget:
    """The location of an item: a design in a project, and the selection there."""

    project: str
    component: str
    selected: ItemRef | None = None


@dataclass(frozen=True, slots=True)
class SearchItem:
    """An item of the index; `title` is matched fuzzily, `detail` and `location` by substring."""

    kind: SearchKind
    title: str
    detail: str = ""
    location: str = ""
    target: SearchTarget | None = None
    command: str = ""
    keys: str = ""
    title_lower: str = field(init=False, repr=False)
    context_lower: str = field(init=False, repr=False)

    def __post_init__(self) -> None:

        object.__setattr__(self, "title_lower", self.title.lower())
        object.__setattr__(self, "context_lower", f"{self.detail}\n{self.location}".lower())


@dataclass(frozen=True, slots=True, kw_only=True)
class SearchMatch:
    """A matching item, and the positions of the matched letters in its title."""

    item: SearchItem
    positions: tuple[int, ...] = ()


class SearchIndex:
    """The items of a library, cached by design."""

    def __init__(self, library: Library) -> None:
        self._library = library
        self._listed: dict[tuple[str, str], tuple[Design, tuple[SearchItem, ...]]] = {}

    def items(self) -> list[SearchItem]:
        listed: dict[tuple[str, str], tuple[Design, tuple[SearchItem, ...]]] = {}
        found: list[SearchItem] = []
        several = len(self._library.workspaces) > 1
        for workspace in self._library.workspaces:
            found += _hand_written_items(workspace)
            for design in workspace.project.designs:
                key = workspace.key, design.component
                known = self._listed.get(key)
                if known is None or known[0] is not design:
                    suffix = f" · {workspace.project.name}" if several else ""
                    known = design, tuple(_design_items(workspace.key, design, suffix))
                listed[key] = known
                found += known[1]
        self._listed = listed
        return found


def rank_items(
    items: Iterable[SearchItem], query: str, here: SearchTarget | None = None, limit: int = MAX_RESULTS
) -> tuple[SearchMatch, ...]:
    """The best matches of a query, sorted by score.

    Args:
        items: The items to search.
        query: Words that must all match. An empty query matches everything.
        here: The open design, whose items are preferred.
        limit: The maximum number of matches.
    """
    words = query.lower()[:_MAX_QUERY_LENGTH].split()[:_MAX_WORDS]
    patterns = [(word, subsequence_pattern(word)) for word in words]
    scored = ((score, item) for item in items if (score := _quick_score(patterns, item, here)) is not None)
    # Aligning thousands of items would be noticeable, so only the best by the quick score are aligned.
    best = heapq.nlargest(2 * limit, scored, key=lambda pair: pair[0])
    refined = [(_refined_score(words, score, item), item) for score, item in best]
    refined.sort(key=lambda pair: -pair[0].score)
    return tuple(SearchMatch(item=item, positions=alignment.positions) for alignment, item in refined[:limit])


def _quick_score(
    patterns: Sequence[tuple[str, Pattern[str]]], item: SearchItem, here: SearchTarget | None
) -> float | None:
    """A quick score, None if the item does not match; runs for every item at every keystroke."""
    score = _WEIGHTS.get(item.kind, 0.0) - len(item.title) * _LENGTH_PENALTY
    for word, letters in patterns:
        position = item.title_lower.find(word)
        if position == 0:
            score += _WHOLE if len(word) == len(item.title_lower) else _AT_START
        elif position > 0:
            is_word = not item.title_lower[position - 1].isalnum() or item.title[position : position + 1].isupper()
            score += _AT_WORD if is_word else _INSIDE
        elif (context := _context_score(word, item, is_spread=letters.match(item.title_lower) is not None)) is not None:
            score += context
        else:
            return None
    target = item.target
    if here is not None and target is not None and (target.project, target.component) == (here.project, here.component):
        score += _SAME_DESIGN_BONUS
    return score


def _context_score(word: str, item: SearchItem, *, is_spread: bool) -> float | None:
    """The score of a word that is no substring of the title."""
    if _starts_word_in_context(word, item):
        return _CONTEXT_WORD
    if is_spread:
        return _SPREAD
    return _CONTEXT_INSIDE if word in item.context_lower else None


def _starts_word_in_context(word: str, item: SearchItem) -> bool:
    at = item.context_lower.find(word)
    return at >= 0 and not item.context_lower[at - 1 : at].isalnum()


def _refined_score(words: Sequence[str], quick_score: float, item: SearchItem) -> Alignment:
    """The quick score plus the alignment of the query with the title."""
    positions: set[int] = set()
    score = quick_score
    for word in words:
        # If the word is in the context, letters spread over the title match by chance.
        is_by_chance = word not in item.title_lower and _starts_word_in_context(word, item)
        found = None if is_by_chance else align(word, item.title)
        if found is not None:
            score += _ALIGNMENT_WEIGHT * found.score / len(word)
            positions.update(found.positions)
    return Alignment(score=score, positions=tuple(sorted(positions)))


def _hand_written_items(workspace: Workspace) -> Iterator[SearchItem]:
    """The components without a design; their target is a design that uses them."""
    for component in workspace.project.components:
        used = ((design, use) for design in workspace.project.designs for use in design.uses)
        design, use = next((pair for pair in used if pair[1].component == component.component), (None, None))
        if design is not None and use is not None:
            target = SearchTarget(
                project=workspace.key, component=design.component, selected=ItemRef(kind="components", id=use.alias)
            )
            location = f"hand-written, used by {design.component}"
            yield SearchItem(SearchKind.COMPONENT, component.component, component.doc, location, target)


def _design_items(key: str, design: Design, suffix: str) -> Iterator[SearchItem]:
    component = design.component
    location = component + suffix

    def make_target(of: ItemKind | None = None, id_: str = "") -> SearchTarget:
        return SearchTarget(project=key, component=component, selected=ItemRef(kind=of, id=id_) if of else None)

    yield SearchItem(SearchKind.COMPONENT, component, design.doc, suffix.removeprefix(" · "), make_target())
    for state in design.states:
        yield SearchItem(SearchKind.STATE, state.name, state.doc, location, make_target("states", state.name))
    for use in design.uses:
        yield SearchItem(SearchKind.USE, use.alias, use.component, location, make_target("components", use.alias))
    for frame in design.frames:
        yield SearchItem(
            SearchKind.FRAME, frame.name, ", ".join(frame.states), location, make_target("frames", frame.name)
        )
    for note in design.notes:
        first, _break, rest = note.text.strip().partition("\n")
        yield SearchItem(SearchKind.NOTE, first, rest, location, make_target("notes", note.name))
    conditions = {latch.name: f" – {latch.on} – {latch.off}".removesuffix(" – ") for latch in design.latches}
    for section, declaration in design.declarations():
        detail = _declaration_detail(section, declaration) + conditions.get(declaration.name, "")
        yield SearchItem(SearchKind.DECLARATION, declaration.name, detail, location, make_target())
    for located in iter_transitions(design):
        transition = located.decision
        assert isinstance(transition, Transition)
        source = "every state" if located.source == COMMON else located.source
        detail = " – ".join(part for part in (transition.doc, transition_label(located)) if part)
        target = make_target("transitions", transition_key(located.path))
        yield SearchItem(SearchKind.TRANSITION, f"{source} → {transition.to}", detail, location, target)


def _declaration_detail(section: str, declaration: Declaration) -> str:
    what = " ".join(part for part in (section.removesuffix("s"), declaration.type, declaration.unit) if part)
    return f"{what} – {declaration.doc}" if declaration.doc else what
