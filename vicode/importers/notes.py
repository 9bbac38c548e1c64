"""Lists what the designs of an imported behavior cannot express: it stays in the XABSL files, or has another form."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from vicode.findings import DesignPath
from vicode.importers.comments import PlacedComment
from vicode.model.paths import describe_path
from vicode.xabsl import tree
from vicode.xabsl.compiler import CompileResult
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.ranges import parse_range
from vicode.xabsl.source_loader import ProgramSource
from vicode.xabsl.tokens import DOC

TokenNote = tuple[int, str]
"""The index of a token, and what the design cannot express there."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportNote:
    """Something in a file that the designs cannot express."""

    file: Path
    line: int
    text: str


def list_notes(
    source: ProgramSource,
    compiled: CompileResult,
    comments: Iterable[tuple[Path, PlacedComment, int | None]],
    options: Mapping[Path, list[TokenNote]],
) -> tuple[ImportNote, ...]:
    """List the notes by file and line.

    Args:
        source: The files.
        compiled: The result of compiling them.
        comments: The comments with their files and the tokens above which their elements show them.
        options: The notes on options.
    """
    found = {(each.file, each.line, each.text): each for each in _iter_notes(source, compiled, comments, options)}
    order = {path: number for number, path in enumerate(source.files)}
    return tuple(sorted(found.values(), key=lambda note: (order[note.file], note.line, note.text)))


def _iter_notes(
    source: ProgramSource,
    compiled: CompileResult,
    comments: Iterable[tuple[Path, PlacedComment, int | None]],
    options: Mapping[Path, list[TokenNote]],
) -> Iterator[ImportNote]:
    paths = {id(parsed.tokens): path for path, parsed in source.files.items()}
    for tokens, token, definition in compiled.references:
        if definition.role == "input" and definition.parameters and tokens.kinds[token + 1] != "(":
            text = f"{definition.name} is read without arguments: the design calls it with the defaults"
            yield ImportNote(file=paths[id(tokens)], line=_line(tokens, token), text=text)
    for path, parsed in source.files.items():
        for node in _iter_ranged(parsed.file):
            is_number = node.type is None or node.type.text == "float"
            if node.range and (not is_number or parse_range(node.range) is None):
                text = f"the range [{node.range}] is not a pair of numbers: the design keeps it in the description"
                yield ImportNote(file=path, line=_line(parsed.tokens, node.first_token), text=text)
        for token, text in options.get(path, ()):
            yield ImportNote(file=path, line=_line(parsed.tokens, token), text=text)
    for path, comment, start in comments:
        tokens = source.files[path].tokens
        if comment.span is not None and start is not None and _is_elsewhere(tokens, comment, start):
            text = f"the design shows this comment above {_describe(comment.path)}"
            yield ImportNote(file=path, line=tokens.line_at(comment.span[0]), text=text)


def _is_elsewhere(tokens: Tokens, comment: PlacedComment, start: int) -> bool:
    """Whether a comment stands neither above the first line of its element nor behind a token of that line."""
    assert comment.span is not None
    line = tokens.line_at(comment.span[0])
    first = start
    while first and tokens.kinds[first - 1] in ("else", DOC):
        first -= 1
    is_beside = line in (_line(tokens, start), _line(tokens, first))
    return not is_beside and not (comment.own_line and first <= comment.token <= start)


def _describe(path: DesignPath) -> str:
    return describe_path(path, "the design")


def _iter_ranged(file: tree.FileNode) -> Iterator[tree.SymbolNode | tree.ParameterNode]:
    for item in file.body:
        for node in item.declarations if isinstance(item, tree.NamespaceNode) else ():
            if isinstance(node, tree.SymbolNode):
                yield node
            if isinstance(node, tree.SymbolNode | tree.BehaviorNode):
                yield from node.parameters or ()
        if isinstance(item, tree.OptionNode):
            yield from item.parameters


def _line(tokens: Tokens, token: int) -> int:
    return tokens.line_at(tokens.starts[token])
