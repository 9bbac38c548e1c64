"""Imports state machines that C++ sources declare: options of CABSL, and transition tables of boost::sml."""

import re
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from vicode.cpp_tokens import COMMENT, iter_tokens
from vicode.findings import Finding
from vicode.importers import ImportedDesign, ImportNote, ImportResult
from vicode.importers.cpp.cabsl import iter_options, read_option
from vicode.importers.cpp.conditions import ALIAS, CppConditions
from vicode.importers.cpp.machine import CppMachine
from vicode.importers.cpp.sml import TABLE, Table, find_macros, iter_tables, read_table
from vicode.importers.cpp.tree import CppError, CppSource, CppTree, read_source
from vicode.importers.design_names import DesignNames, design_files
from vicode.model.project import Enumeration, Project

__all__ = ["ALIAS", "CPP_SUFFIXES", "CppImport", "contains_machines", "import_cpp"]

CPP_SUFFIXES = frozenset({".h", ".hh", ".hpp", ".hxx", ".c", ".cc", ".cpp", ".cxx", ".inl", ".ipp"})
_MACHINE = re.compile(rf"\boption\s*[({{]|\b{TABLE}\s*\(")
_DECLARATION = re.compile(r"\boption\s*\(\s*(?:\(\s*\w+\s*\)\s*)?(\w+)")
_Types = dict[str, tuple[str, list[str]]]
_Found = tuple[CppSource, CppTree, tuple[CppTree, CppTree] | Table]


@dataclass(frozen=True, slots=True, kw_only=True)
class CppImport:
    """The machines of C++ files as a project.

    Attributes:
        unused: Options that nothing mentions; none if options are chosen at run time.
        errors: Files that cannot be read.
    """

    result: ImportResult
    machines: Mapping[str, CppMachine]
    unused: tuple[str, ...]
    errors: tuple[Finding, ...]


def contains_machines(text: str) -> bool:
    """Whether a text may declare state machines."""
    return bool(_MACHINE.search(text))


def import_cpp(texts: Mapping[Path, str], name: str) -> CppImport:
    """Convert the state machines of files to a project with a name.

    Args:
        texts: The texts of the files; those without machines show which options are used elsewhere.
        name: The name of the project.
    """
    found, errors = list[_Found](), list[Finding]()
    for path, text in texts.items():
        try:
            source = read_source(path, text if contains_machines(text) else "")
        except CppError as error:
            errors.append(error.finding)
            continue
        found += ((source, each[0], each[1:]) for each in iter_options(source.nodes))
        found += ((source, each.name, each) for each in iter_tables(source.nodes))
    names, types = DesignNames(), _Types()
    components = {each: names.allocate(each) for each in dict.fromkeys(node.text for _source, node, _body in found)}
    macros = {macro: about for text in texts.values() for macro, about in find_macros(text).items()}
    machines: dict[str, CppMachine] = {}
    graph: dict[str, set[str]] = {}
    for source, node, body in found:
        own = components[node.text]
        if own in machines:
            machines[own].notes.append(
                (machines[own].node.start, f"{source.path.name} declares it, too: not in the design")
            )
            continue
        conditions = CppConditions(machine=own, component=names.allocate(f"{own}Inputs"), names=names, types=types)
        machine = CppMachine(
            source=source, component=own, node=node, components=components, conditions=conditions, graph=graph
        )
        try:
            for each in read_table(machine, body, macros) if isinstance(body, Table) else read_option(machine, *body):
                machines.setdefault(each.component, each)
        except RecursionError:
            errors.append(CppError(f"'{node.text}' is nested too deeply", source.location(node.start)).finding)
    options = {node.text for _source, node, body in found if not isinstance(body, Table)}
    return CppImport(
        result=_result(machines, types, name),
        machines=machines,
        unused=tuple(components[each] for each in _find_unused(options, texts.values())),
        errors=tuple(errors),
    )


def _find_unused(options: set[str], texts: Iterable[str]) -> list[str]:
    """The options that are only declared."""
    mentioned, declared = Counter[str](), Counter[str]()
    for text in texts:
        if any(name in text for name in options):
            plain = [each for each in iter_tokens(text) if each.kind != COMMENT]
            mentioned.update(each.text.strip('"') for each in plain)
            declared.update(_DECLARATION.findall(" ".join(each.text for each in plain)))
            if "select_option" in text and re.search(r"\bselect_option\s*\(\s*\w", text):
                return []
    return sorted(name for name in options if mentioned[name] <= declared[name])


def _result(machines: Mapping[str, CppMachine], types: _Types, name: str) -> ImportResult:
    # The regions of a table have the same inputs and notes.
    inputs = {each.conditions.component: each.conditions for each in machines.values()}.values()
    notes = {
        (each.source.path, each.source.location(start).line, text)
        for each in machines.values()
        for start, text in each.notes
    }
    project = Project(
        name=name,
        languages=("cpp",),
        enumerations=tuple(
            Enumeration(name=each, elements=tuple((element, "") for element in elements))
            for each, elements in types.values()
        ),
        components=tuple(each for conditions in inputs if (each := conditions.interface())),
        designs=tuple(machine.design for machine in machines.values()),
    )
    designs = (
        ImportedDesign(component=each, path=path, comments=(), file=machine.source.path, anchors=())
        for (each, machine), path in zip(machines.items(), design_files(machines), strict=True)
    )
    listed = tuple(ImportNote(file=file, line=line, text=text) for file, line, text in sorted(notes))
    return ImportResult(project=project, designs=tuple(designs), comments=(), notes=listed)
