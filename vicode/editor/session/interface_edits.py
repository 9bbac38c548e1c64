"""Edits that add inputs and commands: a declaration in project.yaml, and the use of its component in a design."""

from dataclasses import dataclass, replace

from vicode.model.design import Declaration, Design, Use
from vicode.model.edits import unique_name
from vicode.model.names import snake_case
from vicode.model.project import MISSING, Interface, Project

_SENSORS = "Sensors"


@dataclass(frozen=True, slots=True, kw_only=True)
class UsedInterface:
    """A component of project.yaml, which may still be missing there, and its alias in a design."""

    component: str
    alias: str

    def add_output(self, project: Project, output: Declaration) -> Project:
        """The project with an output of the component, which is added without an implementation if it is missing."""
        if all(interface.component != self.component for interface in project.components):
            project = replace(project, components=(*project.components, Interface(component=self.component)))
        components = (
            replace(interface, outputs=(*interface.outputs, output))
            if interface.component == self.component
            else interface
            for interface in project.components
        )
        return replace(project, components=tuple(components))

    def add_use(self, design: Design) -> Design:
        """The design that uses the component under the alias."""
        if design.use(self.alias) is not None:
            return design
        return replace(design, uses=(*design.uses, Use(alias=self.alias, component=self.component)))


def place_input(project: Project, design: Design) -> UsedInterface:
    """Where a new input belongs: in the first used component of inputs without an implementation, else in Sensors."""
    of_inputs = {each.component for each in project.components if _may_hold_inputs(each)}
    known = next((use for use in design.uses if use.component in of_inputs), None)
    if known is not None:
        return UsedInterface(component=known.component, alias=known.alias)
    component = _SENSORS if _SENSORS in of_inputs else unique_name(_SENSORS, shared_names(project))
    return use_under_free_alias(project, design, component)


def use_under_free_alias(project: Project, design: Design, component: str) -> UsedInterface:
    taken = {use.alias for use in design.uses} | {declaration.name for _section, declaration in design.declarations()}
    taken |= {constant.name for constant in project.constants}
    return UsedInterface(component=component, alias=unique_name(snake_case(component), taken))


def shared_names(project: Project) -> set[str]:
    """The names that a new enumeration, constant or component must not have."""
    enumerations, constants = ({item.name for item in items} for items in (project.enumerations, project.constants))
    return enumerations | constants | set(project.interfaces())


def _may_hold_inputs(interface: Interface) -> bool:
    """Whether the component is not implemented and does not only take commands."""
    return interface.implementation == MISSING and (bool(interface.outputs) or not interface.parameters)
