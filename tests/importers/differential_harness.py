"""Runs an imported behavior as generated Python and in the XABSL engine with the same inputs."""

import importlib
import random
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from vicode.bica import Root, SimulatedClock
from vicode.check import check_project
from vicode.findings import Severity
from vicode.generators import generate, python_class_path
from vicode.importers import ImportResult, import_behavior
from vicode.model.project import Project
from vicode.xabsl.compiler import CompileResult, compile_source, declared_symbols
from vicode.xabsl.engine import Engine
from vicode.xabsl.engine.linker import python_name
from vicode.xabsl.engine.program import Program
from vicode.xabsl.engine.replay import TableWorld
from vicode.xabsl.engine.symbols import SymbolList
from vicode.xabsl.source_loader import ProgramSource

Record = dict[str, Any]


def import_checked(source: ProgramSource, name: str = "behavior") -> tuple[ImportResult, CompileResult]:
    """Import a behavior and assert that the project has no errors."""
    compiled = compile_source(source)
    assert compiled.program is not None, compiled.findings
    imported = import_behavior(source, compiled, name)
    errors = [finding for finding in check_project(imported.project) if finding.severity is Severity.ERROR]
    assert errors == []
    return imported, compiled


@dataclass
class RecordingWorld:
    """A world that records the calls of its basic behaviors."""

    symbols: SymbolList
    program: Program
    world: TableWorld = field(init=False)
    calls: list[tuple[str, Record]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.world = TableWorld(self.symbols, self.program)
        for behavior in self.symbols.behaviors:
            setattr(self.world, python_name(behavior.name), self._listener(behavior.name))

    def _listener(self, name: str) -> Any:
        return lambda **given: self.calls.append((name, given))

    def outputs(self) -> Record:
        """Return the values of the output symbols."""
        named = [symbol.name for symbol in self.symbols.symbols if symbol.role == "output"]
        return {name: getattr(self.world, python_name(name)) for name in named}

    def take_calls(self) -> list[tuple[str, Record]]:
        """Return the calls since the last time."""
        told, self.calls = self.calls, []
        return told


class EngineRun:
    """The XABSL engine."""

    def __init__(self, compiled: CompileResult, agent: str) -> None:
        assert compiled.program is not None
        self.program = compiled.program
        self.symbols = declared_symbols(compiled.table)
        self.recording = RecordingWorld(self.symbols, self.program)
        self.now = 0
        self.engine = Engine(self.program, self.recording.world, symbols=self.symbols, clock=lambda: self.now)
        assert self.engine.select(agent)

    def cycle(self, ms: int) -> Record:
        """Run one cycle; return active options, memory, outputs and calls."""
        self.now = ms
        self.engine.execute()
        options = {
            option.name: (option.state, option.option_time, option.state_time) for option in self.engine.active_options
        }
        memory = {symbol.name: getattr(self.engine.memory, name) for symbol, name in self._memory()}
        return {
            "options": options,
            "set": self.recording.outputs(),
            "kept": memory,
            "told": self.recording.take_calls(),
        }

    def _memory(self) -> Iterator[tuple[Any, str]]:
        for symbol in self.program.symbols:
            names = [name for name in vars(self.engine.memory) if name == python_name(symbol.name)]
            if names:
                yield symbol, names[0]


class GeneratedPythonRun:
    """The Python generated from the imported designs."""

    def __init__(self, project: Project, compiled: CompileResult, agent: str, folder: Path) -> None:
        assert compiled.program is not None
        self.project = project
        self.recording = RecordingWorld(declared_symbols(compiled.table), compiled.program)
        for file in generate(project, languages=("python",)):
            path = folder / file.path
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(file.text, encoding="utf-8")
        self.clock = SimulatedClock(0)
        component = next(
            declared.root for declared in project.agents if (declared.xabsl_name or declared.name) == agent
        )
        module, _, name = python_class_path(project, component).partition(":")
        for loaded in [loaded for loaded in sys.modules if loaded.split(".")[0] == module.split(".")[0]]:
            del sys.modules[loaded]
        sys.path.insert(0, str(folder / "python"))
        try:
            importlib.invalidate_caches()
            imported = getattr(importlib.import_module(module), name)
        finally:
            sys.path.remove(str(folder / "python"))
        self.now = 0
        self.root = Root(imported, clock=self, world=self.recording.world, on_error="stop")
        self.names = {design.component: design.xabsl_name or design.component for design in project.designs}

    def now_ns(self) -> int:
        return self.now * 1_000_000

    def cycle(self, ms: int) -> Record:
        """Run one iteration; return active options, memory, outputs and calls."""
        self.now = ms
        self.root.step()
        options = {}
        for component in self.root.components:
            name = type(component).__name__
            design = next(
                (design for design in self.project.designs if name in (design.component, f"{design.component}_")), None
            )
            if design is None or component._stepped_in != self.root.iteration:
                continue
            state = design.state(component.state)
            assert state is not None
            times = round(component.component_time * 1000), round(component.state_time * 1000)
            options[self.names[design.component]] = (state.xabsl_name or state.name, *times)
        return {"options": options, "set": self.recording.outputs(), "told": self.recording.take_calls()}


def random_input_rows(symbols: SymbolList, seed: int, count: int) -> Iterator[tuple[int, dict[str, float]]]:
    """Yield times in ms with the inputs that change."""
    chance = random.Random(seed)
    inputs = [symbol for symbol in symbols.symbols if symbol.role == "input"]
    elements = {name: len(elements) for name, elements in (*symbols.enums, *symbols.internal_enums)}
    ms = chance.randrange(1000)
    for _ in range(count):
        ms += chance.choice((1, 20, 33, 500, 4000))
        changed = chance.sample(inputs, min(len(inputs), chance.choice((0, 1, 3, 8))))
        yield ms, {symbol.name: _value(symbol, elements, chance) for symbol in changed}


def _value(symbol: Any, elements: dict[str, int], chance: random.Random) -> float:
    if symbol.kind == "b":
        return float(chance.random() < 0.5)
    if symbol.kind == "e":
        return float(chance.randrange(max(1, elements.get(symbol.enum, 1))))
    return chance.choice(
        (0.0, 1.0, -1.0, chance.uniform(-3, 3), chance.uniform(-4000, 4000), float(chance.randrange(-500, 500)))
    )


def compare_runs(source: ProgramSource, folder: Path, agent: str, *, count: int, seed: int = 1) -> int:
    """Assert that both behave the same in every cycle; return the number of cycles without an exception."""
    imported, compiled = import_checked(source)
    first, second = EngineRun(compiled, agent), GeneratedPythonRun(imported.project, compiled, agent, folder)
    done = 0
    for number, (ms, inputs) in enumerate(random_input_rows(first.symbols, seed, count)):
        for name, value in inputs.items():
            first.recording.world.set_input(name, value)
            second.recording.world.set_input(name, value)
        wanted, got = first.cycle(ms), second.cycle(ms)
        for key in ("options", "set", "told"):
            assert got[key] == wanted[key], (agent, number, ms, key)
        done += not first.engine.errors
    return done


def compare_team_runs(source: ProgramSource, folder: Path, agent: str, *, robots: int, count: int) -> set[str]:
    """Assert that communicating teams of both behave the same; return the states that were active."""
    imported, compiled = import_checked(source)
    engines = [EngineRun(compiled, agent) for _ in range(robots)]
    pythons = [GeneratedPythonRun(imported.project, compiled, agent, folder / str(number)) for number in range(robots)]
    for number, (first, second) in enumerate(zip(engines, pythons, strict=True)):
        first.engine.team.priority = second.root.team.priority = number // 2
        first.engine.team.ticks = second.root.team.ticks = 2
    tables = [random_input_rows(first.symbols, 100 + number, count) for number, first in enumerate(engines)]
    seen: set[str] = set()
    for at in range(count):
        told = (
            [first.engine.generate_outgoing_message() for first in engines],
            [second.root.team.tell() for second in pythons],
        )
        for number, (first, second) in enumerate(zip(engines, pythons, strict=True)):
            first.engine.prepare_incoming_messages()
            second.root.team.prepare()
            for other in (other for other in range(robots) if other != number and at):
                first.engine.process_incoming_message(told[0][other])
                second.root.team.hear(told[1][other])
            ms, inputs = next(tables[number])
            for name, value in inputs.items():
                first.recording.world.set_input(name, value)
                second.recording.world.set_input(name, value)
            wanted, got = first.cycle(ms), second.cycle(ms)
            assert got["options"] == wanted["options"], (at, number)
            assert got["set"] == wanted["set"]
            seen |= {state for state, *_times in wanted["options"].values()}
    return seen
