"""Everything of a library by name: states, transitions, components, declarations, commands; and what a query means."""

import heapq
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from re import Pattern

from vicode.editor.session.fuzzy_match import Alignment, align, subsequence_pattern
from vicode.editor.session.library import Library
from vicode.editor.session.workspace import Workspace
from vicode.editor.view import ItemRef, transition_key, transition_label
from vicode.model.design import COMMON, Declaration, Design, Transition
from vicode.model.traversal import iter_transitions

MAX_RESULTS = 50
_MAX_QUERY_LENGTH, _MAX_WORDS = 100, 6
# What the places of the letters weigh against the rough score.
_ALIGNMENT_WEIGHT = 30.0
# What the same letters more likely mean.
_SAME_DESIGN_BONUS, _LENGTH_PENALTY = 12.0, 0.2
_WHOLE, _AT_START, _AT_WORD, _INSIDE, _SPREAD = 130.0, 100.0, 80.0, 45.0, 40.0
# A word of a doc is rather meant than letters spread over a name; letters inside such a word are not.
_CONTEXT_WORD, _CONTEXT_INSIDE = 72.0, 20.0


class SearchKind(StrEnum):
    """What is found; the values are words that people read."""

    COMMAND = "command"
    COMPONENT = "component"
    STATE = "state"
    USE = "used component"
    DECLARATION = "declaration"
    TRANSITION = "transition"


_WEIGHTS = {
    SearchKind.COMPONENT: 8.0,
    SearchKind.STATE: 6.0,
    SearchKind.COMMAND: 4.0,
    SearchKind.USE: 2.0,
    SearchKind.DECLARATION: 1.0,
}


@dataclass(frozen=True, slots=True, kw_only=True)
class SearchTarget:
    """Where a thing is: the design of a component in a project, and what to select there."""

    project: str
    component: str
    selected: ItemRef | None = None


@dataclass(frozen=True, slots=True)
class SearchItem:
    """Something that can be found: `title` is ranked fuzzily, `detail` and `location` as they are written."""

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
        """Keep what is compared in small letters."""
        object.__setattr__(self, "title_lower", self.title.lower())
        object.__setattr__(self, "context_lower", f"{self.detail}\n{self.location}".lower())


@dataclass(frozen=True, slots=True, kw_only=True)
class SearchMatch:
    """A thing that was meant, and which letters of its title were found."""

    item: SearchItem
    positions: tuple[int, ...] = ()


class SearchIndex:
    """The things of a library; what has not changed since the last question is not listed again."""

    def __init__(self, library: Library) -> None:
        """Begin with nothing listed."""
        self._library = library
        self._listed: dict[tuple[str, str], tuple[Design, tuple[SearchItem, ...]]] = {}

    def items(self) -> list[SearchItem]:
        """All of them, as the designs are now."""
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
    """The things that a query means, the likeliest first.

    Args:
        things: What there is.
        query: Words; each must be found in a thing. Without any, what is near.
        here: The design that is open: its things come before equal ones of others.
        most: How many are wanted.
    """
    words = query.lower()[:_MAX_QUERY_LENGTH].split()[:_MAX_WORDS]
    asked = [(word, subsequence_pattern(word)) for word in words]
    scored = ((score, thing) for thing in items if (score := _quick_score(asked, thing, here)) is not None)
    # What a glance finds best is looked at closely; sorting all of thousands that closely would be felt.
    best = heapq.nlargest(2 * limit, scored, key=lambda pair: pair[0])
    looked = [(_refined_score(words, score, thing), thing) for score, thing in best]
    looked.sort(key=lambda pair: -pair[0].score)
    return tuple(SearchMatch(item=thing, positions=found.positions) for found, thing in looked[:limit])


def _quick_score(
    asked: Sequence[tuple[str, Pattern[str]]], thing: SearchItem, here: SearchTarget | None
) -> float | None:
    """A rough score, None for what does not match; this runs for every thing at every key."""
    score = _WEIGHTS.get(thing.kind, 0.0) - len(thing.title) * _LENGTH_PENALTY
    for word, letters in asked:
        at = thing.title_lower.find(word)
        if at == 0:
            score += _WHOLE if len(word) == len(thing.title_lower) else _AT_START
        elif at > 0:
            is_word = not thing.title_lower[at - 1].isalnum() or thing.title[at : at + 1].isupper()
            score += _AT_WORD if is_word else _INSIDE
        elif (
            beside := _context_score(word, thing, is_spread=letters.match(thing.title_lower) is not None)
        ) is not None:
            score += beside
        else:
            return None
    goal = thing.target
    if here is not None and goal is not None and (goal.project, goal.component) == (here.project, here.component):
        score += _SAME_DESIGN_BONUS
    return score


def _context_score(word: str, thing: SearchItem, *, is_spread: bool) -> float | None:
    """The score of a word that is not in the title as it is."""
    if _starts_word_in_context(word, thing):
        return _CONTEXT_WORD
    if is_spread:
        return _SPREAD
    return _CONTEXT_INSIDE if word in thing.context_lower else None


def _starts_word_in_context(word: str, thing: SearchItem) -> bool:
    at = thing.context_lower.find(word)
    return at >= 0 and not thing.context_lower[at - 1 : at].isalnum()


def _refined_score(words: Sequence[str], glance: float, thing: SearchItem) -> Alignment:
    """The score of a glance refined by how well the letters lie in the title."""
    places: set[int] = set()
    score = glance
    for word in words:
        # Letters spread over the title by chance say nothing where the word itself stands beside it.
        is_by_chance = word not in thing.title_lower and _starts_word_in_context(word, thing)
        found = None if is_by_chance else align(word, thing.title)
        if found is not None:
            score += _ALIGNMENT_WEIGHT * found.score / len(word)
            places.update(found.positions)
    return Alignment(score=score, positions=tuple(sorted(places)))


def _hand_written_items(workspace: Workspace) -> Iterator[SearchItem]:
    """Components without a design lead to a design that uses them."""
    for component in workspace.project.components:
        used = ((design, use) for design in workspace.project.designs for use in design.uses)
        design, use = next(((each, use) for each, use in used if use.component == component.component), (None, None))
        if design is not None and use is not None:
            goal = SearchTarget(
                project=workspace.key, component=design.component, selected=ItemRef(kind="components", id=use.alias)
            )
            where = f"hand-written, used by {design.component}"
            yield SearchItem(SearchKind.COMPONENT, component.component, component.doc, where, goal)


def _design_items(key: str, design: Design, suffix: str) -> Iterator[SearchItem]:
    component = design.component
    where = component + suffix

    def goal(of: str = "", id_: str = "") -> SearchTarget:
        return SearchTarget(project=key, component=component, selected=ItemRef(kind=of, id=id_) if of else None)

    yield SearchItem(SearchKind.COMPONENT, component, design.doc, suffix.removeprefix(" · "), goal())
    for state in design.states:
        yield SearchItem(SearchKind.STATE, state.name, state.doc, where, goal("states", state.name))
    for use in design.uses:
        yield SearchItem(SearchKind.USE, use.alias, use.component, where, goal("components", use.alias))
    for section, declaration in design.declarations():
        yield SearchItem(SearchKind.DECLARATION, declaration.name, _words_of(section, declaration), where, goal())
    for located in iter_transitions(design):
        transition = located.decision
        assert isinstance(transition, Transition)
        source = "every state" if located.source == COMMON else located.source
        detail = " – ".join(part for part in (transition.doc, transition_label(located)) if part)
        target = goal("transitions", transition_key(located.path))
        yield SearchItem(SearchKind.TRANSITION, f"{source} → {transition.to}", detail, where, target)


def _words_of(section: str, declaration: Declaration) -> str:
    what = " ".join(part for part in (section.removesuffix("s"), declaration.type, declaration.unit) if part)
    return f"{what} – {declaration.doc}" if declaration.doc else what
