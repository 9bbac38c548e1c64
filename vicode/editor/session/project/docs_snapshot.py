"""The input of a project's documentation site while the project is edited, including unsaved designs."""

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
    """A design with unsaved changes, and the text of its file."""

    design: Design
    disk_text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class DocsSnapshot:
    """The state of a project; equal snapshots have equal documentation."""

    folder: Path
    file_signatures: object
    """What stood on the disk when it was looked at last."""
    unsaved_designs: Mapping[str, UnsavedDesign] = field(default_factory=dict)


def take_snapshot(workspace: Workspace) -> DocsSnapshot:
    drafts = {
        document.design.component: UnsavedDesign(design=document.design, disk_text=document.shared.disk_text)
        for document in workspace.documents
        if not document.is_saved
    }
    return DocsSnapshot(folder=workspace.folder, file_signatures=workspace.file_signatures, unsaved_designs=drafts)


def load_docs_subject(snapshot: DocsSnapshot) -> SiteInput:
    """Read the project with its unsaved designs; slow, and safe in a worker thread.

    Raises:
        OSError: The folder no longer exists.
    """
    opened = open_project(snapshot.folder)
    for name, draft in snapshot.unsaved_designs.items():
        if name in opened.files:
            opened = _with_draft(opened, name, draft)
    project = opened.project
    findings = locate_findings([*opened.findings, *check_project(project)], opened)
    errors = [finding for finding in findings if finding.severity is Severity.ERROR]
    faulty = {
        language: find_faulty_components([error for error in errors if error.applies_to(language)], opened)
        for language in project.languages
    }
    return make_site_input(opened, project, findings, faulty)


def _with_draft(opened: OpenProject, name: str, draft: UnsavedDesign) -> OpenProject:
    designs = tuple(draft.design if design.component == name else design for design in opened.project.designs)
    project = replace(opened.project, designs=designs)
    try:
        text = save_design(draft.design, draft.disk_text)
    except ValueError:
        # This design cannot be saved: keep the lines of the text on disk.
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
