"""A behavior open in a text editor: files with unsaved text, definitions and references."""

import re
from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from vicode.xabsl.compiler import CompileResult, compile_source
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.parser import ParsedFile, parse
from vicode.xabsl.source_loader import ProgramSource, load_source, read_text
from vicode.xabsl.symbol_table import Definition
from vicode.xabsl.tokens import KEYWORDS

_AGENT = re.compile(r"^\s*agent\s+\w", re.MULTILINE)
_MAX_FOLDERS = 8
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_.]*")


@dataclass(frozen=True, slots=True)
class SymbolOccurrence:
    """A range of characters in a file, 0-based, with its text or its replacement."""

    path: Path
    start: int
    end: int
    text: str = ""


class RenameError(ValueError):
    """A new name is invalid or taken."""


@dataclass(eq=False)
class OpenBehavior:
    """The program with the main file `main`. `open_texts` are the texts of open files, saved or not."""

    main: Path
    open_texts: dict[Path, str] = field(default_factory=dict)
    source: ProgramSource = field(init=False)
    compiled: CompileResult = field(init=False)
    _parse_cache: dict[str, tuple[str, ParsedFile]] = field(default_factory=dict)
    _references: dict[int, list[tuple[int, Definition]]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.refresh()

    def refresh(self) -> CompileResult:
        """Parse changed files and compile the program again."""
        self.source = load_source(self.main, self._read, self._parse)
        self.compiled = compile_source(self.source)
        self._references = {}
        for tokens, at, declared in self.compiled.references:
            self._references.setdefault(id(tokens), []).append((at, declared))
        for declared in self._definitions():
            self._references.setdefault(id(declared.tokens), []).append((declared.name_node.first_token, declared))
        for found in self._references.values():
            found.sort(key=lambda each: each[0])
        return self.compiled

    def definition_at(self, path: Path, offset: int) -> Definition | None:
        """The definition that the name at a character refers to."""
        parsed = self.source.files.get(path)
        if parsed is None:
            return None
        number = token_at(parsed.tokens, offset)
        uses = self._references.get(id(parsed.tokens), [])
        at = bisect_right(uses, number, key=lambda each: each[0]) - 1
        return uses[at][1] if at >= 0 and uses[at][0] == number else None

    def declaration_occurrence(self, declared: Definition) -> SymbolOccurrence:
        return self._occurrence(declared.tokens, declared.name_node.first_token)

    def occurrences(self, declared: Definition) -> list[SymbolOccurrence]:
        """Declaration and uses of a definition, in the order of files and lines."""
        paths = {id(parsed.tokens): parsed.tokens for parsed in self.source.files.values()}
        return [
            self._occurrence(paths[key], at)
            for key in paths
            for at, each in self._references.get(key, ())
            if each is declared
        ]

    def rename_edits(self, declared: Definition, name: str) -> list[SymbolOccurrence]:
        """The text changes that rename a definition.

        Raises:
            RenameError: The name is invalid or taken.
        """
        name = name.removeprefix("@")
        if not _NAME.fullmatch(name) or name in KEYWORDS:
            raise RenameError(f"{name} is not a valid name")
        if any(each.name == name and _share_scope(each, declared) for each in self._definitions()):
            raise RenameError(f"there is already a {declared.description} {name}")
        spots = []
        for spot in self.occurrences(declared):
            sign = "@" if spot.text.startswith("@") else ""
            before = f"{declared.enum}." if declared.role == "element" and spot.text != declared.name else ""
            spots.append(SymbolOccurrence(spot.path, spot.start, spot.end, sign + before + name))
        if declared.role == "enum":
            spots += self._qualified_element_edits(declared.name, name)
        return spots

    def _qualified_element_edits(self, enum: str, name: str) -> Iterator[SymbolOccurrence]:
        """Changes of elements that are qualified with the name of their enumeration."""
        for tokens, at, declared in self.compiled.references:
            text = tokens.texts[at]
            if declared.role == "element" and declared.enum == enum and text.startswith(f"{enum}."):
                spot = self._occurrence(tokens, at)
                yield SymbolOccurrence(spot.path, spot.start, spot.end, name + text.removeprefix(enum))

    def _definitions(self) -> Iterator[Definition]:
        table = self.compiled.table
        groups = (table.enums, table.options, table.behaviors, table.agents)
        for each in (*(each for group in groups for each in group.values()), *table.symbols(*_ROLES)):
            yield each
            for inner in (each.parameters, each.elements, each.states):
                yield from inner.values()

    def _occurrence(self, tokens: Tokens, at: int) -> SymbolOccurrence:
        path = next(path for path, parsed in self.source.files.items() if parsed.tokens is tokens)
        start = tokens.starts[at]
        return SymbolOccurrence(path, start, start + len(tokens.texts[at]), tokens.texts[at])

    def _read(self, path: Path) -> str:
        text = self.open_texts.get(path)
        return read_text(path) if text is None else text

    def _parse(self, text: str, name: str) -> ParsedFile:
        known = self._parse_cache.get(name)
        if known is None or known[0] != text:
            self._parse_cache[name] = known = (text, parse(text, name))
        return known[1]


_ROLES = ("input", "output", "internal", "const")


def _share_scope(one: Definition, other: Definition) -> bool:
    """Whether two definitions must have different names."""
    if one.role in ("parameter", "state", "element"):
        return one.role == other.role and one.node.first_token != other.node.first_token and one.tokens is other.tokens
    return one.role == other.role


def token_at(tokens: Tokens, offset: int) -> int:
    """The number of the token at a character; between two tokens the later one if it is a name, else the earlier."""
    number = bisect_right(tokens.starts, offset) - 1
    ends_there = number > 0 and tokens.starts[number] == offset
    if ends_there and not _NAME.match(tokens.texts[number].lstrip("@")):
        before = number - 1
        if tokens.starts[before] + len(tokens.texts[before]) == offset:
            return before
    return max(number, 0)


def find_main_file(path: Path) -> Path:
    """Find the file with the agents of the behavior that includes a file; the file itself if there is none."""
    for folder in [path.parent, *path.parent.parents][:_MAX_FOLDERS]:
        found = [each for each in sorted(folder.glob("*.xabsl")) if _has_agents(each)]
        found.sort(key=lambda each: each.name != "agents.xabsl")
        for each in found:
            if path in load_source(each).files:
                return each.resolve()
    return path


def _has_agents(path: Path) -> bool:
    try:
        return bool(_AGENT.search(read_text(path)))
    except OSError:
        return False
