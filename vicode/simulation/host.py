"""Steps one component with its stubs or its world; each iteration yields a result."""

from __future__ import annotations

import importlib
from typing import Any, cast

from vicode.bica import Component, IterationRecord, Observer, Root, SimulatedClock
from vicode.bica.loader import load_component, make_world, wrap_user_errors
from vicode.bica.observer import to_json_value
from vicode.simulation.guards import GuardEvaluator
from vicode.simulation.limits import CapturedOutput
from vicode.simulation.messages import Inputs, IterationResult, Setup, Start
from vicode.simulation.restore import restore_root
from vicode.simulation.stubs import StubInputs, install_stub_module


class RunHost:
    """Creates the component that a setup names.

    Raises:
        UserCodeError: It cannot be loaded or created.
        CyclicUseError: Components use each other in a cycle.
    """

    def __init__(self, setup: Setup, prints: CapturedOutput) -> None:
        self._setup, self._prints = setup, prints
        self._record: IterationRecord | None = None
        self._clock = SimulatedClock()
        install_stub_module(setup.stubs)
        component_class = load_component(setup.component)
        probes = importlib.import_module(setup.probes)
        world = make_world(setup.world or None, setup.seed)
        observer = Observer(self._on_record, values=True)
        with wrap_user_errors(f"cannot create {setup.component}"):
            self._root = Root(
                # The observer records errors, so they are not printed.
                component_class,
                clock=self._clock,
                world=world,
                on_error=lambda _error: None,
                observer=observer,
            )
        self._inputs = StubInputs(self._root, dict(setup.parameter_types), probes.ENUMERATIONS)
        self._watch = GuardEvaluator(self._root.main, probes, setup.functions)

    @property
    def main(self) -> Component:
        return self._root.main

    def set_inputs(self, inputs: Inputs) -> None:
        """Set the outputs of stubs and the parameters of the root component."""
        self._inputs.set(inputs)

    def continue_from(self, start: Start, inputs: Inputs) -> None:
        """Enter a recorded run with its inputs: the next step is the iteration after `start`."""
        self._clock.advance(max(0, start.time_ns - self._clock.now_ns()))
        restore_root(self._root, start)
        self.set_inputs(inputs)
        for stub in self._inputs.stubs:
            stub.work()

    def evaluate_guards(self) -> dict[str, dict[str, Any]]:
        """The current truth values of the guards."""
        return self._watch.evaluate()

    def step(self, time_ns: int | None = None) -> IterationResult:
        """Run one iteration and advance the clock; a recorded iteration has its own time, and no guards."""
        if time_ns is not None:
            self._clock.advance(max(0, time_ns - self._clock.now_ns()))
        self._watch.begin_iteration()
        # Calls made while guards were inspected do not belong to the iteration.
        self._inputs.begin_iteration()
        world = self._root.world
        advance = getattr(world, "advance", None)
        if advance is not None:
            advance(self._clock.now_ns())
        self._root.step()
        iteration = self._make_result(has_guards=time_ns is None)
        if time_ns is None:
            self._clock.advance(self._setup.tick_ns)
        return iteration

    def _on_record(self, record: IterationRecord) -> None:
        self._record = record

    def _make_result(self, *, has_guards: bool) -> IterationResult:
        record = self._record
        assert record is not None
        lines, left_out = self._prints.drain()
        snapshot = getattr(self._root.world, "snapshot", None)
        return IterationResult(
            iteration=record["iteration"],
            time_ns=record["time_ns"],
            tree=[cast("dict[str, Any]", step) for step in record["tree"]],
            errors=record["errors"],
            still_done=record["still_done"],
            inputs=record.get("inputs", {}),
            world=to_json_value(snapshot()) if snapshot is not None else None,
            finished=bool(getattr(self._root.world, "finished", False)),
            guards=self._watch.evaluate() if has_guards else {},
            prints=lines,
            omitted_lines=left_out,
            calls=[call for stub in self._inputs.stubs for call in stub.drain_calls()],
        )
