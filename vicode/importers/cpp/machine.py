"""A state machine that was read from C++, and its places in the file."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from vicode.findings import DesignPath, SourceLocation
from vicode.importers.cpp.conditions import ALIAS, Inputs
from vicode.importers.cpp.tree import CppNode, CppSource
from vicode.importers.design_names import DesignNames
from vicode.model.design import Decision, Design, State, Use
from vicode.model.traversal import iter_decisions


@dataclass(slots=True, kw_only=True)
class CppMachine:
    """A state machine of a file.

    Attributes:
        components: The names of all machines of the behavior in C++, and as components.
        start: The offset of its name.
        graph: Which components use which, of all machines that were read so far.
        ends: States that end it without success.
        notes: What is not understood, by offset.
        is_partial: Whether transitions may be missing.
        is_open: Whether it may use any other machine.
    """

    source: CppSource
    component: str
    start: int
    components: Mapping[str, str]
    inputs: Inputs
    graph: dict[str, set[str]]
    ends: set[str] = field(default_factory=set)
    notes: list[tuple[int, str]] = field(default_factory=list)
    is_partial: bool = False
    is_open: bool = False
    design: Design = field(default_factory=lambda: Design(component=""))
    _uses: dict[str, str] = field(default_factory=dict)
    _aliases: DesignNames = field(default_factory=lambda: DesignNames(taken=frozenset({ALIAS})))
    _decisions: list[tuple[Decision, int]] = field(default_factory=list)
    _states: dict[str, int] = field(default_factory=dict)

    def use(self, name: str, node: CppNode) -> str:
        """The alias of another machine; "" if this one is not to use it, since machines cannot use each other in a cycle."""
        component = self.components[name]
        if component not in self._uses:
            if self.component in self._find_used(component):
                self.note(node, f"the use of {name} closes a cycle: it is left out")
                return ""
            self.graph.setdefault(self.component, set()).add(component)
            self._uses[component] = self._aliases.allocate(component)
        return self._uses[component]

    def _find_used(self, component: str) -> set[str]:
        found, pending = {component}, [component]
        while pending:
            new = self.graph.get(pending.pop(), set()) - found
            found |= new
            pending += new
        return found

    def uses(self) -> tuple[Use, ...]:
        inputs = (Use(alias=ALIAS, component=self.inputs.component),) if self.inputs.declarations else ()
        return (*inputs, *(Use(alias=alias, component=component) for component, alias in self._uses.items()))

    def place(self, decision: Decision, node: CppNode) -> Decision:
        self._decisions.append((decision, node.start))
        return decision

    def place_state(self, state: State, node: CppNode) -> State:
        self._states.setdefault(state.name, node.start)
        return state

    def note(self, node: CppNode, text: str) -> None:
        self.notes.append((node.start, text))

    def locations(self) -> dict[DesignPath, SourceLocation]:
        """The places of the machine, its states and decisions; the path of the machine is ("component",)."""
        starts: dict[DesignPath, int] = {("component",): self.start}
        starts |= {("states", name): start for name, start in self._states.items()}
        by_id = {id(decision): start for decision, start in self._decisions}
        starts |= {
            each.path: by_id[id(each.decision)] for each in iter_decisions(self.design) if id(each.decision) in by_id
        }
        return {path: self.source.location(start) for path, start in starts.items()}
