"""vicode test: regression tests of a design as files that pytest runs."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.command_runner import vicode
from tests.conformance.test_suites import GATE, GATE_PROJECT

ROOT = Path(__file__).parents[2]
HANDS = """\
from vicode.bica import Component


class Eye(Component):
    def __init__(self, root):
        super().__init__(root)
        self.distance, self.seen = 5.0, False

    def work(self):
        self.seen = True
        self.distance = max(self.distance - 0.25, 0.0)
"""
CODE = "actions: [{code: {python: 'print(self.speed)'}}]"


@pytest.fixture
def gates(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of a project with one design and a hand-written component; it is the current folder."""
    for name, text in (("project.yaml", GATE_PROJECT), ("gate.yaml", GATE), ("hands.py", HANDS)):
        (tmp_path / name).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run_pytest(folder: Path, *options: str) -> "subprocess.CompletedProcess[str]":
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(folder), *options]
    return subprocess.run(command, env={"PYTHONPATH": str(ROOT)}, capture_output=True, text=True, check=False)


def test_the_written_tests_pass_until_the_design_behaves_otherwise(
    gates: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert vicode("test", "gen", "gate.yaml") == 0
    assert capsys.readouterr().out.startswith("wrote tests/gate.suite.json: ")
    assert sorted(path.name for path in (gates / "tests").iterdir()) == ["gate.suite.json", "test_gates_designs.py"]
    passed = run_pytest(gates / "tests")
    assert passed.returncode == 0, passed.stdout
    (gates / "gate.yaml").write_text(GATE.replace("eye.distance < 4", "eye.distance <= 4"), encoding="utf-8")
    failed = run_pytest(gates / "tests")
    assert failed.returncode == 1
    assert "Python: Gate is Open, expected Closed" in failed.stdout
    (gates / "gate.yaml").unlink()
    broken = run_pytest(gates / "tests", "-x")
    assert "gate.yaml" in broken.stdout
    assert "write the suite again with 'vicode test'" in broken.stdout


def test_the_same_design_gives_the_same_bytes(gates: Path) -> None:
    assert vicode("test", "gen", ".", "--out", "one") == 0
    assert vicode("test", "gen", "gate.yaml", "--out", "other") == 0
    one, other = ((gates / name / "gate.suite.json").read_text(encoding="utf-8") for name in ("one", "other"))
    assert one == other
    assert json.loads(one)["design"] == "../gate.yaml"


@pytest.mark.parametrize("name", ["gate.suite.json", "test_gates_designs.py"])
def test_a_file_of_others_is_not_replaced(name: str, gates: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (gates / "tests").mkdir()
    (gates / "tests" / name).write_text("mine", encoding="utf-8")
    assert vicode("test", "gen", "gate.yaml") == 2
    assert f"tests/{name} is not replaced" in capsys.readouterr().err
    assert [(path.name, path.read_text(encoding="utf-8")) for path in (gates / "tests").iterdir()] == [(name, "mine")]


def test_a_recorded_run_becomes_a_test_of_its_component(gates: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("run", "gate.yaml", "--seconds", "2", "--trace", "run.jsonl", "--values") == 0
    assert vicode("test", "record", "run.jsonl") == 0
    assert "wrote tests/run.suite.json: 1 case, 100 steps" in capsys.readouterr().out
    assert run_pytest(gates / "tests").returncode == 0
    # A suite with this name that was made from something else stays.
    assert vicode("test", "gen", "gate.yaml") == 0
    (gates / "gate.jsonl").write_bytes((gates / "run.jsonl").read_bytes())
    capsys.readouterr()
    assert vicode("test", "record", "gate.jsonl") == 2
    assert "it has tests of Gate from vicode test gen" in capsys.readouterr().err


def test_a_suite_of_another_trace_with_the_same_name_stays(gates: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for folder, seconds in (("p", "1"), ("q", "2")):
        (gates / folder).mkdir()
        assert vicode("run", "gate.yaml", "--seconds", seconds, "--trace", f"{folder}/a.jsonl", "--values") == 0
    assert vicode("test", "record", "p/a.jsonl") == 0
    before = (gates / "tests/a.suite.json").read_bytes()
    assert vicode("test", "record", "q/a.jsonl") == 2
    assert "it has tests of Gate from ../p/a.jsonl" in capsys.readouterr().err
    assert (gates / "tests/a.suite.json").read_bytes() == before
    # The same trace may be recorded again.
    (gates / "q/a.jsonl").replace(gates / "p/a.jsonl")
    assert vicode("test", "record", str(gates / "p/a.jsonl")) == 0
    assert (gates / "tests/a.suite.json").read_bytes() != before


def test_an_edited_module_stays(gates: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("test", "gen", "gate.yaml") == 0
    assert vicode("test", "gen", "gate.yaml") == 0
    assert "kept" not in capsys.readouterr().out
    module = gates / "tests/test_gates_designs.py"
    edited = module.read_text(encoding="utf-8") + "# mine\n"
    module.write_text(edited, encoding="utf-8")
    assert vicode("test", "gen", "gate.yaml") == 0
    assert "kept tests/test_gates_designs.py, which differs from what" in capsys.readouterr().out
    assert module.read_text(encoding="utf-8") == edited


def test_a_file_that_is_no_suite_is_named_once(gates: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (gates / "tests").mkdir()
    (gates / "tests/a.suite.json").write_text("{}", encoding="utf-8")
    assert vicode("test", "mutate", "gate.yaml") == 2
    assert capsys.readouterr().err == 'vicode: tests/a.suite.json: it has no "vicode-suite": 1\n'


def test_a_run_of_another_design_is_no_test(gates: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("run", "gate.yaml", "--seconds", "2", "--trace", "run.jsonl", "--values") == 0
    (gates / "gate.yaml").write_text(GATE.replace("distance < 1}", "distance < 0.5}"), encoding="utf-8")
    assert vicode("test", "record", "run.jsonl") == 1
    assert "the design does not behave as recorded" in capsys.readouterr().err
    assert not (gates / "tests").exists()


def test_a_trace_without_values_is_no_test(gates: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("run", "gate.yaml", "--seconds", "1", "--trace", "run.jsonl") == 0
    assert vicode("test", "record", "run.jsonl") == 2
    assert "record the run with --values" in capsys.readouterr().err


def test_faults_that_no_test_notices_are_listed_with_their_lines(
    gates: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert vicode("test", "mutate", "gate.yaml") == 2
    assert "write one with 'vicode test gen gate.yaml'" in capsys.readouterr().err
    (gates / "traces").mkdir()
    assert vicode("run", "gate.yaml", "--seconds", "1", "--trace", "traces/run.jsonl", "--values") == 0
    capsys.readouterr()
    assert vicode("test", "mutate", "gate.yaml", "--traces", "traces") == 0
    first, *lines = capsys.readouterr().out.splitlines()
    assert first.startswith("Gate: ")
    assert "not noticed: transition to Closed removed (gate.yaml:18)" in lines
    assert vicode("test", "gen", "gate.yaml") == 0
    capsys.readouterr()
    assert vicode("test", "mutate", "gate.yaml") == 0
    assert "transition" not in capsys.readouterr().out


def test_a_suite_that_does_not_hold_is_not_measured(gates: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("test", "gen", "gate.yaml") == 0
    (gates / "gate.yaml").write_text(GATE.replace("< 4", "< 3"), encoding="utf-8")
    assert vicode("test", "mutate", "gate.yaml") == 2
    assert "tests/gate.suite.json does not hold for the design as it is" in capsys.readouterr().err


def test_code_that_is_not_portable_is_named(gates: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (gates / "gate.yaml").write_text(re.sub(r"actions: .*", CODE, GATE), encoding="utf-8")
    assert vicode("test", "gen", "gate.yaml") == 2
    assert "Gate cannot be tested: the reference interpreter cannot run it: Gate: " in capsys.readouterr().err
    assert not (gates / "tests").exists()
    (gates / "gate.yaml").write_text(GATE.replace("actions: [{set: {speed: 0.5}}]", CODE), encoding="utf-8")
    assert vicode("test", "gen", "gate.yaml") == 0
    out = capsys.readouterr().out
    assert "never: state Open of Gate (gate.yaml:13) active" in out
    assert "left out: steps with code that is not portable (Gate: " in out
