"""Names in generated C++: those of the design, with a trailing `_` where C++ or the runtime uses the name itself."""

from collections.abc import Iterable
from dataclasses import dataclass

from vicode.generators.plan import ComponentPlan, PackagePlan, ProjectPlan, ValuePlan
from vicode.languages import LANGUAGES
from vicode.model.names import python_attribute_name

RESERVED_MODULES = frozenset({*LANGUAGES["cpp"].keywords, "bica", "components", "declarations", "interfaces", "world"})
"""File names that no design may use."""

_KEYWORDS = LANGUAGES["cpp"].keywords
_GLOBAL_NAMES = frozenset({"Components", "State", "World", "bica", "std"})
_MEMBERS = frozenset(
    [
        "Parameters",
        "State",
        "StepGuard",
        "act",
        "act_common",
        "attempt",
        "attempt_in",
        "begin_iteration",
        "call",
        "call_id",
        "called",
        "change_state",
        "change_to",
        "decide",
        "decide_common",
        "enter",
        "entered_ns",
        "errors",
        "forget_calls",
        "in_final_state",
        "is_recent",
        "leave",
        "left_state",
        "mark_restart",
        "may_enter",
        "must_work",
        "name",
        "period_ns",
        "repeat_calls",
        "require",
        "required_by",
        "restart_again",
        "restart_times",
        "start",
        "state_name",
        "state_time_ns",
        "component_time_ns",
        "stay",
        "step_machine",
        "step_modulated",
        "stepped_in",
        "transition",
        "visit_parameters",
        "visit_values",
        "was_stepped",
    ]
)


def namespace(package: PackagePlan) -> str:
    return escape(package.name, _GLOBAL_NAMES)


def escape(name: str, taken: Iterable[str] = ()) -> str:
    """The name, with a trailing `_` if it is a keyword or taken."""
    while name in _KEYWORDS or name in taken:
        name += "_"
    return name


def member_name(name: str) -> str:
    """The name of a value or used component in its class."""
    return escape(name, _MEMBERS)


def state_names(component: ComponentPlan) -> dict[str, str]:
    """The elements of the enumeration of the states; a name that starts with a digit gets a leading `S`."""
    names = (state.name for state in component.states)
    return {name: escape(f"S{name}" if name[0].isdigit() or name[0] == "_" else name) for name in names}


def world_name(value: ValuePlan) -> str:
    """The name of a method of the world, as in Python."""
    return escape(python_attribute_name(value.xabsl_name or value.name))


@dataclass(frozen=True, slots=True)
class GlobalNames:
    """The names in the namespace of the project; `members` hides some of them inside a class."""

    namespace: str
    names: dict[str, str]
    members: frozenset[str] = frozenset()

    @classmethod
    def of_project(cls, plan: ProjectPlan) -> "GlobalNames":
        used = [use.component for design in plan.project.designs for use in design.uses]
        classes = {escape(name, _GLOBAL_NAMES) for name in (*plan.package.modules, *plan.package.interfaces, *used)}
        names = {}
        for declared in [*(item.name for item in plan.enumerations), *(item.name for item in plan.constants)]:
            names[declared] = escape(declared, classes | _GLOBAL_NAMES)
        return cls(namespace(plan.package), names)

    def inside(self, members: Iterable[str]) -> "GlobalNames":
        """The names as a class with these members must write them."""
        return GlobalNames(self.namespace, self.names, frozenset(members))

    def declared(self, name: str) -> str:
        """An enumeration or constant."""
        return self._qualified(self.names[name])

    def class_name(self, component: str) -> str:
        return self._qualified(escape(component, _GLOBAL_NAMES))

    def type_name(self, type_: str) -> str:
        """The C++ type of a value."""
        return _TYPES.get(type_) or self.declared(type_)

    def _qualified(self, name: str) -> str:
        return f"::{self.namespace}::{name}" if name in self.members else name


_TYPES = {"bool": "bool", "int": "std::int64_t", "float": "double"}
