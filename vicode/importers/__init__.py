"""Behaviors of XABSL as projects of designs; nothing is left out without a word."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from vicode.importers.comments import Anchor, place_remarks
from vicode.importers.names import Names, other_name
from vicode.importers.options import OptionImporter
from vicode.importers.robot import robot_text
from vicode.importers.vocabulary import Remark, Vocabulary, learn
from vicode.model.project import Agent, Project
from vicode.xabsl import tree
from vicode.xabsl.compiler import Compiled
from vicode.xabsl.sources import Source

__all__ = ["ROBOT", "Imported", "ImportedDesign", "import_behavior", "robot_text"]

ROBOT = "robot:Robot"
"""The world of an imported project, which `robot_text` is the beginning of."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportedDesign:
    """Where a design belongs (relative to the project), and remarks for the things in it.

    `file` is what it was read from, `anchors` are the tokens of it that things of the design come from.
    """

    component: str
    path: str
    remarks: tuple[Remark, ...]
    file: Path
    anchors: tuple[Anchor, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Imported:
    """A project with its designs; `remarks` belong to project.yaml."""

    project: Project
    designs: tuple[ImportedDesign, ...]
    remarks: tuple[Remark, ...]


def import_behavior(source: Source, compiled: Compiled, name: str) -> Imported:
    """Turn a behavior that was compiled without errors into a project.

    Args:
        source: its files.
        compiled: what the compiler found out about them.
        name: the project's name.
    """
    vocabulary = learn(source, compiled.table)
    meanings = {(id(tokens), at): declared for tokens, at, declared in compiled.uses}
    designs, placed = [], []
    options = {id(each.node): each for each in compiled.table.options.values()}
    remarks = list(vocabulary.remarks)
    for path, parsed in source.files.items():
        for item in parsed.file.body:
            if id(item) not in options:
                continue
            importer = OptionImporter(vocabulary, meanings, parsed, options[id(item)])
            design, found = importer.design()
            designs.append(design)
            placed.append(
                ImportedDesign(
                    component=design.component,
                    path=_path(source, path),
                    remarks=tuple(found),
                    file=path,
                    anchors=tuple(importer.anchors),
                )
            )
    agents = tuple(_agents(source, compiled, vocabulary))
    for path, parsed in source.files.items():
        if not any(isinstance(item, tree.Option) for item in parsed.file.body):
            remarks += _remarks_of(parsed.file, vocabulary, is_main=path == source.main)
    project = Project(
        name=name,
        doc=_doc(source),
        languages=("python", "xabsl"),
        world=ROBOT,
        enumerations=tuple(vocabulary.enumerations),
        constants=tuple(vocabulary.constants),
        components=tuple(vocabulary.interfaces),
        agents=agents,
        designs=tuple(designs),
    )
    return Imported(project=project, designs=tuple(placed), remarks=tuple(remarks))


def _path(source: Source, file: Path) -> str:
    """Where the design of a file goes: where the file stands beside the one with the agents."""
    folder = source.main.parent
    shown = file.relative_to(folder) if file.is_relative_to(folder) else Path(file.name)
    return shown.with_suffix(".yaml").as_posix()


def _doc(source: Source) -> str:
    """What the first comment of a behavior says, its title first."""
    lines = [line.strip() for line in source.files[source.main].file.initial.splitlines()]
    others = [line for line in lines if line and line.partition(":")[0].strip() != "Title"]
    return "\n".join([*([source.title] if source.title else []), *others])


def _agents(source: Source, compiled: Compiled, vocabulary: Vocabulary) -> Iterator[Agent]:
    names = Names()
    for each in source.files[source.main].file.body:
        if isinstance(each, tree.Agent):
            name = names.give(each.name.text)
            vocabulary.paths[id(each)] = ("agents", name)
            yield Agent(
                name=name,
                root=vocabulary.components[compiled.table.options[each.root.text]],
                title=each.title if each.title != name else "",
                doc=each.doc,
                xabsl_name=other_name(name, each.name.text),
            )


def _remarks_of(file: tree.File, vocabulary: Vocabulary, *, is_main: bool) -> Iterator[Remark]:
    """Comments of a file that declares symbols or agents."""
    anchors: list[Anchor] = []
    for item in file.body:
        inside = item.declarations if isinstance(item, tree.Namespace) else [item]
        anchors += [(each.at, vocabulary.paths[id(each)]) for each in inside if id(each) in vocabulary.paths]
    if file.initial and not is_main:
        yield (anchors[0][1] if anchors else (), file.initial)
    yield from place_remarks(file.comments, anchors)
