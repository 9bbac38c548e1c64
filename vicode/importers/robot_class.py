"""Generate a skeleton of the robot class that an imported project accesses as its world."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from vicode.model.design import Declaration
from vicode.model.names import python_attribute_name, snake_case
from vicode.model.project import WORLD, Interface, Project
from vicode.model.xabsl.names import element_name, is_basic_behavior
from vicode.templating import render

_ZEROS = {"bool": "False", "float": "0.0", "int": "0"}


@dataclass(frozen=True, slots=True, kw_only=True)
class _Value:
    name: str
    default: str
    doc: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Function:
    name: str
    parameters: str
    result: str
    body: str
    doc: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Section:
    title: str
    doc: tuple[str, ...]
    values: tuple[_Value, ...]
    functions: tuple[_Function, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class _RobotView:
    sections: tuple[_Section, ...]


def render_robot_class(project: Project) -> str:
    """Render a Python module with the class `Robot`, which has every member that the components access."""
    interfaces = [interface for interface in project.components if interface.implementation == WORLD]
    sections = [_symbol_section(project, interface) for interface in interfaces if interface.readable]
    behaviors = tuple(_behavior_method(project, item) for item in interfaces if is_basic_behavior(item))
    if behaviors:
        sections.append(_Section(title="Basic behaviors", doc=(), values=(), functions=behaviors))
    return render("importers/robot_class.py.jinja", view=_RobotView(sections=tuple(sections)))


def _symbol_section(project: Project, interface: Interface) -> _Section:
    values = [output for output in interface.outputs if output.arguments is None]
    functions = [output for output in interface.outputs if output.arguments is not None]
    title = _line(interface.title or interface.component)
    return _Section(
        title=title,
        doc=tuple(line for line in _lines(interface.doc) if line.lower() != title.lower()),
        values=tuple(_value(project, item) for item in (*values, *interface.variables)),
        functions=tuple(_function(project, item) for item in functions),
    )


def _value(project: Project, declaration: Declaration) -> _Value:
    return _Value(
        name=_name(declaration),
        default=_default(project, declaration),
        doc=tuple(_lines(_description(project, declaration))),
    )


def _function(project: Project, declaration: Declaration) -> _Function:
    return _Function(
        name=_name(declaration),
        parameters=_parameters(project, declaration.arguments or ()),
        result=_type(declaration),
        body=f"return {_default(project, declaration)}",
        doc=tuple(_lines(_description(project, declaration))),
    )


def _behavior_method(project: Project, interface: Interface) -> _Function:
    return _Function(
        name=python_attribute_name(interface.xabsl_name or snake_case(interface.component)),
        parameters=_parameters(project, interface.parameters),
        result="None",
        body="return",
        doc=tuple(_lines(interface.doc)),
    )


def _parameters(project: Project, declarations: Iterable[Declaration]) -> str:
    parameters = [f"{_name(item)}: {_type(item)} = {_default(project, item)}" for item in declarations]
    return f", *, {', '.join(parameters)}" if parameters else ""


def _name(declaration: Declaration) -> str:
    return python_attribute_name(declaration.xabsl_name or declaration.name)


def _type(declaration: Declaration) -> str:
    return declaration.type if declaration.type in _ZEROS else "str"


def _default(project: Project, declaration: Declaration) -> str:
    enumeration = project.enumeration(declaration.type)
    if enumeration is None:
        return _ZEROS.get(declaration.type, "0.0")
    return f'"{element_name(enumeration, enumeration.element_names[0])}"'


def _description(project: Project, declaration: Declaration) -> str:
    enumeration = project.enumeration(declaration.type)
    facts = [f"in {declaration.unit}"] if declaration.unit else []
    if declaration.range:
        facts.append(f"{declaration.range[0]:g} to {declaration.range[1]:g}")
    if enumeration is not None:
        facts.append(", ".join(element_name(enumeration, name) for name in enumeration.element_names))
    fact = f"({'; '.join(facts)})" if facts else ""
    return " ".join(part for part in (declaration.doc, fact) if part)


def _lines(text: str) -> Iterator[str]:
    return (_line(line) for line in text.splitlines() if line.strip())


def _line(text: str) -> str:
    """Replace non-printable characters, which could end a comment."""
    return "".join(char if char.isprintable() else " " for char in text).strip()
