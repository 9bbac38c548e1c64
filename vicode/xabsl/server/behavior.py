"""A behavior that is being written: its files as the editor has them, what they declare, and where it is used."""

import re
from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from vicode.xabsl.compiler import Compiled, compile_source
from vicode.xabsl.declared import Declared
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.parser import Parsed, parse
from vicode.xabsl.sources import Source, load, read_text
from vicode.xabsl.tokens import KEYWORDS

_AGENT = re.compile(r"^\s*agent\s+\w", re.MULTILINE)
_HIGHEST = 8
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_.]*")


@dataclass(frozen=True, slots=True)
class Spot:
    """Some characters of a file, counted from 0, and a text for them."""

    path: Path
    start: int
    end: int
    text: str = ""


class RenameError(ValueError):
    """A name that cannot be given; says why."""


@dataclass(eq=False)
class Behavior:
    """The program that begins in `main`. `open_texts` are files as an editor has them, saved or not."""

    main: Path
    open_texts: dict[Path, str] = field(default_factory=dict)
    source: Source = field(init=False)
    compiled: Compiled = field(init=False)
    _known: dict[str, tuple[str, Parsed]] = field(default_factory=dict)
    _uses: dict[int, list[tuple[int, Declared]]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Read it for the first time."""
        self.look()

    def look(self) -> Compiled:
        """Read what has changed, and bind all of it anew."""
        self.source = load(self.main, self._read, self._parse)
        self.compiled = compile_source(self.source)
        self._uses = {}
        for tokens, at, declared in self.compiled.uses:
            self._uses.setdefault(id(tokens), []).append((at, declared))
        for declared in self._all():
            self._uses.setdefault(id(declared.tokens), []).append((declared.word.at, declared))
        for found in self._uses.values():
            found.sort(key=lambda each: each[0])
        return self.compiled

    def declared_at(self, path: Path, offset: int) -> Declared | None:
        """What the word at a character means."""
        parsed = self.source.files.get(path)
        if parsed is None:
            return None
        number = token_at(parsed.tokens, offset)
        uses = self._uses.get(id(parsed.tokens), [])
        at = bisect_right(uses, number, key=lambda each: each[0]) - 1
        return uses[at][1] if at >= 0 and uses[at][0] == number else None

    def spot_of(self, declared: Declared) -> Spot:
        """Where something is declared."""
        return self._spot(declared.tokens, declared.word.at)

    def spots_of(self, declared: Declared) -> list[Spot]:
        """Where something is declared and used, in the order of files and lines."""
        paths = {id(parsed.tokens): parsed.tokens for parsed in self.source.files.values()}
        return [self._spot(paths[key], at) for key in paths for at, each in self._uses.get(key, ()) if each is declared]

    def renamed(self, declared: Declared, name: str) -> list[Spot]:
        """The spots that a new name changes, with what to write there.

        Raises:
            RenameError: It is no name, or something else has it.
        """
        name = name.removeprefix("@")
        if not _NAME.fullmatch(name) or name in KEYWORDS:
            raise RenameError(f"{name} cannot be a name")
        if any(each.name == name and _are_neighbours(each, declared) for each in self._all()):
            raise RenameError(f"there is a {declared.what} {name} already")
        spots = []
        for spot in self.spots_of(declared):
            sign = "@" if spot.text.startswith("@") else ""
            before = f"{declared.enum}." if declared.role == "element" and spot.text != declared.name else ""
            spots.append(Spot(spot.path, spot.start, spot.end, sign + before + name))
        if declared.role == "enum":
            spots += self._elements_of(declared.name, name)
        return spots

    def _elements_of(self, enum: str, name: str) -> Iterator[Spot]:
        """Elements that are used with the name of their enumeration before them."""
        for tokens, at, declared in self.compiled.uses:
            text = tokens.texts[at]
            if declared.role == "element" and declared.enum == enum and text.startswith(f"{enum}."):
                spot = self._spot(tokens, at)
                yield Spot(spot.path, spot.start, spot.end, name + text.removeprefix(enum))

    def _all(self) -> Iterator[Declared]:
        table = self.compiled.table
        groups = (table.enums, table.options, table.behaviors, table.agents)
        for each in (*(each for group in groups for each in group.values()), *table.symbols(*_ROLES)):
            yield each
            for inner in (each.parameters, each.elements, each.states):
                yield from inner.values()

    def _spot(self, tokens: Tokens, at: int) -> Spot:
        path = next(path for path, parsed in self.source.files.items() if parsed.tokens is tokens)
        start = tokens.starts[at]
        return Spot(path, start, start + len(tokens.texts[at]), tokens.texts[at])

    def _read(self, path: Path) -> str:
        text = self.open_texts.get(path)
        return read_text(path) if text is None else text

    def _parse(self, text: str, name: str) -> Parsed:
        known = self._known.get(name)
        if known is None or known[0] != text:
            self._known[name] = known = (text, parse(text, name))
        return known[1]


_ROLES = ("input", "output", "internal", "const")


def _are_neighbours(one: Declared, other: Declared) -> bool:
    """Whether two declarations may not have the same name."""
    if one.role in ("parameter", "state", "element"):
        return one.role == other.role and one.node.at != other.node.at and one.tokens is other.tokens
    return one.role == other.role


def token_at(tokens: Tokens, offset: int) -> int:
    """The number of the token at a character; of two that touch the later, unless it is a sign behind a word."""
    number = bisect_right(tokens.starts, offset) - 1
    ends_there = number > 0 and tokens.starts[number] == offset
    if ends_there and not _NAME.match(tokens.texts[number].lstrip("@")):
        before = number - 1
        if tokens.starts[before] + len(tokens.texts[before]) == offset:
            return before
    return max(number, 0)


def find_main(path: Path) -> Path:
    """The file with the agents of the behavior that a file belongs to; the file itself if there is none."""
    for folder in [path.parent, *path.parent.parents][:_HIGHEST]:
        found = [each for each in sorted(folder.glob("*.xabsl")) if _has_agents(each)]
        found.sort(key=lambda each: each.name != "agents.xabsl")
        for each in found:
            if path in load(each).files:
                return each.resolve()
    return path


def _has_agents(path: Path) -> bool:
    try:
        return bool(_AGENT.search(read_text(path)))
    except OSError:
        return False
