"""Behaviors of XABSL as projects of designs; nothing is left out without a word."""

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
"""The world of an imported project, which `robot_text` is the beginning of."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportedDesign:
    """Where a design belongs (relative to the project), and remarks for the things in it.

    `file` is what it was read from, `anchors` are the tokens of it that things of the design come from.
    """

    component: str
    path: str
    comments: tuple[PlacedComment, ...]
    file: Path
    anchors: tuple[Anchor, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportResult:
    """A project with its designs; `comments` belong to project.yaml."""

    project: Project
    designs: tuple[ImportedDesign, ...]
    comments: tuple[PlacedComment, ...]


def import_behavior(source: ProgramSource, compiled: CompileResult, name: str) -> ImportResult:
    """Turn a behavior that was compiled without errors into a project.

    Args:
        source: its files.
        compiled: what the compiler found out about them.
        name: the project's name.
    """
    vocabulary = import_declarations(source, compiled.table)
    meanings = {(id(tokens), at): declared for tokens, at, declared in compiled.references}
    designs, placed = [], []
    options = {id(each.node): each for each in compiled.table.options.values()}
    remarks = list(vocabulary.comments)
    for path, parsed in source.files.items():
        for item in parsed.file.body:
            if id(item) not in options:
                continue
            importer = OptionImporter(vocabulary, meanings, parsed, options[id(item)])
            design, found = importer.import_design()
            designs.append(design)
            placed.append(
                ImportedDesign(
                    component=design.component,
                    path=_path(source, path),
                    comments=tuple(found),
                    file=path,
                    anchors=tuple(importer.anchors),
                )
            )
    agents = tuple(_agents(source, compiled, vocabulary))
    for path, parsed in source.files.items():
        if not any(isinstance(item, tree.OptionNode) for item in parsed.file.body):
            remarks += _place_file_comments(parsed.file, vocabulary, is_main=path == source.main)
    project = Project(
        name=name,
        doc=_doc(source),
        languages=("python", "xabsl"),
        world=ROBOT_WORLD,
        enumerations=tuple(vocabulary.enumerations),
        constants=tuple(vocabulary.constants),
        components=tuple(vocabulary.interfaces),
        agents=agents,
        designs=tuple(designs),
    )
    return ImportResult(project=project, designs=tuple(placed), comments=tuple(remarks))


def _path(source: ProgramSource, file: Path) -> str:
    """Where the design of a file goes: where the file stands beside the one with the agents."""
    folder = source.main.parent
    shown = file.relative_to(folder) if file.is_relative_to(folder) else Path(file.name)
    return shown.with_suffix(".yaml").as_posix()


def _doc(source: ProgramSource) -> str:
    """What the first comment of a behavior says, its title first."""
    lines = [line.strip() for line in source.files[source.main].file.header.splitlines()]
    others = [line for line in lines if line and line.partition(":")[0].strip() != "Title"]
    return "\n".join([*([source.title] if source.title else []), *others])


def _agents(source: ProgramSource, compiled: CompileResult, vocabulary: ImportedDeclarations) -> Iterator[Agent]:
    names = DesignNames()
    for each in source.files[source.main].file.body:
        if isinstance(each, tree.AgentNode):
            name = names.allocate(each.name.text)
            vocabulary.paths[id(each)] = ("agents", name)
            yield Agent(
                name=name,
                root=vocabulary.components[compiled.table.options[each.root.text]],
                title=each.title if each.title != name else "",
                doc=each.doc,
                xabsl_name=xabsl_name_or_empty(name, each.name.text),
            )


def _place_file_comments(
    file: tree.FileNode, vocabulary: ImportedDeclarations, *, is_main: bool
) -> Iterator[PlacedComment]:
    """Comments of a file that declares symbols or agents."""
    anchors: list[Anchor] = []
    for item in file.body:
        inside = item.declarations if isinstance(item, tree.NamespaceNode) else [item]
        anchors += [(each.first_token, vocabulary.paths[id(each)]) for each in inside if id(each) in vocabulary.paths]
    if file.header and not is_main:
        yield (anchors[0][1] if anchors else (), file.header)
    yield from place_comments(file.comments, anchors)
