"""Gives every piece of hand-written code a region and a name; both outlive renames where ids are given."""

from vicode.generators.plan.naming import Names, stem_of
from vicode.generators.plan.values import Body
from vicode.model.design import COMMON, Code, Design, State


class Bodies:
    """The code of one design; ids and names are given in the order of asking."""

    def __init__(self, design: Design) -> None:
        """Begin with none given out."""
        self._regions = Names()
        self._actions, self._predicates = Names(), Names()
        self._states = {state.name: state for state in design.states}

    def whole(self, role: str, code: Code) -> Body | None:
        """The code of the module or of the class, None if there is none."""
        return Body(region=self._regions.give(role, "."), stem=role, code=code) if code.texts else None

    def action(self, source: str, phase: str, code: Code, given_id: str) -> Body:
        """The code of an action in a state, or of the common ones."""
        region = given_id or f"{self._owner(source)}.{phase}"
        default = stem_of(_shown(source)) if phase == "actions" else f"{stem_of(_shown(source))}_{phase}"
        stem = stem_of(given_id) if given_id else default
        return Body(region=self._regions.give(region, "."), stem=self._actions.give(stem), code=code)

    def predicate(self, source: str, outcome: str, code: Code, *, given_id: str, doc: str) -> Body:
        """The code of a guard; `outcome` is a state's name, "stay" or "group"."""
        region = given_id or f"{self._owner(source)}.to.{self._owner(outcome)}"
        stem = stem_of(given_id) if given_id else f"{stem_of(_shown(source))}_to_{stem_of(outcome)}"
        return Body(region=self._regions.give(region, "."), stem=self._predicates.give(stem), code=code, doc=doc)

    def _owner(self, name: str) -> str:
        state: State | None = self._states.get(name)
        return state.id or state.name if state else _shown(name)


def _shown(name: str) -> str:
    return "common" if name == COMMON else name
