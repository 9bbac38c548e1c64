"""Ids of the actions, declarations and constructs in a design and its project, by which forms and edits name them.

An index would name another item as soon as somebody adds, moves or removes one. Ids follow their items from one
version of the design to the next. A browser chooses the ids of the items that it adds, so it can draw their fields
and send what is typed into them before it has an answer.
"""

import re
from collections.abc import Iterator, Mapping
from typing import Any

from vicode.editor.session.gestures.item_paths import rebase_path
from vicode.findings import DesignPath
from vicode.model.design import Design
from vicode.model.merge import find_renamed_states, match_items
from vicode.model.project import Project

ACTION_LISTS = ("actions", "enter", "leave")
PROJECT_LISTS = ("enumerations", "constants", "components", "agents")
DECLARATION_LISTS = ("parameters", "outputs", "variables", "arguments")
CONSTRUCT_LISTS = ("latches", "interrupts", "steps", "layers")
ID_LISTS = (*ACTION_LISTS, *DECLARATION_LISTS, *CONSTRUCT_LISTS, *PROJECT_LISTS, "elements")
"""The lists whose items have ids."""
_NOWHERE: DesignPath = ("",)
_WANTED = re.compile(r"b[0-9a-z]{4,20}")
_Ids = Mapping[str, tuple[str, ...]]


class ListIds:
    """The ids of all lists; those of a list that has not changed yet are its indices."""

    def __init__(self) -> None:
        self._changed: dict[DesignPath, _Ids] = {}
        """The ids of lists by their name, by the path of their owner."""
        self._last = 0
        self._wanted: tuple[DesignPath, str] | None = None
        self._project: tuple[Project, ListIds] | None = None

    def of_owner(self, path: DesignPath) -> _Ids | None:
        """What differs from the indices; equal values mean equal ids."""
        return self._changed.get(path)

    def ids(self, path: DesignPath, items: tuple[Any, ...]) -> tuple[str, ...]:
        """The ids of the items of a list."""
        known = self._changed.get(path[:-1], {}).get(str(path[-1]))
        return tuple(map(str, range(len(items)))) if known is None else known

    def index(self, path: DesignPath, items: tuple[Any, ...], id_: str) -> int | None:
        ids = self.ids(path, items)
        return ids.index(id_) if id_ in ids else None

    def want(self, path: DesignPath, id_: str) -> None:
        """Give this id to the item that the next edit adds to a list."""
        self._wanted = (path, id_) if _WANTED.fullmatch(id_) else None

    def of_project(self, project: Project) -> "ListIds":
        """The ids of the lists in project.yaml."""
        known = self._project
        if known is None:
            self._project = known = (project, ListIds())
        elif known[0] is not project:
            if any(getattr(known[0], name) is not getattr(project, name) for name in PROJECT_LISTS):
                known[1].follow(known[0], project)
            self._project = known = (project, known[1])
        return known[1]

    def snapshot(self) -> object:
        """Equal values mean that all ids are equal."""
        return self._changed

    def follow(self, old: Design | Project, new: Design | Project) -> None:
        """Update the ids to a new version of the design or project."""
        before = dict(_owners(old))
        moved = self._moved(old, new)
        changed: dict[DesignPath, _Ids] = {}
        for path, owner in _owners(new):
            source = moved.get(path, path)
            known, then = self._changed.get(source), before.get(source)
            if then is not owner:
                known = self._follow_owner(source, then, path, owner)
            if known:
                changed[path] = known
        self._changed, self._wanted = changed, None

    @staticmethod
    def _moved(old: Any, new: Any) -> dict[DesignPath, DesignPath]:
        """The old paths of owners whose paths have changed."""
        moved: dict[DesignPath, DesignPath] = {}
        if isinstance(new, Design) and [each.name for each in old.states] != [each.name for each in new.states]:
            moved = {("states", now): ("states", then) for then, now in find_renamed_states(old, new).items()}
        if isinstance(new, Design) and old.outputs is new.outputs:
            return moved
        indexed = (path for path, _owner in _owners(new) if path and isinstance(path[-1], int))
        return moved | {path: rebase_path(path, new, old) or _NOWHERE for path in indexed}

    def _follow_owner(self, source: DesignPath, then: Any, path: DesignPath, owner: Any) -> _Ids:
        if then is None:
            return {}
        changed: dict[str, tuple[str, ...]] = {}
        for section in ID_LISTS:
            before, items = getattr(then, section, None) or (), getattr(owner, section, None) or ()
            ids = self.ids((*source, section), before)
            if before != items:
                ids = self._follow_list(ids, before, items, (*path, section))
            if ids != tuple(map(str, range(len(items)))):
                changed[section] = ids
        return changed

    def _follow_list(
        self, ids: tuple[str, ...], before: tuple[Any, ...], items: tuple[Any, ...], path: DesignPath
    ) -> tuple[str, ...]:
        matches = match_items(before, items, is_keyed=path[-1] not in ACTION_LISTS)
        followed = {to: ids[index] for index, to in matches.items()}
        if len(before) == len(items):
            # An item that was changed beyond recognition.
            for index in range(len(items)):
                if index not in followed and index not in matches:
                    followed[index] = ids[index]
        return tuple(
            followed.get(index) or self._new_id(path, (*ids, *followed.values())) for index in range(len(items))
        )

    def _new_id(self, path: DesignPath, taken: tuple[str, ...]) -> str:
        wanted = self._wanted
        # What is derived from a new construct is added to other lists.
        if wanted is not None and wanted[0] == path and wanted[1] not in taken:
            self._wanted = None
            return wanted[1]
        self._last += 1
        return f"n{self._last}"


def noun_of(section: str) -> str:
    """What an item of a list is called."""
    return section.removesuffix("es" if section == "latches" else "s")


def _owners(root: Design | Project) -> Iterator[tuple[DesignPath, Any]]:
    """The owners of lists, with their paths."""
    yield (), root
    if isinstance(root, Design):
        for state in root.states:
            yield ("states", state.name), state
        yield ("common",), root.common
        if root.competence is not None:
            yield ("competence",), root.competence
        yield from _indexed((), "outputs", root.outputs)
        return
    yield from _indexed((), "enumerations", root.enumerations)
    for path, component in _indexed((), "components", root.components):
        yield path, component
        yield from _indexed(path, "outputs", component.outputs)


def _indexed(path: DesignPath, section: str, items: tuple[Any, ...]) -> Iterator[tuple[DesignPath, Any]]:
    return (((*path, section, index), item) for index, item in enumerate(items))
