"""A behavior open in a text editor: files with unsaved text, definitions and references."""

import re
from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from vicode.xabsl.compiler import CompileResult, compile_source
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.parser import ParsedFile, parse
from vicode.xabsl.source_loader import ProgramSource, load_source
from vicode.xabsl.source_text import EncodedText, read_source
from vicode.xabsl.symbol_table import Definition
from vicode.xabsl.tokens import KEYWORDS

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
    """The program with the main file `main`. `open_texts` are the texts of open files, saved or not.

    `encoding` is that of files that are not UTF-8.
    """

    main: Path
    open_texts: dict[Path, str] = field(default_factory=dict)
    encoding: str = ""
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
        for tokens, token, definition in self.compiled.references:
            self._references.setdefault(id(tokens), []).append((token, definition))
        for definition, _owner in self.definitions():
            self._references.setdefault(id(definition.tokens), []).append(
                (definition.name_node.first_token, definition)
            )
        for references in self._references.values():
            references.sort(key=lambda reference: reference[0])
        return self.compiled

    def definition_at(self, path: Path, offset: int) -> Definition | None:
        """The definition that the name at a character refers to."""
        parsed = self.source.files.get(path)
        if parsed is None:
            return None
        number = token_at(parsed.tokens, offset)
        references = self._references.get(id(parsed.tokens), [])
        index = bisect_right(references, number, key=lambda reference: reference[0]) - 1
        return references[index][1] if index >= 0 and references[index][0] == number else None

    def references_in(self, tokens: Tokens) -> list[tuple[int, Definition]]:
        """The names in a file, declared or used: number of the token and definition, in order."""
        return self._references.get(id(tokens), [])

    def path_of(self, tokens: Tokens) -> Path:
        return next(path for path, parsed in self.source.files.items() if parsed.tokens is tokens)

    def include_at(self, path: Path, offset: int) -> Path | None:
        """The file that the include statement at a character names."""
        parsed = self.source.files.get(path)
        number = token_at(parsed.tokens, offset) if parsed else 0
        for include in parsed.file.includes if parsed else ():
            if include.first_token <= number <= include.last_token:
                return (path.parent / include.path.replace("\\", "/")).resolve()
        return None

    def is_written(self, occurrence: SymbolOccurrence, definition: Definition) -> bool:
        """Whether a name is declared or assigned there."""
        if occurrence == self.declaration_occurrence(definition):
            return True
        tokens = self.source.files[occurrence.path].tokens
        number = token_at(tokens, occurrence.start)
        return tokens.kinds[number + 1] == "=" and tokens.kinds[number - 1] in ("{", ";")

    def declaration_occurrence(self, definition: Definition) -> SymbolOccurrence:
        return self._occurrence(definition.tokens, definition.name_node.first_token)

    def occurrences(self, definition: Definition) -> list[SymbolOccurrence]:
        """Declaration and uses of a definition, in the order of files and lines."""
        tokens_by_id = {id(parsed.tokens): parsed.tokens for parsed in self.source.files.values()}
        return [
            self._occurrence(tokens_by_id[key], token)
            for key in tokens_by_id
            for token, referenced in self._references.get(key, ())
            if referenced is definition
        ]

    def renamed_occurrence(self, path: Path, offset: int) -> SymbolOccurrence:
        """The name at a character that can be renamed.

        Raises:
            RenameError: There is no name, or no known declaration.
        """
        parsed = self.source.files.get(path)
        if parsed is None:
            raise RenameError("no behavior includes this file")
        number = token_at(parsed.tokens, offset)
        occurrence = self._occurrence(parsed.tokens, number)
        if self.definition_at(path, offset) is not None:
            return occurrence
        if occurrence.text in KEYWORDS:
            raise RenameError(f"'{occurrence.text}' is a keyword")
        if not _NAME.fullmatch(occurrence.text.removeprefix("@")) or not occurrence.start <= offset <= occurrence.end:
            raise RenameError("there is no name at the cursor")
        raise RenameError(f"{occurrence.text} is not declared in this behavior")

    def rename_edits(self, definition: Definition, name: str) -> list[SymbolOccurrence]:
        """The text changes that rename a definition.

        Raises:
            RenameError: The name is invalid or taken.
        """
        name = name.removeprefix("@")
        if not _NAME.fullmatch(name) or name in KEYWORDS:
            raise RenameError(f"{name} is not a valid name")
        if any(other.name == name and _share_scope(other, definition) for other, _owner in self.definitions()):
            raise RenameError(f"there is already a {definition.description} {name}")
        edits = []
        for occurrence in self.occurrences(definition):
            sign = "@" if occurrence.text.startswith("@") else ""
            qualifier = (
                f"{definition.enum}." if definition.role == "element" and occurrence.text != definition.name else ""
            )
            edits.append(SymbolOccurrence(occurrence.path, occurrence.start, occurrence.end, sign + qualifier + name))
        if definition.role == "enum":
            edits += self._qualified_element_edits(definition.name, name)
        return edits

    def _qualified_element_edits(self, enum: str, name: str) -> Iterator[SymbolOccurrence]:
        """Changes of elements that are qualified with the name of their enumeration."""
        for tokens, token, definition in self.compiled.references:
            text = tokens.texts[token]
            if definition.role == "element" and definition.enum == enum and text.startswith(f"{enum}."):
                occurrence = self._occurrence(tokens, token)
                yield SymbolOccurrence(
                    occurrence.path, occurrence.start, occurrence.end, name + text.removeprefix(enum)
                )

    def definitions(self) -> Iterator[tuple[Definition, Definition | None]]:
        """All definitions, each with the one that contains it, such as the option of a state."""
        table = self.compiled.table
        groups = (table.enums, table.options, table.behaviors, table.agents)
        for definition in (*(definition for group in groups for definition in group.values()), *table.symbols(*_ROLES)):
            yield definition, None
            for inner in (definition.parameters, definition.elements, definition.states):
                for each in inner.values():
                    yield each, definition

    def _occurrence(self, tokens: Tokens, token: int) -> SymbolOccurrence:
        start = tokens.starts[token]
        return SymbolOccurrence(self.path_of(tokens), start, start + len(tokens.texts[token]), tokens.texts[token])

    def _read(self, path: Path) -> str | EncodedText:
        text = self.open_texts.get(path)
        return read_source(path, self.encoding) if text is None else text

    def _parse(self, text: str, name: str) -> ParsedFile:
        cached = self._parse_cache.get(name)
        if cached is None or cached[0] != text:
            self._parse_cache[name] = cached = (text, parse(text, name))
        return cached[1]


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
        previous = number - 1
        if tokens.starts[previous] + len(tokens.texts[previous]) == offset:
            return previous
    return max(number, 0)
