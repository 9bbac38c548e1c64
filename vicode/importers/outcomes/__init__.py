"""Converts machines whose states end with outcomes, as in FlexBE and YASMIN, to designs.

A state calls the component that does its work and reads its outcome. A machine in a machine is a design of its own: its
outcomes are final states, which set its output `outcome`. A component starts again after an iteration without a call.
So a transition between two states with the same component passes through a state that does not call it.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from vicode.importers.design_names import DesignNames
from vicode.importers.notes import ImportNote
from vicode.model.design import Assign, Call, Declaration, Design, Guard, Point, State, Transition, Use
from vicode.model.names import name_from_text, snake_case
from vicode.model.project import Enumeration, Interface, Project

__all__ = ["OutcomeMachine", "OutcomeState", "OutcomeTransition", "Place", "convert_machines"]

_RUNNING = "running"
_OUTCOME = "outcome"
Place = tuple[Path, int]
"""A file and a line."""


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


def convert_machines(machines: Mapping[str, OutcomeMachine], name: str) -> tuple[Project, tuple[ImportNote, ...]]:
    """Convert machines, which refer to each other by their keys, to a project, and list what is left out."""
    converter = _Converter(machines)
    designs = tuple(converter.design(key) for key in machines)
    project = Project(
        name=name,
        languages=("python", "cpp"),
        enumerations=tuple(converter.enumerations.values()),
        components=tuple(converter.components),
        designs=designs,
    )
    return project, tuple(converter.notes)


class _Converter:
    def __init__(self, machines: Mapping[str, OutcomeMachine]) -> None:
        self._machines = machines
        self._names = DesignNames()
        self._designs = {key: self._class_name(each.name) for key, each in machines.items()}
        self.enumerations: dict[tuple[str, ...], Enumeration] = {}
        self.components: list[Interface] = []
        self.notes: list[ImportNote] = []

    def _class_name(self, text: str) -> str:
        return self._names.allocate(name_from_text(text) or text)

    def design(self, key: str) -> Design:
        machine = self._machines[key]
        return _DesignWriter(self, machine, self._designs[key], key).write()

    def note(self, place: Place, text: str) -> None:
        self.notes.append(ImportNote(file=place[0], line=place[1], text=text))

    def literal(self, outcomes: tuple[str, ...], outcome: str) -> str:
        """The element of an enumeration that stands for an outcome."""
        type_ = self.enumeration(outcomes)
        return f"{type_.name}.{type_.element_names[1 + outcomes.index(outcome)]}"

    def enumeration(self, outcomes: tuple[str, ...]) -> Enumeration:
        if outcomes not in self.enumerations:
            names = DesignNames(frozenset({_RUNNING}))
            elements = ((_RUNNING, ""), *((names.allocate(each), "") for each in outcomes))
            name = self._class_name("Or".join(name_from_text(each) or each for each in outcomes) or "Outcome")
            self.enumerations[outcomes] = Enumeration(name=name, elements=elements)
        return self.enumerations[outcomes]

    def work(self, state: OutcomeState, key: str) -> tuple[str, tuple[str, ...], bool]:
        """The component of a state, its outcomes, and whether it is a design."""
        is_known = state.machine in self._machines
        if is_known and self._reaches(state.machine, key):
            self.note(state.place, f"'{state.name}' runs a machine that contains it: it is one component to be written")
        elif is_known:
            return self._designs[state.machine], self._machines[state.machine].outcomes, True
        outcomes = tuple(dict.fromkeys(each.outcome for each in state.transitions))
        component = self._class_name(state.name)
        outputs = (Declaration(name=_OUTCOME, type=self.enumeration(outcomes).name),)
        self.components.append(Interface(component=component, doc=state.doc, outputs=outputs))
        return component, outcomes, False

    def _reaches(self, start: str, goal: str) -> bool:
        found, waiting = set[str](), [start]
        while waiting:
            key = waiting.pop()
            if key not in found:
                found.add(key)
                waiting += (each.machine for each in self._machines[key].states if each.machine in self._machines)
        return goal in found


class _DesignWriter:
    def __init__(self, converter: _Converter, machine: OutcomeMachine, component: str, key: str) -> None:
        self._converter, self._machine, self._component, self._key = converter, machine, component, key
        states = tuple({each.name: each for each in reversed(machine.states)}.values())[::-1]
        for each in machine.states:
            if each not in states:
                converter.note(each.place, f"another state is named '{each.name}': it is left out")
        self._states = states
        self._work = {each.name: converter.work(each, key) for each in states}
        self._names = DesignNames()
        self._state_names = {each.name: self._names.allocate(each.name) for each in states}
        self._end_names: dict[str, str] = {}
        self._again: dict[str, State] = {}
        aliases = DesignNames(frozenset({_OUTCOME, *(each.name for each in converter.enumerations.values())}))
        used = dict.fromkeys(component for component, _outcomes, _is_design in self._work.values())
        self._uses = {each: Use(alias=aliases.allocate(snake_case(each)), component=each) for each in used}

    def write(self) -> Design:
        machine = self._machine
        states = [self._state(each) for each in self._states]
        ends = [self._end(outcome, name) for outcome, name in self._end_names.items()]
        if machine.start not in self._state_names:
            self._converter.note(machine.place, f"'{machine.start}', where it starts, is no state of '{machine.name}'")
        return Design(
            component=self._component,
            doc=machine.doc,
            uses=tuple(self._uses.values()),
            outputs=(Declaration(name=_OUTCOME, type=self._converter.enumeration(machine.outcomes).name),),
            initial=self._state_names.get(machine.start) or next(iter(self._state_names.values()), ""),
            states=(*states, *self._again.values(), *ends),
        )

    def _state(self, state: OutcomeState) -> State:
        component, outcomes, is_design = self._work[state.name]
        alias = self._uses[component].alias
        transitions = []
        for each in state.transitions:
            target = self._target(state, each)
            if each.outcome not in outcomes:
                self._converter.note(each.place, f"'{each.outcome}' is no outcome of '{state.name}': it is left out")
            elif target:
                test = f"{alias}.{_OUTCOME} == {self._converter.literal(outcomes, each.outcome)}"
                guard = Guard(when=f"done({alias}) and {test}" if is_design else test)
                transitions.append(Transition(to=target, guard=guard, doc=each.doc))
        known = {each.outcome for each in state.transitions}
        for outcome in outcomes if is_design else ():
            if outcome not in known:
                self._converter.note(state.place, f"no transition of '{state.name}' has the outcome '{outcome}'")
        if not transitions:
            self._converter.note(state.place, f"no transition leaves '{state.name}'")
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
        if to not in self._state_names:
            self._converter.note(transition.place, f"'{to}' is neither a state nor an outcome: it is left out")
            return ""
        if self._work[to][0] != self._work[state.name][0]:
            return self._state_names[to]
        if to not in self._again:
            doc = f"One iteration in which {self._work[to][0]} is not called, so that it starts again."
            name = self._names.allocate(f"{to}_again")
            self._again[to] = State(name=name, doc=doc, transitions=(Transition(to=self._state_names[to]),))
        return self._again[to].name

    def _end(self, outcome: str, name: str) -> State:
        literal = self._converter.literal(self._machine.outcomes, outcome)
        enter = (Assign(values=((_OUTCOME, literal),)),)
        return State(name=name, at=self._machine.ends.get(outcome), final=True, enter=enter)
