"""Finds symbols by their qualified name, such as Player, Player.Kick or Side.left."""

from collections.abc import Iterator

from vicode.model.project import Project
from vicode.model.rename.projects import is_declared
from vicode.model.rename.references import SymbolRef

_PROJECT_SECTIONS = ("components", "constants", "enumerations", "agents")
_COMPONENT_SECTIONS = ("uses", "parameters", "outputs", "variables")


def find_symbols(project: Project, name: str) -> tuple[SymbolRef, ...]:
    """The symbols with this name: NAME of the project, COMPONENT.NAME, ENUMERATION.ELEMENT, COMPONENT.OUTPUT.ARGUMENT.

    The section of a component is `components`, also if it has a design; that of a state is `states`.
    """
    return tuple(dict.fromkeys(_find(project, name.split("."))))


def list_names(project: Project) -> tuple[str, ...]:
    """The qualified names of all symbols except arguments."""
    names = [name for section in ("constants", "enumerations", "agents") for name in _names(project, section)]
    names += [f"{each.name}.{element}" for each in project.enumerations for element in each.element_names]
    for component, interface in project.interfaces().items():
        design = project.design(component)
        inner = [each.name for each in (*interface.parameters, *interface.outputs, *interface.variables)]
        if design is not None:
            inner = [each.name for _section, each in design.declarations()]
            inner += [*(state.name for state in design.states), *(use.alias for use in design.uses)]
        names += [component, *(f"{component}.{name}" for name in inner)]
    return tuple(dict.fromkeys(names))


def _names(project: Project, section: str) -> list[str]:
    return [each.name for each in getattr(project, section)]


def _find(project: Project, parts: list[str]) -> Iterator[SymbolRef]:
    match parts:
        case [name]:
            if project.interface(name) is not None:
                yield SymbolRef(section="components", name=name)
            candidates = [SymbolRef(section=section, name=name) for section in _PROJECT_SECTIONS]
        case [owner, name]:
            design = project.design(owner)
            if design is not None and design.state(name) is not None:
                yield SymbolRef(section="states", name=name, component=owner)
            candidates = [SymbolRef(section=section, name=name, component=owner) for section in _COMPONENT_SECTIONS]
            candidates.append(SymbolRef(section="elements", name=name, owner=owner))
        case [component, output, name]:
            candidates = [SymbolRef(section="arguments", name=name, component=component, owner=output)]
        case _:
            candidates = []
    yield from (candidate for candidate in candidates if is_declared(project, candidate))
