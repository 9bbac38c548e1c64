"""State machines to measure, and how each way of programming them says the same."""

from __future__ import annotations

import importlib.util
import random
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

from vicode.bica import Component
from vicode.generators import generate
from vicode.model.design import Assign, Declaration, Design, Guard, State, Transition, Use
from vicode.model.project import Interface, Project
from vicode.output import apply_diffs, compare_files

TICK_NS = 20_000_000
TIMER_NS = 300_000_000


@dataclass(frozen=True, slots=True, kw_only=True)
class Edge:
    """A transition: to the state numbered `target` when a sense is high, or after a time when `sense` is empty."""

    target: int
    sense: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Machine:
    """Outgoing edges of each state, tested in order; with `acts` each state sets its own speed."""

    edges: tuple[tuple[Edge, ...], ...]
    acts: bool


class TickClock:
    """A clock that advances by one tick per read, so that all candidates get the same times."""

    def __init__(self) -> None:
        self._now_ns = 0

    def now_ns(self) -> int:
        """Return the time of the next tick."""
        self._now_ns += TICK_NS
        return self._now_ns


def make_machine(states: int, edges: int, *, acts: bool) -> Machine:
    """Every state leads to the next one and to random others; the last edge of every second state is a timer."""
    chance = random.Random(states)

    def make_edge(state: int, number: int) -> Edge:
        other = (state + chance.randrange(1, states)) % states
        is_timer = number == edges - 1 and state % 2 == 0
        return Edge(target=other if number else (state + 1) % states, sense="" if is_timer else "abc"[number])

    return Machine(
        edges=tuple(tuple(make_edge(state, number) for number in range(edges)) for state in range(states)), acts=acts
    )


def load_component(machine: Machine, senses: str = "benchmarks.senses:Senses") -> type[Component]:
    """Generate and import the component of a machine; `senses` is the implementation of the component that it reads."""
    project = make_project(machine, senses)
    with tempfile.TemporaryDirectory() as folder:
        apply_diffs(compare_files(generate(project), Path(folder)), Path(folder))
        for name in [name for name in sys.modules if name.partition(".")[0] == "bench"]:
            del sys.modules[name]
        sys.path.insert(0, str(Path(folder, "python")))
        importlib.invalidate_caches()
        measured: type[Component] = importlib.import_module("bench.measured").Measured
        sys.path.pop(0)
    return measured


def make_project(machine: Machine, senses: str, *, counts: bool = False) -> Project:
    """The project of a machine; with `counts` its output `changes` counts the changes of the state."""
    interface = Interface(
        component="Senses",
        implementation=senses,
        outputs=tuple(Declaration(name=name, type="float") for name in "abc"),
    )
    design = Design(
        component="Measured",
        frequency_hz=50,
        uses=(Use(alias="senses", component="Senses"),),
        variables=(
            Declaration(name="speed", initial="0"),
            *([Declaration(name="changes", initial="0")] if counts else []),
        ),
        initial="S0",
        states=tuple(make_state(machine, number, counts=counts) for number in range(len(machine.edges))),
    )
    return Project(name="bench", components=(interface,), designs=(design,))


def make_state(machine: Machine, number: int, *, counts: bool) -> State:
    """Return a state of the design that says what a machine does."""
    leave = (Assign(values=(("changes", "changes + 1"),)),) if counts else ()
    actions = (Assign(values=(("speed", str(number)),)),) if machine.acts else ()
    transitions = tuple(
        Transition(
            to=f"S{edge.target}",
            guard=Guard(when=f"senses.{edge.sense} > 0.9") if edge.sense else Guard(after=str(TIMER_NS / 1e9)),
        )
        for edge in machine.edges[number]
    )
    return State(name=f"S{number}", actions=actions, leave=leave, transitions=transitions)


def write_if_elif(machine: Machine) -> str:
    """Return the source of a class `Measured` as a person would write it: decide in one if/elif, act in another."""
    lines = [
        "class Measured:",
        "    period_ns = 20_000_000",
        "    def __init__(self, senses, clock):",
        "        self.senses, self.clock, self.speed = senses, clock, 0",
        "        self.iteration, self.stepped_in, self.state = 0, -1, 'S0'",
        "        self.started_ns = self.entered_ns = self.worked_ns = 0",
        "    def step(self):",
        "        now_ns = self.clock.now_ns()",
        "        self.iteration += 1",
        "        if self.iteration - self.stepped_in > 1:",
        "            self.state = 'S0'",
        "            self.started_ns = self.entered_ns = now_ns",
        "            self.worked_ns = now_ns - self.period_ns",
        "        self.stepped_in = self.iteration",
        "        if now_ns - self.worked_ns < self.period_ns:",
        "            return",
        "        self.worked_ns = now_ns",
        "        state = self.state",
    ]
    for state, edges in enumerate(machine.edges):
        lines.append(f"        {'elif' if state else 'if'} state == 'S{state}':")
        for number, edge in enumerate(edges):
            lines += [
                f"            {'elif' if number else 'if'} {format_guard(edge, 'now_ns - self.entered_ns')}:",
                f"                self.state, self.entered_ns = 'S{edge.target}', now_ns",
            ]
    if machine.acts:
        lines.append("        state = self.state")
        for state in range(len(machine.edges)):
            keyword = "elif" if state else "if"
            lines += [f"        {keyword} state == 'S{state}':", f"            self.speed = {state}"]
    return "\n".join(lines)


def format_guard(edge: Edge, time_in_state: str, senses: str = "self.senses") -> str:
    """Return the guard of an edge in Python."""
    return f"{senses}.{edge.sense} > 0.9" if edge.sense else f"{time_in_state} >= {TIMER_NS}"


def load_source(source: str) -> ModuleType:
    """Import a text as a module, as if it had been generated into a file."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "measured.py"
        path.write_text(source, encoding="utf-8")
        spec = importlib.util.spec_from_file_location("measured", path)
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
    return module
