"""State machines in C++ sources: reads files and folders, and finds problems in them by the rules for designs."""

import re
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from vicode.check.behavior import check_behavior
from vicode.findings import DesignPath, Finding, FindingSubject, get_rule, sort_findings
from vicode.importers.cpp import ALIAS, CPP_SUFFIXES, CppImport, contains_machines, import_cpp
from vicode.model.design import Call, Design
from vicode.model.project import Project
from vicode.model.traversal import find_decision
from vicode.services.imported_behavior.behavior_check import locate_finding
from vicode.store import find_projects

_CODES = frozenset({"D401", "D402", "D421", "D422", "D423", "D433", "D434", "D435"})
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


_READ = (
    "C++ files may have options of CABSL and tables of boost::sml; vicode import also reads XABSL, SCXML, "
    "VICODE (X.xml), rqt BICA (X.bica), FlexBE (x_sm.py) and YASMIN (x.xml)"
)


def load_cpp(paths: Iterable[Path], name: str) -> CppImport:
    """Import the machines of files; `paths` are files and folders.

    Raises:
        OSError: A file cannot be read, or there is no state machine.
    """
    files = [file for path in paths for file in find_cpp_files(path)]
    imported = import_cpp({file: _read(file) for file in dict.fromkeys(files)}, name)
    if not imported.machines and not imported.errors:
        shown = ", ".join(map(str, paths))
        raise OSError(f"no state machines in {shown}; {_READ}")
    return imported


def _read(file: Path) -> str:
    return file.read_bytes().decode("utf-8", errors="replace")


def find_in_cpp(imported: CppImport) -> tuple[Finding, ...]:
    """The findings about machines, located in the C++ files, without those that the import causes."""
    plain = without_code(imported.result.project)
    found = [each for each in check_behavior(plain) if each.rule.code in _CODES and _is_meant(each, imported)]
    places = {component: machine.locations() for component, machine in imported.machines.items()}
    for name in imported.unused:
        subject = FindingSubject(component=name, path=("component",))
        message = f"nothing in these files calls {name}"
        fix = "call it or delete it, unless a configuration file names it"
        found.append(Finding(rule=get_rule("P214"), message=message, fix=fix, subject=subject))
    return sort_findings([*imported.errors, *(locate_finding(each, places) for each in found)])


def without_code(project: Project) -> Project:
    """A project without C++ texts, which have no meaning for designs."""
    designs = []
    for design in project.designs:
        calls = {state.name: tuple(each for each in state.actions if isinstance(each, Call)) for state in design.states}
        states = (replace(state, enter=(), leave=(), actions=calls[state.name]) for state in design.states)
        designs.append(replace(design, states=tuple(states)))
    return replace(project, designs=tuple(designs))


def _is_meant(finding: Finding, imported: CppImport) -> bool:
    """Whether a finding is about the machine, and not about what the import could not read."""
    if finding.subject is None or finding.subject.component not in imported.machines:
        return False
    machine, path = imported.machines[finding.subject.component], finding.subject.path
    if finding.rule.code in ("D421", "D422"):
        return not machine.is_partial and path[-1] not in machine.ends
    if finding.rule.code != "D435":
        return True
    # Inputs are unrelated for the analysis, but `seen(300)` and `!seen(500)` exclude each other. So the inputs of the
    # guards must have no word in common, and one of the guards must read all of them: then it holds for some values.
    places = [path, *(note.subject.path for note in finding.notes if note.subject)]
    texts = [_guard_text(machine.design, place) for place in places]
    read = [set(_INPUT.findall(text)) for text in texts]
    everything = set[str]().union(*read)
    interface = machine.conditions.interface()
    shown = [each.doc for each in interface.outputs if each.name in everything] if interface else []
    words = [word for text in shown for word in set(re.findall(r"[A-Za-z_]\w*", text))]
    is_fixed = not everything & machine.conditions.unfixed and not any("done(" in text for text in texts)
    return is_fixed and everything in read and len(words) == len(set(words))


def _guard_text(design: Design, path: DesignPath) -> str:
    located = find_decision(design, path)
    groups = (group for group, _is_then in located.groups) if located else ()
    return " ".join(each.guard.when for each in (*([located.decision] if located else []), *groups))
