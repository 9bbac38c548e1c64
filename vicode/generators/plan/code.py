"""Assign region ids and function names to hand-written code; elements with an id keep both when they are renamed."""

from vicode.findings import DesignPath
from vicode.generators.plan.plan_types import CodePlan
from vicode.generators.plan.unique_identifiers import NameAllocator
from vicode.model.design import COMMON, Code, Design, State
from vicode.model.names import identifier_stem


class CodePlanner:
    """Plans the code of one design; names are unique and depend on the order of the calls."""

    def __init__(self, design: Design) -> None:
        self._regions = NameAllocator()
        self._actions, self._predicates = NameAllocator(), NameAllocator()
        self._states = {state.name: state for state in design.states}

    def plan_section(self, role: str, code: Code) -> CodePlan | None:
        """Plan the code of the module or the class body; None if it is empty."""
        if not code.texts:
            return None
        return CodePlan(path=(role,), region_id=self._regions.allocate(role, "."), stem=role, code=code)

    def plan_action(self, path: DesignPath, source: str, phase: str, code: Code, *, given_id: str) -> CodePlan:
        region = given_id or f"{self._owner(source)}.{phase}"
        default = (
            identifier_stem(_source_name(source))
            if phase == "actions"
            else f"{identifier_stem(_source_name(source))}_{phase}"
        )
        stem = identifier_stem(given_id) if given_id else default
        return CodePlan(
            path=(*path, "code"),
            region_id=self._regions.allocate(region, "."),
            stem=self._actions.allocate(stem),
            code=code,
        )

    def plan_guard(
        self, path: DesignPath, source: str, outcome: str, code: Code, *, given_id: str, doc: str
    ) -> CodePlan:
        """Plan the code of a guard; `outcome` is a state name, "stay" or "group"."""
        region = given_id or f"{self._owner(source)}.to.{self._owner(outcome)}"
        stem = (
            identifier_stem(given_id)
            if given_id
            else f"{identifier_stem(_source_name(source))}_to_{identifier_stem(outcome)}"
        )
        return CodePlan(
            path=(*path, "code"),
            region_id=self._regions.allocate(region, "."),
            stem=self._predicates.allocate(stem),
            code=code,
            doc=doc,
        )

    def _owner(self, name: str) -> str:
        state: State | None = self._states.get(name)
        return state.id or state.name if state else _source_name(name)


def _source_name(name: str) -> str:
    return "common" if name == COMMON else name
