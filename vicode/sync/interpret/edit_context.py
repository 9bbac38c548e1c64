"""What proposals know: the design, its project, and the change of the code that they are to explain."""

import ast
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from vicode.findings import DesignPath
from vicode.model.design import COMMON, Design
from vicode.model.project import Project
from vicode.model.traversal import LocatedAction, LocatedDecision, iter_actions, iter_decisions
from vicode.regions import find_regions, wrap_region
from vicode.sync.code_items import CodeItem
from vicode.sync.interpret.expression_reader import ExpressionReader
from vicode.sync.interpret.units import Units

_GENERATED = re.compile(r"_(in|enter|leave|when|do|decide|act)_|(__init__|modulate|_set_states)\Z")
_MARK = re.compile(r"\s*# </?vicode\b")


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeChange:
    """Items of the generated code that a person replaced by others; one of the two may be empty.

    `line` is the line in the edited file where the first items are or were.
    """

    removed: tuple[CodeItem, ...] = ()
    added: tuple[CodeItem, ...] = ()
    line: int = 1

    @property
    def sides(self) -> tuple[tuple[CodeItem, ...], tuple[CodeItem, ...]]:
        return self.removed, self.added

    @property
    def key(self) -> object:
        return tuple(tuple(item.key for item in items) for items in self.sides)

    @property
    def item(self) -> CodeItem:
        return (self.added or self.removed)[0]


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """What a method of the generated class belongs to.

    `phase` is "decisions" or "actions" (both: ""), "enter" or "leave"; `source` is a state or COMMON.
    """

    source: str
    phase: str


@dataclass(frozen=True, kw_only=True)
class EditContext:
    """The design and its generated code.

    Attributes:
        project: The project with the design.
        design: The design with the edits understood so far.
        stems: The states by the part of method names that stands for them.
        edited: The units of the edited file.
        lines: The lines of the edited file.
        bodies: The bodies of the regions of the generated code.
    """

    project: Project
    design: Design
    stems: dict[str, str]
    edited: Units
    lines: tuple[str, ...]
    bodies: Mapping[str, str]

    @cached_property
    def reader(self) -> ExpressionReader:
        return ExpressionReader.of(self.project, self.design)

    @cached_property
    def class_line(self) -> int:
        """The first line of the class in the edited file; 0 without a class."""
        return next((number for number, line in enumerate(self.lines, start=1) if line.startswith("class ")), 0)

    def place_of(self, scope: str) -> Place | None:
        """Return what a method belongs to, None if it is not a method of a state."""
        kind, _underscore, stem = method_name(scope).removeprefix("_").partition("_")
        if stem == "common" and kind in ("decide", "act"):
            return Place(source=COMMON, phase="decisions" if kind == "decide" else "actions")
        state = self.stems.get(stem)
        if state is None or kind not in ("in", "enter", "leave"):
            return None
        return Place(source=state, phase="" if kind == "in" else kind)

    def decisions_in(self, place: Place) -> list[LocatedDecision]:
        if place.phase not in ("", "decisions"):
            return []
        return [located for located in iter_decisions(self.design) if located.source == place.source]

    def decision_lists_in(self, place: Place) -> Iterator[tuple[DesignPath, int]]:
        """Yield the path of each list of decisions with its length."""
        top: DesignPath = (
            ("common", "transitions") if place.source == COMMON else ("states", place.source, "transitions")
        )
        lengths: dict[DesignPath, int] = {top: 0}
        for located in self.decisions_in(place):
            lengths[located.path[:-1]] = lengths.get(located.path[:-1], 0) + 1
        yield from lengths.items()

    def actions_in(self, place: Place) -> list[LocatedAction]:
        phases = ("actions", "modulates") if place.phase in ("", "actions") else (place.phase,)
        return [
            located
            for located in iter_actions(self.design)
            if located.state == place.source and located.phase in phases
        ]

    def action_list_in(self, place: Place) -> tuple[DesignPath, int]:
        """Return the path of the list of actions with its length."""
        phase = place.phase if place.phase in ("enter", "leave") else "actions"
        path: DesignPath = ("common", "actions") if place.source == COMMON else ("states", place.source, phase)
        return path, sum(located.path[:-1] == path for located in self.actions_in(place))

    def definition_of(self, scope: str) -> ast.FunctionDef | None:
        """Return the method of the edited file with a scope."""
        nodes = (item.node for item in self.edited.items.get(".".join(scope.split(".")[:2]), ()))
        return next((node for node in nodes if isinstance(node, ast.FunctionDef)), None)

    def source_of(self, items: tuple[CodeItem, ...]) -> str:
        """Return the lines of items of the edited file, without their indentation and without marks of regions."""
        lines = self.lines[items[0].first - 1 : max(item.last for item in items)]
        text = "\n".join(line for line in lines if not _MARK.match(line))
        # Lines inside of strings keep their indentation, as in a region.
        return find_regions(wrap_region("code", text)).regions[0].body


def is_generated_name(name: str) -> bool:
    """Whether a method has a name that the generator gives."""
    return bool(_GENERATED.match(name))


def method_name(scope: str) -> str:
    """Return the name of the method in a scope such as `Player._in_kick`; empty if it is not in a method."""
    parts = scope.split(".")
    return parts[1] if len(parts) > 1 else ""
