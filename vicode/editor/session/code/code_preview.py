"""A preview of the code generated from a design, with the origin of each line."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace

from vicode.editor.session import texts
from vicode.editor.view import ItemRef, item_at_path
from vicode.generators import GENERATORS, Origin, UnsoundDesignError, generate, list_origins
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.output import OutputFile
from vicode.regions import find_regions, get_comment_prefix


@dataclass(frozen=True, slots=True, kw_only=True)
class PreviewFile:
    """A generated file."""

    path: str
    language: str
    text: str
    origins: tuple[Origin, ...] = ()

    def item_lines(self, item: ItemRef) -> tuple[int, int]:
        """The first and last line generated from an item, (0, 0) if there are none."""
        origin = next((origin for origin in self.origins if item_at_path(origin.path) == item), None)
        return (origin.first, origin.last) if origin else (0, 0)

    def item_at(self, line: int) -> ItemRef | None:
        """The smallest item that a line was generated from."""
        around = [origin for origin in self.origins if origin.first <= line <= origin.last]
        smallest = min(around, key=lambda origin: origin.last - origin.first, default=None)
        return item_at_path(smallest.path) if smallest else None

    def region_lines(self, ids: Collection[str]) -> tuple[int, ...]:
        """The lines of some regions."""
        regions = (
            region for region in find_regions(self.text, get_comment_prefix(self.path)).regions if region.id in ids
        )
        return tuple(line for region in regions for line in range(region.line, region.end_line + 1))


@dataclass(frozen=True, slots=True, kw_only=True)
class CodePreview:
    """The generated files, the component's own first; `note` is why files of a language are missing."""

    note: str = ""
    files: tuple[PreviewFile, ...] = field(default=())


def preview_code(project: Project, design: Design, sources: Mapping[str, str]) -> CodePreview:
    """Generate the files of a design without writing them.

    Args:
        project: The project of the design.
        design: Replaces the design of the same component in the project.
        sources: The source files by component, named in the generated text.
    """
    designs = tuple(design if other.component == design.component else other for other in project.designs)
    project = replace(project, designs=designs)
    languages = [language for language in GENERATORS if language in project.languages]
    if not languages:
        return CodePreview(note=f"No code: this project generates {', '.join(project.languages) or 'nothing'}")
    files: list[PreviewFile] = []
    notes: list[str] = []
    for language in languages:
        try:
            files += _files(project, design.component, language, sources)
        except UnsoundDesignError as error:
            notes.append(texts.no_code(error, language if len(languages) > 1 else ""))
    return CodePreview(note="; ".join(dict.fromkeys(notes)), files=tuple(files))


def _files(project: Project, component: str, language: str, sources: Mapping[str, str]) -> list[PreviewFile]:
    """The files of a component in a language, followed by those that all components share."""
    others = {design.component for design in project.designs} - {component}

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
