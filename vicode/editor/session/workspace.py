"""One open project: its designs as they are now, and their files."""

import time
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from vicode.check import check_design, check_project
from vicode.editor.session import code_generation
from vicode.editor.session.code_generation import GenerationInput, GenerationResult, PendingOutput
from vicode.editor.session.document import DiskVersion, DocumentSession, FileTransaction, SharedDocument
from vicode.editor.session.presence import DISK_USER, UserDirectory
from vicode.findings import DesignPath as Way
from vicode.findings import Finding
from vicode.model.design import Design, State
from vicode.model.merge import merge_designs
from vicode.model.names import snake_case
from vicode.model.project import Project
from vicode.output import back_up_edited
from vicode.store import OpenProject, find_design_files, open_project, read_design, save_design, write_text

_POLL_INTERVAL_S = 0.8


class DiskConflictError(Exception):
    """The file of a design was changed by another program, and what it says now touches unsaved work."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TrashedDesign:
    """A design that was taken away: enough to put it back as it was."""

    component: str
    file: Path
    content: bytes


@dataclass(eq=False)
class Workspace:
    """A project being worked on. `project` always holds the designs as they are in the open documents."""

    folder: Path
    key: str
    users: UserDirectory = field(default_factory=UserDirectory)
    autosave: bool = False
    """Whether designs are saved by themselves, a second after they were touched."""
    project: Project = field(init=False)
    broken_files: dict[str, Path] = field(init=False)
    files: dict[str, Path] = field(init=False)
    removed_components: dict[str, str] = field(init=False, default_factory=dict)
    trashed_designs: dict[str, TrashedDesign] = field(init=False, default_factory=dict)
    _polled_s: float = field(init=False, default=0.0)
    _texts: dict[str, str] = field(init=False)
    _parse_findings: dict[str, tuple[Finding, ...]] = field(init=False)
    _seen: frozenset[tuple[str, int, int]] = field(init=False, default=frozenset())
    _documents: dict[str, DocumentSession] = field(init=False, default_factory=dict)
    _checked: tuple[Project, tuple[Finding, ...]] | None = field(init=False, default=None)

    def __post_init__(self) -> None:
        """Read the project."""
        self.sync_from_disk()

    def poll_disk(self) -> None:
        """Follow the disk, once a second however many windows ask.

        Raises:
            OSError: The folder is gone.
        """
        now_s = time.monotonic()
        if now_s - self._polled_s >= _POLL_INTERVAL_S:
            self._polled_s = now_s
            self.sync_from_disk()

    def sync_from_disk(self, act: FileTransaction | None = None) -> None:
        """Take over what other programs wrote; where unsaved changes touch it, they stay until somebody decides.

        What `act` wrote was done here, and is told so.

        Raises:
            OSError: The folder is gone.
        """
        seen = frozenset(_signature(file) for file in (*find_design_files(self.folder), *_project_files(self.folder)))
        if seen != self._seen:
            self._seen = seen
            self._apply_project(open_project(self.folder), act)

    def open_document(self, component: str) -> DocumentSession | None:
        """The open document of a design, opened now if it was not; None when there is no such design."""
        design = self.project.design(component)
        if component not in self._documents and design is not None:
            file, text = self.files[component], self._texts[component]
            reading = self._parse_findings.get(component, ())
            sheet = SharedDocument(
                file=file, disk_text=text, saved=design, check=self._check, parse_findings=reading, users=self.users
            )
            document = DocumentSession(sheet)
            document.subscribe(self._recheck_dependents)
            self._documents[component] = document
        return self._documents.get(component)

    @property
    def documents(self) -> tuple[DocumentSession, ...]:
        """The designs that are open."""
        return tuple(self._documents.values())

    def component_in_file(self, path: Path) -> str | None:
        """The component whose design a file holds."""
        wanted = path.resolve()
        return next((name for name, file in self.files.items() if name and file.resolve() == wanted), None)

    @property
    def broken_file_names(self) -> tuple[str, ...]:
        """The files that are meant to be designs and cannot be read, relative to the project's folder."""
        return tuple(self.broken_files)

    @property
    def unsaved_components(self) -> tuple[str, ...]:
        """The components whose designs have changes that no file holds."""
        return tuple(name for name, document in self._documents.items() if not document.is_saved)

    def findings_if_open(self, component: str) -> tuple[Finding, ...] | None:
        """What is wrong with a design as it is open; None when it is not."""
        document = self._documents.get(component)
        return document.findings if document else None

    @property
    def project_findings(self) -> tuple[Finding, ...]:
        """What is wrong with what project.yaml declares."""
        if self._checked is None or self._checked[0] is not self.project:
            self._checked = (self.project, check_project(self.project, ()))
        return self._checked[1]

    @property
    def file_signatures(self) -> frozenset[tuple[str, int, int]]:
        """The files of the project when the disk was looked at last: another set means that one was written."""
        return self._seen

    @property
    def parse_findings(self) -> Mapping[str, tuple[Finding, ...]]:
        """What was wrong with the files when they were read, by component; "" is what belongs to none."""
        return self._parse_findings

    @property
    def source_paths(self) -> dict[str, str]:
        """The files of the designs by component, relative to the project's folder."""
        folder = self.folder.resolve()
        inside = ((name, file.resolve()) for name, file in self.files.items() if name)
        return {name: file.relative_to(folder).as_posix() for name, file in inside if file.is_relative_to(folder)}

    def save(self, document: DocumentSession, *, overwrite: bool = False) -> None:
        """Write a design into its file, patching the text that stands there.

        What another program wrote meanwhile is merged in. With `overwrite`, what is here wins where both touched the same.

        Raises:
            ChangedOnDiskError: The two touch, and nobody said which shall win.
            OSError: The file cannot be written.
            ValueError: No file can hold the design as it is now.
        """
        text = _read(document.file)
        if (text or "") != document.shared.disk_text:
            self._reconcile_with_disk(document.shared, _disk_version(document, text))
        if document.shared.disk_conflict is not None:
            if not overwrite and (document.shared.conflicts or document.shared.disk_conflict.design is None):
                raise DiskConflictError
            self.resolve_conflict(document)
            text = _read(document.file)
        self._write(document, text, text or "")

    def resolve_conflict(self, document: DocumentSession, theirs_at: Collection[Way] = ()) -> None:
        """End a clash with the file: both sides' work is kept, and at `theirs_at` the file's where both touched.

        A file that holds no design any more is put aside and written over; one that is gone is made again.

        Raises:
            OSError: The file cannot be put aside or written.
            ValueError: No file can hold the design as it is now.
        """
        disk = document.shared.disk_conflict
        if disk is None:
            return
        if disk.design is None:
            if not document.is_file_missing:
                back_up_edited(document.file)
            # What was read last has the comments and the order of the keys.
            self._write(document, None, document.shared.disk_text)
            return
        merged = merge_designs(document.shared.saved, document.design, disk.design, theirs_at=theirs_at)
        document.adopt_disk_version(disk, "merge with disk", merged.design)

    def reload(self, document: DocumentSession) -> str:
        """Open a design as it is on disk now; returns why not, if it cannot be read."""
        disk = _disk_version(document, _read(document.file))
        if disk.design is None:
            return f"{document.file.name} holds no design of {document.design.component} any more"
        document.adopt_disk_version(disk, "reload from disk")
        return ""

    def can_create(self, component: str) -> bool:
        """Whether a new design of this name has a file of its own to go to."""
        return not self._file_for(component).exists()

    def create(self, component: str, text: str = "") -> DocumentSession:
        """Make a new design with a file of its own: of a text that holds it, else with one state.

        Raises:
            FileExistsError: There is already a file of its name.
            OSError: The file cannot be written.
        """
        file = self._file_for(component)
        if file.exists():
            raise FileExistsError(file)
        design = Design(component=component, initial="Start", states=(State(name="Start", at=(160, 120)),))
        if text:
            design = read_design(text, file.name).design or design
        text = text or save_design(design, "")
        write_text(file, text)
        self.files[component], self._texts[component] = file, text
        self.project = replace(self.project, designs=(*self.project.designs, design))
        document = self.open_document(component)
        assert document is not None
        return document

    def drop_document(self, component: str, renamed_to: str = "") -> None:
        """Let go of a design whose file is gone; its windows are told where it went, "" for nowhere."""
        self._documents.pop(component, None)
        self.removed_components[component] = renamed_to

    def is_file_unchanged(self, component: str) -> bool:
        """Whether the file of a design still holds what was read from it or written to it last."""
        document = self._documents.get(component)
        known = document.shared.disk_text if document else self._texts.get(component)
        return _read(self.files[component]) == known

    @property
    def output_folder(self) -> Path:
        """Where generated code is written."""
        return (self.folder / self.project.generated).resolve()

    def prepare_output(self, document: DocumentSession) -> PendingOutput:
        """Find out what generating a design, and all it uses as they were saved, would write.

        Raises:
            ChangedOnDiskError: Another program changed the file of the design.
            OSError: A file cannot be read.
        """
        self.sync_from_disk()
        if document.shared.disk_conflict is not None:
            raise DiskConflictError
        saved = {name: each.shared.saved for name, each in self._documents.items()}
        designs = tuple(saved.get(each.component, each) for each in self.project.designs)
        reading = {
            **self._parse_findings,
            **{name: each.shared.parse_findings for name, each in self._documents.items()},
        }
        job = GenerationInput(
            project=replace(self.project, designs=designs), source_paths=self.source_paths, parse_findings=reading
        )
        return code_generation.prepare_output(self.output_folder, job, document.design.component)

    def generate(self, document: DocumentSession, *, is_forced: bool = False) -> GenerationResult:
        """Write that code; with force files that a person edited are set aside first, else nothing is written then.

        Raises:
            ChangedOnDiskError: Another program changed the file of the design.
            OSError: A file cannot be written.
        """
        return code_generation.write_output(self.prepare_output(document), is_forced=is_forced)

    def _write(self, document: DocumentSession, text: str | None, patched: str) -> None:
        """Write a design by patching a text; `text` is what the file holds."""
        new = save_design(document.design, patched)
        if new != text:
            write_text(document.file, new)
        reading = read_design(new, document.file.name).findings
        document.adopt_disk_version(DiskVersion(text=new, design=document.design, parse_findings=reading), "save")

    def _file_for(self, component: str) -> Path:
        return self.folder / f"{snake_case(component)}.yaml"

    def _apply_project(self, opened: OpenProject, act: FileTransaction | None) -> None:
        """Make a project as read the one that is worked on."""
        self._texts, self.files = dict(opened.texts), dict(opened.files)
        self.removed_components = {
            name: new for name, new in self.removed_components.items() if opened.project.design(name) is None
        }
        self.broken_files = {_name_in(self.folder, file): file for file in opened.broken_files}
        self._parse_findings = dict.fromkeys(opened.texts, ())
        for finding in opened.findings:
            name = finding.subject.component if finding.subject else ""
            self._parse_findings[name] = (*self._parse_findings.get(name, ()), finding)
        read = {design.component: design for design in opened.project.designs}
        # A design whose file is gone goes on here: saving it makes the file again.
        kept = {name: each.design for name, each in self._documents.items()}
        for name in kept:
            self.files.setdefault(name, self._documents[name].file)
        self.project = replace(opened.project, designs=tuple({**read, **kept}.values()))
        for name, document in self._documents.items():
            text = self._texts.get(name) if name in read else _read(document.file)
            if text != document.shared.disk_text:
                disk = DiskVersion(
                    text=text or "", design=read.get(name), parse_findings=self._parse_findings.get(name, ())
                )
                self._reconcile_with_disk(document.shared, disk, act if act and document.file in act.files else None)
            else:
                document.shared.disk_conflict = None
            document.shared.recheck()

    def _reconcile_with_disk(
        self, sheet: SharedDocument, disk: DiskVersion, act: FileTransaction | None = None
    ) -> None:
        """Bring an open design together with what another program wrote, unless both changed the same."""
        hand = DocumentSession(sheet, DISK_USER)
        if disk.design is None:
            # The file is gone, or half written: what is here stays until somebody saves.
            sheet.disk_conflict = disk
            sheet.notify_listeners(hand)
        elif hand.is_saved and act is not None:
            sheet.mark_saved(disk)
            hand.apply_transaction(act, disk.design)
        elif hand.is_saved:
            hand.adopt_disk_version(disk, "reload from disk")
        else:
            merged = merge_designs(sheet.saved, hand.design, disk.design)
            if merged.conflicts:
                sheet.disk_conflict = disk
                sheet.notify_listeners(hand)
            else:
                hand.adopt_disk_version(disk, "merge from disk", merged.design)

    def _check(self, design: Design) -> tuple[Finding, ...]:
        designs = (design if each.component == design.component else each for each in self.project.designs)
        self.project = replace(self.project, designs=tuple(designs))
        return check_design(self.project, design)

    def _recheck_dependents(self, changed: DocumentSession) -> None:
        """A change of what one design shows to others may mend or break those that use it."""
        component = changed.design.component
        for document in self._documents.values():
            if document.shared is not changed.shared and any(
                use.component == component for use in document.design.uses
            ):
                document.shared.recheck()


def _disk_version(document: DocumentSession, text: str | None) -> DiskVersion:
    """What a text makes of the file of a document; another component in it is not this design."""
    read = read_design(text or "", document.file.name)
    is_same = text is not None and read.design is not None and read.design.component == document.design.component
    return DiskVersion(text=text or "", design=read.design if is_same else None, parse_findings=read.findings)


def _read(file: Path) -> str | None:
    """The text of a file, None when there is none."""
    try:
        # Bytes, as reading text would turn the line ends of other systems into ours.
        return file.read_bytes().decode("utf-8")
    except (FileNotFoundError, UnicodeDecodeError):
        return None


def _name_in(folder: Path, file: Path) -> str:
    inside, place = file.resolve(), folder.resolve()
    return inside.relative_to(place).as_posix() if inside.is_relative_to(place) else file.name


def _signature(file: Path) -> tuple[str, int, int]:
    try:
        status = file.stat()
    except OSError:
        return (str(file), 0, 0)
    return (str(file), status.st_mtime_ns, status.st_size)


def _project_files(folder: Path) -> tuple[Path, ...]:
    return (folder / "project.yaml", folder / "project.yml")
