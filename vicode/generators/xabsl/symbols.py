"""Build the declaration files: enumerations, constants, symbols, basic behaviors and agents."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from vicode.generators.plan import UnsoundDesignError
from vicode.generators.xabsl.name_map import XabslNameMap, format_decimal
from vicode.generators.xabsl.option_printer import header_comment, title_text, wrap_description
from vicode.model.constant_folding import ConstantValue
from vicode.model.design import Declaration, Design
from vicode.model.project import Enumeration, Interface, Project
from vicode.model.xabsl.names import (
    INTERNAL_SYMBOL,
    component_name,
    effective_agents,
    element_name,
    is_basic_behavior,
    output_role,
    symbol_declarations,
    symbol_name,
    unqualified_name,
    variable_role,
)
from vicode.xabsl import tree


def format_range(declaration: Declaration) -> str:
    """Format a range without its brackets."""
    if declaration.range is None:
        return ""
    return "..".join(("-" if end < 0 else "") + format_decimal(abs(end)) for end in declaration.range)


@dataclass(frozen=True, slots=True)
class SymbolsWriter:
    """Builds the declaration files of one project."""

    name_map: XabslNameMap

    @property
    def project(self) -> Project:
        return self.name_map.project

    def declarations_file(self, namespace: str) -> tree.FileNode:
        declarations: list[tree.DeclarationNode] = [self._enumeration(item) for item in self.project.enumerations]
        declarations += self._constants()
        return tree.FileNode(
            body=[tree.NamespaceNode(tree.NameNode(namespace), "Enumerations and constants", declarations)]
        )

    def behaviors_file(self, namespace: str) -> tree.FileNode:
        declarations: list[tree.DeclarationNode] = [
            tree.BehaviorNode(
                tree.NameNode(component_name(interface)),
                [self._parameter(parameter, 2) for parameter in interface.parameters],
                wrap_description(interface.doc or interface.title, 1),
            )
            for interface in self.project.components
            if is_basic_behavior(interface)
        ]
        return tree.FileNode(body=[tree.NamespaceNode(tree.NameNode(namespace), "Basic behaviors", declarations)])

    def interface_file(self, interface: Interface, namespace: str) -> tree.FileNode:
        declarations = [self._symbol(interface.component, item, output_role(interface)) for item in interface.outputs]
        declarations += [
            self._symbol(interface.component, item, variable_role(interface)) for item in interface.variables
        ]
        heading = title_text(interface.title or interface.component)
        return tree.FileNode(
            body=[
                tree.NamespaceNode(
                    tree.NameNode(namespace), heading, [*declarations], wrap_description(interface.doc, 0)
                )
            ]
        )

    def design_file(self, design: Design, namespace: str) -> tree.FileNode:
        """Build the symbols of a design: its outputs and variables."""
        declarations = [self._symbol(design.component, item, INTERNAL_SYMBOL) for item in symbol_declarations(design)]
        return tree.FileNode(
            body=[tree.NamespaceNode(tree.NameNode(namespace), title_text(design.component), [*declarations])]
        )

    def agents_file(self, includes: Sequence[str]) -> tree.FileNode:
        """Build the main file, which includes all other files and declares the agents."""
        agents: list[tree.OptionNode | tree.NamespaceNode | tree.AgentNode] = []
        for agent in effective_agents(self.project):
            root = self.project.design(agent.root)
            if root is None:
                raise UnsoundDesignError(f"the root '{agent.root}' of the agent '{agent.name}' has no design")
            heading = title_text(agent.title or agent.name)
            name, option = tree.NameNode(unqualified_name(agent)), tree.NameNode(component_name(root))
            agents.append(tree.AgentNode(name, heading, option, wrap_description(agent.doc, 0)))
        return tree.FileNode(
            includes=[tree.IncludeNode(path) for path in includes],
            body=agents,
            header=header_comment(_header_lines(self.project)),
        )

    def _enumeration(self, enumeration: Enumeration) -> tree.EnumerationNode:
        elements = [tree.NameNode(element_name(enumeration, name)) for name in enumeration.element_names]
        meanings = (f"{element.text}: {doc}" for element, (_, doc) in zip(elements, enumeration.elements, strict=True))
        described = [text for text, (_, doc) in zip(meanings, enumeration.elements, strict=True) if doc]
        doc = wrap_description(" ".join([enumeration.doc, "; ".join(described)]), 1)
        return tree.EnumerationNode(tree.NameNode(unqualified_name(enumeration)), elements, enumeration.internal, doc)

    def _constants(self) -> Iterator[tree.ConstantNode]:
        for item in self.project.constants:
            if self.name_map.type_of(item).text == "float":
                value = self.name_map.constants.get(item.name)
                if value is None:
                    raise UnsoundDesignError(f"the constant '{item.name}' has no value")
                name, unit = tree.NameNode(unqualified_name(item)), title_text(item.unit)
                yield tree.ConstantNode(name, _constant_text(item, value), unit, wrap_description(item.doc, 1))

    def _symbol(self, component: str, declared: Declaration, role: str) -> tree.SymbolNode:
        type_ = self.name_map.type_of(declared)
        is_number = type_.text == "float"
        parameters = declared.arguments
        return tree.SymbolNode(
            role,
            tree.NameNode(symbol_name(component, declared)),
            type_,
            format_range(declared) if is_number else "",
            title_text(declared.unit) if is_number else "",
            None if parameters is None else [self._parameter(item, 2) for item in parameters],
            wrap_description(declared.doc, 1),
        )

    def _parameter(self, declared: Declaration, depth: int) -> tree.ParameterNode:
        type_ = self.name_map.type_of(declared)
        is_number = type_.text == "float"
        return tree.ParameterNode(
            tree.NameNode(unqualified_name(declared)),
            type_,
            format_range(declared) if is_number else "",
            title_text(declared.unit) if is_number else "",
            wrap_description(declared.doc, depth),
        )


def _header_lines(project: Project) -> Iterator[str]:
    """Return the title and the doc; the first line of the doc may be the title, as in imported projects."""
    lines = project.doc.strip().splitlines()
    has_title = bool(lines) and len(lines[0]) <= _MAX_TITLE_LENGTH and not lines[0].endswith(".")
    yield f"Title: {lines[0] if has_title else project.name}"
    yield from lines[has_title:]


_MAX_TITLE_LENGTH = 80


def _constant_text(declared: Declaration, value: ConstantValue) -> str:
    assert not isinstance(value, str)
    digits = declared.initial.strip()
    if digits.removeprefix("-").replace(".", "", 1).isdecimal() and digits.removeprefix("-")[0].isdecimal():
        return digits
    return ("-" if value < 0 else "") + format_decimal(abs(value))
