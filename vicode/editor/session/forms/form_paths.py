"""Paths of fields: as the browser names them, of their owners in the design, and in the file.

In the browser, an action or declaration is named by its id instead of its index (`ListIds`), and a guard is a step of
its own: "enter/n3/values", "guard/when".
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, TypeVar, cast

from vicode.editor.session.forms.list_ids import ID_LISTS, ListIds
from vicode.editor.session.gestures.item_paths import item_at
from vicode.editor.view import ItemRef
from vicode.findings import DesignPath
from vicode.model.decision_keys import parse_transition_key
from vicode.model.design import Design
from vicode.model.project import Project

_Message = TypeVar("_Message")
_KEYS = {"values": "set", "arguments": "with"}


def item_path(item: ItemRef) -> DesignPath | None:
    """The path of an item in the design; None if it has no form."""
    match item:
        case ItemRef(kind="design"):
            return ()
        case ItemRef(kind="transitions", id=key):
            return parse_transition_key(key)
        case ItemRef(kind="components", id=alias):
            return ("uses", alias)
        case ItemRef(kind="states" | "frames" | "notes" as section, id=name):
            return (section, name)
        case ItemRef(kind="common"):
            return ("common",)
        case _:
            return None


def parse_path(path: str) -> DesignPath:
    """The steps of a path in the browser."""
    return tuple(int(step) if step.isdecimal() else step for step in path.split("/") if step)


def is_in_list(steps: DesignPath) -> bool:
    """Whether a path in the browser leads to an action, a declaration or a construct, or a part of one."""
    return len(steps) > 1 and steps[0] in (*ID_LISTS, "competence")


def at_design(message: _Message) -> _Message:
    """A message about a field that several forms show ("design/latches/0/on"), as one about the form of the design."""
    path = getattr(message, "path", None) or ""
    if not path.startswith("design/"):
        return message
    changed: Any = message
    return cast(_Message, replace(changed, item=ItemRef(kind="design"), path=path.removeprefix("design/")))


def resolve(root: Design | Project, ids: ListIds, item: DesignPath, steps: DesignPath) -> DesignPath | None:
    """The path with indices instead of ids; None if there is no such action or declaration."""
    if not is_in_list(steps):
        return steps
    if steps[0] == "competence":
        below = resolve(root, ids, (*item, steps[0]), steps[1:])
        return None if below is None else (steps[0], *below)
    path = (*item, steps[0])
    index = ids.index(path, item_at(root, path) or (), str(steps[1]))
    if index is None:
        return None
    inner = resolve(root, ids, (*path, index), steps[2:])
    return None if inner is None else (steps[0], index, *inner)


def split_path(steps: DesignPath) -> tuple[DesignPath, DesignPath]:
    """The owner of a resolved path, relative to the item, and the path of the value in its owner."""
    if "modulates" in steps:
        last = steps.index("modulates") + 2
    else:
        start = 0 if steps[:1] == ("competence",) else -1
        last = max((at for at, step in enumerate(steps) if isinstance(step, int)), default=start) + 1
    return steps[:last], steps[last:]


def file_path(design: Design, item: DesignPath, steps: Sequence[str | int]) -> DesignPath:
    """The path in the file of a resolved path."""
    if not item:
        return _path_in_design(design, tuple(steps))
    if tuple(steps) == ("initial",):
        return ("initial",)
    if item[:1] == ("uses",):
        return item
    if item[:1] == ("frames",):
        # A frame is a list of states.
        return (*item, *(step for step in steps if step != "states"))
    if steps[:1] == ("modulates",):
        return (*item, *(step for step in steps if step != "arguments"))
    return (*item, *(_KEYS.get(str(step), step) for step in steps if step != "guard"))


def _path_in_design(design: Design, steps: DesignPath) -> DesignPath:
    """Declarations are named in the file, and some of their values have other keys there."""
    named: list[str | int] = []
    for at, step in enumerate(steps):
        named.append(getattr(item_at(design, steps[: at + 1]), "name", step) if isinstance(step, int) else step)
    match steps:
        case (*_, int(), "modulates", alias, "arguments"):
            # Findings about commands are at the state of the step or layer.
            return ("states", named[steps.index("modulates") - 1], "modulates", alias)
        case ("interrupts", int(), "during"):
            return (*named[:-1], "while")
        case ("layers", int(), "hold"):
            return (*named[:-1], "for")
        case (*_, int(), "name"):
            return tuple(named[:-1])
        case (*_, "parameters" | "arguments", int(), "initial"):
            return (*named[:-1], "default")
        case ("frequency_hz",):
            return ("frequency",)
        case _:
            return tuple(named)
