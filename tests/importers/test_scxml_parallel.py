"""Regions of <parallel> are designs that are called; with idle iterations between events, they pass the same states."""

import random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.importers.scxml_oracle import NotStableError, Oracle, RandomDocument
from vicode.importers.scxml import Exactness, ScxmlError, ScxmlImport, import_scxml
from vicode.semantics.interpreter import Interpreter

# Each microstep takes at most two iterations.
IDLE = 16


class _Run:
    """The imported designs; each event lasts one iteration."""

    def __init__(self, imported: ScxmlImport) -> None:
        self.imported = imported
        self.interpreter = Interpreter(imported.project, "Machine")
        self.now = 0
        self.records: list[dict] = []

    def step(self, event: str = "") -> None:
        events = self.imported.events
        given = events.inputs.of_event(event) if event else None
        for name in events.inputs.names.values():
            self.interpreter.set_input(events.name, name, name == given)
        self.records = self.interpreter.step(self.now)["tree"]
        self.now += 100_000_000

    def configuration(self) -> set[str]:
        """The active states without children or regions."""
        designs = {design.component: design for design in self.imported.project.designs}
        states = [
            next(state for state in designs[each["component"]].states if state.name == each["state"])
            for each in self.records
            if each["component"] in designs
        ]
        return {each.name for each in states if not each.modulates}

    def data(self, names: set[str]) -> dict[str, float]:
        found = {
            name: value
            for component in self.interpreter.memory.components.values()
            for name, value in component.values.items()
            if name in names
        }
        return found


def compare(text: str, imported: ScxmlImport, events: list[str], idle: int) -> None:
    """Compare a document with its designs after each event.

    Raises:
        NotStableError: The document takes transitions for ever.
    """
    oracle, run = Oracle(text), _Run(imported)
    for event in ["", *events]:
        if event:
            oracle.send(event)
        run.step(event)
        for _iteration in range(idle if event else IDLE):
            run.step()
        assert run.configuration() == oracle.configuration(), (text, events, event)
        data = {name: float(value) for name, value in oracle.data.items()}
        assert run.data(set(data)) == data, (text, events, event)
        if not oracle.is_running:
            return
