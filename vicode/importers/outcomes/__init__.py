"""Converts machines whose states end with outcomes, as in FlexBE and YASMIN, to designs.

A state calls the component that does its work and reads its outcome. A machine in a machine is a design of its own: its
outcomes are final states, which set its output `outcome`. A component starts again after an iteration without a call.
So a transition between two states with the same component passes through a state that does not call it.
"""

from collections.abc import Collection, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

from vicode.importers.design_names import DesignNames
from vicode.importers.sources import Sources
from vicode.languages import LANGUAGES
from vicode.model.design import Assign, Call, Declaration, Design, Guard, Point, State, Transition, Use
from vicode.model.names import name_from_text, snake_case
from vicode.model.project import Enumeration, Interface, Project

Place = tuple[Path, int]
"""A file and a line."""

_KEYWORDS = LANGUAGES["cpp"].keywords
_RUNNING, _OUTCOME = "running", "outcome"


@dataclass(frozen=True, slots=True, kw_only=True)
class OutcomeTransition:
    """Where an outcome leads: to a state, or to an outcome of the machine."""

    outcome: str
    to: str
    place: Place
    doc: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class OutcomeState:
    """A state; `machine` is the key of the machine that does its work, "" if a component is to be written."""

    name: str
    place: Place
    transitions: tuple[OutcomeTransition, ...]
    machine: str = ""
    doc: str = ""
    at: Point | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class OutcomeMachine:
    """A machine; `start` is the name of its first state, `ends` are the positions of outcomes."""

    name: str
    place: Place
    outcomes: tuple[str, ...]
    start: str
    states: tuple[OutcomeState, ...]
    doc: str = ""
    ends: Mapping[str, Point] = field(default_factory=dict)


def convert_machines(machines: Mapping[str, OutcomeMachine], name: str, sources: Sources) -> Project:
    """Convert machines, which refer to each other by their keys, to a project, and note what is left out."""
    converter = _Converter(machines, sources)
    designs = tuple(_DesignWriter(converter, key).write() for key in machines)
    return Project(
        name=name,
        languages=("python", "cpp"),
        enumerations=tuple(converter.enumerations.values()),
        components=tuple(converter.components),
        designs=designs,
    )


class _Converter:
    def __init__(self, machines: Mapping[str, OutcomeMachine], sources: Sources) -> None:
        self.machines, self.sources = machines, sources
        self._names = DesignNames(keywords=_KEYWORDS)
        self.designs = {key: self._class_name(each.name) for key, each in machines.items()}
        self.enumerations: dict[tuple[str, ...], Enumeration] = {}
        self.components: list[Interface] = []
        self._inner = {key: {each.machine for each in one.states} & machines.keys() for key, one in machines.items()}
        self._without_cycle = _find_without_cycle(self._inner)

    def _class_name(self, text: str) -> str:
        return self._names.allocate(name_from_text(text) or text)

    def literal(self, outcomes: tuple[str, ...], outcome: str) -> str:
        """The element of an enumeration that stands for an outcome."""
        type_ = self.enumeration(outcomes)
        return f"{type_.name}.{type_.element_names[1 + outcomes.index(outcome)]}"

    def enumeration(self, outcomes: tuple[str, ...]) -> Enumeration:
        if outcomes not in self.enumerations:
            names = DesignNames(frozenset({_RUNNING}), _KEYWORDS)
            elements = ((_RUNNING, ""), *((names.allocate(each), "") for each in outcomes))
            name = self._class_name("Or".join(name_from_text(each) or each for each in outcomes) or "Outcome")
            self.enumerations[outcomes] = Enumeration(name=name, elements=elements)
        return self.enumerations[outcomes]

    def work(self, state: OutcomeState, key: str) -> tuple[str, tuple[str, ...], bool]:
        """The component of a state, its outcomes, and whether it is a design."""
        if state.machine in self.machines and not self._reaches(state.machine, key):
            machine = self.machines[state.machine]
            ends = {each.to for inner in machine.states for each in inner.transitions} & set(machine.outcomes)
            return self.designs[state.machine], machine.outcomes if ends else (), True
        if state.machine:
            text = f"the machine of '{state.name}' contains it, or cannot be read: it is one component to be written"
            self.sources.note(*state.place, text)
        outcomes = tuple(dict.fromkeys(each.outcome for each in state.transitions))
        component = self._class_name(state.name)
        outputs = (Declaration(name=_OUTCOME, type=self.enumeration(outcomes).name),) if outcomes else ()
        self.components.append(Interface(component=component, doc=state.doc, outputs=outputs))
        return component, outcomes, False

    def _reaches(self, start: str, goal: str) -> bool:
        passed, pending = set[str](), {start} - self._without_cycle
        while pending and goal not in pending:
            passed |= pending
            pending = set().union(*(self._inner[each] for each in pending)) - passed - self._without_cycle
        return bool(pending)


def _find_without_cycle(inner: Mapping[str, Collection[str]]) -> set[str]:
    """The machines that contain no machine that contains itself."""
    sorter, found = TopologicalSorter(inner), set[str]()
    # After this error, it still sorts what comes before the cycles.
    with suppress(CycleError):
        sorter.prepare()
    while ready := sorter.get_ready():
        found.update(ready)
        sorter.done(*ready)
    return found


class _DesignWriter:
    def __init__(self, converter: _Converter, key: str) -> None:
        self._converter, self._machine, self._component = converter, converter.machines[key], converter.designs[key]
        self._states: dict[str, OutcomeState] = {}
        for each in self._machine.states:
            if self._states.setdefault(each.name, each) is not each:
                self._note(each.place, f"another state is named '{each.name}': it is left out")
        self._start = self._machine.start if self._machine.start in self._states else next(iter(self._states))
        self._work = {name: converter.work(each, key) for name, each in self._states.items()}
        self._names = DesignNames(keywords=_KEYWORDS)
        self._state_names = {name: self._names.allocate(name) for name in self._states}
        self._end_names: dict[str, str] = {}
        self._again: dict[str, State] = {}
        taken = frozenset({_OUTCOME, *(each.name for each in converter.enumerations.values())})
        aliases = DesignNames(taken, _KEYWORDS)
        used = dict.fromkeys(component for component, _outcomes, _is_design in self._work.values())
        self._uses = {each: Use(alias=aliases.allocate(snake_case(each)), component=each) for each in used}

    def _note(self, place: Place, text: str) -> None:
        self._converter.sources.note(*place, text)

    def write(self) -> Design:
        machine = self._machine
        states = [self._state(each) for each in self._states.values()]
        ends = [self._end(outcome, name) for outcome, name in self._end_names.items()]
        if machine.start != self._start:
            self._note(machine.place, f"'{machine.start}', where it starts, is no state: it starts with the first one")
        type_ = self._converter.enumeration(machine.outcomes).name if ends else ""
        return Design(
            component=self._component,
            doc=machine.doc,
            uses=tuple(self._uses.values()),
            outputs=(Declaration(name=_OUTCOME, type=type_),) if ends else (),
            initial=self._state_names[self._start],
            states=(*states, *self._again.values(), *ends),
        )

    def _state(self, state: OutcomeState) -> State:
        component, outcomes, is_design = self._work[state.name]
        alias, transitions = self._uses[component].alias, list[Transition]()
        for each in state.transitions:
            if each.outcome not in outcomes:
                text = f"'{state.name}' never ends with '{each.outcome}': the transition is left out"
                self._note(each.place, text)
            elif target := self._target(state, each):
                test = f"{alias}.{_OUTCOME} == {self._converter.literal(outcomes, each.outcome)}"
                # After a restart, the first state decides before it calls: the outcome is an old one.
                first = (
                    f"done({alias}) and " if is_design else "state_time > 0 and " if state.name == self._start else ""
                )
                guard = Guard(when=first + test)
                transitions.append(Transition(to=target, guard=guard, doc=each.doc))
        for outcome in set(outcomes) - {each.outcome for each in state.transitions}:
            self._note(state.place, f"no transition of '{state.name}' has the outcome '{outcome}'")
        return State(
            name=self._state_names[state.name],
            doc="" if state.name == self._state_names[state.name] else state.name,
            at=state.at,
            actions=(Call(alias=alias),),
            transitions=tuple(transitions),
        )

    def _target(self, state: OutcomeState, transition: OutcomeTransition) -> str:
        """The state of the design to which a transition leads, "" if there is none."""
        to = transition.to
        if to in self._machine.outcomes:
            if to not in self._end_names:
                self._end_names[to] = self._names.allocate(to)
            return self._end_names[to]
        if to not in self._states:
            self._note(transition.place, f"'{to}' is neither a state nor an outcome: the transition is left out")
            return ""
        if self._work[to][0] != self._work[state.name][0]:
            return self._state_names[to]
        if to not in self._again:
            doc = f"One iteration without {self._work[to][0]}, so that it starts again."
            name = self._names.allocate(f"{to}_again")
            self._again[to] = State(name=name, doc=doc, transitions=(Transition(to=self._state_names[to]),))
        return self._again[to].name

    def _end(self, outcome: str, name: str) -> State:
        enter = Assign(values=((_OUTCOME, self._converter.literal(self._machine.outcomes, outcome)),))
        return State(name=name, at=self._machine.ends.get(outcome), final=True, enter=(enter,))
