"""Properties of random behaviors: printing and code are reversible, and the engine agrees with the oracle."""

import random
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from tests.strategies.xabsl_behaviors import behaviors
from tests.xabsl.oracle import Oracle
from tests.xabsl.xabsl_cases import load_texts
from vicode.findings import Severity
from vicode.xabsl import tree
from vicode.xabsl.compiler import compile_source, declared_symbols
from vicode.xabsl.engine.code_reader import read_code
from vicode.xabsl.engine.code_writer import write_code
from vicode.xabsl.engine.program import Program
from vicode.xabsl.engine.replay import ReplayRobot
from vicode.xabsl.engine.symbols import SymbolList, read_symbols, write_symbols
from vicode.xabsl.parser import parse
from vicode.xabsl.printer import print_file


def compiled(files: dict[str, tree.FileNode]) -> tuple[Program, SymbolList]:
    result = compile_source(load_texts({name: print_file(file) for name, file in files.items()}))
    errors = [finding for finding in result.findings if finding.severity is Severity.ERROR]
    assert result.program, errors
    return result.program, declared_symbols(result.table)


@given(behaviors())
def test_a_printed_tree_is_parsed_as_the_same_tree(files: dict[str, tree.FileNode]) -> None:
    for file in files.values():
        printed = print_file(file)
        parsed = parse(printed)
        assert parsed.findings == []
        assert parsed.file == file
        assert print_file(parsed.file) == printed


@given(behaviors())
def test_code_and_symbols_are_read_back(files: dict[str, tree.FileNode]) -> None:
    program, symbols = compiled(files)
    assert read_code(write_code(program)) == program
    assert read_symbols(write_symbols(symbols)).behaviors == symbols.behaviors


@given(behaviors(), st.integers(0, 10_000))
def test_the_engine_agrees_with_the_oracle(files: dict[str, tree.FileNode], seed: int) -> None:
    program, symbols = compiled(files)
    robot, oracle, rng = ReplayRobot(program, symbols), Oracle(program, symbols), random.Random(seed)
    elements = dict(symbols.enums)["side"]
    for _cycle in range(12):
        robot.now += rng.choice((1, 20, 60))
        inputs: dict[str, Any] = {}
        for symbol in symbols.symbols:
            if symbol.role == "input":
                number = (
                    rng.randrange(3)
                    if symbol.kind == "e"
                    else rng.choice((0, 1, 3.5) if symbol.kind == "d" else (0, 1))
                )
                robot.world.set_input(symbol.name, number)
                convert = {"d": float, "b": bool, "e": lambda at: elements[int(at)]}[symbol.kind]
                inputs[symbol.name] = convert(number)
        robot.engine.execute()
        expected = oracle.cycle(robot.now, inputs)
        assert len(robot.engine.errors) == len(oracle.twice)
        assert _plain(robot.engine.trace) == _plain(expected)


def _plain(value: Any) -> Any:
    """Normalize nodes: elements without their enumeration, numbers as texts, so that nan equals nan."""
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, str):
        return value.removeprefix("side.")
    return repr(float(value))
