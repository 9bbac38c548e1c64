"""Puts comments that a patch lost back above the items that they belong to."""

import re
from collections import Counter
from collections.abc import Iterator, Mapping

from vicode.findings import DesignPath
from vicode.store.comments import CommentedFile, add_comments
from vicode.store.schema_types import FormatValue
from vicode.store.typed_node import TypedNode

_MAYBE_COMMENT = re.compile(r"#[^\n]*")


def keep_comments(old: str, new: str, *, is_project_file: bool) -> str:
    """Add the comments of items that stay, also where they moved, such as a transition to another state.

    Args:
        old: The old text, with line feeds.
        new: The new text, in which comments of removed and of other items are missing.
        is_project_file: Whether the texts are those of a project.yaml.
    """
    if not Counter(_MAYBE_COMMENT.findall(old)) - Counter(_MAYBE_COMMENT.findall(new)):
        return new
    before, after = (CommentedFile(text, is_project_file=is_project_file) for text in (old, new))
    missing = Counter(comment.text for comment in before.comments) - Counter(comment.text for comment in after.comments)
    if before.root is None or after.root is None or not missing:
        return new
    search = _ItemSearch(before.root, after.root)
    added = []
    for comment in before.comments:
        path = search.find(before.owner_of(comment)) if missing[comment.text] else None
        if path is not None:
            missing[comment.text] -= 1
            added.append((path, comment.text))
    return add_comments(new, added, is_project_file=is_project_file) if added else new


def take_comments(source: str, old: str, new: str, names: Mapping[str, str]) -> str:
    """Add the comments of states, declarations and uses that a design has taken over from another file.

    Args:
        source: The text of the other file.
        old: The text of the design before.
        new: Its text with the items that it has taken over.
        names: The new names of states, by their names in `source`.
    """
    other, before, after = (CommentedFile(text) for text in (source, old, new))
    added = []
    for comment in other.comments:
        path = other.owner_of(comment)
        if path[:1] == ("states",):
            path = tuple(names.get(str(step), step) if at == 1 else step for at, step in enumerate(path))
        if len(path) > 1 and _has_item(after.root, path) and not _has_item(before.root, path):
            added.append((path, comment.text))
    return add_comments(new, added) if added else new


def _has_item(root: TypedNode | None, path: DesignPath) -> bool:
    section = root.children.get(path[0]) if root is not None else None
    return section is not None and path[1] in section.children


class _ItemSearch:
    """Finds items of an old tree in a new one."""

    def __init__(self, old: TypedNode, new: TypedNode) -> None:
        self._old, self._new = old, new
        left, entered = _list_items(old), _list_items(new)
        self._moved = {
            value: (*parent, index)
            for (parent, value), indices in entered.items()
            if len(indices) > len(left.get((parent, value), ()))
            for index in indices
        }

    def find(self, path: DesignPath) -> DesignPath | None:
        """The new path of an item; None if it was removed."""
        found: DesignPath = ()
        old, new = self._old, self._new
        is_found = True
        for step in path:
            child = old.children[step]
            step_found = _find_step(old, new, step) if is_found else None
            moved = self._moved.get(child.value) if isinstance(step, int) and child.value is not None else None
            is_found = step_found is not None or moved is not None
            if step_found is not None:
                found, new = (*found, step_found), new.children[step_found]
            elif moved is not None:
                found, new = moved, self._at(moved)
            old = child
        return found if is_found else None

    def _at(self, path: DesignPath) -> TypedNode:
        node = self._new
        for step in path:
            node = node.children[step]
        return node


def _find_step(old: TypedNode, new: TypedNode, step: str | int) -> str | int | None:
    """The key of a child in a new node: by its name, or else by its value, or else by its place among changed ones."""
    if isinstance(step, str) and step in new.children:
        return step
    value, values = old.children[step].value, {key: child.value for key, child in old.children.items()}
    for key, child in new.children.items():
        if child.value == value and (isinstance(step, int) or key not in old.children):
            return key
    is_changed = isinstance(step, int) and len(new.children) == len(old.children) and step in new.children
    return step if is_changed and new.children[step].value not in values.values() else None


def _list_items(root: TypedNode) -> dict[tuple[DesignPath, FormatValue], list[int]]:
    """The indices of the items of lists, by the path of the list and the value."""
    found: dict[tuple[DesignPath, FormatValue], list[int]] = {}
    for path, node in _walk(root, ()):
        if path and isinstance(path[-1], int) and node.value is not None:
            found.setdefault((path[:-1], node.value), []).append(path[-1])
    return found


def _walk(node: TypedNode, path: DesignPath) -> Iterator[tuple[DesignPath, TypedNode]]:
    yield path, node
    for step, child in node.children.items():
        yield from _walk(child, (*path, step))
