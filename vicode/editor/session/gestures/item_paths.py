"""Paths to the items of a design or project: lookup, change, and the same item in another version."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

from vicode.findings import DesignPath
from vicode.model.design import Declaration, Design
from vicode.model.merge import find_renamed_states, find_renamed_uses, item_key, match_items

Rename = Callable[[str, str], str]
"""Returns the new name of an item in a section; "" if it no longer exists."""


@dataclass(eq=False)
class TrackedItem:
    """An item that is followed while it is renamed or moved.

    `get_root` returns the current design or project. Steps of the path are attributes, indices, and names of states,
    used components and calls; the empty path is the root.
    """

    get_root: Callable[[], Any]
    _path: DesignPath | None = ()
    _root: Any = field(init=False)

    def __post_init__(self) -> None:
        self._root = self.get_root()

    @property
    def path(self) -> DesignPath | None:
        """The current path; None if the item no longer exists."""
        root = self.get_root()
        if root is not self._root:
            if self._path is not None:
                self._path = rebase_path(self._path, self._root, root)
            self._root = root
        return self._path


def item_at(root: Any, path: DesignPath) -> Any:
    """The item at a path; None if there is none."""
    for step in path:
        root = _child(root, step)
    return root


def change_item(root: Any, path: DesignPath, change: Callable[[Any], Any]) -> Any:
    """The root with the item at a path replaced by `change(item)`; unchanged if there is none."""
    if not path:
        return change(root)
    step, rest = path[0], path[1:]
    child = _child(root, step)
    if child is None:
        return root
    changed = change_item(child, rest, change)
    if isinstance(root, tuple):
        index = next(at for at, each in enumerate(root) if each is child) if isinstance(step, str) else step
        return (*root[:index], changed, *root[index + 1 :])
    return replace(root, **{_attribute(step): changed})


def rebase_path(path: DesignPath, old: Any, new: Any) -> DesignPath | None:
    """The path of the same item in another version of a design or project; None if it no longer exists."""

    def rename(section: str, name: str) -> str:
        if section == "notes":
            return name if any(note.name == name for note in new.notes) else ""
        if section == "frames":
            return renamed_frame(name, old, new)
        return (renamed_state if section == "states" else renamed_use)(name, old, new)

    return _rebase(path, old, new, rename)


def renamed_state(name: str, old: Design, new: Design) -> str:
    """The name of a state in a newer design; "" if it no longer exists."""
    return name if new.state(name) is not None else find_renamed_states(old, new).get(name, "")


def renamed_use(alias: str, old: Design, new: Design) -> str:
    """The alias of a used component in a newer design; "" if it no longer exists."""
    return alias if new.use(alias) is not None else find_renamed_uses(old, new).get(alias, "")


def renamed_frame(name: str, old: Design, new: Design) -> str:
    """The title of a frame in a newer design; "" if it no longer exists."""
    frame = old.frame(name)
    if new.frame(name) is not None or frame is None:
        return name
    added = (each for each in new.frames if old.frame(each.name) is None)
    return next((each.name for each in added if replace(each, name=name) == frame), "")


def _rebase(path: DesignPath, old: Any, new: Any, rename: Rename) -> DesignPath | None:
    if not path:
        return ()
    section, rest = path[0], path[1:]
    before, after = _child(old, section), _child(new, section)
    start: DesignPath = (section,)
    if isinstance(before, tuple) and rest:
        step = rest[0]
        to = rename(str(section), step) if isinstance(step, str) else _matching_index(step, before, after or ())
        before, after, rest, start = _child(before, step), _child(after, to), rest[1:], (section, to)
    if before is None or after is None:
        return None
    inner = _rebase(rest, before, after, rename)
    return None if inner is None else (*start, *inner)


def _matching_index(index: int, before: tuple[Any, ...], after: tuple[Any, ...]) -> int:
    """The index of the same item. An unrecognizable item keeps its index if the length of the list is unchanged."""
    if before is after or index >= len(before):
        return index
    is_keyed = isinstance(before[index], Declaration | tuple)
    unrecognized = index if len(before) == len(after) else len(after)
    return match_items(before, after, is_keyed=is_keyed).get(index, unrecognized)


def _child(parent: Any, step: str | int) -> Any:
    if not isinstance(parent, tuple):
        return getattr(parent, _attribute(step), None)
    if isinstance(step, int):
        return parent[step] if step < len(parent) else None
    return next((each for each in parent if item_key(each) == step), None)


def _attribute(step: str | int) -> str:
    return "otherwise" if step == "else" else str(step)
