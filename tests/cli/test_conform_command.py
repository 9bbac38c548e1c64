"""vicode conform: one design in all languages, on the same inputs."""

from pathlib import Path

import pytest

from tests.cli.command_runner import vicode

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


def write_design(folder: Path, code: str) -> None:
    (folder / "counter.yaml").write_text(COUNTER.format(code=code), encoding="utf-8")


def test_languages_agree_on_random_inputs_and_on_those_of_a_trace(
    counters: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_design(counters, "{set: {n: n - 1}}")
    assert vicode("conform", "counter.yaml", "--iterations", "50", "--seed", "4") == 0
    assert capsys.readouterr().out == "Counter: Python, C++, XABSL and simulator agree in 50 iterations (seed 4)\n"
    assert vicode("run", "counter.yaml", "--ticks", "12", "--trace", "run.jsonl", "--values", "--tick-ms", "20") == 0
    capsys.readouterr()
    assert vicode("conform", "counter.yaml", "--inputs", "run.jsonl") == 0
    assert capsys.readouterr().out.startswith("Counter: Python, C++, XABSL and simulator agree in 12 iterations")


def test_the_first_difference_is_shown_with_both_traces(counters: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_design(counters, "code: {python: self.n = self.n - 1, cpp: n = n - 2;}")
    assert vicode("run", "counter.yaml", "--ticks", "6", "--trace", "run.jsonl", "--values", "--tick-ms", "20") == 0
    capsys.readouterr()
    assert vicode("conform", "counter.yaml", "--inputs", "run.jsonl") == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "Counter: Python, C++ and simulator: the traces differ (run.jsonl)"
    assert lines[1].startswith("XABSL is not compared: ")
    assert lines[2:4] == [
        "Python and C++ differ in iteration 3, 0.040 s",
        "  Counter: values.n: Python 1, C++ 0",
    ]
    assert any("n=1" in line and "≠" in line and "n=0" in line for line in lines[4:])


def test_without_a_compiler_the_other_languages_are_compared(
    counters: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    write_design(counters, "{set: {n: n - 1}}")
    monkeypatch.setenv("PATH", str(counters))
    monkeypatch.delenv("CXX", raising=False)
    assert vicode("conform", "counter.yaml", "--iterations", "5") == 0
    assert capsys.readouterr().out.splitlines() == [
        "Counter: Python, XABSL and simulator agree in 5 iterations (seed 0)",
        "C++ is not compared: there is no g++ or clang++ (Debian: sudo apt install g++)",
    ]


def test_a_trace_that_cannot_be_read_is_an_error(counters: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_design(counters, "{set: {n: n - 1}}")
    assert vicode("conform", "counter.yaml", "--inputs", "hands.py") == 2
    assert "hands.py: line 1 is not JSON" in capsys.readouterr().err
