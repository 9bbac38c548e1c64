"""Complete behaviors compile to the code of the original compiler, and run as recorded from the original engine."""

import json

import pytest

from tests.xabsl.xabsl_cases import CASES, PROGRAMS, original_record, parse_words, read_case
from vicode.xabsl.compiler import CompileResult, compile_source, declared_symbols
from vicode.xabsl.engine.code_reader import read_code
from vicode.xabsl.engine.code_writer import write_code
from vicode.xabsl.engine.replay import ReplayRobot, read_rows
from vicode.xabsl.engine.symbols import read_symbols, write_symbols
from vicode.xabsl.source_loader import load_source


def compiled_case(name: str) -> CompileResult:
    return compile_source(load_source(CASES / "programs" / name / "agents.xabsl"))


@pytest.mark.parametrize("name", PROGRAMS)
def test_code_and_symbol_list_match_the_original(name: str) -> None:
    compiled = compiled_case(name)
    assert compiled.program
    assert parse_words(write_code(compiled.program)) == parse_words(read_case(name, "intermediate.dat"))
    assert write_symbols(declared_symbols(compiled.table)) == read_case(name, "symbols.txt")


@pytest.mark.parametrize("name", PROGRAMS)
def test_code_is_read_back_as_the_same_program(name: str) -> None:
    program = read_code(read_case(name, "intermediate.dat"))
    assert read_code(write_code(program)) == program
    compiled = compiled_case(name).program
    assert compiled
    assert compiled.options == program.options


@pytest.mark.parametrize("name", PROGRAMS)
def test_every_cycle_matches_the_original_engine(name: str) -> None:
    program, symbols = read_code(read_case(name, "intermediate.dat")), read_symbols(read_case(name, "symbols.txt"))
    rows = read_rows(read_case(name, "inputs.csv").splitlines())
    expected_lines = [json.loads(line) for line in read_case(name, "trace.jsonl").splitlines()]
    assert len(rows) == len(expected_lines)
    robot = ReplayRobot(program, symbols)
    for cycle, (row, expected) in enumerate(zip(rows, expected_lines, strict=True)):
        robot.apply_row(row)
        robot.engine.execute()
        assert original_record(robot, cycle) == expected
