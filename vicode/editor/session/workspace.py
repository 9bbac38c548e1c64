"""One open project: its designs as they are now, and their files."""

import time
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from vicode.check import check_design, check_project
from vicode.editor.session import generating
from vicode.editor.session.document import Act, Document, OnDisk, Sheet
from vicode.editor.session.generating import Generated, Job, Prepared
from vicode.editor.session.people import DISK, People
from vicode.findings import Finding
from vicode.findings import Path as Way
from vicode.model.design import Design, State
from vicode.model.merging import merge
from vicode.model.names import snake_case
from vicode.model.project import Project
from vicode.output import set_aside
from vicode.store import OpenProject, design_files, open_project, read_design, save_design, write_text

_GLANCE_S = 0.8


class ChangedOnDiskError(Exception):
    """The file of a design was changed by another program, and what it says now touches unsaved work."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ThrownAway:
    """A design that was taken away: enough to put it back as it was."""

    component: str
    file: Path
    content: bytes


@dataclass(eq=False)
class Workspace:
    """A project being worked on. `project` always holds the designs as they are in the open documents."""

    folder: Path
    key: str
    people: People = field(default_factory=People)
    autosave: bool = False
    """Whether designs are saved by themselves, a second after they were touched."""
    project: Project = field(init=False)
    broken_files: dict[str, Path] = field(init=False)
    files: dict[str, Path] = field(init=False)
    gone: dict[str, str] = field(init=False, default_factory=dict)
    thrown_away: dict[str, ThrownAway] = field(init=False, default_factory=dict)
    _glanced_s: float = field(init=False, default=0.0)
    _texts: dict[str, str] = field(init=False)
    _reading: dict[str, tuple[Finding, ...]] = field(init=False)
    _seen: frozenset[tuple[str, int, int]] = field(init=False, default=frozenset())
    _documents: dict[str, Document] = field(init=False, default_factory=dict)
    _checked: tuple[Project, tuple[Finding, ...]] | None = field(init=False, default=None)

    def __post_init__(self) -> None:
        """Read the project."""
        self.follow_disk()

    def glance(self) -> None:
        """Follow the disk, once a second however many windows ask.

        Raises:
            OSError: The folder is gone.
        """
        now_s = time.monotonic()
        if now_s - self._glanced_s >= _GLANCE_S:
            self._glanced_s = now_s
            self.follow_disk()

    def follow_disk(self, act: Act | None = None) -> None:
        """Take over what other programs wrote; where unsaved changes touch it, they stay until somebody decides.

        What `act` wrote was done here, and is told so.

        Raises:
            OSError: The folder is gone.
        """
        seen = frozenset(_signature(file) for file in (*design_files(self.folder), *_project_files(self.folder)))
        if seen != self._seen:
            self._seen = seen
            self._take(open_project(self.folder), act)

    def document(self, component: str) -> Document | None:
        """The open document of a design, opened now if it was not; None when there is no such design."""
        design = self.project.design(component)
        if component not in self._documents and design is not None:
            file, text = self.files[component], self._texts[component]
            reading = self._reading.get(component, ())
            sheet = Sheet(
                file=file, disk_text=text, saved=design, check=self._check, reading=reading, people=self.people
            )
            document = Document(sheet)
            document.watch(self._follow)
            self._documents[component] = document
        return self._documents.get(component)

    @property
    def documents(self) -> tuple[Document, ...]:
        """The designs that are open."""
        return tuple(self._documents.values())

    def component_of_file(self, path: Path) -> str | None:
        """The component whose design a file holds."""
        wanted = path.resolve()
        return next((name for name, file in self.files.items() if name and file.resolve() == wanted), None)

    @property
    def broken(self) -> tuple[str, ...]:
        """The files that are meant to be designs and cannot be read, relative to the project's folder."""
        return tuple(self.broken_files)

    @property
    def unsaved(self) -> tuple[str, ...]:
        """The components whose designs have changes that no file holds."""
        return tuple(name for name, document in self._documents.items() if not document.is_saved)

    def open_findings(self, component: str) -> tuple[Finding, ...] | None:
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
    def seen(self) -> frozenset[tuple[str, int, int]]:
        """The files of the project when the disk was looked at last: another set means that one was written."""
        return self._seen

    @property
    def reading(self) -> Mapping[str, tuple[Finding, ...]]:
        """What was wrong with the files when they were read, by component; "" is what belongs to none."""
        return self._reading

    @property
    def sources(self) -> dict[str, str]:
        """The files of the designs by component, relative to the project's folder."""
        folder = self.folder.resolve()
        inside = ((name, file.resolve()) for name, file in self.files.items() if name)
        return {name: file.relative_to(folder).as_posix() for name, file in inside if file.is_relative_to(folder)}

    def save(self, document: Document, *, over: bool = False) -> None:
        """Write a design into its file, patching the text that stands there.

        What another program wrote meanwhile is merged in. With `over`, what is here wins where both touched the same.

        Raises:
            ChangedOnDiskError: The two touch, and nobody said which shall win.
            OSError: The file cannot be written.
            ValueError: No file can hold the design as it is now.
        """
        text = _read(document.file)
        if (text or "") != document.sheet.disk_text:
            self._meet(document.sheet, _on_disk(document, text))
        if document.sheet.clash is not None:
            if not over and (document.sheet.conflicts or document.sheet.clash.design is None):
                raise ChangedOnDiskError
            self.settle(document)
            text = _read(document.file)
        self._write(document, text, text or "")

    def settle(self, document: Document, theirs_at: Collection[Way] = ()) -> None:
        """End a clash with the file: both sides' work is kept, and at `theirs_at` the file's where both touched.

        A file that holds no design any more is put aside and written over; one that is gone is made again.

        Raises:
            OSError: The file cannot be put aside or written.
            ValueError: No file can hold the design as it is now.
        """
        disk = document.sheet.clash
        if disk is None:
            return
        if disk.design is None:
            if not document.file_is_gone:
                set_aside(document.file)
            # What was read last has the comments and the order of the keys.
            self._write(document, None, document.sheet.disk_text)
            return
        merged = merge(document.sheet.saved, document.design, disk.design, theirs_at=theirs_at)
        document.take_disk(disk, "merge with disk", merged.design)

    def reload(self, document: Document) -> str:
        """Open a design as it is on disk now; returns why not, if it cannot be read."""
        disk = _on_disk(document, _read(document.file))
        if disk.design is None:
            return f"{document.file.name} holds no design of {document.design.component} any more"
        document.take_disk(disk, "reload from disk")
        return ""

    def may_create(self, component: str) -> bool:
        """Whether a new design of this name has a file of its own to go to."""
        return not self._file_for(component).exists()

    def create(self, component: str, text: str = "") -> Document:
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
        document = self.document(component)
        assert document is not None
        return document

    def forget(self, component: str, became: str = "") -> None:
        """Let go of a design whose file is gone; its windows are told where it went, "" for nowhere."""
        self._documents.pop(component, None)
        self.gone[component] = became

    def is_as_read(self, component: str) -> bool:
        """Whether the file of a design still holds what was read from it or written to it last."""
        document = self._documents.get(component)
        known = document.sheet.disk_text if document else self._texts.get(component)
        return _read(self.files[component]) == known

    @property
    def output_folder(self) -> Path:
        """Where generated code is written."""
        return (self.folder / self.project.generated).resolve()

    def prepare(self, document: Document) -> Prepared:
        """Find out what generating a design, and all it uses as they were saved, would write.

        Raises:
            ChangedOnDiskError: Another program changed the file of the design.
            OSError: A file cannot be read.
        """
        self.follow_disk()
        if document.sheet.clash is not None:
            raise ChangedOnDiskError
        saved = {name: each.sheet.saved for name, each in self._documents.items()}
        designs = tuple(saved.get(each.component, each) for each in self.project.designs)
        reading = {**self._reading, **{name: each.sheet.reading for name, each in self._documents.items()}}
        job = Job(project=replace(self.project, designs=designs), sources=self.sources, reading=reading)
        return generating.prepare(self.output_folder, job, document.design.component)

    def generate(self, document: Document, *, is_forced: bool = False) -> Generated:
        """Write that code; with force files that a person edited are set aside first, else nothing is written then.

        Raises:
            ChangedOnDiskError: Another program changed the file of the design.
            OSError: A file cannot be written.
        """
        return generating.write(self.prepare(document), is_forced=is_forced)

    def _write(self, document: Document, text: str | None, patched: str) -> None:
        """Write a design by patching a text; `text` is what the file holds."""
        new = save_design(document.design, patched)
        if new != text:
            write_text(document.file, new)
        reading = read_design(new, document.file.name).findings
        document.take_disk(OnDisk(text=new, design=document.design, reading=reading), "save")

    def _file_for(self, component: str) -> Path:
        return self.folder / f"{snake_case(component)}.yaml"

    def _take(self, opened: OpenProject, act: Act | None) -> None:
        """Make a project as read the one that is worked on."""
        self._texts, self.files = dict(opened.texts), dict(opened.files)
        self.gone = {name: new for name, new in self.gone.items() if opened.project.design(name) is None}
        self.broken_files = {_name_in(self.folder, file): file for file in opened.broken}
        self._reading = dict.fromkeys(opened.texts, ())
        for finding in opened.findings:
            name = finding.thing.component if finding.thing else ""
            self._reading[name] = (*self._reading.get(name, ()), finding)
        read = {design.component: design for design in opened.project.designs}
        # A design whose file is gone goes on here: saving it makes the file again.
        kept = {name: each.design for name, each in self._documents.items()}
        for name in kept:
            self.files.setdefault(name, self._documents[name].file)
        self.project = replace(opened.project, designs=tuple({**read, **kept}.values()))
        for name, document in self._documents.items():
            text = self._texts.get(name) if name in read else _read(document.file)
            if text != document.sheet.disk_text:
                disk = OnDisk(text=text or "", design=read.get(name), reading=self._reading.get(name, ()))
                self._meet(document.sheet, disk, act if act and document.file in act.files else None)
            else:
                document.sheet.clash = None
            document.sheet.check_again()

    def _meet(self, sheet: Sheet, disk: OnDisk, act: Act | None = None) -> None:
        """Bring an open design together with what another program wrote, unless both changed the same."""
        hand = Document(sheet, DISK)
        if disk.design is None:
            # The file is gone, or half written: what is here stays until somebody saves.
            sheet.clash = disk
            sheet.tell(hand)
        elif hand.is_saved and act is not None:
            sheet.stands_on_disk(disk)
            hand.follow_act(act, disk.design)
        elif hand.is_saved:
            hand.take_disk(disk, "reload from disk")
        else:
            merged = merge(sheet.saved, hand.design, disk.design)
            if merged.conflicts:
                sheet.clash = disk
                sheet.tell(hand)
            else:
                hand.take_disk(disk, "merge from disk", merged.design)

    def _check(self, design: Design) -> tuple[Finding, ...]:
        designs = (design if each.component == design.component else each for each in self.project.designs)
        self.project = replace(self.project, designs=tuple(designs))
        return check_design(self.project, design)

    def _follow(self, changed: Document) -> None:
        """A change of what one design shows to others may mend or break those that use it."""
        component = changed.design.component
        for document in self._documents.values():
            if document.sheet is not changed.sheet and any(use.component == component for use in document.design.uses):
                document.sheet.check_again()


def _on_disk(document: Document, text: str | None) -> OnDisk:
    """What a text makes of the file of a document; another component in it is not this design."""
    read = read_design(text or "", document.file.name)
    is_same = text is not None and read.design is not None and read.design.component == document.design.component
    return OnDisk(text=text or "", design=read.design if is_same else None, reading=read.findings)


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
