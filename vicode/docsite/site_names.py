"""The names that a site shows: those of XABSL if the designs come from there, else those of the designs."""

from collections.abc import Iterator
from dataclasses import dataclass

from vicode.model.design import Declaration, Design, State
from vicode.model.project import Enumeration, Interface, Project
from vicode.model.xabsl.names import (
    INTERNAL_SYMBOL,
    component_name,
    element_name,
    is_basic_behavior,
    output_role,
    symbol_name,
    unqualified_name,
    variable_role,
)


def is_from_xabsl(project: Project) -> bool:
    """Whether designs of the project come from XABSL: they follow its rules of arithmetic."""
    return any(design.arithmetic == "xabsl" for design in project.designs)


@dataclass(frozen=True, slots=True, kw_only=True)
class NamedSymbol:
    """A declaration with its owner ("" for a constant) and section."""

    component: str
    section: str
    declaration: Declaration


class SiteNames:
    """The shown names of the items of a project."""

    def __init__(self, project: Project) -> None:
        self.is_xabsl = is_from_xabsl(project)
        self._project = project
        owners: tuple[Design | Interface, ...] = (*project.components, *project.designs) if self.is_xabsl else ()
        self._components = {each.component: component_name(each) for each in owners}
        self._symbols: dict[str, NamedSymbol] = {}
        self._elements: dict[str, list[tuple[Enumeration, str]]] = {}
        if self.is_xabsl:
            self._symbols = dict(self._named_symbols(owners))
            for enumeration in project.enumerations:
                for element in enumeration.element_names:
                    name = element_name(enumeration, element)
                    for each in (name, f"{unqualified_name(enumeration)}.{name}"):
                        self._elements.setdefault(each, []).append((enumeration, element))
        self.key = (tuple(self._components.values()), tuple(self._symbols), tuple(self._elements))
        """The inputs of all names."""

    @property
    def design_kind(self) -> str:
        """What a design is called."""
        return "option" if self.is_xabsl else "state machine"

    def interface_kind(self, interface: Interface) -> str:
        """What a component without a design is called."""
        if is_basic_behavior(interface):
            return "basic behavior"
        return "namespace" if self.is_xabsl else "interface"

    def declaration_kind(self, owner: Design | Interface, section: str) -> str:
        """What a declaration in a section of a component is called."""
        if section == "parameters" or not self.is_xabsl:
            return section.removesuffix("s")
        if isinstance(owner, Design):
            return f"{INTERNAL_SYMBOL} symbol"
        return f"{output_role(owner) if section == 'outputs' else variable_role(owner)} symbol"

    def component(self, name: str) -> str:
        """The shown name of a component."""
        return self._components.get(name, name)

    def state(self, state: State) -> str:
        return unqualified_name(state) if self.is_xabsl else state.name

    def state_of(self, design: Design, name: str) -> str:
        """The shown name of the state with this name, the name itself if there is none."""
        state = design.state(name) if self.is_xabsl else None
        return self.state(state) if state else name

    def declaration(self, owner: Design | Interface | None, section: str, declaration: Declaration) -> str:
        """The shown name of a declaration; without an owner, of a constant."""
        if not self.is_xabsl:
            return declaration.name
        if owner is None or section == "parameters":
            is_option = isinstance(owner, Design)
            return "@" * is_option + unqualified_name(declaration)
        return symbol_name(owner.component, declaration)

    def argument(self, declaration: Declaration) -> str:
        """The shown name of an argument or of a parameter in a call."""
        return unqualified_name(declaration) if self.is_xabsl else declaration.name

    def enumeration(self, name: str) -> str:
        """The shown name of a type."""
        enumeration = self._project.enumeration(name) if self.is_xabsl else None
        return unqualified_name(enumeration) if enumeration else name

    def element(self, enumeration: Enumeration, element: str) -> str:
        return element_name(enumeration, element) if self.is_xabsl else element

    def find_symbol(self, name: str) -> NamedSymbol | None:
        """The symbol or constant that has this name in XABSL."""
        return self._symbols.get(name)

    def find_element(self, name: str, type_: str) -> tuple[Enumeration, str] | None:
        """The element with this XABSL name, of a type if several types have such an element."""
        found = self._elements.get(name, [])
        return next((each for each in found if each[0].name == type_), found[0] if len(found) == 1 else None)

    def _named_symbols(self, owners: tuple[Design | Interface, ...]) -> Iterator[tuple[str, NamedSymbol]]:
        for constant in self._project.constants:
            yield unqualified_name(constant), NamedSymbol(component="", section="constants", declaration=constant)
        for owner in owners:
            for section in ("outputs", "variables"):
                for each in getattr(owner, section):
                    symbol = NamedSymbol(component=owner.component, section=section, declaration=each)
                    yield symbol_name(owner.component, each), symbol
