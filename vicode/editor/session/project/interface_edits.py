"""Edits that add inputs and commands: a declaration in project.yaml, and the use of its component in a design."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from vicode.model.design import Declaration, Design, Use
from vicode.model.edits import unique_name
from vicode.model.expressions import BOOL, FLOAT, INT
from vicode.model.names import is_valid_name, snake_case
from vicode.model.project import MISSING, Interface, Project
from vicode.services import messages

_SENSORS = "Sensors"


@dataclass(frozen=True, slots=True, kw_only=True)
class InterfaceEdit:
    """An edit of a design and project.yaml, or the error message."""

    label: str = ""
    error: str = ""
    change_design: Callable[[Design], Design] = lambda design: design
    change_project: Callable[[Project], Project] = lambda project: project


def add_input(project: Project, design: Design, name: str, type_: str) -> InterfaceEdit:
    """Declare an output of a component without an implementation, and use the component in the design."""
    place = place_input(project, design)
    interface = project.interface(place.component)
    error = _validate_name(name, "input", interface is not None and _has_declaration(interface, name))
    if error:
        return InterfaceEdit(error=error)
    output = Declaration(name=name, type=type_)
    return InterfaceEdit(
        label=f"add input {name}",
        change_design=place.add_use,
        change_project=lambda old: place.add_output(old, output),
    )


def add_command(project: Project, design: Design, name: str, parameters: str) -> InterfaceEdit:
    """Declare a component without an implementation, and use it in the design.

    Args:
        project: The project.
        design: The design.
        name: The name of the component, or an alias such as `walk`.
        parameters: Names separated by commas, each with an optional type: `speed, turn: int`.
    """
    component = name[:1].upper() + name[1:]
    declarations = tuple(_parse_parameter(part) for part in parameters.split(",") if part.strip())
    errors = [_validate_name(component, "component", component in shared_names(project))]
    errors += [
        _validate_name(item.name, "parameter", item.name in {other.name for other in declarations[:index]})
        for index, item in enumerate(declarations)
    ]
    if error := next(filter(None, errors), ""):
        return InterfaceEdit(error=error)
    added = Interface(component=component, parameters=declarations)
    return InterfaceEdit(
        label=f"add command {component}",
        change_design=use_under_free_alias(project, design, component).add_use,
        change_project=lambda old: replace(old, components=(*old.components, added)),
    )


def type_names(project: Project) -> list[str]:
    """The types that a declaration can have."""
    return [BOOL, INT, FLOAT, *(enumeration.name for enumeration in project.enumerations)]


def _parse_parameter(text: str) -> Declaration:
    name, _colon, type_ = text.partition(":")
    return Declaration(name=name.strip(), type=type_.strip() or FLOAT)


def _validate_name(name: str, kind: str, is_taken: bool) -> str:
    if not name:
        return messages.NAME_MISSING
    if not is_valid_name(name):
        return messages.invalid_identifier(name)
    return messages.name_exists(kind, name) if is_taken else ""


def _has_declaration(interface: Interface, name: str) -> bool:
    return any(each.name == name for each in (*interface.readable, *interface.parameters))


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
    return interface.implementation == MISSING and (bool(interface.outputs) or interface.component == _SENSORS)
