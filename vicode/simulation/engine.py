"""One component with its stand-ins or its world, stepped an iteration at a time; every iteration becomes a moment."""

from __future__ import annotations

import importlib
from dataclasses import asdict
from typing import Any, cast

from vicode.bica import Component, ErrorRecord, IterationRecord, Observer, Root, SimulatedClock
from vicode.bica.loading import load_component, make_world, telling
from vicode.bica.observer import to_plain
from vicode.simulation.guards import GuardWatch
from vicode.simulation.limits import Prints
from vicode.simulation.messages import Inputs, Moment, Setup
from vicode.simulation.stand_ins import StandInComponent, as_type, offer_stand_ins

_MOST_ERRORS = 20


class Engine:
    """Makes the component that a setup names.

    Raises:
        UserCodeError: It cannot be loaded or made.
        CyclicUseError: Components need each other.
    """

    def __init__(self, setup: Setup, prints: Prints) -> None:
        self._setup, self._prints = setup, prints
        self._errors: list[dict[str, Any]] = []
        self._record: IterationRecord | None = None
        self._clock = SimulatedClock()
        offer_stand_ins(setup.stand_ins)
        component_class = load_component(setup.component)
        probes = importlib.import_module(setup.probes)
        self._enumerations = probes.ENUMERATIONS
        world = make_world(setup.world or None, setup.seed)
        observer = Observer(self._keep, values=True)
        with telling(f"cannot make {setup.component}"):
            self._root = Root(component_class, clock=self._clock, world=world, on_error=self._report, observer=observer)
        self._stand_ins = [each for each in self._root.components if isinstance(each, StandInComponent)]
        for each in self._stand_ins:
            each.begin(self._enumerations)
        self._watch = GuardWatch(self._root.main, probes, setup.functions)

    @property
    def main(self) -> Component:
        """The root component."""
        return self._root.main

    def set_inputs(self, inputs: Inputs) -> None:
        """Take over what somebody set."""
        for stand_in in self._stand_ins:
            stand_in.set_outputs(inputs.get(stand_in.stand_in.component, {}))
        types = dict(self._setup.parameter_types)
        given = {name: value for name, value in inputs.get("", {}).items() if name in types}
        if given:
            now = {name: getattr(self.main, name) for name in types}
            new = {name: as_type(value, types[name], self._enumerations) for name, value in given.items()}
            cast("Any", self.main).modulate(**{**now, **new})

    def look(self) -> dict[str, dict[str, Any]]:
        """The guards as they are now."""
        return self._watch.look()

    def step(self) -> Moment:
        """Run one iteration and let the clock go on."""
        self._watch.begin()
        for each in self._stand_ins:
            # What was asked while somebody looked is no part of the iteration.
            each.take_asked()
        world = self._root.world
        advance = getattr(world, "advance", None)
        if advance is not None:
            advance(self._clock.now_ns())
        self._root.step()
        moment = self._describe()
        self._clock.advance(self._setup.tick_ns)
        return moment

    def _keep(self, record: IterationRecord) -> None:
        self._record = record

    def _report(self, record: ErrorRecord) -> None:
        if len(self._errors) < _MOST_ERRORS:
            self._errors.append(asdict(record))

    def _describe(self) -> Moment:
        record = self._record
        assert record is not None
        root = record["tree"][0]
        errors, self._errors = self._errors, []
        lines, left_out = self._prints.take()
        snapshot = getattr(self._root.world, "snapshot", None)
        return Moment(
            iteration=record["iteration"],
            time_ns=record["time_ns"],
            state=root["state"],
            came_from=root["changed_from"],
            transition=root["transition"],
            worked=root["worked"],
            done=root["done"],
            finished=bool(getattr(self._root.world, "finished", False)),
            tree=[cast("dict[str, Any]", step) for step in record["tree"]],
            guards=self._watch.look(),
            prints=lines,
            unprinted=left_out,
            errors=errors,
            asked=[call for each in self._stand_ins for call in each.take_asked()],
            world=to_plain(snapshot()) if snapshot is not None else None,
        )
