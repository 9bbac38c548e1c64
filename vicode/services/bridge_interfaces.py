"""What behaviors require of the world of a bridge, with the places of the declarations."""

from collections.abc import Collection, Iterator
from pathlib import Path

from vicode.bridge.binding import DeclaredType, Requirement
from vicode.findings import DesignPath, FindingSubject
from vicode.generators import collect_components
from vicode.model.design import Declaration
from vicode.model.names import python_attribute_name, snake_case
from vicode.model.project import WORLD, Interface, Project
from vicode.store import OpenProject, find_location
from vicode.xabsl.compiler import declared_symbols
from vicode.xabsl.engine import Program
from vicode.xabsl.engine.linker import keyword_names, python_name
from vicode.xabsl.engine.validation import select_used_symbols
from vicode.xabsl.symbol_table import Definition, SymbolTable

_TYPES = {"bool": bool, "int": int, "float": float}


def design_requirements(opened: OpenProject, roots: Collection[str]) -> list[Requirement]:
    """What the world components that these designs use read and call."""
    project = opened.project
    designs = collect_components(project, roots)
    used = {use.component for design in project.designs if design.component in designs for use in design.uses}
    interfaces = (each for each in project.components if each.component in used and each.implementation == WORLD)
    return [each for interface in interfaces for each in _list_interface(opened, interface)]


def _list_interface(opened: OpenProject, interface: Interface) -> Iterator[Requirement]:

    name = interface.component
    for key, declarations in (("outputs", interface.outputs), ("variables", interface.variables)):
        for each in declarations:
            yield Requirement(
                name=_attribute(each),
                description=f"{key[:-1]} {each.name} of {name}",
                place=_find_place(opened, ("components", name, key, each.name)),
                parameters=None if each.arguments is None else tuple(argument.name for argument in each.arguments),
            )
    if interface.parameters or not (interface.outputs or interface.variables):
        yield Requirement(
            name=python_attribute_name(interface.xabsl_name or snake_case(name)),
            description=f"component {name}",
            place=_find_place(opened, ("components", name)),
            parameters=tuple(each.name for each in interface.parameters),
        )


def _attribute(declaration: Declaration) -> str:
    """The attribute of the world that generated code reads, in each language."""
    return python_attribute_name(declaration.xabsl_name or declaration.name)


def _find_place(opened: OpenProject, path: DesignPath) -> str:

    location = find_location(FindingSubject(path=path, is_key=True), opened.sources)
    return f"{location.file}:{location.line}:{location.column}" if location is not None else "project.yaml"


def design_types(project: Project) -> dict[str, DeclaredType]:
    """The types of all outputs of world components."""
    types = {}
    for output in (each for interface in project.components for each in interface.readable):
        enumeration = project.enumeration(output.type)
        types[_attribute(output)] = DeclaredType(
            value_type=str if enumeration else _TYPES.get(output.type, float),
            elements=enumeration.element_names if enumeration else (),
            unit=output.unit,
            bounds=output.range,
        )
    return types


def xabsl_requirements(program: Program, table: SymbolTable, folder: Path) -> list[Requirement]:
    """The input symbols and basic behaviors that a program uses."""
    used = select_used_symbols(declared_symbols(table), program)
    definitions = {each.name: each for each in (*table.symbols("input"), *table.behaviors.values())}
    inputs = [each for each in used.symbols if each.role == "input"]
    requirements = [
        Requirement(
            name=python_name(each.name),
            description=f"input symbol {each.name}",
            place=_place_of(definitions.get(each.name), folder),
            parameters=tuple(keyword_names(each.name, each.parameters).values()) or None,
        )
        for each in inputs
    ]
    return requirements + [
        Requirement(
            name=python_name(each.name),
            description=f"basic behavior {each.name}",
            place=_place_of(definitions.get(each.name), folder),
            parameters=tuple(keyword_names(each.name, each.parameters).values()),
        )
        for each in used.behaviors
    ]


def _place_of(definition: Definition | None, folder: Path) -> str:
    if definition is None:
        return str(folder)
    location = definition.tokens.location(definition.name_node.first_token)
    return f"{folder / location.file}:{location.line}:{location.column}"
