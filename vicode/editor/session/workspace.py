"""One open project: its designs as they are now, and their files."""

from dataclasses import dataclass, field, replace
from pathlib import Path

from vicode.check import check_design
from vicode.editor.session.document import Document
from vicode.editor.session.generating import Generated, generate_into
from vicode.findings import Finding
from vicode.model.design import Design, State
from vicode.model.names import snake_case
from vicode.model.project import Project
from vicode.store import open_project, read_design, save_design, write_text


class ChangedOnDiskError(Exception):
    """The file of a design is not what it was when it was opened or saved last."""


@dataclass(eq=False)
class Workspace:
    """A project being worked on. `project` always holds the designs as they are in the open documents."""

    folder: Path
    key: str
    project: Project = field(init=False)
    broken: tuple[str, ...] = field(init=False)
    files: dict[str, Path] = field(init=False)
    _texts: dict[str, str] = field(init=False)
    _documents: dict[str, Document] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        """Read the project."""
        opened = open_project(self.folder)
        self.project = opened.project
        self.files = dict(opened.files)
        self.broken = tuple(file.name for file in opened.broken)
        self._texts = dict(opened.texts)

    def document(self, component: str) -> Document | None:
        """The open document of a design, opened now if it was not; None when there is no such design."""
        design = self.project.design(component)
        if component not in self._documents and design is not None:
            file, text = self.files[component], self._texts[component]
            document = Document(file=file, disk_text=text, saved=design, check=self._check)
            document.watch(self._follow)
            self._documents[component] = document
        return self._documents.get(component)

    def component_of_file(self, path: Path) -> str | None:
        """The component whose design a file holds."""
        wanted = path.resolve()
        return next((name for name, file in self.files.items() if name and file.resolve() == wanted), None)

    @property
    def sources(self) -> dict[str, str]:
        """The files of the designs by component, relative to the project's folder."""
        folder = self.folder.resolve()
        inside = ((name, file.resolve()) for name, file in self.files.items() if name)
        return {name: file.relative_to(folder).as_posix() for name, file in inside if file.is_relative_to(folder)}

    def save(self, document: Document, *, over: bool = False) -> None:
        """Write a design into its file, patching the text that stands there.

        Raises:
            ChangedOnDiskError: Another program changed the file and `over` does not say to write all the same.
            OSError: The file cannot be written.
        """
        text = _read(document.file) if document.file.exists() else ""
        if text != document.disk_text and not over:
            raise ChangedOnDiskError
        new = save_design(document.design, text)
        if new != text:
            write_text(document.file, new)
        document.mark_saved(new)

    def reload(self, document: Document) -> str:
        """Open a design as it is on disk now; returns why not, if it cannot be read."""
        text = _read(document.file)
        design = read_design(text, document.file.name).design
        if design is None or design.component != document.design.component:
            return f"{document.file.name} holds no design of {document.design.component} any more"
        document.reload(design, text)
        return ""

    def create(self, component: str) -> Document:
        """Make a new design with one state and a file of its own.

        Raises:
            FileExistsError: There is already a file of its name.
            OSError: The file cannot be written.
        """
        file = self.folder / f"{snake_case(component)}.yaml"
        if file.exists():
            raise FileExistsError(file)
        design = Design(component=component, initial="Start", states=(State(name="Start", at=(160, 120)),))
        text = save_design(design, "")
        write_text(file, text)
        self.files[component], self._texts[component] = file, text
        self.project = replace(self.project, designs=(*self.project.designs, design))
        document = self.document(component)
        assert document is not None
        return document

    def generate(self, document: Document) -> Generated:
        """Write the code of a design, and of all it uses, into the project's output folder.

        Raises:
            OSError: A file cannot be written.
        """
        folder = (self.folder / self.project.generated).resolve()
        return generate_into(folder, self.project, document.design.component, self.sources)

    def _check(self, design: Design) -> tuple[Finding, ...]:
        designs = (design if each.component == design.component else each for each in self.project.designs)
        self.project = replace(self.project, designs=tuple(designs))
        return check_design(self.project, design)

    def _follow(self, changed: Document) -> None:
        """A change of what one design shows to others may mend or break those that use it."""
        for document in self._documents.values():
            if document is not changed and any(
                use.component == changed.design.component for use in document.design.uses
            ):
                document.check_again()


def _read(file: Path) -> str:
    # Bytes, as reading text would turn the line ends of other systems into ours.
    return file.read_bytes().decode("utf-8")
