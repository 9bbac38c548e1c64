"""Items: the parts of a design that can be selected, their ids, and the item at a path."""

from dataclasses import dataclass, field
from typing import Literal

from vicode.findings import DesignPath
from vicode.model.decision_keys import transition_key

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
        case ("states", str(name), *_) | ("competence", "steps", str(name), *_) | ("layers", str(name), *_):
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
