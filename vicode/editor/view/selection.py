"""Items: the parts of a design that can be selected, their ids, and the item at a path."""

from dataclasses import dataclass, field
from typing import Literal

from vicode.findings import DesignPath

ItemKind = Literal["states", "transitions", "components", "links", "common", "frames", "notes", "design"]


@dataclass(frozen=True, slots=True, kw_only=True)
class ItemRef:
    """A selectable item."""

    kind: ItemKind = field(metadata={"json": "of"})
    id: str = ""


def item_at_path(path: DesignPath) -> ItemRef:
    """The smallest item that contains a path."""
    match path:
        case ("states", _, "transitions", int(), *_) | ("common", "transitions", int(), *_):
            return ItemRef(kind="transitions", id=transition_key(decision_path(path)))
        case ("states", str(name), *_):
            return ItemRef(kind="states", id=name)
        case ("common", *_):
            return ItemRef(kind="common", id="@common")
        case ("uses", str(alias), *_):
            return ItemRef(kind="components", id=alias)
        case ("frames", str(name), *_):
            return ItemRef(kind="frames", id=name)
        case ("notes", str(name), *_):
            return ItemRef(kind="notes", id=name)
        case _:
            return ItemRef(kind="design")


def decision_path(path: DesignPath) -> DesignPath:
    """The path of the innermost decision on a path."""
    last = max(index for index, part in enumerate(path) if isinstance(part, int))
    return path[: last + 1]


def transition_key(path: DesignPath) -> str:
    """The canvas id of a decision: "Kick/0", "Kick/2/then/1", "@common/0"."""
    source, rest = ("@common", path[2:]) if path[0] == "common" else (path[1], path[3:])
    return "/".join(str(part) for part in (source, *rest))


def parse_transition_key(key: str) -> DesignPath:
    """The path of a decision from its canvas id."""
    source, *rest = key.split("/")
    start: DesignPath = ("common", "transitions") if source == "@common" else ("states", source, "transitions")
    return (*start, *(int(part) if part.isdecimal() else part for part in rest))
