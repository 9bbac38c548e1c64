"""Everything of a library by name: states, transitions, components, declarations, commands; and what a query means."""

import heapq
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from re import Pattern

from vicode.editor.session.library import Library
from vicode.editor.session.ranking import Alignment, align, subsequence
from vicode.editor.session.workspace import Workspace
from vicode.editor.view import Selected, label_of, transition_key
from vicode.model.design import COMMON, Declaration, Design, Transition
from vicode.model.walks import walk_transitions

MOST = 50
_LONGEST_QUERY, _MOST_WORDS = 100, 6
# What the places of the letters weigh against the rough score.
_CLOSELY = 30.0
# What the same letters more likely mean.
_HERE, _SHORT = 12.0, 0.2
_WHOLE, _AT_START, _AT_WORD, _INSIDE, _SPREAD = 130.0, 100.0, 80.0, 45.0, 40.0
# A word of a doc is rather meant than letters spread over a name; letters inside such a word are not.
_BESIDE_WORD, _BESIDE = 72.0, 20.0


class Kind(StrEnum):
    """What is found; the values are words that people read."""

    COMMAND = "command"
    COMPONENT = "component"
    STATE = "state"
    USE = "used component"
    DECLARATION = "declaration"
    TRANSITION = "transition"


_WEIGHTS = {Kind.COMPONENT: 8.0, Kind.STATE: 6.0, Kind.COMMAND: 4.0, Kind.USE: 2.0, Kind.DECLARATION: 1.0}


@dataclass(frozen=True, slots=True, kw_only=True)
class Goal:
    """Where a thing is: the design of a component in a project, and what to select there."""

    project: str
    component: str
    selected: Selected | None = None


@dataclass(frozen=True, slots=True)
class Thing:
    """Something that can be found: `title` is ranked fuzzily, `detail` and `where` as they are written."""

    kind: Kind
    title: str
    detail: str = ""
    where: str = ""
    goal: Goal | None = None
    command: str = ""
    keys: str = ""
    low: str = field(init=False, repr=False)
    beside: str = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Keep what is compared in small letters."""
        object.__setattr__(self, "low", self.title.lower())
        object.__setattr__(self, "beside", f"{self.detail}\n{self.where}".lower())


@dataclass(frozen=True, slots=True, kw_only=True)
class Match:
    """A thing that was meant, and which letters of its title were found."""

    thing: Thing
    places: tuple[int, ...] = ()


class Index:
    """The things of a library; what has not changed since the last question is not listed again."""

    def __init__(self, library: Library) -> None:
        """Begin with nothing listed."""
        self._library = library
        self._listed: dict[tuple[str, str], tuple[Design, tuple[Thing, ...]]] = {}

    def things(self) -> list[Thing]:
        """All of them, as the designs are now."""
        listed: dict[tuple[str, str], tuple[Design, tuple[Thing, ...]]] = {}
        found: list[Thing] = []
        several = len(self._library.workspaces) > 1
        for workspace in self._library.workspaces:
            found += _hand_written(workspace)
            for design in workspace.project.designs:
                key = workspace.key, design.component
                known = self._listed.get(key)
                if known is None or known[0] is not design:
                    suffix = f" · {workspace.project.name}" if several else ""
                    known = design, tuple(_things_of(workspace.key, design, suffix))
                listed[key] = known
                found += known[1]
        self._listed = listed
        return found


def rank(things: Iterable[Thing], query: str, here: Goal | None = None, most: int = MOST) -> tuple[Match, ...]:
    """The things that a query means, the likeliest first.

    Args:
        things: What there is.
        query: Words; each must be found in a thing. Without any, what is near.
        here: The design that is open: its things come before equal ones of others.
        most: How many are wanted.
    """
    words = query.lower()[:_LONGEST_QUERY].split()[:_MOST_WORDS]
    asked = [(word, subsequence(word)) for word in words]
    scored = ((score, thing) for thing in things if (score := _glance(asked, thing, here)) is not None)
    # What a glance finds best is looked at closely; sorting all of thousands that closely would be felt.
    best = heapq.nlargest(2 * most, scored, key=lambda pair: pair[0])
    looked = [(_look(words, score, thing), thing) for score, thing in best]
    looked.sort(key=lambda pair: -pair[0].score)
    return tuple(Match(thing=thing, places=found.places) for found, thing in looked[:most])


def _glance(asked: Sequence[tuple[str, Pattern[str]]], thing: Thing, here: Goal | None) -> float | None:
    """A rough score, None for what does not match; this runs for every thing at every key."""
    score = _WEIGHTS.get(thing.kind, 0.0) - len(thing.title) * _SHORT
    for word, letters in asked:
        at = thing.low.find(word)
        if at == 0:
            score += _WHOLE if len(word) == len(thing.low) else _AT_START
        elif at > 0:
            is_word = not thing.low[at - 1].isalnum() or thing.title[at : at + 1].isupper()
            score += _AT_WORD if is_word else _INSIDE
        elif (beside := _beside(word, thing, is_spread=letters.match(thing.low) is not None)) is not None:
            score += beside
        else:
            return None
    goal = thing.goal
    if here is not None and goal is not None and (goal.project, goal.component) == (here.project, here.component):
        score += _HERE
    return score


def _beside(word: str, thing: Thing, *, is_spread: bool) -> float | None:
    """The score of a word that is not in the title as it is."""
    if _is_told_beside(word, thing):
        return _BESIDE_WORD
    if is_spread:
        return _SPREAD
    return _BESIDE if word in thing.beside else None


def _is_told_beside(word: str, thing: Thing) -> bool:
    at = thing.beside.find(word)
    return at >= 0 and not thing.beside[at - 1 : at].isalnum()


def _look(words: Sequence[str], glance: float, thing: Thing) -> Alignment:
    """The score of a glance refined by how well the letters lie in the title."""
    places: set[int] = set()
    score = glance
    for word in words:
        # Letters spread over the title by chance say nothing where the word itself stands beside it.
        is_by_chance = word not in thing.low and _is_told_beside(word, thing)
        found = None if is_by_chance else align(word, thing.title)
        if found is not None:
            score += _CLOSELY * found.score / len(word)
            places.update(found.places)
    return Alignment(score=score, places=tuple(sorted(places)))


def _hand_written(workspace: Workspace) -> Iterator[Thing]:
    """Components without a design lead to a design that uses them."""
    for component in workspace.project.components:
        used = ((design, use) for design in workspace.project.designs for use in design.uses)
        design, use = next(((each, use) for each, use in used if use.component == component.component), (None, None))
        if design is not None and use is not None:
            goal = Goal(
                project=workspace.key, component=design.component, selected=Selected(of="components", id=use.alias)
            )
            where = f"hand-written, used by {design.component}"
            yield Thing(Kind.COMPONENT, component.component, component.doc, where, goal)


def _things_of(key: str, design: Design, suffix: str) -> Iterator[Thing]:
    component = design.component
    where = component + suffix

    def goal(of: str = "", id_: str = "") -> Goal:
        return Goal(project=key, component=component, selected=Selected(of=of, id=id_) if of else None)

    yield Thing(Kind.COMPONENT, component, design.doc, suffix.removeprefix(" · "), goal())
    for state in design.states:
        yield Thing(Kind.STATE, state.name, state.doc, where, goal("states", state.name))
    for use in design.uses:
        yield Thing(Kind.USE, use.alias, use.component, where, goal("components", use.alias))
    for section, declaration in design.declarations():
        yield Thing(Kind.DECLARATION, declaration.name, _words_of(section, declaration), where, goal())
    for located in walk_transitions(design):
        transition = located.decision
        assert isinstance(transition, Transition)
        source = "every state" if located.source == COMMON else located.source
        detail = " – ".join(part for part in (transition.doc, label_of(located)) if part)
        target = goal("transitions", transition_key(located.path))
        yield Thing(Kind.TRANSITION, f"{source} → {transition.to}", detail, where, target)


def _words_of(section: str, declaration: Declaration) -> str:
    what = " ".join(part for part in (section.removesuffix("s"), declaration.type, declaration.unit) if part)
    return f"{what} – {declaration.doc}" if declaration.doc else what
