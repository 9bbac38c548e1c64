"""C++ as a tree of brackets with the place of each token, without comments and preprocessor lines.

Of `#if` … `#else`, only the first branch is read, of `#if 0` the second one: so brackets stay balanced.
"""

import re
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from textwrap import dedent

from vicode.cpp_tokens import COMMENT, DIRECTIVE, NUMBER, SIGN, WORD, CppToken, iter_tokens
from vicode.findings import Finding, SourceLocation, get_rule

_CLOSING = {"(": ")", "[": "]", "{": "}"}
_MAX_DEPTH = 100
_DIRECTIVE = re.compile(r"\s*#\s*(if|el|endif)\w*\s*(.*)")
_IN_TEMPLATES = frozenset({"<", ">", "::", ",", "*", "&"})


class CppError(Exception):
    """A file cannot be read; `finding` says why and where."""

    def __init__(self, message: str, location: SourceLocation) -> None:
        super().__init__(message)
        self.finding = Finding(rule=get_rule("S804"), message=message, location=location)


@dataclass(frozen=True, slots=True)
class CppTree:
    """A token, or brackets with what is in them; `text` is the token or the opening bracket."""

    text: str
    kind: str
    start: int
    end: int
    children: tuple["CppTree", ...] = ()


@dataclass(slots=True)
class CppSource:
    """A file; `unread` are the offsets of the branches of the preprocessor that were not read."""

    path: Path
    text: str
    nodes: tuple[CppTree, ...] = ()
    unread: list[int] = field(default_factory=list)
    lines: list[int] = field(default_factory=list)

    def location(self, start: int) -> SourceLocation:
        self.lines = self.lines or [0, *(found.end() for found in re.finditer("\n", self.text))]
        line = bisect_right(self.lines, start)
        return SourceLocation(file=str(self.path), line=line, column=start - self.lines[line - 1] + 1)

    def slice(self, nodes: Sequence[CppTree]) -> str:
        """The text of neighboring nodes, without the indentation that all lines have."""
        start, end = (nodes[0].start, nodes[-1].end) if nodes else (0, 0)
        indentation = self.text[self.text.rfind("\n", 0, start) + 1 : start]
        return dedent(("" if indentation.strip() else indentation) + self.text[start:end]).expandtabs(4)


def read_source(path: Path, text: str) -> CppSource:
    """Read a file.

    Raises:
        CppError: Brackets do not match.
    """
    source = CppSource(path, text)
    stack: list[tuple[CppToken, list[CppTree]]] = [(CppToken(SIGN, "", 0, 0), [])]
    for token in _iter_read(source):
        if token.kind != SIGN or token.text not in "()[]{}":
            stack[-1][1].append(CppTree(token.text, token.kind, token.start, token.end))
        elif token.text in _CLOSING and len(stack) <= _MAX_DEPTH:
            stack.append((token, []))
        elif _CLOSING.get(stack[-1][0].text) == token.text:
            opening, inside = stack.pop()
            stack[-1][1].append(CppTree(opening.text, SIGN, opening.start, token.end, tuple(inside)))
        else:
            problem = "is nested too deeply" if token.text in _CLOSING else "closes nothing"
            raise CppError(f"'{token.text}' {problem}", source.location(token.start))
    if len(stack) > 1:
        raise CppError(f"'{stack[-1][0].text}' is never closed", source.location(stack[-1][0].start))
    source.nodes = tuple(stack[0][1])
    return source


def _iter_read(source: CppSource) -> Iterator[CppToken]:
    branches = list[bool | None]()
    for token in iter_tokens(source.text):
        if token.kind == DIRECTIVE and (found := _DIRECTIVE.match(token.text)):
            if found[1] == "if":
                branches.append(found[2] not in ("0", "false"))
            elif branches:
                was_read = branches.pop()
                # None: a branch was read.
                branches += [] if found[1] == "endif" else [True if was_read is False else None]
                source.unread += [token.start] if branches and was_read and found[1] == "el" else []
        elif token.kind not in (COMMENT, DIRECTIVE) and all(branches):
            yield token


def split(nodes: Sequence[CppTree], separator: str) -> list[tuple[CppTree, ...]]:
    """The parts between separators outside of brackets and template arguments; at least one."""
    places = [index for index in iter_plain(nodes) if nodes[index].text == separator]
    return [tuple(nodes[a + 1 : b]) for a, b in zip([-1, *places], [*places, len(nodes)], strict=True)]


def iter_plain(nodes: Sequence[CppTree]) -> Iterator[int]:
    """The indices of nodes outside of template arguments."""
    index = 0
    while index < len(nodes):
        end = template_end(nodes, index)
        if end == index:
            yield index
        index = end + 1


def template_end(nodes: Sequence[CppTree], index: int) -> int:
    """The index of the `>` of the template arguments that start at an index; the index itself if none do."""
    if nodes[index].text != "<" or not index or nodes[index - 1].kind != WORD:
        return index
    depth = 0
    for place in range(index, len(nodes)):
        text = nodes[place].text
        depth += (text == "<") - (text == ">")
        if not depth:
            after = nodes[place + 1].text if place + 1 < len(nodes) else ""
            return place if after in ("(", "::", "{") or nodes[index - 1].text in ("state", "event") else index
        if nodes[place].kind not in (WORD, NUMBER) and text not in _IN_TEMPLATES:
            break
    return index


def class_name(nodes: Sequence[CppTree], index: int) -> CppTree | None:
    """The name of the class whose body, or whose `operator()`, is the node at an index; None for other nodes."""
    if nodes[index].text != "{":
        return None
    start = next((place + 1 for place in range(index - 1, -1, -1) if nodes[place].text in (";", "{")), 0)
    head = nodes[start:index]
    for before, node in pairwise(head):
        if before.text in ("struct", "class") and node.kind == WORD:
            return node
        if node.text == "::" and any(each.text == "operator" for each in head):
            return before
    return None


def words(nodes: Sequence[CppTree]) -> set[str]:
    """All words in a text."""
    return {node.text for node in nodes if node.kind == WORD}.union(*(words(node.children) for node in nodes))


def compact(nodes: Sequence[CppTree]) -> str:
    """A text with few spaces: equal tokens give equal texts."""
    text = ""
    for node in nodes:
        inside = f"{node.text}{compact(node.children)}{_CLOSING[node.text]}" if node.text in _CLOSING else node.text
        text += f" {inside}" if re.search(r"[\w,&|=]$", text) and re.match(r"[\w&|=!]", inside) else inside
    return text
