"""Import XABSL behaviors as vicode projects."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

from vicode.findings import DesignPath
from vicode.importers.comments import Anchor, CommentPlaces, PlacedComment, place_comments, place_header
from vicode.importers.declarations import ImportedDeclarations, import_declarations
from vicode.importers.design_names import DesignNames, design_files, xabsl_name_or_empty
from vicode.importers.notes import ImportNote, TokenNote, list_notes
from vicode.importers.options import OptionImporter
from vicode.importers.robot_class import render_robot_class
from vicode.model.design import Design
from vicode.model.project import Agent, Project
from vicode.xabsl import tree
from vicode.xabsl.compiler import CompileResult
from vicode.xabsl.parser import ParsedFile
from vicode.xabsl.source_loader import ProgramSource

__all__ = [
    "ROBOT_WORLD",
    "ImportNote",
    "ImportResult",
    "ImportedDeclarationFile",
    "ImportedDesign",
    "PlacedComment",
    "import_behavior",
    "render_robot_class",
]

ROBOT_WORLD = "robot:Robot"
"""The world of an imported project; `render_robot_class` generates a skeleton of it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportedDesign:
    """The file and the comments of an imported design.

    Attributes:
        path: The design file, relative to the project.
        file: The XABSL file it was imported from.
        anchors: Tokens of that file with the design elements they became.
        places: Where comments stand in that file.
    """

    component: str
    path: str
    comments: tuple[PlacedComment, ...]
    file: Path
    anchors: tuple[Anchor, ...]
    places: CommentPlaces = field(default_factory=CommentPlaces)


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportedDeclarationFile:
    """A file that declares symbols or agents, with its comments, which project.yaml contains."""

    file: Path
    comments: tuple[PlacedComment, ...]
    places: CommentPlaces


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportResult:
    """An imported project.

    Attributes:
        comments: Those of project.yaml.
        declaration_files: The files that have most of them.
        notes: What the designs cannot express.
    """

    project: Project
    designs: tuple[ImportedDesign, ...]
    comments: tuple[PlacedComment, ...]
    declaration_files: tuple[ImportedDeclarationFile, ...] = ()
    notes: tuple[ImportNote, ...] = ()


def import_behavior(source: ProgramSource, compiled: CompileResult, name: str) -> ImportResult:
    """Convert a behavior that was compiled without errors to a project.

    Args:
        source: The files of the behavior.
        compiled: The result of compiling them.
        name: The name of the project.
    """
    declarations = import_declarations(source, compiled.table)
    references = {(id(tokens), token): declared for tokens, token, declared in compiled.references}
    designs, imported = [], []
    option_notes: dict[Path, list[TokenNote]] = {}
    options = {id(option.node): option for option in compiled.table.options.values()}
    for path, parsed in source.files.items():
        for item in parsed.file.body:
            if id(item) not in options:
                continue
            importer = OptionImporter(declarations, references, parsed, options[id(item)])
            design, about = _import_option(importer, source, path)
            option_notes[path] = importer.notes
            designs.append(design)
            imported.append(about)
    stems = (each.path.removesuffix(".yaml") for each in imported)
    imported = [replace(each, path=path) for each, path in zip(imported, design_files(stems), strict=True)]
    agents = tuple(_agents(source, compiled, declarations))
    files = tuple(
        _declaration_file(path, parsed, declarations, is_main=path == source.main)
        for path, parsed in source.files.items()
        if not any(isinstance(item, tree.OptionNode) for item in parsed.file.body)
    )
    comments = (*declarations.comments, *(comment for file in files for comment in file.comments))
    project = Project(
        name=name,
        doc=_doc(source),
        languages=("python", "xabsl"),
        world=ROBOT_WORLD,
        enumerations=tuple(declarations.enumerations),
        constants=tuple(declarations.constants),
        components=tuple(declarations.interfaces),
        agents=agents,
        designs=tuple(designs),
    )
    notes = list_notes(source, compiled, _started_comments([*imported, *files]), option_notes)
    return ImportResult(
        project=project, designs=tuple(imported), comments=comments, declaration_files=files, notes=notes
    )


def _import_option(importer: OptionImporter, source: ProgramSource, path: Path) -> tuple[Design, ImportedDesign]:
    design, comments = importer.import_design()
    about = ImportedDesign(
        component=design.component,
        path=_path(source, path),
        comments=tuple(comments),
        file=path,
        anchors=tuple(importer.anchors),
        places=importer.places,
    )
    return design, about


def _started_comments(
    files: Iterable[ImportedDesign | ImportedDeclarationFile],
) -> Iterator[tuple[Path, PlacedComment, int | None]]:
    """Each comment with its file and the first token of its element, except those above the first element."""
    for file in files:
        starts: dict[DesignPath, int] = {}
        for token, path in file.places.anchors:
            starts[path] = min(token, starts.get(path, token))
        first = min(starts.values(), default=0)
        below = (comment for comment in file.comments if comment.token > first)
        yield from ((file.file, comment, starts.get(comment.path)) for comment in below)


def _path(source: ProgramSource, file: Path) -> str:
    """Return the path of the design, which mirrors the location of the file relative to the main file."""
    folder = source.main.parent
    relative = file.relative_to(folder) if file.is_relative_to(folder) else Path(file.name)
    return relative.with_suffix(".yaml").as_posix()


def _doc(source: ProgramSource) -> str:
    """Return the title and the header comment of a behavior."""
    lines = [line.strip() for line in source.files[source.main].file.header.splitlines()]
    other_lines = [line for line in lines if line and line.partition(":")[0].strip() != "Title"]
    return "\n".join([*([source.title] if source.title else []), *other_lines])


def _agents(source: ProgramSource, compiled: CompileResult, declarations: ImportedDeclarations) -> Iterator[Agent]:
    names = DesignNames()
    for node in source.files[source.main].file.body:
        if isinstance(node, tree.AgentNode):
            name = names.allocate(node.name.text)
            declarations.paths[id(node)] = ("agents", name)
            yield Agent(
                name=name,
                root=declarations.components[compiled.table.options[node.root.text]],
                title=node.title if node.title != name else "",
                doc=node.doc,
                xabsl_name=xabsl_name_or_empty(name, node.name.text),
            )


def _declaration_file(
    path: Path, parsed: ParsedFile, declarations: ImportedDeclarations, *, is_main: bool
) -> ImportedDeclarationFile:
    """Place the comments of a file that declares symbols or agents. The header of the main file is a description."""
    file, places = parsed.file, CommentPlaces()
    for item in file.body:
        for node in item.declarations if isinstance(item, tree.NamespaceNode) else [item]:
            if id(node) in declarations.paths:
                places.add(node.first_token, declarations.paths[id(node)])
    comments = list(place_comments(file.comments, places))
    if not is_main:
        first = places.anchors[0][1] if places.anchors else ()
        comments[:0] = place_header(parsed.tokens, file.header, first)
    return ImportedDeclarationFile(file=path, comments=tuple(comments), places=places)
