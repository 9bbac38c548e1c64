"""Writes added, changed and deleted comments of designs to the XABSL files."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from difflib import SequenceMatcher
from pathlib import Path

from vicode.services.imported_behavior.comment_places import CommentPlace, XabslComment
from vicode.xabsl.patching.comment_edits import (
    Lines,
    comment_token,
    formatted_comments,
    insert_above,
    insert_beside,
    insert_header,
    remove_comment,
    rewrite_comment,
)
from vicode.xabsl.patching.source_edits import PatchError, SourceEdits
from vicode.xabsl.source_loader import ProgramSource
from vicode.xabsl.tokens import HEADER


def write_comments(
    source: ProgramSource, places: Iterable[CommentPlace], originals: Mapping[Lines, str]
) -> dict[Path, str]:
    """Change the comments of these places to those of the designs; returns the texts of the changed files.

    Args:
        source: The files.
        places: The places that differ.
        originals: Comments that the files had before, by their lines: they are written as they were.
    """
    files = {path: SourceEdits(parsed) for path, parsed in source.files.items()}
    for place in places:
        _PlaceEdits(files, place, originals).run()
    texts = {}
    for path, file in files.items():
        if file.edits:
            try:
                texts[path] = file.result()
            except PatchError:
                continue
    return texts


@dataclass(slots=True)
class _CommentChanges:
    """The new lines of each comment, and the lines of new comments before each of them and behind the last."""

    kept: list[list[str]]
    added: dict[int, list[str]] = field(default_factory=dict)

    def add(self, index: int, lines: Sequence[str]) -> None:
        self.added.setdefault(index, []).extend(lines)


class _PlaceEdits:
    def __init__(
        self,
        files: Mapping[Path, SourceEdits],
        place: CommentPlace,
        originals: Mapping[Lines, str],
    ) -> None:
        self.files, self.place, self.originals = files, place, originals
        self.comments = place.comments

    def run(self) -> None:
        wanted = self.place.wanted_lines
        if not self.place.is_exact:
            # Where the structure differs, comments are deleted only: others may belong elsewhere.
            wanted = _common_lines(self.place.present_lines, wanted)
        changes = _compare(self.comments, wanted)
        for index in sorted(changes.added, reverse=True):
            self._add(changes, index)
        for each, lines in zip(self.comments, changes.kept, strict=True):
            span = each.comment.span
            if span is None or list(each.lines) == lines:
                continue
            if lines:
                rewrite_comment(self.files[each.file], span, each.lines, lines)
            else:
                remove_comment(self.files[each.file], span)

    def _add(self, changes: _CommentChanges, index: int) -> None:
        """Write new comments before the comment with this index, behind the one before it, or at the start."""
        lines = changes.added[index]
        following = self.comments[index] if index < len(self.comments) else None
        previous = self.comments[index - 1] if index else None
        header = next((number for number in (index, index - 1) if self._is_header(number)), None)
        if header is not None:
            kept = changes.kept[header]
            changes.kept[header] = [*lines, *kept] if header == index else [*kept, *lines]
        elif following is not None and following.comment.own_line and following.comment.span:
            insert_beside(self.files[following.file], following.comment.span, self._format(lines), is_after=False)
        elif self._is_before_start(previous):
            self._insert_at_start(lines)
        elif previous is not None and previous.comment.own_line and previous.comment.span:
            insert_beside(self.files[previous.file], previous.comment.span, self._format(lines), is_after=True)
        else:
            self._move_up(changes, index, lines)

    def _move_up(self, changes: _CommentChanges, index: int, lines: Sequence[str]) -> None:
        """Move the comments inside and behind the element above it, so that the new ones can follow them."""
        first = next(number for number in range(index) if not self._is_before_start(self.comments[number]))
        moved = [line for kept in changes.kept[first:index] for line in kept]
        changes.kept[first:index] = [[] for _ in range(first, index)]
        self._insert_at_start([*moved, *lines])

    def _insert_at_start(self, lines: Sequence[str]) -> None:
        if self.place.start is not None:
            path, token = self.place.start
            insert_above(self.files[path], token, self._format(lines))
        elif self.place.header_file is not None:
            insert_header(self.files[self.place.header_file], lines)

    def _is_header(self, index: int) -> bool:
        if not 0 <= index < len(self.comments):
            return False
        each = self.comments[index]
        return each.comment.token == 0 and self.files[each.file].tokens.kinds[0] == HEADER

    def _is_before_start(self, each: XabslComment | None) -> bool:
        if each is None or self.place.start is None:
            return each is None
        path, token = self.place.start
        return each.file == path and each.comment.token <= comment_token(self.files[path], token)

    def _format(self, lines: Sequence[str]) -> list[str]:
        return formatted_comments(lines, self.originals)


def _compare(comments: Sequence[XabslComment], wanted: Sequence[str]) -> _CommentChanges:
    """Distribute the wanted lines to the comments: lines beside those of a comment of several lines belong to it."""
    owners = [index for index, each in enumerate(comments) for _line in each.lines]
    present = [line for each in comments for line in each.lines]
    changes = _CommentChanges([[] for _ in comments])
    matcher = SequenceMatcher(None, present, wanted, autojunk=False)
    for tag, first, last, new_first, new_last in matcher.get_opcodes():
        pairs = min(last - first, new_last - new_first) if tag != "delete" else 0
        for number in range(pairs):
            changes.kept[owners[first + number]].append(wanted[new_first + number])
        rest = wanted[new_first + pairs : new_last]
        if not rest:
            continue
        before = owners[first + pairs - 1] if first + pairs else None
        after = owners[first + pairs] if first + pairs < len(owners) else len(comments)
        if before is not None and before == after:
            changes.kept[before] += rest
        else:
            changes.add(after if before is None else before + 1, rest)
    return changes


def _common_lines(present: Sequence[str], wanted: Sequence[str]) -> list[str]:
    """The present lines that are wanted, as often as they are wanted."""
    left, common = Counter(wanted), []
    for line in present:
        if left[line]:
            left[line] -= 1
            common.append(line)
    return common


def comments_by_lines(comments: Iterable[XabslComment], source: ProgramSource) -> dict[Lines, str]:
    """The texts of comments by their lines."""
    found: dict[Lines, str] = {}
    for each in comments:
        span = each.comment.span
        text = source.files[each.file].tokens.text[slice(*span)] if span else ""
        if text and each.lines and not text.startswith("/***"):
            found.setdefault(each.lines, text.replace("\r\n", "\n"))
    return found
