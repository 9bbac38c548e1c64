"""The generated code of a design that may still have mistakes: every file, and what its lines come from."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from vicode.editor.view import ItemRef, item_at_path
from vicode.generators import GENERATORS, Origin, UnsoundDesignError, generate, list_origins
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.output import OutputFile
from vicode.regions import compute_checksum, find_regions, get_comment_prefix, has_header, is_edited


@dataclass(frozen=True, slots=True, kw_only=True)
class PreviewFile:
    """A file as it would be written; `edited_regions` are the regions that were edited by hand in the one on disk."""

    path: str
    language: str
    text: str
    origins: tuple[Origin, ...] = ()
    edited_regions: tuple[str, ...] = ()

    def item_lines(self, thing: ItemRef) -> tuple[int, int]:
        """First and last line of what a thing of the drawing became, (0, 0) if it is not in here."""
        found = [origin for origin in self.origins if item_at_path(origin.path) == thing]
        # A state's lines hold those of its code; a transition has its own.
        return (found[0].first, found[0].last) if found else (0, 0)

    def item_at(self, line: int) -> ItemRef | None:
        """The smallest thing of the drawing that a line comes from."""
        around = [origin for origin in self.origins if origin.first <= line <= origin.last]
        smallest = min(around, key=lambda origin: origin.last - origin.first, default=None)
        return item_at_path(smallest.path) if smallest else None

    def edited_lines(self) -> tuple[int, ...]:
        """The lines of the regions that are another text on disk."""
        regions = (
            region
            for region in find_regions(self.text, get_comment_prefix(self.path)).regions
            if region.id in self.edited_regions
        )
        return tuple(line for region in regions for line in range(region.line, region.end_line + 1))


@dataclass(frozen=True, slots=True, kw_only=True)
class CodePreview:
    """The files to choose from, the component's own first; `note` says why there are none, or none of a language."""

    note: str = ""
    files: tuple[PreviewFile, ...] = field(default=())


def preview_code(
    project: Project, design: Design, sources: Mapping[str, str], folder: Path | None = None
) -> CodePreview:
    """What `vicode gen` would write for a design; no file is written.

    Args:
        project: What surrounds the design.
        design: As it is now, in place of the one of its name in the project.
        sources: The files of the designs by component, as the generated text names them.
        folder: Where generated code stands, to tell what was edited there; None: nobody wants to know.
    """
    designs = tuple(design if each.component == design.component else each for each in project.designs)
    whole = replace(project, designs=designs)
    languages = [language for language in GENERATORS if language in project.languages]
    if not languages:
        return CodePreview(note=f"No code: this project generates {', '.join(project.languages) or 'nothing'}")
    files: list[PreviewFile] = []
    notes: list[str] = []
    for language in languages:
        try:
            files += _files(whole, design.component, language, sources)
        except UnsoundDesignError as error:
            which = f" for {language}" if len(languages) > 1 else ""
            notes.append(f"No code{which} yet: {error}")
    edited = (replace(file, edited_regions=_edited(file, folder)) if folder else file for file in files)
    return CodePreview(note="; ".join(dict.fromkeys(notes)), files=tuple(edited))


def _files(project: Project, component: str, language: str, sources: Mapping[str, str]) -> list[PreviewFile]:
    """The files of a component in a language, then those that all components share."""
    others = {each.component for each in project.designs} - {component}

    def write(without: set[str]) -> tuple[OutputFile, ...]:
        return generate(project, components=(component,), exclude=without, languages=(language,), sources=sources)

    files, shared = write(others), {file.path for file in write({component, *others})}
    return [
        PreviewFile(
            path=file.path,
            language=language,
            text=file.text,
            origins=() if file.path in shared else list_origins(project, component, language, file.text),
        )
        for file in sorted(files, key=lambda file: file.path in shared)
    ]


def _edited(file: PreviewFile, folder: Path) -> tuple[str, ...]:
    """The regions of the file on disk that hold other code than was generated, and than the design has."""
    try:
        old = (folder / file.path).read_bytes().decode("utf-8")
    except (OSError, UnicodeDecodeError):
        return ()
    if not has_header(old):
        return ()
    fresh = {
        region.id: compute_checksum(region.body)
        for region in find_regions(file.text, get_comment_prefix(file.path)).regions
    }
    return tuple(
        region.id
        for region in find_regions(old, get_comment_prefix(file.path)).regions
        if is_edited(region) and compute_checksum(region.body) != fresh.get(region.id)
    )
