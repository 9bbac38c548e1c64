"""Applies edits of generated code by other programs to open designs, and records the applied edits."""

import contextlib
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path, PurePath
from typing import TYPE_CHECKING

from vicode.editor.session.code.outside_edits import OutsideEdit
from vicode.editor.session.document import DocumentSession
from vicode.editor.session.gestures.item_paths import TrackedItem
from vicode.editor.session.presence import DISK_USER
from vicode.findings import DesignPath, Finding, FindingSubject
from vicode.generators import UnsoundDesignError, collect_components, component_generator, list_component_paths
from vicode.model.design import Design
from vicode.model.merge import merge_designs
from vicode.model.project import Project
from vicode.output import FileDiff, FileStatus
from vicode.regions import find_regions, get_comment_prefix, is_edited
from vicode.sync import (
    AppliedEdit,
    FileEdits,
    GeneratedHistory,
    RecordedEdit,
    RegionKey,
    apply_regions,
    describe_conflict,
    describe_problems,
    find_file_edits,
    find_new_errors,
    read_applied,
    record_applied,
    set_code,
)

if TYPE_CHECKING:
    from vicode.editor.session.workspace import Workspace


_RESOLVE = "choose a text with 'Resolve…' in the header"
_FIX_IN_FILE = "fix it in the file; then it is applied to the design"


class OutdatedChoiceError(Exception):
    """The file or the design has changed since the choice was offered."""


class GeneratedPaths:
    """The generated files of designs, computed again when files of the project change."""

    def __init__(self) -> None:
        self._seen: object = None
        self._paths: dict[str, tuple[str, ...]] = {}

    def find(self, workspace: "Workspace", component: str) -> tuple[str, ...]:
        """The files with the code of one design, relative to the folder of generated files."""
        if self._seen is not workspace.file_signatures:
            self._seen, self._paths = workspace.file_signatures, {}
        if component not in self._paths:
            self._paths[component] = list_component_paths(workspace.project, component)
        return self._paths[component]


def follow_generated_files(workspace: "Workspace") -> None:
    """Apply the edits of the generated files of all open designs that have changed."""
    for document in workspace.documents:
        outside = document.shared.outside
        files = [
            workspace.output_folder / path
            for path in workspace.generated_paths.find(workspace, document.design.component)
        ]
        # What could not be applied may be after a change of the design.
        seen = (tuple(map(file_signature, files)), document.rev if outside.is_open else 0)
        if seen != outside.seen:
            outside.seen = seen
            apply_edits(workspace, document)


def apply_edits(workspace: "Workspace", document: DocumentSession) -> None:
    """Apply the edits of the generated files of a design, as one edit; conflicts and invalid code wait for a user."""
    outside = document.shared.outside
    before = (outside.waiting, outside.problems)
    try:
        files = tuple(_find_edits(workspace, document))
        edits = tuple(_list_edits(workspace.project, files, workspace.output_folder.name))
    except UnsoundDesignError:
        outside.is_postponed = True
        return
    outside.is_postponed = False
    new = [edit for edit in edits if edit.finding is None and edit.version not in outside.offered]
    outside.offered |= {edit.version for edit in new}
    merged = [(edit, edit.region.merged or "") for edit in new]
    if new and _apply(document, merged, f"edit of generated code: {_listed(new)}", _only_user(document)):
        outside.announce(f"Applied from {PurePath(new[0].file.path).name}: {_listed(new)}", document.history.current_id)
        edits = tuple(edit for edit in edits if edit not in new)
    outside.waiting = edits
    folder = workspace.output_folder.name
    outside.problems = tuple(each for file in files for each in describe_problems(file, folder))
    outside.edited_outside = tuple(file for file in files if file.is_edited_outside and file.is_origin_known)
    if (outside.waiting, outside.problems) != before:
        _tell_problem(document, before[0], before[1])
        document.shared.recheck()


def find_lacking(workspace: "Workspace", component: str) -> tuple[DocumentSession, ...]:
    """Apply the edits of the generated code of a design and of all it uses, which are opened if they have edits.

    Returns:
        The designs that still lack edits.
    """
    used = collect_components(workspace.project, (component,))
    for name in sorted(used):
        if any(_has_edits(workspace.output_folder / path) for path in workspace.generated_paths.find(workspace, name)):
            workspace.open_document(name)
    follow_generated_files(workspace)
    return tuple(
        document
        for document in workspace.documents
        if document.design.component in used and document.shared.outside.lacks_edits
    )


def resolve(workspace: "Workspace", document: DocumentSession, choices: Mapping[OutsideEdit, str | None]) -> None:
    """Apply the choices of a user, as one edit of the design.

    Args:
        workspace: The project.
        document: The design.
        choices: The new text for each edit; None keeps the text of the design.

    Raises:
        OutdatedChoiceError: The file or the design has changed since; nothing is changed.
    """
    outside = document.shared.outside
    apply_edits(workspace, document)
    current = {_shown_version(edit): edit for edit in outside.waiting}
    if any(_shown_version(edit) not in current for edit in choices):
        raise OutdatedChoiceError
    chosen = [(current[_shown_version(edit)], text) for edit, text in choices.items()]
    outside.record((edit for edit, text in chosen if text is None), 0)
    applied = [(edit, text) for edit, text in chosen if text is not None]
    if applied:
        _apply(
            document,
            applied,
            f"resolve generated code: {_listed(edit for edit, _text in applied)}",
            document.user_id,
        )
    apply_edits(workspace, document)
    if document.is_saved:
        save_records(workspace, document)


def apply_to_design(document: DocumentSession, base: Design, design: Design, words: Sequence[str]) -> bool:
    """Merge a design that was read back from a generated file; return False on a conflict with the open one.

    Args:
        document: The open design.
        base: The design that the file was compared with.
        design: The same design with the edits.
        words: The edits in words.
    """
    merged = merge_designs(base, document.design, design)
    if merged.conflicts:
        return False
    document.edit(f"edit of generated code: {_shortened(words)}", lambda _design: merged.design)
    return True


def save_records(workspace: "Workspace", document: DocumentSession) -> None:
    """Write down which edits the saved design contains, for later runs of vicode."""
    changes = document.shared.outside.applied_edits(document.history)
    if changes and workspace.output_folder.is_dir():
        # Without the records, vicode asks about these edits again.
        with contextlib.suppress(OSError):
            record_applied(workspace.output_folder, changes)


def applied_edits(workspace: "Workspace") -> dict[RegionKey, RecordedEdit | None]:
    """The edits of generated files that open designs contain; None for those that they lost again."""
    return {
        key: applied
        for document in workspace.documents
        for key, applied in document.shared.outside.applied_edits(document.history).items()
    }


def _shown_version(edit: OutsideEdit) -> Hashable:
    return (edit.version, edit.region.design_text)


def _tell_problem(document: DocumentSession, waiting: Sequence[OutsideEdit], problems: Sequence[Finding]) -> None:
    """Announce the first new edit that could not be applied."""
    outside = document.shared.outside
    known = {edit.version for edit in waiting if edit.finding is not None}
    findings = [edit.finding for edit in outside.waiting if edit.finding is not None and edit.version not in known]
    findings += [finding for finding in outside.problems if finding not in problems]
    if findings:
        DocumentSession(document.shared, DISK_USER).post_notice(_located(findings[0]))


def _located(finding: Finding) -> str:
    place = finding.location
    return f"{PurePath(place.file).name}, line {place.line}: {finding.message}" if place else finding.message


def _only_user(document: DocumentSession) -> str:
    """The only user of a design, who can undo an applied edit like an own edit."""
    users = {presence.user.id for presence in document.shared.presence.presences}
    return users.pop() if len(users) == 1 else DISK_USER


def _apply(document: DocumentSession, edits: Sequence[tuple[OutsideEdit, str]], label: str, user_id: str) -> bool:
    """Change the code in the design, as one edit of a user; return whether it changed."""
    shared = document.shared
    session, before = DocumentSession(shared, user_id), shared.history

    def change(design: Design) -> Design:
        for edit, text in edits:
            design = set_code(design, edit.path, edit.file.language, text.strip("\n") or "pass")
        return design

    session.edit(label, change)
    if shared.history is before:
        return False
    entry_id = shared.history.current_id
    shared.outside.record((edit for edit, _text in edits), entry_id)
    shared.outside.mark((TrackedItem(lambda: document.design, edit.path) for edit, _text in edits), entry_id)
    return True


def _find_edits(workspace: "Workspace", document: DocumentSession) -> Iterator[FileEdits]:
    """The edits in the files of one design.

    Raises:
        UnsoundDesignError: The design has errors.
    """
    project, folder, design = workspace.project, workspace.output_folder, document.design
    applied = {**read_applied(folder), **applied_edits(workspace)}
    for path in workspace.generated_paths.find(workspace, design.component):
        old, language = _read(folder / path), path.partition("/")[0]
        if not _has_marks(old):
            continue
        code = component_generator(project, language, workspace.source_paths)(design)
        if code is None:
            raise UnsoundDesignError(design.component)
        difference = FileDiff(path=path, status=FileStatus.CHANGED, old=old, new=code.file.text)
        history = GeneratedHistory(folder=folder)
        yield from find_file_edits([difference], [code.file], history, applied=applied, display_folder=folder.name)


def _list_edits(project: Project, files: Sequence[FileEdits], folder: str) -> Iterator[OutsideEdit]:
    """The edits of regions with their paths; those with a finding cannot be applied as they are."""
    outcome = apply_regions(project, files)
    designs = (outcome.designs.get(design.component, design) for design in project.designs)
    changed = replace(project, designs=tuple(designs))
    errors = tuple(find_new_errors(project, changed, outcome.applied, folder))
    for each in outcome.applied:
        error = next((error for error in errors if _is_at(error, each.path)), None)
        finding = _not_applied(error, each) if error else None
        yield OutsideEdit(file=each.file, region=each.region, path=each.path, finding=finding)
    for file, region, path in outcome.conflicts:
        finding = replace(
            describe_conflict(file, region, path, folder),
            fix=_RESOLVE,
            subject=FindingSubject(component=file.component, path=path),
            notes=(),
        )
        yield OutsideEdit(file=file, region=region, path=path, finding=finding)


def _is_at(finding: Finding, path: DesignPath) -> bool:
    return finding.subject is not None and finding.subject.path[: len(path)] == path


def _not_applied(error: Finding, edit: AppliedEdit) -> Finding:
    subject = FindingSubject(component=edit.file.component, path=edit.path)
    return replace(
        error,
        message=f"an edit of the generated code is not applied: {error.message}",
        fix=_FIX_IN_FILE,
        subject=subject,
    )


def _listed(edits: Iterable[OutsideEdit]) -> str:
    return _shortened([edit.name for edit in edits])


def _shortened(names: Sequence[str]) -> str:
    return ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")


def _has_edits(file: Path) -> bool:
    return any(map(is_edited, find_regions(_read(file), get_comment_prefix(file.name)).regions))


def _has_marks(text: str) -> bool:
    """Whether a text may contain regions; half-written files may not."""
    return "<vicode " in text


def _read(file: Path) -> str:
    """The text of a file with line feeds as line breaks; empty if it cannot be read."""
    try:
        return file.read_text("utf-8")
    except (OSError, UnicodeDecodeError):
        return ""


def file_signature(file: Path) -> tuple[str, int, int]:
    """Path, modification time and size of a file, which change with its content."""
    try:
        status = file.stat()
    except OSError:
        return (str(file), 0, 0)
    return (str(file), status.st_mtime_ns, status.st_size)
