"""Runs designs in XABSL: generated options, compiled, on the engine."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from vicode.bica import arithmetic
from vicode.conformance.inputs import (
    PARAMETERS,
    ConformanceRun,
    RunInput,
    as_number,
    element_of,
    iteration_times,
    used_interfaces,
)
from vicode.conformance.traces import TraceIteration, TraceNormalizer
from vicode.generators import collect_components, generate
from vicode.model.design import Declaration, Design
from vicode.model.expressions import INT
from vicode.model.project import INTERNAL, Agent, Interface
from vicode.model.xabsl.names import component_name, symbol_name, unqualified_name
from vicode.xabsl.compiler import CompileResult, compile_source, declared_symbols
from vicode.xabsl.engine import Engine
from vicode.xabsl.engine.replay import TableWorld
from vicode.xabsl.engine.symbols import RobotSymbol
from vicode.xabsl.source_loader import load_source


def run_xabsl(run: ConformanceRun) -> list[TraceIteration]:
    """Run a design that XABSL can express.

    Raises:
        UnsoundDesignError: A design cannot be generated.
    """
    compiled = _compile(run)
    robots = [XabslRobot(run, compiled, number) for number in range(run.robots)]
    normalizer, iterations = TraceNormalizer(run.project), []
    sent = [robot.engine.generate_outgoing_message() for robot in robots]
    # The clock of XABSL is not set back: it gets the times of the iterations.
    for count, (time_ns, step) in enumerate(zip(iteration_times(run), run.steps, strict=True), start=1):
        received = list(sent)
        for number, robot in enumerate(robots):
            robot.engine.prepare_incoming_messages()
            for sender, message in enumerate(received):
                if sender != number:
                    robot.engine.process_incoming_message(message)
            shared = robot.shared()
            robot.step(time_ns, step.inputs[number])
            sent[number] = robot.engine.generate_outgoing_message()
            record = {"iteration": count, "time_ns": time_ns, "tree": robot.tree(), "inputs": shared}
            iterations.append(normalizer.iteration(record, number))
    return iterations


def _compile(run: ConformanceRun) -> CompileResult:
    kept = collect_components(run.project, (run.root,))
    project = replace(
        run.project,
        designs=tuple(design for design in run.project.designs if design.component in kept),
        agents=(Agent(name="conformance", root=run.root),),
    )
    files = {Path("/", file.path): file.text for file in generate(project, languages=("xabsl",))}
    main = next(path for path in files if path.name == "agents.xabsl")

    def read(path: Path) -> str:
        if path not in files:
            raise FileNotFoundError(2, "No such file or directory")
        return files[path]

    return compile_source(load_source(main, read))


class XabslRobot:
    """One robot: an engine, and the names of the design for those of XABSL."""

    def __init__(self, run: ConformanceRun, compiled: CompileResult, number: int) -> None:
        assert compiled.program is not None
        symbols, project = declared_symbols(compiled.table), run.project
        self._run, self.now_ms = run, 0
        self._inputs = {each.key: each for each in run.inputs}
        ints = frozenset(input_symbol(each) for each in run.inputs if each.type == INT)
        self.world = InputWorld(symbols, compiled.program, ints)
        self.engine = Engine(compiled.program, self.world, symbols=symbols, clock=lambda: self.now_ms, traced=True)
        self.engine.team.priority, self.engine.team.ticks = number, run.team_ticks
        self._slots = {slot.name: index for index, slot in enumerate(self.engine.program.symbols)}
        self._designs = {component_name(design): design for design in project.designs}
        declared: list[Interface | Design] = [*project.components, *project.designs]
        self._components = {component_name(each): each.component for each in declared}
        self._parameters = {
            f"{component_name(each)}.{unqualified_name(parameter)}": (parameter.name, parameter.type)
            for each in declared
            for parameter in each.parameters
        }
        self._elements = {
            (item.name, dict(item.xabsl_elements).get(name) or name): f"{item.name}.{name}"
            for item in project.enumerations
            for name in item.element_names
        }
        self._types = dict(TraceNormalizer(project).types)
        self._root_values: dict[str, Any] = {}
        for each in run.inputs:
            self._set(each.key, each.initial)

    def step(self, time_ns: int, inputs: Mapping[tuple[str, str], Any]) -> None:
        """Set inputs and execute a cycle."""
        for key, value in inputs.items():
            self._set(key, value)
        design = self._run.project.design(self._run.root)
        if design is not None and design.parameters:
            self.engine.set_root(component_name(design), **self._root_values)
        self.now_ms = time_ns // 1_000_000
        self.engine.execute()

    def _set(self, key: tuple[str, str], value: Any) -> None:
        each = self._inputs[key]
        if each.component == PARAMETERS:
            name = each.xabsl_name or each.name
            plain = arithmetic.limit(value) if each.type == INT else value
            self._root_values[name] = element_of(value) if each.elements else plain
        elif input_symbol(each) in self.world.input_names:
            self.world.set_input(input_symbol(each), as_number(value, each.elements))

    def shared(self) -> dict[str, dict[str, Any]]:
        """The shared variables."""
        return {
            item.component: self._values(item.component, item.readable)
            for item in used_interfaces(self._run.project, self._run.root)
            if item.implementation == INTERNAL
        }

    def _values(self, component: str, declared: tuple[Declaration, ...]) -> dict[str, Any]:
        slots = {each.name: self._slots.get(symbol_name(component, each)) for each in declared}
        return {
            name: self._plain(component, name, getattr(self.engine.memory, f"v{slot}"))
            for name, slot in slots.items()
            if slot is not None
        }

    def _plain(self, component: str, name: str, value: Any) -> Any:
        return self._elements.get((self._types.get((component, name), ""), str(value)), value)

    def tree(self) -> list[dict[str, Any]]:
        """The steps of the last cycle, in the form of traces."""
        return list(self._steps(self.engine.trace, None))

    def _steps(self, nodes: list[Any], by: str | None) -> Iterator[dict[str, Any]]:
        for node in (each for each in nodes if each[0] != "s"):
            component = self._components[node[1]]
            given = {self._parameters[name][0]: value for name, value in node[3 if node[0] == "b" else 5].items()}
            step: dict[str, Any] = {
                "component": component,
                "by": by,
                "link": "modulates" if by else "root",
                "worked": True,
                "transition": None,
                "parameters": {name: self._plain(component, name, value) for name, value in given.items()}
                if by
                else {},
            }
            if node[0] == "o":
                step |= self._option_fields(node)
            yield step
            if node[0] == "o":
                yield from self._steps(node[6], component)

    def _option_fields(self, node: list[Any]) -> dict[str, Any]:
        design = self._designs[node[1]]
        states = {unqualified_name(state): state for state in design.states}
        return {
            "state": states[node[2]].name,
            "component_time_ns": node[3] * 1_000_000,
            "state_time_ns": node[4] * 1_000_000,
            "changed_from": states[node[7]].name if node[7] != node[2] else None,
            "done": states[node[2]].final,
            "values": self._values(design.component, (*design.outputs, *design.variables)),
        }


class InputWorld(TableWorld):
    """A world whose inputs, and outputs that options read, are set one by one; values of type int stay whole."""

    def __init__(self, symbols: Any, program: Any, ints: frozenset[str]) -> None:
        self._ints = ints
        super().__init__(symbols, program)
        self._inputs |= {symbol.name: symbol for symbol in symbols.symbols if symbol.role == "output"}
        self.input_names = frozenset(self._inputs)

    def _value(self, symbol: RobotSymbol, total: float) -> Any:
        value = super()._value(symbol, total)
        return float(arithmetic.to_int(value)) if symbol.name in self._ints else value


def input_symbol(each: RunInput) -> str:
    """The name of the symbol that provides an input."""
    return symbol_name(each.component, Declaration(name=each.name, xabsl_name=each.xabsl_name))
