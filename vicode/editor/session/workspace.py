"""An open project: its designs with unsaved edits, and their files."""

import contextlib
import time
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from vicode.check import check_design, check_project
from vicode.editor.session.code import code_sync
from vicode.editor.session.document import DiskVersion, DocumentSession, FileTransaction, SharedDocument
from vicode.editor.session.presence import DISK_USER, UserDirectory
from vicode.findings import DesignPath, Finding
from vicode.model.design import Design, State
from vicode.model.merge import merge_designs
from vicode.model.names import snake_case
from vicode.model.project import Project
from vicode.output import back_up_edited
from vicode.services.generation import design_output
from vicode.services.generation.design_output import GenerationRequest, GenerationResult, PendingOutput
from vicode.services.running_robots.robot_link import RobotLink
from vicode.store import (
    FileChangedError,
    OpenProject,
    find_design_files,
    is_file_taken,
    open_project,
    read_design,
    relative_design_paths,
    replace_text,
    save_design,
    write_text,
)
from vicode.store.documents import PROJECT_FILES

_POLL_INTERVAL_S = 0.8
_MAX_SAVE_ATTEMPTS = 50


class DiskConflictError(Exception):
    """Another program changed the file of a design, in conflict with unsaved edits."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TrashedDesign:
    """A design moved to the trash, with the content to restore it."""

    component: str
    file: Path
    content: bytes


@dataclass(eq=False)
class Workspace:
    """A project that is edited; `project` includes the unsaved edits of open documents."""

    folder: Path
    key: str
    users: UserDirectory = field(default_factory=UserDirectory)
    robots: RobotLink = field(default_factory=RobotLink)
    is_trusted: bool = False
    """Whether a user said that the code of the folder may run."""
    has_other_editor: bool = False
    """Whether another editor has the folder open."""
    project: Project = field(init=False)
    broken_files: dict[str, Path] = field(init=False)
    files: dict[str, Path] = field(init=False)
    removed_components: dict[str, str] = field(init=False, default_factory=dict)
    trashed_designs: dict[str, TrashedDesign] = field(init=False, default_factory=dict)
    generated_paths: code_sync.GeneratedPaths = field(init=False, default_factory=code_sync.GeneratedPaths)
    _polled_s: float = field(init=False, default=0.0)
    _texts: dict[str, str] = field(init=False)
    _parse_findings: dict[str, tuple[Finding, ...]] = field(init=False)
    _seen: frozenset[tuple[str, int, int]] = field(init=False, default=frozenset())
    _documents: dict[str, DocumentSession] = field(init=False, default_factory=dict)
    _checked: tuple[Project, tuple[Finding, ...]] | None = field(init=False, default=None)

    def __post_init__(self) -> None:
        self.sync_from_disk()

    def poll_disk(self) -> None:
        """Call `sync_from_disk` at most about once a second, however many windows poll.

        Raises:
            OSError: The folder no longer exists.
        """
        now_s = time.monotonic()
        if now_s - self._polled_s >= _POLL_INTERVAL_S:
            self._polled_s = now_s
            self.sync_from_disk()
            code_sync.follow_generated_files(self)

    def sync_from_disk(self, transaction: FileTransaction | None = None) -> None:
        """Load the changes of other programs; where they conflict with unsaved edits, a user must resolve the conflict.

        Args:
            transaction: An edit by a user of this editor, to which changes of its files are attributed.

        Raises:
            OSError: The folder no longer exists.
        """
        files = (*find_design_files(self.folder), *(self.folder / name for name in PROJECT_FILES))
        seen = frozenset(map(code_sync.file_signature, files))
        if seen != self._seen:
            self._seen = seen
            self._apply_project(open_project(self.folder), transaction)

    def open_document(self, component: str) -> DocumentSession | None:
        """Open the document of a design, or return it if open; None if there is no such design."""
        design = self.project.design(component)
        if component not in self._documents and design is not None:
            file, text = self.files[component], self._texts[component]
            findings = self._parse_findings.get(component, ())
            shared = SharedDocument(
                file=file, disk_text=text, saved=design, check=self._check, parse_findings=findings, users=self.users
            )
            document = DocumentSession(shared)
            document.shared.changes.subscribe(self._recheck_dependents)
            self._documents[component] = document
        return self._documents.get(component)

    @property
    def documents(self) -> tuple[DocumentSession, ...]:
        return tuple(self._documents.values())

    def component_in_file(self, path: Path) -> str | None:
        return next((name for name, file in self.files.items() if name and file.resolve() == path.resolve()), None)

    @property
    def broken_file_names(self) -> tuple[str, ...]:
        """The design files that cannot be parsed, relative to the project folder."""
        return tuple(self.broken_files)

    @property
    def unsaved_components(self) -> tuple[str, ...]:
        return tuple(name for name, document in self._documents.items() if not document.is_saved)

    def findings_if_open(self, component: str) -> tuple[Finding, ...] | None:
        """The findings of an open design, None if it is not open."""
        document = self._documents.get(component)
        return document.findings if document else None

    @property
    def project_findings(self) -> tuple[Finding, ...]:
        if self._checked is None or self._checked[0] is not self.project:
            self._checked = (self.project, check_project(self.project, ()))
        return self._checked[1]

    @property
    def file_signatures(self) -> frozenset[tuple[str, int, int]]:
        """Path, modification time and size of each file at the last synchronization."""
        return self._seen

    @property
    def parse_findings(self) -> Mapping[str, tuple[Finding, ...]]:
        """The findings of parsing the files, by component; those of no component under ""."""
        return self._parse_findings

    @property
    def source_paths(self) -> dict[str, str]:
        """The design files by component, relative to the project folder."""
        return relative_design_paths(self.files, self.folder)

    def save(self, document: DocumentSession, *, overwrite: bool = False) -> None:
        """Save a design by patching the text of its file, merging changes of other programs.

        Args:
            document: The design.
            overwrite: Keep this editor's version where the two conflict.

        Raises:
            DiskConflictError: The versions conflict, and `overwrite` is false.
            OSError: The file cannot be written.
            ValueError: The design cannot be represented in a file.
        """
        for _attempt in range(_MAX_SAVE_ATTEMPTS):
            # Another program may write the file between the merge with its version and the replacement.
            with contextlib.suppress(FileChangedError):
                self._merge_and_write(document, overwrite=overwrite)
                break
        else:
            self._merge_and_write(document, overwrite=overwrite)
        code_sync.save_records(self, document)

    def _merge_and_write(self, document: DocumentSession, *, overwrite: bool) -> None:
        text = _read(document.file)
        if (text or "") != document.shared.disk_text:
            self._reconcile_with_disk(document.shared, _disk_version(document, text))
        if document.shared.disk_conflict is not None:
            if not overwrite and (document.shared.conflicts or document.shared.disk_conflict.design is None):
                raise DiskConflictError
            self.resolve_conflict(document)
            text = _read(document.file)
        self._write(document, text, text or "")

    def resolve_conflict(self, document: DocumentSession, theirs_at: Collection[DesignPath] = ()) -> None:
        """Merge the two sides of a conflict with the file.

        A file that no longer contains a design is backed up and overwritten; a missing file is created again.

        Args:
            document: The design.
            theirs_at: The paths of the conflicts in which the version on disk wins.

        Raises:
            OSError: The file cannot be backed up or written.
            ValueError: The design cannot be represented in a file.
        """
        disk = document.shared.disk_conflict
        if disk is None:
            return
        if disk.design is None:
            if not document.is_file_missing:
                back_up_edited(document.file)
            self._write(document, None, document.shared.disk_text)
            return
        merged = merge_designs(document.shared.saved, document.design, disk.design, theirs_at=theirs_at)
        document.adopt_disk_version(disk, "resolve conflict with disk", merged.design)

    def can_create(self, component: str) -> bool:
        """Whether the file name of a new component is free."""
        return not is_file_taken(self._file_for(component))

    def create(self, component: str, text: str = "") -> DocumentSession:
        """Create a design and its file, from a text or else with one state.

        Raises:
            FileExistsError: The file already exists.
            OSError: The file cannot be written.
        """
        file = self._file_for(component)
        if is_file_taken(file):
            raise FileExistsError(file)
        design = Design(component=component, initial="Start", states=(State(name="Start", at=(160, 120)),))
        if text:
            design = read_design(text, file.name).design or design
        text = text or save_design(design, "")
        replace_text(file, None, text)
        self.files[component], self._texts[component] = file, text
        self.project = replace(self.project, designs=(*self.project.designs, design))
        document = self.open_document(component)
        assert document is not None
        return document

    def drop_document(self, component: str, renamed_to: str = "") -> None:
        """Close a design whose file was removed; its windows show the component it was renamed to, if any."""
        self._documents.pop(component, None)
        self.removed_components[component] = renamed_to

    def is_file_unchanged(self, component: str) -> bool:
        """Whether the file of a design still contains the text last read or written."""
        document = self._documents.get(component)
        known = document.shared.disk_text if document else self._texts.get(component)
        return _read(self.files[component]) == known

    @property
    def output_folder(self) -> Path:
        return (self.folder / self.project.generated).resolve()

    def prepare_output(self, document: DocumentSession) -> PendingOutput:
        """Generate the saved versions of a design and of all it uses, without writing.

        Raises:
            DiskConflictError: Another program changed the file of the design.
            OSError: A file cannot be read.
        """
        self.sync_from_disk()
        if document.shared.disk_conflict is not None:
            raise DiskConflictError
        saved = {name: document.shared.saved for name, document in self._documents.items()}
        designs = tuple(saved.get(design.component, design) for design in self.project.designs)
        findings = {name: document.shared.parse_findings for name, document in self._documents.items()}
        job = GenerationRequest(
            project=replace(self.project, designs=designs),
            source_paths=self.source_paths,
            parse_findings=self._parse_findings | findings,
            applied=code_sync.applied_edits(self),
            project_folder=self.folder,
        )
        return design_output.prepare_output(self.output_folder, job, document.design.component)

    def generate(self, document: DocumentSession, *, is_forced: bool = False) -> GenerationResult:
        """Generate and write code; hand-edited files are backed up if `is_forced`, and else prevent writing.

        Raises:
            DiskConflictError: Another program changed the file of the design.
            OSError: A file cannot be written.
        """
        return design_output.write_output(self.prepare_output(document), is_forced=is_forced)

    def _write(self, document: DocumentSession, text: str | None, patched: str) -> None:
        """Write a design as a patch of `patched`; `text` is the content of the file, None if it is missing."""
        new = save_design(document.design, patched)
        if new != text and text is None and document.file.exists():
            # Not a design any more: it was backed up.
            write_text(document.file, new)
        elif new != text:
            replace_text(document.file, text, new)
        findings = read_design(new, document.file.name).findings
        written = DiskVersion(text=new, design=document.design, parse_findings=findings)
        document.adopt_disk_version(written, "save")

    def _file_for(self, component: str) -> Path:
        return self.folder / f"{snake_case(component)}.yaml"

    def _apply_project(self, opened: OpenProject, transaction: FileTransaction | None) -> None:
        """Replace the project by the one read from disk, merging the open documents."""
        self._texts, self.files = dict(opened.texts), dict(opened.files)
        self.removed_components = {
            name: new for name, new in self.removed_components.items() if opened.project.design(name) is None
        }
        broken = (*opened.broken_files, *([opened.files[""]] if opened.is_project_file_broken else []))
        self.broken_files = {_name_in(self.folder, file): file for file in broken}
        self._parse_findings = dict.fromkeys(opened.texts, ())
        for finding in opened.findings:
            name = finding.subject.component if finding.subject else ""
            self._parse_findings[name] = (*self._parse_findings.get(name, ()), finding)
        read = {design.component: design for design in opened.project.designs}
        # An open design whose file is missing stays; saving it creates the file again.
        kept = {name: document.design for name, document in self._documents.items()}
        for name in kept:
            self.files.setdefault(name, self._documents[name].file)
        self.project = replace(opened.project, designs=tuple({**read, **kept}.values()))
        for name, document in self._documents.items():
            text = self._texts.get(name) if name in read else _read(document.file)
            if text != document.shared.disk_text:
                disk = DiskVersion(
                    text=text or "", design=read.get(name), parse_findings=self._parse_findings.get(name, ())
                )
                is_own = transaction is not None and document.file in transaction.files
                self._reconcile_with_disk(document.shared, disk, transaction if is_own else None)
            else:
                document.shared.disk_conflict = None
            document.shared.recheck()

    def _reconcile_with_disk(
        self, shared: SharedDocument, disk: DiskVersion, transaction: FileTransaction | None = None
    ) -> None:
        """Merge an open design with the version on disk, or record their conflict."""
        session = DocumentSession(shared, DISK_USER)
        if disk.design is None:
            # The file is missing or incomplete: keep the open design until a user saves it.
            shared.disk_conflict = disk
            shared.changes.notify(session)
        elif session.is_saved and transaction is not None:
            shared.mark_saved(disk)
            session.apply_transaction(transaction, disk.design)
        elif session.is_saved:
            session.adopt_disk_version(disk, "reload from disk")
        else:
            merged = merge_designs(shared.saved, session.design, disk.design)
            if merged.conflicts:
                shared.disk_conflict = disk
                shared.changes.notify(session)
            else:
                session.adopt_disk_version(disk, "merge from disk", merged.design)

    def _check(self, design: Design) -> tuple[Finding, ...]:
        designs = (design if other.component == design.component else other for other in self.project.designs)
        self.project = replace(self.project, designs=tuple(designs))
        return check_design(self.project, design)

    def _recheck_dependents(self, changed: DocumentSession) -> None:
        """Check the open designs that use a changed design: its interface may have changed."""
        component = changed.design.component
        for document in self._documents.values():
            if document.shared is not changed.shared and any(
                use.component == component for use in document.design.uses
            ):
                document.shared.recheck()


def _disk_version(document: DocumentSession, text: str | None) -> DiskVersion:
    """The version of a document in a text; `design` is None if the text contains another component."""
    read = read_design(text or "", document.file.name)
    is_same = text is not None and read.design is not None and read.design.component == document.design.component
    return DiskVersion(text=text or "", design=read.design if is_same else None, parse_findings=read.findings)


def _read(file: Path) -> str | None:
    """The text of a file, None if it is missing or not UTF-8."""
    try:
        # Reading as text would convert line ends.
        return file.read_bytes().decode("utf-8")
    except (FileNotFoundError, UnicodeDecodeError):
        return None


def _name_in(folder: Path, file: Path) -> str:
    path, root = file.resolve(), folder.resolve()
    return path.relative_to(root).as_posix() if path.is_relative_to(root) else file.name
