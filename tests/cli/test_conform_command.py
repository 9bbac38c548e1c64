"""vicode conform: one design in all languages, on the same inputs."""

import re
import shutil
from pathlib import Path

import pytest

from tests.cli.command_runner import vicode
from vicode.conformance.traces import TraceDifference, TraceIteration, large_ints_limit

PROJECT = """
vicode: 1
project: Counters
components:
  Eye: {implementation: hands:Eye, outputs: {distance: float, bearing: {type: float, arguments: {x: float}}}}
  Wheels: {implementation: hands:Wheels, parameters: {speed: float}}
"""
HANDS = """
from vicode.bica import Component


class Eye(Component):
    def __init__(self, root):
        super().__init__(root)
        self.distance = 1.0

    def work(self):
        self.distance += 3.0

    def bearing(self, x):
        return 2.0 * x


class Wheels(Component):
    def modulate(self, *, speed):
        pass
"""
COUNTER = """
vicode: 1
component: Counter
uses: {{eye: Eye, wheels: Wheels}}
outputs: {{n: {{type: int}}, turn: {{type: float}}}}
initial: Near
states:
  Near:
    requires: [eye]
    actions: [{{set: {{n: n + 1, turn: eye.bearing(x=n)}}}}, {{call: wheels, with: {{speed: turn}}}}]
    transitions: [{{to: Far, when: eye.distance > 7}}]
  Far:
    requires: [eye]
    actions: [{code}]
    transitions: [{{to: Near, when: eye.distance < 3}}]
"""


@pytest.fixture
def counters(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of a project whose design is written by the test; it is the current folder."""
    (tmp_path / "project.yaml").write_text(PROJECT, encoding="utf-8")
    (tmp_path / "hands.py").write_text(HANDS, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


PRODUCT = """
vicode: 1
component: Product
outputs: {x: 0.1, square: 0.0, hypotenuse: 0.0, angle: 0.0}
initial: Equal
states:
  Equal:
    actions: [{set: {x: x + 0.1, square: (x + 0.1) * (x + 0.1), hypotenuse: "hypot(x, 0.3)", angle: degrees(x) + 0.1}}]
    transitions: [{to: Other, when: x * x - square != 0}]
  Other:
    actions: [{set: {x: x * x + 0.1}}]
"""


def printed(capsys: pytest.CaptureFixture[str]) -> str:
    """What was printed, without JavaScript: not every machine has Node.js, and tests/conformance compares it."""
    text = capsys.readouterr().out.replace(", JavaScript", "")
    return re.sub(r"^JavaScript is not compared: .*\n", "", text, flags=re.MULTILINE)


AGREE = "Counter: reference, Python, C++, XABSL and simulator agree"


def write_design(folder: Path, code: str) -> None:
    (folder / "counter.yaml").write_text(COUNTER.format(code=code), encoding="utf-8")


def test_languages_agree_on_random_inputs_and_on_those_of_a_trace(
    counters: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_design(counters, "{set: {n: n - 1}}")
    assert vicode("conform", "counter.yaml", "--iterations", "50", "--seed", "4") == 0
    lines = printed(capsys).splitlines()
    assert re.fullmatch(rf"{re.escape(AGREE)} in 50 iterations of \d+ runs \(seed 4\)", lines[0])
    assert re.fullmatch(r"XABSL is compared in \d+ of \d+ runs: times of XABSL are whole milliseconds", lines[1])
    assert lines[2:] == [
        "coverage: 2 of 2 guards true and false, 2 of 2 transitions, 2 of 2 states, 2 of 2 comparisons at their limit"
    ]
    assert vicode("run", "counter.yaml", "--ticks", "12", "--trace", "run.jsonl", "--values", "--tick-ms", "20") == 0
    capsys.readouterr()
    assert vicode("conform", "counter.yaml", "--inputs", "run.jsonl") == 0
    assert printed(capsys).startswith(f"{AGREE} in 12 iterations")


GROWING = """
vicode: 1
component: Counter
variables: {n: {type: int}}
initial: Far
states:
  Far:
    actions: [{set: {n: n * FACTOR + 1}}]
    transitions: [{to: Near, when: n > 9007199254740992}]
  Near: {actions: [{set: {n: n - 1}}]}
"""


LARGE_INTS = "numbers are doubles: beyond ±2^53 an int is the nearest double, and is not limited"


def test_a_difference_of_xabsl_after_a_large_int_is_named(counters: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (counters / "project.yaml").write_text("vicode: 1\nproject: Counters\n", encoding="utf-8")
    (counters / "counter.yaml").write_text(GROWING.replace("FACTOR", "1000"), encoding="utf-8")
    assert vicode("run", "counter.yaml", "--ticks", "20", "--trace", "run.jsonl", "--values", "--tick-ms", "20") == 0
    capsys.readouterr()
    assert vicode("conform", "counter.yaml", "--inputs", "run.jsonl") == 0
    first, second, *_coverage = printed(capsys).splitlines()
    assert first.startswith(f"{AGREE} in 20 iterations")
    assert second == f"XABSL is not compared from iteration 7 on: {LARGE_INTS}"
    # Chosen inputs spare XABSL what its numbers cannot express.
    assert vicode("conform", "counter.yaml", "--iterations", "20") == 0
    assert LARGE_INTS not in printed(capsys)


def test_a_difference_before_a_large_int_is_reported() -> None:
    iterations = [
        TraceIteration(number=number, time_ns=0, steps=(), shared={}, had_large_ints=number >= 3)
        for number in (1, 2, 3)
    ]
    for index, is_named in enumerate((False, False, True)):
        found = TraceDifference(index=index, component="", field="n", values=("1", "2"))
        assert (large_ints_limit("xabsl", iterations, found) is not None) == is_named
        assert large_ints_limit("cpp", iterations, found) is None


def test_the_first_difference_is_shown_with_both_traces(counters: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_design(counters, "code: {python: self.n = self.n - 1, cpp: n = n - 2;}")
    assert vicode("run", "counter.yaml", "--ticks", "6", "--trace", "run.jsonl", "--values", "--tick-ms", "20") == 0
    capsys.readouterr()
    assert vicode("conform", "counter.yaml", "--inputs", "run.jsonl") == 1
    lines = printed(capsys).splitlines()
    assert lines[0] == "Counter: reference, Python, C++ and simulator: the traces differ (run.jsonl)"
    assert lines[1].startswith("XABSL is not compared: ")
    assert lines[2:4] == [
        "reference and C++ differ in iteration 3, 0.040 s",
        "  Counter: values.n: reference 1, C++ 0",
    ]
    assert any("n=1" in line and "≠" in line and "n=0" in line for line in lines[4:])


def test_without_a_compiler_the_other_languages_are_compared(
    counters: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    write_design(counters, "{set: {n: n - 1}}")
    monkeypatch.setenv("PATH", str(counters))
    monkeypatch.delenv("CXX", raising=False)
    assert vicode("conform", "counter.yaml", "--iterations", "5") == 0
    lines = printed(capsys).splitlines()
    assert lines[0].startswith("Counter: reference, Python, XABSL and simulator agree in 5 iterations")
    assert lines[1] == "C++ is not compared: there is no g++ or clang++ (Debian: sudo apt install g++)"


def test_a_trace_that_cannot_be_read_is_an_error(counters: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_design(counters, "{set: {n: n - 1}}")
    assert vicode("conform", "counter.yaml", "--inputs", "hands.py") == 2
    assert "hands.py: line 1 is not JSON" in capsys.readouterr().err


def test_the_compiler_of_the_robot_fuses_no_multiplication(counters: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A state differs where x * x - y is calculated at once: an addition to the exact product."""
    (counters / "product.yaml").write_text(PRODUCT, encoding="utf-8")
    for compiler in filter(None, map(shutil.which, ("g++", "clang++"))):
        assert vicode("conform", "product.yaml", "--cxx", f"{compiler} -O3 -march=native") == 0
        assert printed(capsys).startswith("Product: reference, Python, C++ and simulator agree")


@pytest.mark.parametrize("name", ["Conformance", "Gamma"])
def test_the_namespace_of_the_project_is_compiled(
    counters: Path, capsys: pytest.CaptureFixture[str], name: str
) -> None:
    project = PROJECT.replace("Counters", name).replace("Wheels", "Robot")
    (counters / "project.yaml").write_text(project, encoding="utf-8")
    hands = HANDS.replace("Wheels", "Robot")
    (counters / "hands.py").write_text(hands, encoding="utf-8")
    (counters / "counter.yaml").write_text(
        COUNTER.replace("Wheels", "Robot").format(code="{set: {n: n - 1}}"), encoding="utf-8"
    )
    assert vicode("conform", "counter.yaml", "--iterations", "20") == 0
    assert printed(capsys).startswith(AGREE)


def test_an_emulator_runs_the_program(counters: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_design(counters, "{set: {n: n - 1}}")
    emulator = counters / "emulator"
    emulator.write_text('#!/bin/sh\nprintf "%s\\n" "$1" >> emulated\nshift\nexec "$@"\n', encoding="utf-8")
    emulator.chmod(0o755)
    assert vicode("conform", "counter.yaml", "--emulator", f"{emulator} 'a robot'") == 0
    assert printed(capsys).startswith(AGREE)
    assert (counters / "emulated").read_text(encoding="utf-8").split("\n")[0] == "a robot"


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--cxx", "missing-g++ -O2"], "there is no command missing-g++"),
        (["--cxx", "g++ '-O2"], "g++ '-O2: No closing quotation"),
        (["--emulator", "missing-qemu"], "there is no command missing-qemu"),
    ],
)
def test_a_missing_compiler_or_emulator_is_an_error(
    counters: Path, capsys: pytest.CaptureFixture[str], options: list[str], message: str
) -> None:
    write_design(counters, "{set: {n: n - 1}}")
    assert vicode("conform", "counter.yaml", *options) == 2
    assert message in capsys.readouterr().err


def test_flags_that_change_results_are_an_error_of_the_compiler(
    counters: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_design(counters, "{set: {n: n - 1}}")
    assert vicode("conform", "counter.yaml", "--cxx", "g++ -O2 -ffast-math") == 1
    assert "With -ffast-math, states differ from those of the design" in printed(capsys)


COUNTS = (
    "2 of 3 guards true and false, 2 of 3 transitions, 2 of 2 states, 1 of 2 comparisons at their limit, "
    "1 of 1 timers exactly met and missed by 1 ns"
)
NEVER = """
vicode: 1
component: Counter
uses: {eye: Eye}
outputs: {n: {type: int}}
initial: Near
states:
  Near:
    actions: [{set: {n: n + 1}}]
    transitions:
      - to: Far
        when: eye.distance > 7
      - to: Far
        when: eye.distance > 8
  Far:
    transitions: [{to: Near, after: 0.25}]
"""


def test_what_no_input_reaches_is_listed_with_its_line(counters: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (counters / "counter.yaml").write_text(NEVER, encoding="utf-8")
    assert vicode("conform", "counter.yaml") == 0
    lines = [line for line in printed(capsys).splitlines() if line.startswith(("coverage", "never"))]
    assert lines == [
        f"coverage: {COUNTS}",
        "never: guard eye.distance > 8 in Near (counter.yaml:14) true",
        "never: transition from Near to Far (counter.yaml:13) taken",
        "never: eye.distance > 8 in Near (counter.yaml:14) at the limit",
    ]


def test_mutants_of_the_design_that_no_input_shows_are_listed(
    counters: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (counters / "counter.yaml").write_text(NEVER, encoding="utf-8")
    assert vicode("conform", "counter.yaml", "--mutants") == 0
    first, *lines = printed(capsys).splitlines()
    noticed = r"Counter: (\d+) of (\d+) mutants of the design are noticed; (\d+) more are proved to behave like it"
    found = re.fullmatch(noticed, first)
    assert found is not None
    assert int(found[2]) - int(found[1]) == len(lines)
    # The second transition is never taken, so that no change of it matters but one that lets it be taken.
    assert int(found[3]) > 3
    assert not [line for line in lines if "distance" in line or "after" in line or "transition" in line]


def test_mutants_of_a_design_that_cannot_be_interpreted_are_not_tried(
    counters: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = COUNTER.format(code="code: {python: print(self.n), cpp: n = n - 2;}")
    text = text.replace("initial: Near", "initial: Far").replace(
        "{to: Near, when: eye.distance < 3}", "{to: Near, after: 1e9}"
    )
    (counters / "counter.yaml").write_text(text, encoding="utf-8")
    assert vicode("conform", "counter.yaml", "--mutants") == 2
    assert "the reference interpreter cannot run Counter" in capsys.readouterr().err


def test_inputs_avoid_code_that_cannot_be_interpreted(counters: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_design(counters, "code: {python: print(self.n), cpp: n = n - 2;}")
    assert vicode("conform", "counter.yaml") == 0
    out = printed(capsys)
    assert out.startswith("Counter: reference, Python, C++ and simulator agree in")
    assert "never: transition from Near to Far (counter.yaml:11) taken" in out


def test_the_same_seed_chooses_the_same_inputs(counters: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_design(counters, "code: {python: self.n = self.n - 1, cpp: n = n - 2;}")
    printed = []
    for seed in ("1", "1", "2"):
        assert vicode("conform", "counter.yaml", "--seed", seed) == 1
        printed.append(capsys.readouterr().out)
    assert printed[0] == printed[1] != printed[2]
