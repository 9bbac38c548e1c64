"""Writes `live.hpp`: the table of components, states, fields and tunable constants that the live view of a robot needs.

An editor knows by hashes which version of a design runs. The source of each component has its own, so that an edit of a
design changes no other file; `live.hpp` has those of files that designs share.
"""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from hashlib import sha256

from vicode.generators.cpp.component import CODE_HASH
from vicode.generators.cpp.expression_printer import format_number
from vicode.generators.cpp.names import GlobalNames, member_name
from vicode.generators.cpp.project import component_members, list_interfaces
from vicode.generators.cpp.text import quoted
from vicode.generators.plan import ComponentPlan, ProjectPlan, ValuePlan, plan_interface
from vicode.model.expressions import BOOL, FLOAT, INT
from vicode.model.project import WORLD, Interface

SHARED_FILES = ("declarations.hpp", "interfaces.hpp")
"""The files that designs share, whose hashes a robot tells."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LiveComponentView:
    """A component: the expression of its instance, the arguments of `add`, and statements about it."""

    member: str
    arguments: str
    lines: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class LiveView:
    """The header of one project."""

    package: str
    namespace: str
    components: tuple[LiveComponentView, ...]
    shared: tuple[str, ...]
    constants: tuple[str, ...]


def build_live(plan: ProjectPlan, names: GlobalNames, texts: Mapping[str, str]) -> LiveView:
    """The table of a project; `texts` are the files that its designs share, by name."""
    writer = _LiveWriter(plan, names.inside({"component", "components", "project", "shown"}))
    shared = (
        f'project.shared.emplace_back("{name}", {quoted(_hash(texts[name]))});'
        for name in SHARED_FILES
        if name in texts
    )
    tunable = {each.name for each in plan.project.constants if each.tunable}
    constants = (each for each in plan.constants if each.name in tunable)
    return LiveView(
        package=plan.package.name,
        namespace=names.namespace,
        components=tuple(writer.list_components()),
        shared=tuple(shared),
        constants=tuple(writer.add_fields("project.constants", constants, lambda value: names.declared(value.name))),
    )


class _LiveWriter:
    def __init__(self, plan: ProjectPlan, names: GlobalNames) -> None:
        self._plan, self._names = plan, names
        self._members = component_members(plan)

    def list_components(self) -> Iterator[LiveComponentView]:
        used = {
            use.component: f"components.{self._members[each.component]}.{member_name(use.alias)}"
            for each in self._plan.components
            for use in each.uses
        }
        for item in list_interfaces(self._plan):
            own = f"components.{self._members[item.component]}"
            # The program has the hand-written components; those that no design uses are never stepped.
            if item.is_generated or item.component in used:
                yield self._interface(item, own if item.is_generated else used[item.component])
        for component in self._plan.components:
            yield self._component(component)

    def _interface(self, item: Interface, member: str) -> LiveComponentView:
        planned = plan_interface(self._plan.project, item)
        stored = [] if planned.implementation == WORLD else [*planned.outputs, *planned.variables]
        hidden = {value.name for value in stored}
        parameters = (value for value in planned.parameters if value.name not in hidden)
        lines = (
            *self.add_fields(
                "shown.fields", parameters, lambda value: f"component.parameters.{member_name(value.name)}"
            ),
            *self.add_fields("shown.fields", stored, _member),
        )
        arguments = ('""', '""', format_number(float(item.frequency_hz or 0)))
        return LiveComponentView(member=member, arguments=", ".join(arguments), lines=lines)

    def _component(self, plan: ComponentPlan) -> LiveComponentView:
        values = (*plan.parameters, *plan.outputs, *plan.variables)
        states = ", ".join(quoted(state.name) for state in plan.states)
        lines = [f"shown.set_states(component, {{{states}}});"]
        lines += ["shown.show_action_done(component);"] if plan.uses_action_done else []
        lines += ["shown.show_conflict(component);"] if any(each.is_cooperative for each in plan.states) else []
        lines += self.add_fields("shown.fields", values, _member)
        arguments = (quoted(plan.source), "component.code_hash()", format_number(float(plan.frequency_hz or 0)))
        member = f"components.{self._members[plan.component]}"
        return LiveComponentView(member=member, arguments=", ".join(arguments), lines=tuple(lines))

    def add_fields(self, owner: str, values: Iterable[ValuePlan], place: Callable[[ValuePlan], str]) -> Iterator[str]:
        sizes = {each.name: len(each.elements) for each in self._plan.enumerations}
        for value in values:
            if value.type in (BOOL, INT, FLOAT):
                yield f"{owner}.add({quoted(value.name)}, {place(value)});"
            else:
                yield f"{owner}.add({quoted(value.name)}, {quoted(value.type)}, {place(value)}, {sizes[value.type]});"


def add_code_hash(header: str, source: str) -> str:
    """The source of a component with the SHA-256 of its header and source in the place of `CODE_HASH`."""
    return source.replace(f'return "{CODE_HASH}";', f'return "{_hash(header + source)}";', 1)


def find_code_hash(source: str) -> str | None:
    """The hash that `add_code_hash` wrote; None if there is none."""
    found = re.search(r'::code_hash\(\) const \{\n    return "(\w{64})";', source)
    return found[1] if found else None


def _member(value: ValuePlan) -> str:
    return f"component.{member_name(value.name)}"


def _hash(text: str) -> str:
    return sha256(text.encode()).hexdigest()
