"""The files that declare: enumerations and constants, what each component offers, basic behaviors, agents."""

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
    """A range as it stands between brackets."""
    if declaration.range is None:
        return ""
    return "..".join(("-" if end < 0 else "") + format_decimal(abs(end)) for end in declaration.range)


@dataclass(frozen=True, slots=True)
class SymbolsWriter:
    """Writes the declarations of one project."""

    name_map: XabslNameMap

    @property
    def project(self) -> Project:
        """What is written."""
        return self.name_map.project

    def declarations_file(self, namespace: str) -> tree.FileNode:
        """Enumerations and constants."""
        made: list[tree.DeclarationNode] = [self._enumeration(each) for each in self.project.enumerations]
        made += self._constants()
        return tree.FileNode(body=[tree.NamespaceNode(tree.NameNode(namespace), "Enumerations and constants", made)])

    def behaviors_file(self, namespace: str) -> tree.FileNode:
        """What a robot's program is told to do."""
        made: list[tree.DeclarationNode] = [
            tree.BehaviorNode(
                tree.NameNode(component_name(each)),
                [self._parameter(parameter, 2) for parameter in each.parameters],
                wrap_description(each.doc or each.title, 1),
            )
            for each in self.project.components
            if is_basic_behavior(each)
        ]
        return tree.FileNode(body=[tree.NamespaceNode(tree.NameNode(namespace), "Basic behaviors", made)])

    def interface_file(self, interface: Interface, namespace: str) -> tree.FileNode:
        """What a hand-written component offers."""
        made = [self._symbol(interface.component, each, output_role(interface)) for each in interface.outputs]
        made += [self._symbol(interface.component, each, variable_role(interface)) for each in interface.variables]
        heading = title_text(interface.title or interface.component)
        return tree.FileNode(
            body=[tree.NamespaceNode(tree.NameNode(namespace), heading, [*made], wrap_description(interface.doc, 0))]
        )

    def design_file(self, design: Design, namespace: str) -> tree.FileNode:
        """What a design keeps and shows."""
        made = [self._symbol(design.component, each, INTERNAL_SYMBOL) for each in symbol_declarations(design)]
        return tree.FileNode(body=[tree.NamespaceNode(tree.NameNode(namespace), title_text(design.component), [*made])])

    def agents_file(self, includes: Sequence[str]) -> tree.FileNode:
        """The file to begin with: all other files, and the agents."""
        agents: list[tree.OptionNode | tree.NamespaceNode | tree.AgentNode] = []
        for agent in effective_agents(self.project):
            root = self.project.design(agent.root)
            if root is None:
                raise UnsoundDesignError(f"the agent '{agent.name}' begins with '{agent.root}', which has no design")
            heading = title_text(agent.title or agent.name)
            name, option = tree.NameNode(unqualified_name(agent)), tree.NameNode(component_name(root))
            agents.append(tree.AgentNode(name, heading, option, wrap_description(agent.doc, 0)))
        return tree.FileNode(
            includes=[tree.IncludeNode(path) for path in includes],
            body=agents,
            header=header_comment(_header_lines(self.project)),
        )

    def _enumeration(self, enumeration: Enumeration) -> tree.EnumerationNode:
        elements = [tree.NameNode(element_name(enumeration, each)) for each in enumeration.element_names]
        meanings = (f"{element.text}: {doc}" for element, (_, doc) in zip(elements, enumeration.elements, strict=True))
        described = [each for each, (_, doc) in zip(meanings, enumeration.elements, strict=True) if doc]
        doc = wrap_description(" ".join([enumeration.doc, "; ".join(described)]), 1)
        return tree.EnumerationNode(tree.NameNode(unqualified_name(enumeration)), elements, enumeration.internal, doc)

    def _constants(self) -> Iterator[tree.ConstantNode]:
        for each in self.project.constants:
            if self.name_map.type_of(each).text == "float":
                value = self.name_map.constants.get(each.name)
                if value is None:
                    raise UnsoundDesignError(f"the constant '{each.name}' has no value")
                name, unit = tree.NameNode(unqualified_name(each)), title_text(each.unit)
                yield tree.ConstantNode(name, _constant_text(each, value), unit, wrap_description(each.doc, 1))

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
            None if parameters is None else [self._parameter(each, 2) for each in parameters],
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
    """The first lines: a title, which a doc may begin with, as that of an imported project does, then the doc."""
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
