"""Compares what was not understood in two versions of a file."""

from collections import Counter
from collections.abc import Iterable, Iterator

from vicode.findings import DesignPath
from vicode.model.diff.changes import Change, ChangeKind

_Member = tuple[DesignPath, str]


def diff_unread(old: Iterable[_Member], new: Iterable[_Member]) -> tuple[Change, ...]:
    """The members, as pairs of the path of their parent and their text, that were removed and added."""
    before, after = Counter(old), Counter(new)
    return (
        *_list_changes(ChangeKind.REMOVED, before - after),
        *_list_changes(ChangeKind.ADDED, after - before),
    )


def _list_changes(kind: ChangeKind, members: Counter[_Member]) -> Iterator[Change]:
    for path, text in members.elements():
        subject = f"'{' '.join(text.split())}', which is not understood{_describe_place(path)}"
        yield Change(kind=kind, subject=subject, path=path)


def _describe_place(path: DesignPath) -> str:
    return f", in {'.'.join(map(str, path))}" if path else ""
