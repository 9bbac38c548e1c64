"""The measured machines in the libraries that users would take, each in the way its documentation shows.

They read the clock and keep the timers as the others do, but are spared the check of a restart and of the period.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from typing import Any, Protocol

from benchmarks.sample_machines import TICK_NS, TIMER_NS, Edge, Machine, TickClock, format_guard, load_source
from benchmarks.senses import Senses


class Model:
    """What guards of a library read, and the time of its state."""

    def __init__(self, senses: Senses) -> None:
        self.senses = senses
        self.clock = TickClock()
        self.now_ns = self.entered_ns = self.speed = 0
        self.state = "S0"


Step = Callable[[], None]
Candidate = tuple[Step, Callable[[], str]]


def find_libraries() -> dict[str, Callable[[Machine, Senses], Candidate]]:
    """Return the makers of those that are installed, by name."""
    makers = {
        "automat": ("automat", make_automat),
        "transitions": ("transitions", make_transitions),
        "python-statemachine": ("statemachine", make_statemachine),
        "sismic": ("sismic", make_sismic),
    }
    return {name: make for name, (module, make) in makers.items() if find_spec(module)}


def make_transitions(machine: Machine, senses: Senses) -> Candidate:
    model = Model(senses)
    names = [f"S{state}" for state in range(len(machine.edges))]
    library = import_module("transitions").Machine(model=model, states=names, initial="S0", auto_transitions=False)
    for state, edges in enumerate(machine.edges):
        for edge in edges:
            library.add_transition("tick", names[state], names[edge.target], conditions=_make_guard(edge, model))
    return _wrap(model, model.tick, lambda: model.state, acts=machine.acts)  # type: ignore[attr-defined]


def make_statemachine(machine: Machine, senses: Senses) -> Candidate:
    package, model = import_module("statemachine"), Model(senses)
    states = [package.State(initial=state == 0) for state in range(len(machine.edges))]
    links = [
        states[state].to(states[edge.target], cond=_make_guard(edge, model))
        for state, edges in enumerate(machine.edges)
        for edge in edges
    ]
    tick = links[0]
    for link in links[1:]:
        tick = tick | link
    body: dict[str, Any] = {f"S{state}": value for state, value in enumerate(states)}
    library = type("Library", (package.StateMachine,), {**body, "tick": tick, "allow_event_without_transition": True})()
    return _wrap(model, library.tick, lambda: _only(library.configuration).id, acts=machine.acts)


def make_sismic(machine: Machine, senses: Senses) -> Candidate:
    package, model = import_module("sismic.model"), Model(senses)
    chart = package.Statechart("measured")
    chart.add_state(package.CompoundState("root", initial="S0"), None)
    for state in range(len(machine.edges)):
        chart.add_state(package.BasicState(f"S{state}"), "root")
    for state, edges in enumerate(machine.edges):
        for number, edge in enumerate(edges):
            guard = format_guard(edge, "model.now_ns - model.entered_ns", "model.senses")
            link = package.Transition(f"S{state}", f"S{edge.target}", event="tick", guard=guard, priority=-number)
            chart.add_transition(link)
    interpreter = import_module("sismic.interpreter").Interpreter(chart, initial_context={"model": model})
    interpreter.execute_once()

    def tick() -> None:
        interpreter.queue("tick")
        interpreter.execute_once()

    return _wrap(model, tick, lambda: interpreter.configuration[-1], acts=machine.acts)


class Inputs(Protocol):
    """Automat has no guards: the program tests them and gives the machine the input that fits."""

    def go_0(self) -> None:
        """Take the first edge."""

    def go_1(self) -> None:
        """Take the second edge."""

    def go_2(self) -> None:
        """Take the third edge."""


def make_automat(machine: Machine, senses: Senses) -> Candidate:
    model = Model(senses)
    builder = import_module("automat").TypeMachineBuilder(Inputs, Model)
    states = [builder.state(f"S{state}") for state in range(len(machine.edges))]
    for state, edges in enumerate(machine.edges):
        for number, edge in enumerate(edges):
            go = getattr(Inputs, f"go_{number}")
            states[state].upon(go).to(states[edge.target])(_make_arrival(f"S{edge.target}"))
    library = builder.build()(model)
    checks = {f"S{state}": _make_check(edges) for state, edges in enumerate(machine.edges)}
    return _wrap(model, lambda: checks[model.state](library, model), lambda: model.state, acts=machine.acts)


def _make_check(edges: tuple[Edge, ...]) -> Callable[[Inputs, Model], None]:
    lines = ["def check(inputs, model) -> None:"]
    for number, edge in enumerate(edges):
        guard = format_guard(edge, "model.now_ns - model.entered_ns", "model.senses")
        lines += [f"    {'elif' if number else 'if'} {guard}:", f"        inputs.go_{number}()"]
    check: Callable[[Inputs, Model], None] = load_source("\n".join(lines)).check
    return check


def _make_arrival(name: str) -> Callable[[Inputs, Model], None]:
    def arrive(_inputs: Inputs, model: Model) -> None:
        model.state = name

    return arrive


def _make_guard(edge: Edge, model: Model) -> Callable[[], bool]:
    senses = model.senses
    guards: dict[str, Callable[[], bool]] = {
        "a": lambda: senses.a > 0.9,
        "b": lambda: senses.b > 0.9,
        "c": lambda: senses.c > 0.9,
        "": lambda: model.now_ns - model.entered_ns >= TIMER_NS,
    }
    return guards[edge.sense]


def _wrap(model: Model, tick: Callable[[], Any], find_state: Callable[[], str], *, acts: bool) -> Candidate:
    speeds = {f"S{state}": state for state in range(1000)}
    last = "S0"

    def step() -> None:
        nonlocal last
        model.now_ns = model.clock.now_ns()
        tick()
        state = find_state()
        if state != last:
            last = state
            model.entered_ns = model.now_ns
        if acts:
            model.speed = speeds[state]

    # The generated component and the hand-written one enter their first state at the first tick.
    model.entered_ns = TICK_NS
    return step, lambda: last


def _only(configuration: Any) -> Any:
    [state] = configuration
    return state
