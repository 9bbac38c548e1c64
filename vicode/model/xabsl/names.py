"""The names that things of designs have in XABSL."""

from collections.abc import Iterator
from dataclasses import dataclass

from vicode.findings import DesignPath
from vicode.model.design import Declaration, Design, State
from vicode.model.names import snake_case
from vicode.model.project import INTERNAL, Agent, Enumeration, Interface, Project

INPUT, OUTPUT, INTERNAL_SYMBOL, CONST = "input", "output", "internal", "const"
"""What a symbol is: given by the robot's program, told to it, kept by the engine, or a constant."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SymbolName:
    """A name that expressions of XABSL may say. `component` is empty for what project.yaml declares."""

    name: str
    role: str
    declaration: Declaration
    component: str
    path: DesignPath


def unqualified_name(thing: Declaration | State | Enumeration | Agent) -> str:
    """The name it was given for XABSL, else its own."""
    return thing.xabsl_name or thing.name


def component_name(component: Design | Interface) -> str:
    """The name of an option, a basic behavior, or a namespace of symbols."""
    return component.xabsl_name or component.component


def element_name(enumeration: Enumeration, element: str) -> str:
    """The name of an element, without that of its enumeration."""
    return dict(enumeration.xabsl_elements).get(element) or element


def symbol_name(component: str, declaration: Declaration) -> str:
    """The name of what a component offers: after the component's, since all symbols share one space of names."""
    return declaration.xabsl_name or f"{snake_case(component)}.{declaration.name}"


def symbol_declarations(design: Design) -> tuple[Declaration, ...]:
    """What of a design becomes symbols."""
    return tuple(each for each in (*design.outputs, *design.variables) if each.arguments is None)


def variable_role(interface: Interface) -> str:
    """What a variable of a hand-written component is."""
    return INTERNAL_SYMBOL if interface.implementation == INTERNAL else OUTPUT


def output_role(interface: Interface) -> str:
    """What an output of a hand-written component is."""
    return INTERNAL_SYMBOL if interface.implementation == INTERNAL else INPUT


def is_basic_behavior(interface: Interface) -> bool:
    """Whether a hand-written component is something to call: it takes parameters, or tells nothing."""
    return interface.implementation != INTERNAL and (bool(interface.parameters) or not interface.readable)


def list_symbols(project: Project) -> Iterator[SymbolName]:
    """All symbols of a project's program."""
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
    """The agents of a program: those of the project, or where there are none, one a design that no other uses."""
    if project.agents:
        return project.agents
    used = {use.component for design in project.designs for use in design.uses}
    roots = [design.component for design in project.designs if design.component not in used]
    return tuple(Agent(name=snake_case(root), root=root, title=root) for root in roots)
