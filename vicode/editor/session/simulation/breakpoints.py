"""Where a run shall rest: states and transitions that somebody marked."""

from dataclasses import dataclass, field

from vicode.editor.view import Selected, transition_key
from vicode.model.design import Design
from vicode.model.walks import walk_transitions
from vicode.simulation import Stops

_KINDS = ("states", "transitions")


@dataclass(frozen=True, slots=True, kw_only=True)
class Breakpoints:
    """The marked things, of one window."""

    things: frozenset[Selected] = field(default_factory=frozenset)

    def toggled(self, *things: Selected) -> "Breakpoints":
        """With these marked; if all of them are, without."""
        able = {Selected(of=each.of, id=each.id) for each in things if each.of in _KINDS}
        return Breakpoints(things=self.things - able if able <= self.things else self.things | able)

    def within(self, design: Design) -> "Breakpoints":
        """Those whose things are still in the design."""
        known = {Selected(of="states", id=state.name) for state in design.states}
        known |= {Selected(of="transitions", id=transition_key(located.path)) for located in walk_transitions(design)}
        return Breakpoints(things=self.things & known)

    def stops(self, *, changes: bool = False, errors: bool = False, also: str = "") -> Stops:
        """As the running process wants to know them; `also` is one more state."""
        named = {kind: sorted(each.id for each in self.things if each.of == kind) for kind in _KINDS}
        states = (*named["states"], *((also,) if also else ()))
        return Stops(states=states, transitions=tuple(named["transitions"]), changes=changes, errors=errors)
