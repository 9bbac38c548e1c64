"""C++ as a tree of brackets, with the place of each token. Comments and preprocessor lines are left out.

Of `#if` … `#else`, only the first branch is read (the second one of `#if 0`), so that brackets stay balanced.
"""

import re
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from textwrap import dedent

from vicode.cpp_tokens import COMMENT, DIRECTIVE, NUMBER, SIGN, WORD, CppToken, iter_tokens
from vicode.findings import Finding, SourceLocation, get_rule

_CLOSING = {"(": ")", "[": "]", "{": "}"}
_MAX_DEPTH = 100
_DIRECTIVE = re.compile(r"\s*#\s*(if\w*|el\w+|endif)\s*(.*)")


class CppError(Exception):
    """A file cannot be read; `finding` says why and where."""

    def __init__(self, message: str, location: SourceLocation) -> None:
        super().__init__(message)
        self.finding = Finding(rule=get_rule("S804"), message=message, location=location)


@dataclass(frozen=True, slots=True)
class CppNode:
    """A token, or brackets with what is in them; `text` is the token or the opening bracket."""

    text: str
    kind: str
    start: int
    end: int
    children: tuple["CppNode", ...] = ()

    @property
    def is_word(self) -> bool:
        return self.kind == WORD

    def is_group(self, bracket: str) -> bool:
        return self.kind == SIGN and self.text == bracket


@dataclass(slots=True)
class CppSource:
    """A file.

    Attributes:
        unread: The offsets of the `#else` whose branches were not read.
    """

    path: Path
    text: str
    nodes: tuple[CppNode, ...] = ()
    unread: list[int] = field(default_factory=list)
    _lines: list[int] = field(default_factory=list)

    def location(self, start: int, length: int = 1) -> SourceLocation:
        line = self.line(start)
        offset = self._lines[line - 1]
        length = max(1, min(length, self.text.find("\n", start) % (len(self.text) + 1) - start))
        return SourceLocation(file=str(self.path), line=line, column=start - offset + 1, length=length)

    def line(self, start: int) -> int:
        if not self._lines:
            self._lines += [0, *(found.end() for found in re.finditer("\n", self.text))]
        return bisect_right(self._lines, start)

    def slice(self, nodes: Sequence[CppNode]) -> str:
        """The text of neighboring nodes, without the indentation that all lines have."""
        if not nodes:
            return ""
        start = self.text.rfind("\n", 0, nodes[0].start) + 1
        is_first = not self.text[start : nodes[0].start].strip()
        found = self.text[start if is_first else nodes[0].start : nodes[-1].end]
        return "\n".join(line.rstrip() for line in dedent(found.expandtabs(4)).splitlines())


def read_source(path: Path, text: str) -> CppSource:
    """Read a file.

    Raises:
        CppError: Brackets do not match.
    """
    source = CppSource(path, text)
    stack: list[tuple[CppToken | None, list[CppNode]]] = [(None, [])]
    for token in _iter_read(source):
        if token.kind == SIGN and token.text in _CLOSING:
            if len(stack) > _MAX_DEPTH:
                raise CppError("brackets are nested too deeply", source.location(token.start))
            stack.append((token, []))
        elif token.kind == SIGN and token.text in ")]}":
            opening, inside = stack.pop()
            if opening is None or _CLOSING[opening.text] != token.text:
                raise CppError(f"'{token.text}' closes nothing", source.location(token.start))
            stack[-1][1].append(CppNode(opening.text, SIGN, opening.start, token.end, tuple(inside)))
        else:
            stack[-1][1].append(CppNode(token.text, token.kind, token.start, token.end))
    opening, found = stack[-1]
    if opening is not None:
        raise CppError(f"'{opening.text}' is never closed", source.location(opening.start))
    source.nodes = tuple(found)
    return source


def _iter_read(source: CppSource) -> "list[CppToken]":
    """The tokens of the branches that are read."""
    kept, branches = list[CppToken](), list[str]()
    for token in iter_tokens(source.text):
        found = _DIRECTIVE.match(token.text) if token.kind == DIRECTIVE else None
        if found and found[1].startswith("if"):
            branches.append("off" if found[2] in ("0", "false") else "on")
        elif found and branches and found[1] == "endif":
            branches.pop()
        elif found and branches:
            if branches[-1] == "on" and all(each == "on" for each in branches):
                source.unread.append(token.start)
            branches[-1] = "on" if branches[-1] == "off" else "done"
        elif token.kind not in (COMMENT, DIRECTIVE) and all(each == "on" for each in branches):
            kept.append(token)
    return kept


def split(nodes: Sequence[CppNode], separator: str) -> list[tuple[CppNode, ...]]:
    """The parts between separators outside of brackets and template arguments; at least one."""
    parts: list[list[CppNode]] = [[]]
    index = 0
    while index < len(nodes):
        end = template_end(nodes, index)
        if end == index and nodes[index].text == separator and nodes[index].kind in (SIGN, WORD):
            parts.append([])
        else:
            parts[-1] += nodes[index : end + 1]
        index = end + 1
    return [tuple(part) for part in parts]


def template_end(nodes: Sequence[CppNode], index: int) -> int:
    """The index of the `>` that closes the template arguments that start at `<`; the index itself for anything else."""
    if nodes[index].text != "<" or not index or not nodes[index - 1].is_word:
        return index
    depth = 0
    for place in range(index, len(nodes)):
        text = nodes[place].text
        depth += (text == "<") - (text == ">")
        if not depth:
            after = nodes[place + 1].text if place + 1 < len(nodes) else ""
            return (
                place
                if after in ("(", "::", "{") or nodes[index - 1].text.endswith(("_cast", "state", "event"))
                else index
            )
        if nodes[place].kind not in (WORD, NUMBER) and text not in ("<", ">", "::", ",", "*", "&"):
            return index
    return index


def words(nodes: Sequence[CppNode]) -> set[str]:
    """All words in a text."""
    found = {node.text for node in nodes if node.is_word}
    return found.union(*(words(node.children) for node in nodes))


def compact(nodes: Sequence[CppNode]) -> str:
    """The tokens with spaces only where they are needed or usual: equal texts have equal tokens."""
    text = ""
    for node in nodes:
        inside = f"{node.text}{compact(node.children)}{_CLOSING[node.text]}" if node.text in _CLOSING else node.text
        is_wide = text[-1:].isalnum() and (inside[0].isalnum() or inside[0] == "_")
        text += (
            f" {inside} "
            if node.kind == SIGN and len(node.text) == 2 and node.text not in ("::", "->", "++", "--")
            else f"{' ' * is_wide}{inside}"
        )
    return text
