"""What the documentation of a project is about while the project is being edited: unsaved work is part of it."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from vicode.check import check_project
from vicode.docsite import SiteInput, make_site_input
from vicode.editor.session.workspace import Workspace
from vicode.findings import Severity
from vicode.model.design import Design
from vicode.store import (
    OpenProject,
    find_faulty_components,
    iter_owning_components,
    locate_findings,
    open_project,
    read_design,
    save_design,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class UnsavedDesign:
    """A design with changes that no file holds, and the text of its file."""

    design: Design
    disk_text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class DocsSnapshot:
    """A project at one moment. Equal ones have the same documentation, as far as the editor knows of its files."""

    folder: Path
    file_signatures: object
    """What stood on the disk when it was looked at last."""
    unsaved_designs: Mapping[str, UnsavedDesign] = field(default_factory=dict)


def take_snapshot(workspace: Workspace) -> DocsSnapshot:
    """The project as it is now."""
    drafts = {
        each.design.component: UnsavedDesign(design=each.design, disk_text=each.shared.disk_text)
        for each in workspace.documents
        if not each.is_saved
    }
    return DocsSnapshot(folder=workspace.folder, file_signatures=workspace.file_signatures, unsaved_designs=drafts)


def load_docs_subject(snapshot: DocsSnapshot) -> SiteInput:
    """Read the files and lay the drafts over them; takes a moment, and is safe beside the event loop.

    Raises:
        OSError: The folder is gone.
    """
    opened = open_project(snapshot.folder)
    for name, draft in snapshot.unsaved_designs.items():
        if name in opened.files:
            opened = _with_draft(opened, name, draft)
    project = opened.project
    findings = locate_findings([*opened.findings, *check_project(project)], opened)
    errors = [each for each in findings if each.severity is Severity.ERROR]
    faulty = {
        language: find_faulty_components([each for each in errors if each.applies_to(language)], opened)
        for language in project.languages
    }
    return make_site_input(opened, project, findings, faulty)


def _with_draft(opened: OpenProject, name: str, draft: UnsavedDesign) -> OpenProject:
    designs = tuple(draft.design if each.component == name else each for each in opened.project.designs)
    project = replace(opened.project, designs=designs)
    try:
        text = save_design(draft.design, draft.disk_text)
    except ValueError:
        # No file can hold it as it is now: the lines of the last one have to do.
        return replace(opened, project=project)
    read = read_design(text, opened.sources[name].file)
    owned = zip(opened.findings, iter_owning_components(opened.findings, opened), strict=True)
    return replace(
        opened,
        project=project,
        sources={**opened.sources, name: read.source_map},
        texts={**opened.texts, name: text},
        findings=(*(finding for finding, owner in owned if owner != name), *read.findings),
    )
