"""The options, declarations and agents of a program."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from vicode.xabsl import tree
from vicode.xabsl.parser import ParsedFile
from vicode.xabsl.source_loader import ProgramSource

Key = tuple[str, str, int]
"""The kind and name of a declaration, and its number among those with the same name."""


def iter_items(source: ProgramSource) -> Iterator[tuple[Path, ParsedFile, tree.SyntaxNode]]:
    for path, parsed in source.files.items():
        for item in parsed.file.body:
            yield path, parsed, item


@dataclass(frozen=True, slots=True)
class DeclaredItem:
    """A declaration with its file, its namespace and its index there."""

    path: Path
    namespace: tree.NamespaceNode
    index: int

    @property
    def place(self) -> int:
        return id(self.namespace)

    @property
    def node(self) -> tree.DeclarationNode:
        return self.namespace.declarations[self.index]


def agents(source: ProgramSource) -> list[tree.AgentNode]:
    return [item for _path, _file, item in iter_items(source) if isinstance(item, tree.AgentNode)]


def options(source: ProgramSource) -> dict[str, tuple[tree.OptionNode, ParsedFile]]:
    items = iter_items(source)
    return {item.name.text: (item, parsed) for _path, parsed, item in items if isinstance(item, tree.OptionNode)}


def namespaces(source: ProgramSource) -> dict[str, tree.NamespaceNode]:
    return {item.name.text: item for _path, _file, item in iter_items(source) if isinstance(item, tree.NamespaceNode)}


def declarations(source: ProgramSource) -> dict[Key, DeclaredItem]:
    found: dict[Key, DeclaredItem] = {}
    counts: Counter[tuple[str, str]] = Counter()
    for path, _file, item in iter_items(source):
        for index, node in enumerate(item.declarations if isinstance(item, tree.NamespaceNode) else ()):
            assert isinstance(item, tree.NamespaceNode)
            name = (type(node).__name__, node.name.text)
            found[*name, counts[name]] = DeclaredItem(path, item, index)
            counts[name] += 1
    return found
