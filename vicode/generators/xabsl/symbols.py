"""The files that declare: enumerations and constants, what each component offers, basic behaviors, agents."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from vicode.generators.plan import UnsoundDesignError
from vicode.generators.xabsl.printing import first_comment, said, title
from vicode.generators.xabsl.vocabulary import Vocabulary, number_text
from vicode.model.constants import Value
from vicode.model.design import Declaration, Design
from vicode.model.project import Enumeration, Interface, Project
from vicode.model.xabsl.names import (
    KEPT,
    agents_of,
    component_name,
    element_name,
    is_behavior,
    plain_name,
    role_of_output,
    role_of_variable,
    symbol_name,
    symbols_of_design,
)
from vicode.xabsl import tree


def range_text(declaration: Declaration) -> str:
    """A range as it stands between brackets."""
    if declaration.range is None:
        return ""
    return "..".join(("-" if end < 0 else "") + number_text(abs(end)) for end in declaration.range)


@dataclass(frozen=True, slots=True)
class SymbolsWriter:
    """Writes the declarations of one project."""

    vocabulary: Vocabulary

    @property
    def project(self) -> Project:
        """What is written."""
        return self.vocabulary.project

    def shared(self, namespace: str) -> tree.File:
        """Enumerations and constants."""
        made: list[tree.Declaration] = [self._enumeration(each) for each in self.project.enumerations]
        made += self._constants()
        return tree.File(body=[tree.Namespace(tree.Name(namespace), "Enumerations and constants", made)])

    def behaviors(self, namespace: str) -> tree.File:
        """What a robot's program is told to do."""
        made: list[tree.Declaration] = [
            tree.Behavior(
                tree.Name(component_name(each)),
                [self._parameter(parameter, 2) for parameter in each.parameters],
                said(each.doc or each.title, 1),
            )
            for each in self.project.components
            if is_behavior(each)
        ]
        return tree.File(body=[tree.Namespace(tree.Name(namespace), "Basic behaviors", made)])

    def interface(self, interface: Interface, namespace: str) -> tree.File:
        """What a hand-written component offers."""
        made = [self._symbol(interface.component, each, role_of_output(interface)) for each in interface.outputs]
        made += [self._symbol(interface.component, each, role_of_variable(interface)) for each in interface.variables]
        heading = title(interface.title or interface.component)
        return tree.File(body=[tree.Namespace(tree.Name(namespace), heading, [*made], said(interface.doc, 0))])

    def design(self, design: Design, namespace: str) -> tree.File:
        """What a design keeps and shows."""
        made = [self._symbol(design.component, each, KEPT) for each in symbols_of_design(design)]
        return tree.File(body=[tree.Namespace(tree.Name(namespace), title(design.component), [*made])])

    def agents(self, includes: Sequence[str]) -> tree.File:
        """The file to begin with: all other files, and the agents."""
        agents: list[tree.Option | tree.Namespace | tree.Agent] = []
        for agent in agents_of(self.project):
            root = self.project.design(agent.root)
            if root is None:
                raise UnsoundDesignError(f"the agent '{agent.name}' begins with '{agent.root}', which has no design")
            heading = title(agent.title or agent.name)
            name, option = tree.Name(plain_name(agent)), tree.Name(component_name(root))
            agents.append(tree.Agent(name, heading, option, said(agent.doc, 0)))
        return tree.File(
            includes=[tree.Include(path) for path in includes],
            body=agents,
            initial=first_comment(_heading(self.project)),
        )

    def _enumeration(self, enumeration: Enumeration) -> tree.Enumeration:
        elements = [tree.Name(element_name(enumeration, each)) for each in enumeration.element_names]
        meanings = (f"{element.text}: {doc}" for element, (_, doc) in zip(elements, enumeration.elements, strict=True))
        described = [each for each, (_, doc) in zip(meanings, enumeration.elements, strict=True) if doc]
        doc = said(" ".join([enumeration.doc, "; ".join(described)]), 1)
        return tree.Enumeration(tree.Name(plain_name(enumeration)), elements, enumeration.internal, doc)

    def _constants(self) -> Iterator[tree.Constant]:
        for each in self.project.constants:
            if self.vocabulary.type_of(each).text == "float":
                value = self.vocabulary.constants.get(each.name)
                if value is None:
                    raise UnsoundDesignError(f"the constant '{each.name}' has no value")
                name, unit = tree.Name(plain_name(each)), title(each.unit)
                yield tree.Constant(name, _constant_text(each, value), unit, said(each.doc, 1))

    def _symbol(self, component: str, declared: Declaration, role: str) -> tree.Symbol:
        type_ = self.vocabulary.type_of(declared)
        is_number = type_.text == "float"
        parameters = declared.arguments
        return tree.Symbol(
            role,
            tree.Name(symbol_name(component, declared)),
            type_,
            range_text(declared) if is_number else "",
            title(declared.unit) if is_number else "",
            None if parameters is None else [self._parameter(each, 2) for each in parameters],
            said(declared.doc, 1),
        )

    def _parameter(self, declared: Declaration, depth: int) -> tree.Parameter:
        type_ = self.vocabulary.type_of(declared)
        is_number = type_.text == "float"
        return tree.Parameter(
            tree.Name(plain_name(declared)),
            type_,
            range_text(declared) if is_number else "",
            title(declared.unit) if is_number else "",
            said(declared.doc, depth),
        )


def _heading(project: Project) -> Iterator[str]:
    """The first lines: a title, which a doc may begin with, as that of an imported project does, then the doc."""
    lines = project.doc.strip().splitlines()
    has_title = bool(lines) and len(lines[0]) <= _LONGEST_TITLE and not lines[0].endswith(".")
    yield f"Title: {lines[0] if has_title else project.name}"
    yield from lines[has_title:]


_LONGEST_TITLE = 80


def _constant_text(declared: Declaration, value: Value) -> str:
    assert not isinstance(value, str)
    digits = declared.initial.strip()
    if digits.removeprefix("-").replace(".", "", 1).isdecimal() and digits.removeprefix("-")[0].isdecimal():
        return digits
    return ("-" if value < 0 else "") + number_text(abs(value))
