"""State machines in C++ sources: reads files and folders, and finds problems in them by the rules for designs."""

import re
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from vicode.check.behavior import check_behavior
from vicode.findings import DesignPath, Finding, sort_findings
from vicode.importers.cpp import ALIAS, CPP_SUFFIXES, CppImport, contains_machines, import_cpp
from vicode.model.design import Call, Design
from vicode.model.traversal import find_decision
from vicode.services.imported_behavior.behavior_check import locate_finding
from vicode.store import find_projects

_CODES = frozenset({"D401", "D402", "D421", "D422", "D423", "D433", "D434", "D435", "P214"})
"""The rules about transitions; others would tell how machines were imported."""
_INPUT = re.compile(rf"\b{ALIAS}\.(\w+)")


def find_cpp_files(path: Path) -> tuple[Path, ...]:
    """The C++ files at a path if they declare state machines; none for a folder with designs.

    Raises:
        OSError: A file cannot be read.
    """
    if path.is_file():
        return (path,) if path.suffix in CPP_SUFFIXES else ()
    if not path.is_dir() or find_projects(path):
        return ()
    files = tuple(sorted(each for each in path.rglob("*") if each.suffix in CPP_SUFFIXES and each.is_file()))
    return files if any(contains_machines(_read(each)) for each in files) else ()


def load_cpp(paths: Iterable[Path], name: str) -> CppImport:
    """Import the machines of files; `paths` are files and folders.

    Raises:
        OSError: A file cannot be read, or there is no state machine.
    """
    files = [file for path in paths for file in find_cpp_files(path)]
    imported = import_cpp({file: _read(file) for file in dict.fromkeys(files)}, name)
    if not imported.sources and not imported.errors:
        shown = ", ".join(map(str, paths))
        raise OSError(f"no state machines in {shown}; options of CABSL and tables of boost::sml are read")
    return imported


def _read(file: Path) -> str:
    return file.read_bytes().decode("utf-8", errors="replace")


def find_in_cpp(imported: CppImport) -> tuple[Finding, ...]:
    """The findings about machines, located in the C++ files, without those that the import causes."""
    project = imported.result.project
    plain = replace(project, designs=tuple(_without_code(design) for design in project.designs))
    found = (each for each in check_behavior(plain) if each.rule.code in _CODES and _is_meant(each, imported))
    return sort_findings([*imported.errors, *(locate_finding(_reword(each), imported.places) for each in found)])


def _without_code(design: Design) -> Design:
    """A design without C++ texts, which have no meaning for it."""
    return replace(
        design,
        states=tuple(
            replace(each, enter=(), leave=(), actions=tuple(act for act in each.actions if isinstance(act, Call)))
            for each in design.states
        ),
    )


def _is_meant(finding: Finding, imported: CppImport) -> bool:
    """Whether a finding is about the machine, and not about what the import could not read."""
    component, path = (finding.subject.component, finding.subject.path) if finding.subject else ("", ())
    match finding.rule.code:
        case "D421":
            return component not in imported.partial
        case "D422":
            return component not in imported.partial and path[-1] not in imported.ends.get(component, ())
        case "D435":
            return _is_certain(finding, component, imported)
    return True


def _is_certain(finding: Finding, component: str, imported: CppImport) -> bool:
    """Whether states alternate whatever relations the inputs have.

    Inputs are unrelated for the analysis, but `seen(300)` and `!seen(500)` exclude each other. So one of the guards
    must read all inputs that the others read: then it holds for values that exist.
    """
    design = imported.result.project.design(component)
    assert design is not None
    assert finding.subject is not None
    places = [finding.subject.path, *(note.subject.path for note in finding.notes if note.subject)]
    texts = [_guard_text(design, path) for path in places]
    read = [set(_INPUT.findall(text)) for text in texts]
    everything = set[str]().union(*read)
    is_fixed = not everything & imported.unfixed[component] and not any("done(" in text for text in texts)
    return is_fixed and everything in read


def _guard_text(design: Design, path: DesignPath) -> str:
    located = find_decision(design, path)
    if located is None:
        return ""
    return " and ".join(each.guard.when for each in (located.decision, *(group for group, _is_then in located.groups)))


def _reword(finding: Finding) -> Finding:
    if finding.rule.code != "P214" or finding.subject is None:
        return finding
    message = f"nothing that runs calls {finding.subject.component}"
    return replace(finding, message=message, fix="call it, or delete it")
