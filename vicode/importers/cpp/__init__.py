"""Imports state machines that C++ sources declare: options of CABSL, and transition tables of boost::sml."""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from vicode.cpp_tokens import COMMENT, DIRECTIVE, STRING, iter_tokens
from vicode.findings import DesignPath, Finding, SourceLocation
from vicode.importers import ImportedDesign, ImportNote, ImportResult
from vicode.importers.cpp.cabsl import iter_options, read_option
from vicode.importers.cpp.conditions import ALIAS, Inputs
from vicode.importers.cpp.machine import CppMachine
from vicode.importers.cpp.sml import TABLE, Table, find_macros, iter_tables, read_table, with_name
from vicode.importers.cpp.tree import CppError, CppNode, CppSource, read_source
from vicode.importers.design_names import DesignNames
from vicode.model.project import Agent, Project

__all__ = ["ALIAS", "CPP_SUFFIXES", "CppImport", "contains_machines", "import_cpp"]

CPP_SUFFIXES = frozenset({".h", ".hh", ".hpp", ".hxx", ".c", ".cc", ".cpp", ".cxx", ".inl", ".ipp"})
_DECLARED = re.compile(rf"\boption\s*\(|\b{TABLE}\s*\(")
_Found = tuple[CppSource, CppNode, tuple[CppNode, CppNode] | Table]


@dataclass(frozen=True, slots=True, kw_only=True)
class CppImport:
    """The machines of C++ files as a project.

    Attributes:
        places: The places of the design and of its states and decisions, by component.
        unfixed: The inputs by component that may change while the world stands still.
        ends: The states by component that end it without success.
        partial: Components of which transitions may be missing.
        errors: Files that cannot be read.
    """

    result: ImportResult
    sources: Mapping[str, CppSource]
    places: Mapping[str, Mapping[DesignPath, SourceLocation]]
    unfixed: Mapping[str, frozenset[str]]
    ends: Mapping[str, frozenset[str]]
    partial: frozenset[str]
    errors: tuple[Finding, ...]


def contains_machines(text: str) -> bool:
    """Whether a text may declare state machines; most files are sorted out fast."""
    return bool(_DECLARED.search(text)) and (TABLE in text or "state" in text)


def import_cpp(texts: Mapping[Path, str], name: str) -> CppImport:
    """Convert the state machines of files.

    Args:
        texts: The texts of the files; those without machines show which ones are used elsewhere.
        name: The name of the project.
    """
    found, errors = list[_Found](), list[Finding]()
    for path, text in texts.items():
        if contains_machines(text):
            try:
                source = read_source(path, text)
                found += ((source, each[0], each[1:]) for each in iter_options(source.nodes))
                found += ((source, each.name, each) for each in iter_tables(source.nodes))
            except CppError as error:
                errors.append(error.finding)
    names = DesignNames()
    components = {each: names.allocate(each) for each in dict.fromkeys(node.text for _source, node, _body in found)}
    macros = {macro: about for text in texts.values() for macro, about in find_macros(text).items()}
    machines = list(_read(found, components, names, macros))
    # Options that are chosen at run time may be any.
    roots = [] if any(each.is_open for each in machines) else _find_roots(machines, found, components, texts)
    agents = tuple(Agent(name=each, root=each) for each in roots)
    return _result(machines, agents, tuple(errors), name)


def _read(
    found: Iterable[_Found], components: Mapping[str, str], names: DesignNames, macros: Mapping[str, tuple[str, str]]
) -> Iterator[CppMachine]:
    seen: dict[str, CppMachine] = {}
    graph: dict[str, set[str]] = {}
    for source, node, body in found:
        component = components[node.text]
        if component in seen:
            seen[component].notes.append(
                (seen[component].start, f"{source.path.name} declares {node.text}, too: it is left out")
            )
            continue
        inputs = Inputs(machine=component, component=names.allocate(f"{component}Inputs"), types=names)
        machine = CppMachine(
            source=source, component=component, start=node.start, components=components, inputs=inputs, graph=graph
        )
        seen[component] = machine
        if isinstance(body, Table):
            yield from (with_name(machine, design) for design in read_table(machine, body, macros))
        else:
            read_option(machine, *body)
            unread = [each for each in source.unread if body[1].start < each < body[1].end]
            machine.is_partial |= bool(unread)
            machine.notes += ((each, "this branch is not read") for each in unread)
            yield machine


def _find_roots(
    machines: Iterable[CppMachine], found: Iterable[_Found], components: Mapping[str, str], texts: Mapping[Path, str]
) -> list[str]:
    """Tables that no other one uses, and the options that C++ code outside of options mentions, else the unused ones."""
    machines, found = list(machines), list(found)
    used = {use.component for machine in machines for use in machine.design.uses}
    options = {node.text for _source, node, body in found if not isinstance(body, Table)}
    bodies: dict[Path, list[CppNode]] = {}
    for source, _node, body in found:
        bodies.setdefault(source.path, []).extend(() if isinstance(body, Table) else body)
    pattern = re.compile(rf"\b(?:{'|'.join(map(re.escape, options))})\b") if options else None
    mentioned = set[str]()
    for path, text in texts.items():
        if pattern and pattern.search(text):
            mentioned |= options & set(_words_outside(text, bodies.get(path, [])))
    roots = {components[name] for name in mentioned}
    is_option = {components[name] for name in options}
    return [
        each.component
        for each in machines
        if (each.component in roots if roots and each.component in is_option else each.component not in used)
    ]


def _words_outside(text: str, bodies: Iterable[CppNode]) -> Iterator[str]:
    """The words and strings outside of options and of their declarations."""
    ranges, depth, before = [(each.start, each.end) for each in bodies], 0, ""
    for token in iter_tokens(text):
        if token.kind in (COMMENT, DIRECTIVE):
            continue
        # The declaration `option(Name);` does not use the option.
        if token.text == "(" and (depth or before == "option"):
            depth += 1
        elif token.text == ")" and depth:
            depth -= 1
        elif not depth and not any(start <= token.start < end for start, end in ranges):
            yield token.text.strip('"') if token.kind == STRING else token.text
        before = token.text


def _result(machines: list[CppMachine], agents: tuple[Agent, ...], errors: tuple[Finding, ...], name: str) -> CppImport:
    kept = {machine.component: machine for machine in machines}
    shared = {machine.inputs.component: machine.inputs for machine in machines}
    notes = {
        (machine.source.path, machine.source.line(start), text) for machine in machines for start, text in machine.notes
    }
    project = Project(
        name=name,
        languages=("cpp",),
        enumerations=tuple(each for inputs in shared.values() for each in inputs.project_enumerations()),
        components=tuple(inputs.interface() for inputs in shared.values() if inputs.declarations),
        agents=agents,
        designs=tuple(machine.design for machine in kept.values()),
    )
    result = ImportResult(
        project=project,
        designs=tuple(
            ImportedDesign(component=each, path=f"{each}.yaml", comments=(), file=machine.source.path, anchors=())
            for each, machine in kept.items()
        ),
        comments=(),
        notes=tuple(ImportNote(file=file, line=line, text=text) for file, line, text in sorted(notes)),
    )
    return CppImport(
        result=result,
        sources={each: machine.source for each, machine in kept.items()},
        places={each: machine.locations() for each, machine in kept.items()},
        unfixed={each: frozenset(machine.inputs.unfixed) for each, machine in kept.items()},
        ends={each: frozenset(machine.ends) for each, machine in kept.items()},
        partial=frozenset(each for each, machine in kept.items() if machine.is_partial),
        errors=errors,
    )
