"""Another name for something that is declared: an edit where one design says it, else planned and written to files."""

from collections import Counter
from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace
from difflib import SequenceMatcher
from pathlib import Path

from vicode.check import check_project
from vicode.editor.session.descriptions import describe_path, error_reason
from vicode.editor.session.document import DocumentSession, FileTransaction
from vicode.editor.session.rename_component import FileChange, validate_writable
from vicode.editor.session.rename_symbol_xabsl import collect_xabsl_renames, count_names_in_xabsl, rename_in_xabsl
from vicode.editor.session.workspace import Workspace
from vicode.findings import Finding, Severity
from vicode.model.design import Design
from vicode.model.names import is_valid_name, name_from_text
from vicode.model.project import Project
from vicode.model.rename import ReferenceKind, ReferenceRename, SymbolRef, is_declared, rename_symbol, sibling_names
from vicode.model.rename.cpp import count_identifier_in_cpp, has_reference_in_cpp
from vicode.model.rename.python import has_reference_in_python
from vicode.model.traversal import iter_code
from vicode.store import find_project_file, is_read_only, read_project_file, save_design, save_project_file, write_text

_WORDS = {"uses": "alias", "elements": "element", "enumerations": "enumeration"}
_PROJECT_SECTIONS = ("enumerations", "constants", "components", "agents")


@dataclass(frozen=True, slots=True, kw_only=True)
class SymbolRenamePlan:
    """What a new name would change. `error` says in words why it cannot be done.

    Else `design` is the one design that says it, as it would be; or it is None, and `changes` are the files of all
    that do. `note` tells what nobody but a person can change.
    """

    symbol: SymbolRef
    new: str
    error: str = ""
    design: Design | None = None
    changes: tuple[FileChange, ...] = ()
    note: str = ""
    ambiguous_places: tuple[str, ...] = ()
    """Where code says the name and it is not certain what it means there."""
    is_declaration_only: bool = False
    """Whether nothing says the name but the line of project.yaml that declares it."""


def describe_symbol(thing: SymbolRef) -> str:
    """What it is, and its name."""
    return f"{_kind(thing)} {thing.name}"


def validate_identifier(name: str) -> str:
    """Why a text is no name of anything, in words; empty if it is one."""
    wanted = name.strip()
    if not wanted:
        return "it needs a name"
    if is_valid_name(wanted):
        return ""
    example = name_from_text(wanted)
    like = f", such as {example[:1].lower() + example[1:]}" if example else ""
    return f"use letters, digits and underscores, a letter first{like}"


def plan_symbol_rename(workspace: Workspace, thing: SymbolRef, new: str) -> SymbolRenamePlan:
    """What another name for a thing would change; nothing is touched."""
    project = workspace.project
    refused = _validate_name(project, thing, new)
    if refused:
        return SymbolRenamePlan(symbol=thing, new=new, error=refused)
    renamed = rename_in_xabsl(project, rename_symbol(project, thing, new))
    by_hand = tuple(_find_ambiguous_uses(project, renamed, thing))
    touched = [design.component for design in renamed.designs if project.design(design.component) != design]
    is_shared = any(getattr(renamed, section) != getattr(project, section) for section in _PROJECT_SECTIONS)
    refused = describe_new_errors(project, renamed, touched if thing.component and not is_shared else None)
    refused = refused or _validate_code(project, thing, new)
    if not refused and not is_shared and touched == [thing.component]:
        return SymbolRenamePlan(symbol=thing, new=new, design=renamed.design(thing.component), ambiguous_places=by_hand)
    file = find_project_file(workspace.folder) if is_shared else None
    refused = refused or validate_writable(workspace, touched) or _validate_project_file(project, file)
    if refused or (is_shared and file is None):
        return SymbolRenamePlan(symbol=thing, new=new, error=refused or "there is no project.yaml")
    changes = [_design_change(workspace, design) for design in renamed.designs if design.component in touched]
    if file is not None:
        changes.append(_project_change(file, renamed))
    plan = SymbolRenamePlan(
        symbol=thing, new=new, changes=tuple(changes), note=_manual_step(project, thing), ambiguous_places=by_hand
    )
    only = changes[0] if len(changes) == 1 and file is not None else None
    is_alone = only is not None and not plan.note and not by_hand and _changed_lines(only.old or "", only.new) == 1
    return replace(plan, is_declaration_only=is_alone)


def apply_symbol_rename(workspace: Workspace, plan: SymbolRenamePlan, person: str = "") -> str:
    """Write what a plan says; returns why not, if the files are no longer what it was made for.

    Raises:
        OSError: A file cannot be written; those written before are as they were again.
    """
    again = plan_symbol_rename(workspace, plan.symbol, plan.new)
    if again != plan:
        return again.error or "a file has changed meanwhile: look at the list once more"
    whole = RenameEdit(workspace=workspace, symbol=plan.symbol, new=plan.new)
    _write_all(
        workspace, plan, FileTransaction(files=_files_of(plan), label=whole.label, user_id=person, compound=whole)
    )
    return ""


@dataclass(frozen=True, slots=True, kw_only=True)
class RenameEdit:
    """A new name that was written into several files: the histories of their designs take it back in all of them."""

    workspace: Workspace
    symbol: SymbolRef
    new: str

    @property
    def label(self) -> str:
        """What the histories call it."""
        return f"rename {self.symbol.name} to {self.new}"

    def undo(self, person: str) -> str:
        """Give the thing its old name again; returns why not."""
        plan = plan_symbol_rename(self.workspace, replace(self.symbol, name=self.new), self.symbol.name)
        return self._apply(
            plan, FileTransaction(files=_files_of(plan), label=f"undo {self.label}", user_id=person, undone_edit=self)
        )

    def redo(self, person: str) -> str:
        """Give it the new name once more; returns why not."""
        plan = plan_symbol_rename(self.workspace, self.symbol, self.new)
        return self._apply(
            plan, FileTransaction(files=_files_of(plan), label=f"redo {self.label}", user_id=person, compound=self)
        )

    def _apply(self, plan: SymbolRenamePlan, act: FileTransaction) -> str:
        if plan.error:
            return plan.error[:1].upper() + plan.error[1:]
        document = self.workspace.open_document(self.symbol.component)
        if plan.design is not None and document is not None:
            # Nobody else says it any more.
            DocumentSession(document.shared, act.user_id).apply_transaction(act, plan.design)
            return ""
        try:
            _write_all(self.workspace, plan, act)
        except (OSError, ValueError) as error:
            return f"Not done: {error_reason(error)}"
        return ""


def _files_of(plan: SymbolRenamePlan) -> frozenset[Path]:
    return frozenset(change.file for change in plan.changes)


def _write_all(workspace: Workspace, plan: SymbolRenamePlan, act: FileTransaction) -> None:
    """Write all files of a plan, or none of them; open designs follow, and who is at them hears of it."""
    written: list[FileChange] = []
    try:
        for change in plan.changes:
            write_text(change.file, change.new)
            written.append(change)
    except OSError:
        for change in written:
            write_text(change.file, change.old or "")
        raise
    finally:
        workspace.sync_from_disk(act)
    who = workspace.users.name_of(act.user_id) if act.user_id else "Somebody"
    for document in workspace.documents:
        hand = DocumentSession(document.shared, act.user_id)
        if document.file in act.files:
            hand.post_notice(f"{who} renamed {describe_symbol(plan.symbol)} to {plan.new} in {_count_files(act.files)}")
        # The form of every design shows what the project declares.
        document.shared.notify_listeners(hand)


def _kind(thing: SymbolRef) -> str:
    return _WORDS.get(thing.section, thing.section.removesuffix("s"))


def _count_files(files: Collection[Path]) -> str:
    return "1 file" if len(files) == 1 else f"{len(files)} files"


def _validate_name(project: Project, thing: SymbolRef, new: str) -> str:
    """Why nothing can have such a name here, or is not there to get it."""
    kind = _kind(thing)
    shape = validate_identifier(new)
    if shape:
        return shape
    if not is_declared(project, thing):
        return f"there is no {describe_symbol(thing)} any more"
    if new in sibling_names(project, thing):
        return f"there is already {'an' if kind[0] in 'aeo' else 'a'} {kind} {new}"
    if thing.section == "components" and project.interface(new) is not None:
        return f"there is already a component {new}"
    return ""


def _validate_code(project: Project, thing: SymbolRef, new: str) -> str:
    """Whether code of the design already says `self.NEW`, or `this->NEW`: it would mean something else then."""
    design, said = project.design(thing.component), ReferenceRename(kind=ReferenceKind.OWN, old=new, new=f"{new}_")
    if design is None or thing.section == "arguments":
        return ""
    for language, says, me in (("python", has_reference_in_python, "self."), ("cpp", has_reference_in_cpp, "this->")):
        texts = ((placed.code.in_language(language) or "", placed.role) for placed in iter_code(design))
        if any(says(text, role, said) for text, role in texts):
            return f"the code of {thing.component} says {me}{new} already, and means something else"
    return ""


def describe_new_errors(project: Project, renamed: Project, components: Collection[str] | None) -> str:
    """What errors a change would bring to the project or to designs of it (None: to all), in words."""
    before, after = (find_errors(each, components) for each in (project, renamed))
    grown = Counter(each.rule.code for each in after) - Counter(each.rule.code for each in before)
    known = {each.message for each in before}
    found = next((each for each in after if each.rule.code in grown and each.message not in known), None)
    if found is None:
        return ""
    where = found.subject.component if found.subject and components is None else ""
    return f"{found.message}{f', in {where}' if where else ''}"


def find_errors(project: Project, components: Collection[str] | None = None) -> list[Finding]:
    """The errors of a project and all its designs, or those of `components`."""
    found = [each for each in check_project(project, components) if each.severity is Severity.ERROR]
    # What is wrong with a name itself comes first: it says most.
    return sorted(found, key=lambda each: each.rule.code not in ("D404", "D405", "D406", "D407"))


def _validate_project_file(project: Project, file: Path | None) -> str:
    if file is None:
        return ""
    if is_read_only(file):
        return f"{file.name} cannot be changed: read-only"
    read = read_project_file(_read(file), str(file)).project
    if read is None or any(getattr(read, section) != getattr(project, section) for section in _PROJECT_SECTIONS):
        return f"{file.name} was just changed by another program, or cannot be read: look again"
    return ""


def _design_change(workspace: Workspace, design: Design) -> FileChange:
    file = workspace.files[design.component]
    text = _read(file)
    new = save_design(design, text)
    return FileChange(file=file, old=text, new=new, summary=f"{design.component}: {_count_lines(text, new)}")


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
    )
    new = save_project_file(changed, text)
    return FileChange(file=file, old=text, new=new, summary=f"the project: {_count_lines(text, new)}")


def _changed_lines(old: str, new: str) -> int:
    blocks = SequenceMatcher(None, old.splitlines(), new.splitlines(), autojunk=False).get_opcodes()
    return sum(max(block[2] - block[1], block[4] - block[3]) for block in blocks if block[0] != "equal")


def _count_lines(old: str, new: str) -> str:
    count = _changed_lines(old, new)
    return "1 line" if count == 1 else f"{count} lines"


def _find_ambiguous_uses(project: Project, renamed: Project, thing: SymbolRef) -> Iterator[str]:
    """Where C++ and XABSL still say the old name: there a person must look."""
    words = collect_xabsl_renames(project, renamed).old_names
    in_xabsl = {*words, thing.name} if words else set()
    for design in renamed.designs:
        used = [use.component for use in design.uses]
        if thing.component and thing.component not in (design.component, *used):
            continue
        for placed in iter_code(design):
            for language, text in placed.code.texts:
                name, count = {
                    "cpp": ("C++", count_identifier_in_cpp(text, thing.name)),
                    "xabsl": ("XABSL", count_names_in_xabsl(text, in_xabsl)),
                }.get(language, ("", 0))
                if count:
                    often = f", {count} times" if count > 1 else ""
                    yield f"{design.component}: {describe_path(placed.path[:-1] or placed.path)}, {name}{often}"


def _manual_step(project: Project, thing: SymbolRef) -> str:
    """What stays to be done by hand: a class that somebody wrote has the name, too."""
    interface = project.interface(thing.component or thing.name)
    if interface is None or ":" not in interface.implementation:
        return ""
    if thing.section == "components":
        return f"{interface.implementation} keeps its name: it is the class, and written by hand."
    return f"Rename it in {interface.implementation}, too: that class is written by hand."


def _read(file: Path) -> str:
    return file.read_bytes().decode("utf-8")
