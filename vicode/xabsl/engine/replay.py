"""Runs a program on recorded inputs and writes a trace in JSON lines (docs/traces.md)."""

import csv
import json
import math
import re
import time
from collections.abc import Callable, Iterable, Iterator
from typing import Any

from .engine import Engine
from .linker import python_name
from .program import Program, TypedSlot
from .symbols import RobotSymbol, SymbolList

TRACE_HEADER = '{"vicode-trace":1,"runtime":"xabsl"}'
"""The first line of a trace: the version of the form and the writer."""

_NS_PER_MS = 1_000_000
_ROBOT_PREFIX = re.compile(r"(\d{1,9}):")


class ReplayError(ValueError):
    """The inputs do not match the symbols."""


class TableWorld:
    """A world whose inputs are the columns of a table, and whose basic behaviors do nothing.

    The value of an input with parameters is derived from its column (base) and S, the sum of i × decimal i,
    0.5 j × bool j and 0.25 k × number of enum k: base + S for a decimal, base XOR (floor |S| is odd) for a bool, the
    element number base + floor |S| modulo the number of elements for an enum. For bools and enums, an S that is not
    finite counts as 0.
    """

    def __init__(self, symbols: SymbolList, program: Program) -> None:
        self._elements = {
            name: tuple(element.rpartition(".")[2] for element in elements)
            for name, elements in (*symbols.enums, *symbols.internal_enums, *program.enums)
        }
        self._bases: dict[str, float] = {}
        self._inputs = {symbol.name: symbol for symbol in symbols.symbols if symbol.role == "input"}
        for symbol in self._inputs.values():
            self._bases[symbol.name] = 0.0
            if symbol.parameters:
                setattr(self, python_name(symbol.name), self._function(symbol))
            else:
                self.set_input(symbol.name, 0.0)
        for symbol in symbols.symbols:
            if symbol.role == "output":
                zero: object = 0.0 if symbol.kind == "d" else False
                setattr(self, python_name(symbol.name), self._element(symbol.enum, 0) if symbol.kind == "e" else zero)
        for behavior in symbols.behaviors:
            setattr(self, python_name(behavior.name), _do_nothing)

    def set_input(self, name: str, value: float) -> None:
        """Set an input symbol; bools are 0 or 1, enums the number of an element.

        Raises:
            ReplayError: There is no such input symbol.
        """
        symbol = self._inputs.get(name)
        if symbol is None:
            raise ReplayError(f"no input symbol {name}")
        self._bases[name] = value
        if not symbol.parameters:
            setattr(self, python_name(name), self._value(symbol, 0.0))

    def _function(self, symbol: RobotSymbol) -> Callable[..., Any]:
        order = [(python_name(slot.name.removeprefix(f"{symbol.name}.")), slot) for slot in symbol.parameters]
        weights = [
            (keyword, slot, weight * (index + 1))
            for kind, weight in (("d", 1.0), ("b", 0.5), ("e", 0.25))
            for index, (keyword, slot) in enumerate(pair for pair in order if pair[1].kind == kind)
        ]

        def read(**arguments: Any) -> Any:
            total = 0.0
            for keyword, slot, weight in weights:
                total += weight * self._number(slot, arguments[keyword])
            return self._value(symbol, total)

        return read

    def _number(self, slot: TypedSlot, value: Any) -> float:
        return self._elements[slot.enum].index(value) if slot.kind == "e" else float(value)

    def _value(self, symbol: RobotSymbol, total: float) -> Any:
        base = self._bases[symbol.name]
        if symbol.kind == "d":
            return base + total
        steps = math.floor(abs(total)) if math.isfinite(total) else 0
        if symbol.kind == "b":
            return (base != 0) != (steps % 2 == 1)
        return self._element(symbol.enum, int(base) + steps)

    def _element(self, enum: str, number: int) -> str:
        elements = self._elements.get(enum, ())
        return elements[number % len(elements)] if elements else ""


def _do_nothing(**_arguments: object) -> None:
    pass


def read_rows(lines: Iterable[str]) -> list[dict[str, str]]:
    """Read a table of inputs: `time` in ms, optionally `agent` and `reset`, and symbols. An empty cell keeps the value.

    Raises:
        ReplayError: A row has more cells than the header.
    """
    rows = list(csv.DictReader(lines, restkey=""))
    for number, row in enumerate(rows, 2):
        if "" in row:
            raise ReplayError(f"line {number}: more cells than columns")
    return rows


class ReplayRobot:
    """An engine with a world whose inputs are set row by row."""

    def __init__(self, program: Program, symbols: SymbolList, *, strict: bool = False, traced: bool = True) -> None:
        self.now = 0
        self.world = TableWorld(symbols, program)
        self.engine = Engine(program, self.world, symbols=symbols, clock=lambda: self.now, strict=strict, traced=traced)
        self._kinds = {symbol.name: symbol for symbol in symbols.symbols if symbol.role != "input"}
        self._kinds |= {slot.name: RobotSymbol("internal", slot.kind, slot.name, slot.enum) for slot in program.symbols}
        slots = [slot for option in program.options for slot in option.parameters]
        slots += [slot for behavior in symbols.behaviors for slot in behavior.parameters]
        self._slots = {slot.name: slot for slot in slots}
        self._targets = {
            (each.name, state.name) for each in program.options for state in each.states if state.is_target
        }

    def apply_row(self, row: dict[str, str], prefix: str = "") -> None:
        """Set the inputs from a row.

        Raises:
            ReplayError: A column is not an input symbol, or a cell is not a number.
        """
        for column, cell in row.items():
            if not cell or not (column == "time" or column.startswith(prefix)):
                continue
            name = column.removeprefix(prefix)
            if name == "time":
                self.now = int(_parse_number(name, cell))
            elif name == "agent":
                if not self.engine.select(cell):
                    raise ReplayError(f"no agent {cell}")
            elif name == "reset":
                if cell != "0":
                    self.engine.reset()
            else:
                self.world.set_input(name, _parse_number(name, cell))

    def trace_line(self, cycle: int, number: int | None = None) -> str:
        """Format the last cycle as a line of a trace."""
        return json.dumps(self.trace_record(cycle, number), separators=(",", ":"))

    def trace_record(self, cycle: int, number: int | None = None) -> dict[str, Any]:
        """The last cycle as a record of a trace."""
        engine = self.engine
        record: dict[str, Any] = {"iteration": cycle, "time_ns": self.now * _NS_PER_MS, "agent": engine.agent}
        if number is not None:
            record["robot"] = number
        record["tree"] = list(self._steps(engine.trace))
        record["errors"] = [{"message": error} for error in engine.errors]
        return record

    def _steps(self, nodes: list[Any], by: str | None = None) -> Iterator[dict[str, Any]]:
        for node in nodes:
            if node[0] == "b":
                yield self._step(node[1], by, node[2], node[3])
            elif node[0] == "o":
                _kind, name, state, option_time, state_time, parameters, inner, before = node
                yield {
                    **self._step(name, by, option_time, parameters),
                    "state": state,
                    "state_time_ns": state_time * _NS_PER_MS,
                    "changed_from": before if before != state else None,
                    "done": (name, state) in self._targets,
                    "values": {
                        child[1]: self._json_value(self._kinds[child[1]], child[2])
                        for child in inner
                        if child[0] == "s"
                    },
                }
                yield from self._steps(inner, name)

    def _step(self, name: str, by: str | None, active_ms: int, parameters: dict[str, Any]) -> dict[str, Any]:
        return {
            "component": name,
            "by": by,
            "link": "root" if by is None else "modulates",
            "worked": True,
            "component_time_ns": active_ms * _NS_PER_MS,
            "state": "",
            "state_time_ns": 0,
            "changed_from": None,
            "transition": None,
            "parameters": self._parameters(name, parameters),
            "done": False,
        }

    def _parameters(self, name: str, values: dict[str, Any]) -> dict[str, Any]:
        order = sorted(values, key=lambda name: "dbe".index(self._slots[name].kind))
        return {each.removeprefix(f"{name}."): self._json_value(self._slots[each], values[each]) for each in order}

    def _json_value(self, slot: TypedSlot | RobotSymbol, value: Any) -> Any:
        if slot.kind == "e":
            return f"{slot.enum}.{value}"
        if slot.kind == "b":
            return bool(value)
        number = float(value)
        if not math.isfinite(number):
            return str(number)
        return int(number) if number == int(number) else number


def _parse_number(name: str, cell: str) -> float:
    try:
        return float(cell)
    except ValueError:
        raise ReplayError(f"{name}: {cell[:40]} is not a number") from None


def replay(program: Program, symbols: SymbolList, rows: list[dict[str, str]], *, strict: bool = False) -> Iterator[str]:
    """Run a program on inputs; yields the lines of a trace.

    Raises:
        LoadError: The program does not match the symbols.
        ReplayError: The inputs do not match the symbols.
    """
    robot = ReplayRobot(program, symbols, strict=strict)
    for column in rows[0] if rows else ():
        if _ROBOT_PREFIX.match(column):
            raise ReplayError(f"column {column} is for one of several robots; add --team with their number")
    yield TRACE_HEADER
    for cycle, row in enumerate(rows, start=1):
        robot.apply_row(row)
        robot.engine.execute()
        yield robot.trace_line(cycle)


def replay_team(
    program: Program, symbols: SymbolList, rows: list[dict[str, str]], robots: int, ticks: int, *, strict: bool = False
) -> Iterator[str]:
    """Run a program on several robots, with their numbers as priorities.

    Columns other than `time` are prefixed with the number of the robot: "0:", "1:", …

    Raises:
        LoadError: The program does not match the symbols.
        ReplayError: The inputs do not match the symbols.
    """
    for column in rows[0] if rows else ():
        prefix = _ROBOT_PREFIX.match(column)
        if column != "time" and (prefix is None or int(prefix[1]) >= robots):
            symbol = column[prefix.end() if prefix else 0 :]
            raise ReplayError(f"column {column} is for none of the robots 0 to {robots - 1}; name it 0:{symbol}")
    team = [ReplayRobot(program, symbols, strict=strict) for _ in range(robots)]
    for number, robot in enumerate(team):
        robot.engine.team.priority, robot.engine.team.ticks = number, ticks
    sent = [robot.engine.generate_outgoing_message() for robot in team]
    yield TRACE_HEADER
    for cycle, row in enumerate(rows, start=1):
        received, sent = sent, []
        for number, robot in enumerate(team):
            robot.apply_row(row, f"{number}:")
            robot.engine.prepare_incoming_messages()
            for sender, message in enumerate(received):
                if sender != number:
                    robot.engine.process_incoming_message(message)
            robot.engine.execute()
            sent.append(robot.engine.generate_outgoing_message())
            yield robot.trace_line(cycle, number)


def measure_cycles_per_second(
    program: Program, symbols: SymbolList, rows: list[dict[str, str]], times: int, *, strict: bool = False
) -> float:
    """Measure the cycles per second of CPU time of an engine without a trace; setting the inputs is excluded.

    Raises:
        LoadError: The program does not match the symbols.
        ReplayError: The inputs do not match the symbols.
    """
    robot, spent_s = ReplayRobot(program, symbols, strict=strict, traced=False), 0.0
    execute, clock = robot.engine.execute, time.process_time
    for _ in range(times):
        for row in rows:
            robot.apply_row(row)
            start_s = clock()
            execute()
            spent_s += clock() - start_s
    return times * len(rows) / max(spent_s, 1e-9)
