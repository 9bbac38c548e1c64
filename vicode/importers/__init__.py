"""Import XABSL behaviors as vicode projects."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from vicode.importers.comments import Anchor, place_comments
from vicode.importers.declarations import ImportedDeclarations, PlacedComment, import_declarations
from vicode.importers.names import DesignNames, xabsl_name_or_empty
from vicode.importers.options import OptionImporter
from vicode.importers.robot_class import render_robot_class
from vicode.model.project import Agent, Project
from vicode.xabsl import tree
from vicode.xabsl.compiler import CompileResult
from vicode.xabsl.source_loader import ProgramSource

__all__ = ["ROBOT_WORLD", "ImportResult", "ImportedDesign", "import_behavior", "render_robot_class"]

ROBOT_WORLD = "robot:Robot"
"""The world of an imported project; `render_robot_class` generates a skeleton of it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportedDesign:
    """The file and the comments of an imported design.

    Attributes:
        path: The design file, relative to the project.
        file: The XABSL file it was imported from.
        anchors: Tokens of that file with the design elements they became.
    """

    component: str
    path: str
    comments: tuple[PlacedComment, ...]
    file: Path
    anchors: tuple[Anchor, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportResult:
    """An imported project; `comments` are those of project.yaml."""

    project: Project
    designs: tuple[ImportedDesign, ...]
    comments: tuple[PlacedComment, ...]


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
    options = {id(option.node): option for option in compiled.table.options.values()}
    comments = list(declarations.comments)
    for path, parsed in source.files.items():
        for item in parsed.file.body:
            if id(item) not in options:
                continue
            importer = OptionImporter(declarations, references, parsed, options[id(item)])
            design, design_comments = importer.import_design()
            designs.append(design)
            imported.append(
                ImportedDesign(
                    component=design.component,
                    path=_path(source, path),
                    comments=tuple(design_comments),
                    file=path,
                    anchors=tuple(importer.anchors),
                )
            )
    agents = tuple(_agents(source, compiled, declarations))
    for path, parsed in source.files.items():
        if not any(isinstance(item, tree.OptionNode) for item in parsed.file.body):
            comments += _place_file_comments(parsed.file, declarations, is_main=path == source.main)
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
    return ImportResult(project=project, designs=tuple(imported), comments=tuple(comments))


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


def _place_file_comments(
    file: tree.FileNode, declarations: ImportedDeclarations, *, is_main: bool
) -> Iterator[PlacedComment]:
    """Place the comments of a file that declares symbols or agents."""
    anchors: list[Anchor] = []
    for item in file.body:
        nodes = item.declarations if isinstance(item, tree.NamespaceNode) else [item]
        anchors += [
            (node.first_token, declarations.paths[id(node)]) for node in nodes if id(node) in declarations.paths
        ]
    if file.header and not is_main:
        yield (anchors[0][1] if anchors else (), file.header)
    yield from place_comments(file.comments, anchors)
