"""A state machine that was read from C++, and its places in the file."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeVar

from vicode.findings import DesignPath, SourceLocation
from vicode.importers.cpp.conditions import ALIAS, CppConditions
from vicode.importers.cpp.tree import CppSource, CppTree
from vicode.importers.design_names import DesignNames
from vicode.model.design import Decision, Design, State, Use
from vicode.model.traversal import iter_decisions

_Placed = TypeVar("_Placed", bound=Decision | State)


@dataclass(slots=True, kw_only=True)
class CppMachine:
    """A state machine of a file.

    Attributes:
        node: Its name.
        components: The names of all machines of the behavior in C++, and as components.
        graph: Which components use which, of all machines that were read so far.
        ends: States that end it without success.
        is_partial: Whether transitions may be missing.
        notes: What is not understood, by offset.
    """

    source: CppSource
    component: str
    node: CppTree
    components: Mapping[str, str]
    conditions: CppConditions
    graph: dict[str, set[str]]
    ends: set[str] = field(default_factory=set)
    is_partial: bool = False
    notes: list[tuple[int, str]] = field(default_factory=list)
    design: Design = field(default_factory=lambda: Design(component=""))
    _uses: dict[str, Use] = field(default_factory=dict)
    _placed: list[tuple[Decision | State, int]] = field(default_factory=list)

    def use(self, name: str, node: CppTree) -> str:
        """The alias of another machine; "" if its use would close a cycle, which designs do not have."""
        component = self.components[name]
        if self._is_used_by(component):
            self.notes.append((node.start, f"the use of {name} closes a cycle: it is left out"))
            return ""
        self.graph.setdefault(self.component, set()).add(component)
        alias = DesignNames(frozenset({ALIAS})).allocate(component)
        return self._uses.setdefault(component, Use(alias=alias, component=component)).alias

    def note_unread(self, start: int, end: int) -> None:
        """Note the branches of the preprocessor in a part of the file that are not read."""
        unread = [each for each in self.source.unread if start < each < end]
        self.is_partial = bool(unread)
        self.notes += ((each, "this branch is not read") for each in unread)

    def _is_used_by(self, component: str) -> bool:
        return component == self.component or any(map(self._is_used_by, self.graph.get(component, ())))

    def uses(self) -> tuple[Use, ...]:
        inputs = (Use(alias=ALIAS, component=self.conditions.component),) if self.conditions.interface() else ()
        return (*inputs, *self._uses.values())

    def place(self, placed: _Placed, node: CppTree) -> _Placed:
        self._placed.append((placed, node.start))
        return placed

    def locations(self) -> dict[DesignPath, SourceLocation]:
        """The places of states, decisions, and of the machine itself as ("component",)."""
        starts = {id(placed): start for placed, start in self._placed}
        paths: dict[DesignPath, object] = {("states", state.name): state for state in self.design.states}
        paths |= {each.path: each.decision for each in iter_decisions(self.design)}
        found = {path: starts[id(each)] for path, each in paths.items() if id(each) in starts}
        return {path: self.source.location(start) for path, start in {("component",): self.node.start, **found}.items()}
