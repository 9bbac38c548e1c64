"""Renames a symbol: an edit if only one design refers to it, else a plan that is written to several files."""

from collections import Counter
from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace
from difflib import SequenceMatcher
from pathlib import Path

from vicode.check import find_errors as check_for_errors
from vicode.findings import Finding
from vicode.model.design import Design, Origin
from vicode.model.lowering import derived_variables, describe_origin
from vicode.model.paths import describe_path
from vicode.model.project import Project
from vicode.model.rename import ReferenceKind, ReferenceRename, SymbolRef, is_declared, rename_symbol, sibling_names
from vicode.model.rename.cpp import count_identifier_in_cpp, has_reference_in_cpp
from vicode.model.rename.python import has_reference_in_python
from vicode.model.traversal import iter_code
from vicode.services import messages
from vicode.services.rename.component import FileChange
from vicode.services.rename.modules import plan_module_renames
from vicode.services.rename.name_errors import validate_identifier
from vicode.services.rename.project_files import ProjectFiles, validate_writable
from vicode.services.rename.xabsl import collect_xabsl_renames, count_names_in_xabsl, rename_in_xabsl
from vicode.store import (
    find_project_file,
    is_read_only,
    read_project_file,
    save_design,
    save_project_file,
)

_KINDS = {"uses": "alias"}
_PROJECT_SECTIONS = ("enumerations", "constants", "components", "agents", "profiles")


@dataclass(frozen=True, slots=True, kw_only=True)
class SymbolRenamePlan:
    """The changes of a rename, or the error message.

    If only one design refers to the symbol, `design` is that design after the rename; else `changes` are the files to
    write. `note` describes what must be renamed by hand.
    """

    symbol: SymbolRef
    new: str
    error: str = ""
    design: Design | None = None
    changes: tuple[FileChange, ...] = ()
    note: str = ""
    ambiguous_places: tuple[str, ...] = ()
    """Where code contains the name with an uncertain meaning."""
    is_declaration_only: bool = False
    """Whether only the declaration in project.yaml changes."""


def describe_symbol(symbol: SymbolRef) -> str:
    return f"{_kind(symbol)} {symbol.name}"


def plan_symbol_rename(project_files: ProjectFiles, symbol: SymbolRef, new: str) -> SymbolRenamePlan:
    """Plan the rename of a symbol; nothing is changed."""
    project = project_files.project
    error = _validate_name(project, symbol, new)
    if error:
        return SymbolRenamePlan(symbol=symbol, new=new, error=error)
    renamed = rename_in_xabsl(project, rename_symbol(project, symbol, new))
    modules = plan_module_renames(project_files.folder, project, symbol, new)
    ambiguous = (*_find_ambiguous_uses(project, renamed, symbol), *modules.remaining)
    touched = [design.component for design in renamed.designs if project.design(design.component) != design]
    is_shared = any(getattr(renamed, section) != getattr(project, section) for section in _PROJECT_SECTIONS)
    error = describe_new_errors(project, renamed, touched if symbol.component and not is_shared else None)
    error = error or _validate_code(project, symbol, new)
    if not error and not is_shared and touched == [symbol.component]:
        return SymbolRenamePlan(
            symbol=symbol, new=new, design=renamed.design(symbol.component), ambiguous_places=ambiguous
        )
    file = find_project_file(project_files.folder) if is_shared else None
    error = error or validate_writable(project_files, touched) or _validate_project_file(project, file)
    error = error or (messages.read_only(modules.locked) if modules.locked else "")
    if error or (is_shared and file is None):
        return SymbolRenamePlan(symbol=symbol, new=new, error=error or "there is no project.yaml")
    changes = [_design_change(project_files, design) for design in renamed.designs if design.component in touched]
    if file is not None:
        changes.append(_project_change(file, renamed))
    changes += modules.changes
    plan = SymbolRenamePlan(
        symbol=symbol, new=new, changes=tuple(changes), note=_manual_step(project, symbol), ambiguous_places=ambiguous
    )
    only = changes[0] if len(changes) == 1 and file is not None else None
    is_alone = only is not None and not plan.note and not ambiguous and _changed_lines(only.old or "", only.new) == 1
    return replace(plan, is_declaration_only=is_alone)


def derived_names(design: Design) -> dict[str, Origin]:
    """The names of the declarations and states that constructs need, which only these can change."""
    declared = {each.name: each.origin for _section, each in design.declarations() if each.origin}
    states = {each.name: each.origin for each in design.states if each.origin == ("competence",)}
    return {**dict(derived_variables(design)), **declared, **states}


def _kind(symbol: SymbolRef) -> str:
    return _KINDS.get(symbol.section, symbol.section.removesuffix("s"))


def _validate_name(project: Project, symbol: SymbolRef, new: str) -> str:
    invalid = validate_identifier(new)
    if invalid:
        return invalid
    if not is_declared(project, symbol):
        return f"{describe_symbol(symbol)} no longer exists"
    design = project.design(symbol.component)
    derived = derived_names(design) if design is not None else {}
    if new in sibling_names(project, symbol) or new in derived:
        return messages.name_exists(_kind(symbol), new)
    if symbol.section != "uses" and symbol.name in derived and derived[symbol.name] != ("latches", symbol.name):
        return messages.derived_name(symbol.name, describe_origin(derived[symbol.name]))
    if symbol.section == "components" and project.interface(new) is not None:
        return messages.name_exists("component", new)
    return ""


def _validate_code(project: Project, symbol: SymbolRef, new: str) -> str:
    """An error message if code of the design already refers to `self.NEW` or `this->NEW`."""
    design = project.design(symbol.component)
    reference = ReferenceRename(kind=ReferenceKind.OWN, old=new, new=f"{new}_")
    if design is None or symbol.section == "arguments":
        return ""
    for language, has_reference, prefix in (
        ("python", has_reference_in_python, "self."),
        ("cpp", has_reference_in_cpp, "this->"),
    ):
        code = ((located.code.in_language(language) or "", located.role) for located in iter_code(design))
        if any(has_reference(text, role, reference) for text, role in code):
            return messages.name_used_in_code(symbol.component, f"{prefix}{new}")
    return ""


def describe_new_errors(project: Project, renamed: Project, components: Collection[str] | None) -> str:
    """The message of the first error that a change adds to the project or to `components` (None: all), or ""."""
    before, after = find_errors(project, components), find_errors(renamed, components)
    new_codes = Counter(error.rule.code for error in after) - Counter(error.rule.code for error in before)
    known = {error.message for error in before}
    added = next((error for error in after if error.rule.code in new_codes and error.message not in known), None)
    if added is None:
        return ""
    component = added.subject.component if added.subject and components is None else ""
    return f"{added.message}{f', in {component}' if component else ''}"


def find_errors(project: Project, components: Collection[str] | None = None) -> list[Finding]:
    """The errors of a project and all its designs, or those of `components`."""
    # Errors of the name itself come first: they are the most specific.
    found = check_for_errors(project, components)
    return sorted(found, key=lambda finding: finding.rule.code not in ("D404", "D405", "D406", "D407"))


def _validate_project_file(project: Project, file: Path | None) -> str:
    if file is None:
        return ""
    if is_read_only(file):
        return messages.read_only([file.name])
    read = read_project_file(_read(file), str(file)).project
    if read is None or any(getattr(read, section) != getattr(project, section) for section in _PROJECT_SECTIONS):
        return f"another program has just changed {file.name}, or it cannot be read: check it and try again"
    return ""


def _design_change(project_files: ProjectFiles, design: Design) -> FileChange:
    file = project_files.files[design.component]
    text = _read(file)
    new = save_design(design, text)
    return FileChange(
        file=file, old=text, new=new, summary=messages.line_summary(design.component, _changed_lines(text, new))
    )


def _project_change(file: Path, renamed: Project) -> FileChange:
    text = _read(file)
    read = read_project_file(text, str(file)).project
    assert read is not None
    changed = replace(
        read,
        enumerations=renamed.enumerations,
        constants=renamed.constants,
        components=renamed.components,
        agents=renamed.agents,
        profiles=renamed.profiles,
    )
    new = save_project_file(changed, text)
    return FileChange(file=file, old=text, new=new, summary=messages.line_summary(file.name, _changed_lines(text, new)))


def _changed_lines(old: str, new: str) -> int:
    blocks = SequenceMatcher(None, old.splitlines(), new.splitlines(), autojunk=False).get_opcodes()
    return sum(max(block[2] - block[1], block[4] - block[3]) for block in blocks if block[0] != "equal")


def _find_ambiguous_uses(project: Project, renamed: Project, symbol: SymbolRef) -> Iterator[str]:
    """The places where C++ and XABSL code still contains the old name, for the user to check."""
    old_names = collect_xabsl_renames(project, renamed).old_names
    in_xabsl = {*old_names, symbol.name} if old_names else set()
    for design in renamed.designs:
        used = [use.component for use in design.uses]
        if symbol.component and symbol.component not in (design.component, *used):
            continue
        for located in iter_code(design):
            for language, text in located.code.texts:
                name, count = {
                    "cpp": ("C++", count_identifier_in_cpp(text, symbol.name)),
                    "xabsl": ("XABSL", count_names_in_xabsl(text, in_xabsl)),
                }.get(language, ("", 0))
                if count:
                    times = f", {count} times" if count > 1 else ""
                    yield f"{design.component}: {describe_path(located.path[:-1] or located.path)}, {name}{times}"


def _manual_step(project: Project, symbol: SymbolRef) -> str:
    """The note about a hand-written class that contains the name, too."""
    interface = project.interface(symbol.component or symbol.name)
    if interface is None or ":" not in interface.implementation:
        return ""
    if symbol.section == "components":
        return f"The hand-written class {interface.implementation} keeps its name."
    return f"Rename it in the hand-written class {interface.implementation}, too."


def _read(file: Path) -> str:
    return file.read_bytes().decode("utf-8")
