"""Breakpoints on states and transitions."""

from dataclasses import dataclass, field, replace

from vicode.diagram.drawn_transitions import draw_transitions
from vicode.editor.view import ItemRef
from vicode.model.decision_keys import transition_key
from vicode.model.design import COMMON, Design, Transition
from vicode.model.traversal import iter_transitions
from vicode.services.running_robots.robot_link import Place
from vicode.simulation import StopConditions

_KINDS = ("states", "transitions")


@dataclass(frozen=True, slots=True, kw_only=True)
class Breakpoints:
    """The breakpoints of one window: on items, and at `others`, places of a robot that are no item."""

    items: frozenset[ItemRef] = field(default_factory=frozenset)
    others: tuple[Place, ...] = ()

    @staticmethod
    def at_places(places: tuple[Place, ...], design: Design) -> "Breakpoints":
        """The breakpoints of a design at these places of a robot."""
        states = {ItemRef(kind="states", id=str(place[0])) for place in places if len(place) == 1}
        by_item = {ItemRef(kind="transitions", id=key): place for key, place in _transition_places(design).items()}
        items = states | {item for item, place in by_item.items() if place in places}
        others = tuple(place for place in places if len(place) > 1 and place not in by_item.values())
        return Breakpoints(items=frozenset(items), others=others)

    def toggled(self, design: Design, *items: ItemRef) -> "Breakpoints":
        """Add breakpoints to these items, or remove the breakpoints if all items have one.

        A transition that is drawn for several ones has a breakpoint on each.
        """
        rules = {key: drawn.keys for drawn in draw_transitions(design) for key in drawn.keys}
        able = {
            ItemRef(kind=each.kind, id=key)
            for each in items
            if each.kind in _KINDS
            for key in (rules.get(each.id, (each.id,)) if each.kind == "transitions" else (each.id,))
        }
        return replace(self, items=self.items - able if able <= self.items else self.items | able)

    def existing_in(self, design: Design) -> "Breakpoints":
        """The breakpoints whose items still exist in the design."""
        known = {ItemRef(kind="states", id=state.name) for state in design.states}
        known |= {ItemRef(kind="transitions", id=transition_key(located.path)) for located in iter_transitions(design)}
        return replace(self, items=self.items & known)

    def places(self, design: Design) -> tuple[Place, ...]:
        """The breakpoints as a robot knows them: (state,), or (source, target, id) of a transition."""
        ids = {each.id for each in self.items if each.kind == "transitions"}
        transitions = (place for key, place in _transition_places(design).items() if key in ids)
        states = ((each.id,) for each in sorted(self.items, key=str) if each.kind == "states")
        return (*states, *transitions, *self.others)

    def stop_conditions(self, *, changes: bool = False, errors: bool = False, extra_state: str = "") -> StopConditions:
        """The stop conditions of a run; `extra_state` is one more state to stop at."""
        named = {kind: sorted(each.id for each in self.items if each.kind == kind) for kind in _KINDS}
        states = (*named["states"], *((extra_state,) if extra_state else ()))
        return StopConditions(states=states, transitions=tuple(named["transitions"]), changes=changes, errors=errors)


def _transition_places(design: Design) -> dict[str, Place]:
    """Source, target and id of each transition by its key."""
    return {
        transition_key(located.path): (
            "" if located.source == COMMON else located.source,
            decision.to,
            decision.id or None,
        )
        for located in iter_transitions(design)
        if isinstance(decision := located.decision, Transition)
    }
