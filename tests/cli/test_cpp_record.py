"""The record of a robot in C++ is replayed in the designs, and a record of Python in C++."""

import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.cli.command_runner import vicode
from tests.cpp_tools import STANDARD, WARNINGS, find_gpp, outputs, start, write_unit
from tests.manual.code_blocks import ROOT, code_blocks


@pytest.fixture
def rescue(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the project, and the record of the program of the page."""
    shutil.copytree(ROOT / "designs/rescue", tmp_path / "designs/rescue")
    monkeypatch.chdir(tmp_path)
    program, _head, recorded, *_live = code_blocks(ROOT / "docs/cpp.md", "cpp")
    text, count = re.subn(r"    bica::run\(.*\n", lambda _match: recorded.text, program.text)
    assert count == 1
    # As fast as possible, and turning in a few iterations.
    text = text.replace("turning_speed * 0.02", "turning_speed").replace("20'000'000", "1'000'000")
    assert vicode("gen", "designs/rescue", "--language", "cpp", "--out", "out") == 0
    (tmp_path / "out/cpp/main.cpp").write_text(text, encoding="utf-8")
    write_unit(tmp_path / "out/cpp", "rescue")
    command = [find_gpp(), *STANDARD, *WARNINGS, "-I.", "main.cpp", "rescue_unit.cpp", "-o", "robot"]
    assert outputs([start(command, tmp_path / "out/cpp")]) == [""]
    subprocess.run([tmp_path / "out/cpp/robot"], check=True, timeout=60)
    return tmp_path


def test_a_record_of_cpp_is_replayed_in_the_designs(rescue: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _header, *iterations = [json.loads(line) for line in (rescue / "run.jsonl").read_text().splitlines()]
    assert len(iterations) > 5
    assert all(set(line["inputs"]) == {"Odometry", "Laser"} for line in iterations)
    assert [line["iteration"] for line in iterations] == list(range(1, len(iterations) + 1))
    capsys.readouterr()
    assert vicode("replay", "run.jsonl", "--design", "designs") == 0
    assert f"same states in {len(iterations)} iterations" in capsys.readouterr().out
    assert vicode("conform", "designs/rescue/drive_circle.yaml", "--inputs", "run.jsonl") == 0
    design = rescue / "designs/rescue/drive_circle.yaml"
    text = design.read_text(encoding="utf-8")
    assert "360" in text
    design.write_text(text.replace("360", "180"), encoding="utf-8")
    assert vicode("replay", "run.jsonl", "--design", "designs") == 1


def test_a_record_of_python_runs_in_cpp(rescue: Path, capsys: pytest.CaptureFixture[str]) -> None:
    design = "designs/rescue/walk_corridor.yaml"
    assert vicode("run", design, "--seconds", "10", "--trace", "python.jsonl", "--values") == 0
    capsys.readouterr()
    assert vicode("conform", design, "--inputs", "python.jsonl") == 0
    printed = capsys.readouterr().out.replace(", JavaScript", "")
    assert "Python, C++, XABSL and simulator agree in 500 iterations" in printed
