"""Ints mean the same in every language: up to ±2^53, and beyond, where results are limited.

The values in the table are calculated by hand from docs/semantics.md ("Ints"); the random expressions are compared with
the reference interpreter. The programs in C++ are also compiled with the sanitizer of undefined behavior, which ends
them at the first finding.
"""

import itertools
import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

from tests.conformance.int_designs import MOST, int_project, random_design, random_int_run, values_of
from vicode.conformance.cpp import COMPILER_MISSING, CppProgram, CppTools
from vicode.conformance.inputs import ConformanceRun, RunStep
from vicode.conformance.python import run_python, run_simulator
from vicode.conformance.reference import run_reference
from vicode.conformance.report import describe, explain
from vicode.conformance.traces import TraceIteration, first_difference
from vicode.generators.cpp.compiler import find_compiler

SANITIZED = (
    *("-O2", "-fsanitize=undefined,float-cast-overflow,float-divide-by-zero", "-fno-sanitize-recover=all"),
    "-fno-omit-frame-pointer",
)
LEAST64, MOST64 = -(2**63), 2**63 - 1
INF, NAN = math.inf, math.nan

# An expression, its type, the values of a, b (int) and x (float), and the result.
ROWS: Sequence[tuple[str, str, tuple[int, int, float], float]] = (
    # Values are limited where they are stored, and read.
    ("sensor.a", "int", (MOST + 2, 0, 0.0), MOST),
    ("sensor.a", "int", (-(2**63), 0, 0.0), -MOST),
    ("sensor.a + 1", "int", (MOST, 0, 0.0), MOST),
    ("sensor.a + 1 - 1", "int", (MOST, 0, 0.0), MOST),
    ("sensor.a + 1 - 2", "int", (MOST, 0, 0.0), MOST - 1),
    ("sensor.a - 1", "int", (-MOST, 0, 0.0), -MOST),
    ("sensor.a * sensor.b", "int", (2**31, 2**31, 0.0), MOST),
    ("sensor.a * sensor.b", "int", (2**31, -(2**31), 0.0), -MOST),
    ("sensor.a * sensor.b - sensor.a * (sensor.b - 1)", "int", (2**31, 2**31, 0.0), 2**31),
    # Results within an expression are limited to 64 bits.
    ("sensor.a * sensor.b - 9007199254740992 * 1023", "int", (MOST, 2048, 0.0), MOST - 1),
    ("sensor.a * sensor.b == sensor.a * (sensor.b + 1)", "bool", (MOST, 1024, 0.0), True),
    ("sensor.a * sensor.b == sensor.a * (sensor.b + 1)", "bool", (MOST, 1022, 0.0), False),
    ("float(sensor.a * sensor.b)", "float", (MOST, MOST, 0.0), float(MOST64)),
    ("float(sensor.a * sensor.b)", "float", (MOST, -MOST, 0.0), float(LEAST64)),
    ("-(sensor.a * sensor.b) == 9007199254740992 * 1024", "bool", (MOST, -1024, 0.0), True),
    ("abs(sensor.a * sensor.b) == sensor.a * 2048", "bool", (MOST, -1024, 0.0), True),
    ("float(-(sensor.a * sensor.b))", "float", (MOST, -MOST, 0.0), float(MOST64)),
    ("float(sensor.a * sensor.b - sensor.a)", "float", (MOST, -MOST, 0.0), float(LEAST64)),
    ("min(sensor.a * sensor.b, 5)", "int", (MOST, MOST, 0.0), 5),
    ("max(sensor.a * sensor.b, 5)", "int", (MOST, MOST, 0.0), MOST),
    ("clamp(sensor.a * sensor.b, -7, 7)", "int", (MOST, -MOST, 0.0), -7),
    ("sign(sensor.a * sensor.b)", "int", (MOST, -MOST, 0.0), -1),
    ("abs(sensor.a)", "int", (-(2**63), 0, 0.0), MOST),
    ("-sensor.a", "int", (-(2**63), 0, 0.0), MOST),
    # Conversions of floats
    *((f"{function}(sensor.x)", "int", (0, 0, x), result)
      for function in ("int", "floor", "ceil", "round")
      for x, result in ((NAN, 0), (INF, MOST), (-INF, -MOST), (1e300, MOST), (2.0**62, MOST), (-(2.0**63), -MOST))),
    ("int(sensor.x) + 1", "int", (0, 0, 2.0**63), MOST),
    ("int(sensor.x) + int(sensor.x) - int(sensor.x)", "int", (0, 0, -1e300), -MOST),
    ("int(sensor.x)", "int", (0, 0, -1.9), -1),
    ("round(sensor.x)", "int", (0, 0, 2.5), 2),
    ("round(sensor.x)", "int", (0, 0, 2.0**53 - 1), MOST - 1),
    # Comparisons of ints with floats: as doubles
    ("sensor.a < sensor.x", "bool", (MOST + 2, 0, 1e300), True),
    ("sensor.a == sensor.x", "bool", (MOST - 1, 0, 2.0**53), False),
    ("sensor.a == sensor.x", "bool", (2**62, 0, 2.0**53), True),
    ("sensor.a + 1 == sensor.x", "bool", (MOST, 0, 2.0**53), True),
    ("sensor.a + 3 == sensor.x", "bool", (MOST, 0, 2.0**53 + 4), True),
    ("sensor.a > sensor.x", "bool", (5, 0, NAN), False),
    ("sensor.a != sensor.x", "bool", (5, 0, NAN), True),
    ("sensor.a < 9007199254740992.0", "bool", (2**62, 0, 0.0), False),
    ("sensor.a > 9007199254740992", "bool", (2**62, 0, 0.0), False),
    ("sensor.a >= 9007199254740991", "bool", (2**62, 0, 0.0), True),
    ("sensor.a > sensor.b", "bool", (2**63, 2**62, 0.0), False),
    ("1 < sensor.a <= sensor.b", "bool", (2**63, 2**62, 0.0), True),
    # Division: of doubles, always a float
    ("sensor.a / sensor.b", "float", (2**62, 3, 0.0), 2.0**53 / 3.0),
    ("(sensor.a + 1) / 1", "float", (MOST, 0, 0.0), 2.0**53),
    ("(sensor.a * sensor.b) / (sensor.a * 3)", "float", (MOST - 1, 7, 0.0), (MOST - 1) * 7.0 / ((MOST - 1) * 3.0)),
    ("sensor.a / sensor.b", "float", (-5, 0, 0.0), -INF),
    ("sensor.a / sensor.b", "float", (0, 0, 0.0), NAN),
    ("sensor.a // sensor.b", "float", (-7, 2, 0.0), -4.0),
    ("sensor.a // sensor.b", "float", (0, -5, 0.0), -0.0),
    ("sensor.a // sensor.b", "float", (7, 0, 0.0), INF),
    ("(sensor.a + 1) // 2", "float", (MOST, 0, 0.0), 2.0**52),
    ("sensor.a % sensor.b", "float", (-7, 3, 0.0), 2.0),
    ("sensor.a % sensor.b", "float", (7, -3, 0.0), -2.0),
    ("sensor.a % sensor.b", "float", (7, 0, 0.0), NAN),
    ("(sensor.a + 1) % 2", "float", (MOST, 0, 0.0), 0.0),
    ("sensor.a * 0.5", "float", (2**62, 0, 0.0), 2.0**52),
    ("sensor.a + sensor.x", "float", (MOST, 0, 1.0), 2.0**53),
    ("max(sensor.a, sensor.x)", "float", (2**62, 0, 0.5), 2.0**53),
    ("(sensor.a if sensor.b > 0 else sensor.x)", "float", (2**63, 1, 0.5), 2.0**53),
    # Outputs with arguments, inputs of the world, constants
    ("sensor.far(k=sensor.a * sensor.b)", "int", (MOST, MOST, 0.0), MOST),
    ("eyes.near(k=sensor.a + sensor.b)", "int", (5, 7, 0.0), 12),
    ("big", "int", (0, 0, 0.0), MOST),
    ("-big + sensor.a", "int", (1, 0, 0.0), 1 - MOST),
)  # fmt: skip


@pytest.fixture(scope="module")
def compiler() -> str:
    found = find_compiler()
    if found is None:
        pytest.fail(f"C++ cannot be tested: {COMPILER_MISSING}", pytrace=False)
    return found


def run_all(
    runs: Mapping[str, ConformanceRun], folder: Path, compiler: str
) -> dict[str, dict[str, list[TraceIteration]]]:
    def compiled(name: str, *flags: str) -> dict[str, list[TraceIteration]]:
        (folder / name).mkdir()
        return CppProgram(runs, folder / name, CppTools(compiler=(compiler, *flags)), programs=2).run()

    return {
        "reference": {name: run_reference(run) for name, run in runs.items()},
        "python": run_python(runs, folder),
        "simulator": run_simulator(runs, folder),
        "cpp": compiled("plain", "-O0"),
        "sanitized": compiled("sanitized", *SANITIZED),
    }


@pytest.fixture(scope="module")
def table(tmp_path_factory: pytest.TempPathFactory, compiler: str) -> dict[str, list[dict[str, str]]]:
    """The values of the variables r0, r1, … by language, in one iteration for each combination of inputs."""
    project = int_project("rows", ((f"r{index}", row[1], row[0]) for index, row in enumerate(ROWS)))
    steps = [
        RunStep(time_ns=number, inputs=({("Sensor", "a"): a, ("Sensor", "b"): b, ("Sensor", "x"): x},))
        for number, (a, b, x) in enumerate(row[2] for row in ROWS)
    ]
    runs = {"rows": ConformanceRun(project=project, root="Player", steps=tuple(steps))}
    traces = run_all(runs, tmp_path_factory.mktemp("rows"), compiler)
    return {language: list(values_of(each["rows"])) for language, each in traces.items()}


@pytest.mark.parametrize("index", range(len(ROWS)), ids=lambda index: f"{ROWS[index][0]}, {ROWS[index][2]}")
def test_each_row_has_its_value_in_each_language(table: dict[str, list[dict[str, str]]], index: int) -> None:
    type_, expected = ROWS[index][1], ROWS[index][3]
    text = {"int": str, "float": lambda value: repr(float(value)), "bool": lambda value: str(value).lower()}[type_]
    found = {language: values[index][f"r{index}"] for language, values in table.items()}
    assert found == dict.fromkeys(found, text(expected))


def _compare_random(seeds: range, folder: Path, compiler: str, expressions: int) -> None:
    runs = {f"ints_{seed}": random_int_run(random_design(seed, expressions), seed, 40) for seed in seeds}
    traces = run_all(runs, folder, compiler)
    for language, name in itertools.product(traces, runs):
        expected, got = traces["reference"][name], traces[language][name]
        difference = first_difference(expected, got)
        shown = difference and describe(explain(difference, {"reference": expected, language: got}))
        assert difference is None, f"{name}, {language}: {shown}"


def test_languages_agree_on_random_expressions(tmp_path: Path, compiler: str) -> None:
    _compare_random(range(1), tmp_path, compiler, 20)


@pytest.mark.nightly
@pytest.mark.parametrize("batch", range(10))
def test_languages_agree_on_many_random_expressions(batch: int, tmp_path: Path, compiler: str) -> None:
    _compare_random(range(100 + 10 * batch, 110 + 10 * batch), tmp_path, compiler, 40)
