"""The XABSL names of items in designs."""

from collections.abc import Iterator
from dataclasses import dataclass

from vicode.findings import DesignPath
from vicode.model.design import Declaration, Design, State
from vicode.model.names import snake_case
from vicode.model.project import INTERNAL, Agent, Enumeration, Interface, Project

INPUT, OUTPUT, INTERNAL_SYMBOL, CONST = "input", "output", "internal", "const"
"""Roles of symbols: read from the robot program, written to it, stored in the engine, or constant."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SymbolName:
    """The name of an XABSL symbol. `component` is empty for declarations of project.yaml."""

    name: str
    role: str
    declaration: Declaration
    component: str
    path: DesignPath


def unqualified_name(item: Declaration | State | Enumeration | Agent) -> str:
    """Return the explicit XABSL name, else the name."""
    return item.xabsl_name or item.name


def component_name(component: Design | Interface) -> str:
    """Return the name of an option, basic behavior or namespace."""
    return component.xabsl_name or component.component


def element_name(enumeration: Enumeration, element: str) -> str:
    """Return the name of an element without its enumeration."""
    return dict(enumeration.xabsl_elements).get(element) or element


def symbol_name(component: str, declaration: Declaration) -> str:
    """Return the name of a symbol, prefixed with the component because all symbols share one namespace."""
    return declaration.xabsl_name or f"{snake_case(component)}.{declaration.name}"


def symbol_declarations(design: Design) -> tuple[Declaration, ...]:
    """Return the declarations of a design that become symbols."""
    return tuple(each for each in (*design.outputs, *design.variables) if each.arguments is None)


def variable_role(interface: Interface) -> str:
    return INTERNAL_SYMBOL if interface.implementation == INTERNAL else OUTPUT


def output_role(interface: Interface) -> str:
    return INTERNAL_SYMBOL if interface.implementation == INTERNAL else INPUT


def is_basic_behavior(interface: Interface) -> bool:
    """Return whether a hand-written component can be called: it has parameters, or nothing readable."""
    return interface.implementation != INTERNAL and (bool(interface.parameters) or not interface.readable)


def list_symbols(project: Project) -> Iterator[SymbolName]:
    for constant in project.constants:
        path: DesignPath = ("constants", constant.name)
        yield SymbolName(name=unqualified_name(constant), role=CONST, declaration=constant, component="", path=path)
    for interface in project.components:
        for section, role in (("outputs", output_role(interface)), ("variables", variable_role(interface))):
            for each in getattr(interface, section):
                path = ("components", interface.component, section, each.name)
                name = symbol_name(interface.component, each)
                yield SymbolName(name=name, role=role, declaration=each, component="", path=path)
    for design in project.designs:
        for section, each in design.declarations():
            if section != "parameters" and each.arguments is None:
                name = symbol_name(design.component, each)
                where = (section, each.name)
                yield SymbolName(
                    name=name, role=INTERNAL_SYMBOL, declaration=each, component=design.component, path=where
                )


def effective_agents(project: Project) -> tuple[Agent, ...]:
    """Return the agents of the project. Without agents, return one for each design that no other design uses."""
    if project.agents:
        return project.agents
    used = {use.component for design in project.designs for use in design.uses}
    roots = [design.component for design in project.designs if design.component not in used]
    return tuple(Agent(name=snake_case(root), root=root, title=root) for root in roots)
