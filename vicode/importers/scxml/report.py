"""Says of each transition of a document how exact the design is.

SCXML takes all transitions that need no event from outside before the next event arrives. A design takes one transition
per iteration, and an input is true for one iteration. So a transition can be late, and an event that arrives while the
design is on its way is lost, unless a queue keeps it.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from enum import StrEnum

from vicode.importers.scxml.actions import Timer
from vicode.importers.scxml.events import ANY, matches, plain
from vicode.importers.scxml.states import ScxmlState
from vicode.importers.xml_reader import Element

START = "Start"
_MAX_EVENTS = 4


class Exactness(StrEnum):
    """How the design takes a transition; a later member is worse."""

    EXACT = "exact"
    LATER = "later"
    LOSSY = "may lose events"
    DIFFERENT = "may differ"


@dataclass(frozen=True, slots=True, kw_only=True)
class TransitionReport:
    """A transition of a document; `line` is its line, `reason` is empty if it is exact."""

    line: int
    transition: str
    exactness: Exactness
    reason: str = ""

    @property
    def text(self) -> str:
        return f"{self.transition}: {self.exactness}{self.reason and f': {self.reason}'}"


@dataclass(frozen=True, slots=True, kw_only=True)
class Reached:
    """Where a transition leads from a state without children.

    Attributes:
        end: The state without children that is entered.
        is_later: Whether it is entered one iteration later, by way of another state.
        is_own: Whether the transition needs no event from outside.
        domain: The innermost state that is not left.
    """

    end: ScxmlState
    is_later: bool
    is_own: bool
    domain: ScxmlState


@dataclass(frozen=True, slots=True)
class _Fact:
    owner: ScxmlState
    element: Element
    reached: Reached | None

    @property
    def events(self) -> list[str]:
        return self.element.get("event", "").split()


@dataclass(slots=True)
class ReportWriter:
    """Collects what the transitions became in each state without children; `starts` are such states by region."""

    starts: dict[ScxmlState, ScxmlState] = field(default_factory=dict)
    _facts: dict[ScxmlState, list[_Fact]] = field(default_factory=dict)
    _start: tuple[ScxmlState, int] | None = None

    def add(self, leaf: ScxmlState, owner: ScxmlState, element: Element, reached: Reached | None = None) -> None:
        """Add a transition as it is taken in a state; without `reached`, it has no target."""
        self._facts.setdefault(leaf, []).append(_Fact(owner, element, reached))

    def add_start(self, leaf: ScxmlState, line: int) -> None:
        """Add that the first state is entered in the second iteration."""
        self._start = (leaf, line)

    def write(
        self, timers: Sequence[Timer], *, has_queue: bool, has_events: bool
    ) -> tuple[tuple[TransitionReport, ...], tuple[tuple[int, str], ...]]:
        """The reports in document order, and notes on the whole document as pairs of line and text."""
        found: dict[int, list[_Fact]] = {}
        for facts in self._facts.values():
            for fact in facts:
                found.setdefault(id(fact.element), []).append(fact)
        reports = [self._report(facts, timers, has_queue=has_queue) for facts in found.values()]
        notes = []
        if self._start is not None:
            leaf, line = self._start
            lost = "" if has_queue else _lose(self._taken_in(leaf, timers), "before that")
            notes.append((line, f"the first state is entered in the second iteration{lost and f'; {lost}'}"))
        if has_events and not has_queue:
            notes.append((1, "of events that arrive before the same iteration, only one is taken"))
        return tuple(sorted(reports, key=lambda each: (each.line, each.transition))), tuple(sorted(notes))

    def _report(self, facts: list[_Fact], timers: Sequence[Timer], *, has_queue: bool) -> TransitionReport:
        exactness, reason = max(
            (self._judge(fact, timers, has_queue=has_queue) for fact in facts),
            key=lambda judged: (list(Exactness).index(judged[0]), len(judged[1])),
        )
        first = facts[0]
        target = first.element.get("target", "").strip()
        on = f" on {' '.join(first.events)}" if first.events else ""
        return TransitionReport(
            line=first.element.line,
            transition=f"{first.owner.name or 'the document'}{on}{f' to {target}' if target else ', without target'}",
            exactness=exactness,
            reason=reason,
        )

    def _judge(self, fact: _Fact, timers: Sequence[Timer], *, has_queue: bool) -> tuple[Exactness, str]:
        used = [timer for timer in timers if any(matches(each, timer.event) for each in fact.events)]
        for timer in used:
            if reason := self._difference(fact, timer):
                return Exactness.DIFFERENT, reason
        reached = fact.reached
        if reached is None or not (reached.is_later or reached.is_own):
            return Exactness.EXACT, ""
        if parallel := self._left_with(fact.owner):
            return Exactness.DIFFERENT, f"'{reached.end.name}' is not entered if '{parallel}' is left in this iteration"
        lost = "" if has_queue else _lose(self._taken_in(reached.end, timers), "in this iteration")
        reasons = (
            "it takes an iteration of its own" if reached.is_own else "",
            f"'{reached.end.name}' is entered one iteration later" if reached.is_later else "",
            lost,
        )
        return Exactness.LOSSY if lost else Exactness.LATER, "; ".join(filter(None, reasons))

    def _left_with(self, state: ScxmlState) -> str:
        """The parallel state that is left while a region of it is on its way; "" if there is none."""
        for each in state.around():
            left = (fact for fact in self._facts.get(each, ()) if each.regions and each is not state and fact.reached)
            if any(not (fact.events and fact.reached and fact.reached.is_own) for fact in left):
                return each.name
        return ""

    def _taken_in(self, leaf: ScxmlState, timers: Sequence[Timer]) -> list[str]:
        """The events from outside that SCXML takes in a state, or in those it leads to without such an event."""
        own = {timer.event for timer in timers}
        taken, seen, waiting = dict[str, None](), set[int](), [leaf]
        while waiting:
            state = waiting.pop()
            if id(state) not in seen:
                seen.add(id(state))
                waiting += [self.starts[each] for each in state.regions]
                for fact in self._facts.get(state, []):
                    if fact.reached is not None and fact.reached.is_own:
                        waiting.append(fact.reached.end)
                    elif fact.reached is not None:
                        taken |= dict.fromkeys(each for each in fact.events if plain(each) not in own)
        return list(taken)

    def _difference(self, fact: _Fact, timer: Timer) -> str:
        """Why a timer of the design differs from a delayed event; "" if it does not."""
        takers = [
            (each.owner, each.element)
            for facts in self._facts.values()
            for each in facts
            if any(matches(event, timer.event) for event in each.events)
        ]
        leaves = fact.reached is not None and timer.state not in [*fact.reached.domain.ancestors()]
        is_only = len({id(element) for _owner, element in takers}) == 1 and fact.owner is timer.state
        if not timer.state.is_atomic and not (is_only and leaves and not fact.element.get("cond")):
            return f"it is taken whenever the time has passed; SCXML takes '{timer.event}' once, when it arrives"
        if not timer.is_cancelled_on_exit and self._is_left_before(timer):
            return f"'{timer.event}' ends with '{timer.state.name}'; SCXML delivers it unless <cancel> is on exit"
        return ""

    def _is_left_before(self, timer: Timer) -> bool:
        """Whether a state with a timer can be left without it, and entered again."""
        exits = [
            fact
            for fact in self._exits(timer.state)
            if not fact.events or not all(matches(each, timer.event) for each in fact.events)
        ]
        seen, waiting = set[int](), [fact.reached.end for fact in exits if fact.reached]
        while waiting:
            leaf = waiting.pop()
            if timer.state in [*leaf.ancestors()] or leaf in timer.state.around():
                return True
            if id(leaf) not in seen:
                seen.add(id(leaf))
                waiting += [fact.reached.end for fact in self._facts.get(leaf, []) if fact.reached]
        return False

    def _exits(self, state: ScxmlState) -> Iterator[_Fact]:
        for leaf, facts in self._facts.items():
            if state in [*leaf.ancestors()] or leaf in state.around():
                yield from (each for each in facts if each.reached and state not in [*each.reached.domain.ancestors()])


def _lose(events: Iterable[str], when: str) -> str:
    names = ["other events" if each == ANY else each for each in events]
    if not names:
        return ""
    more = f" and {len(names) - _MAX_EVENTS} more" if len(names) > _MAX_EVENTS else ""
    verb = "is" if len(names) == 1 and names[0] != "other events" else "are"
    return f"{', '.join(names[:_MAX_EVENTS])}{more} {verb} lost if arriving {when}"
