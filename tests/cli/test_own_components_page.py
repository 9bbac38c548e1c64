"""docs/own-components.md: its example is sound, runs, and its tests pass."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.command_runner import vicode

ROOT = Path(__file__).parents[2]
_BLOCK = re.compile(r"```(?:yaml|python)\n(?:# (?P<file>\S+\.(?:yaml|py))\n)?(?P<text>.*?)```", re.DOTALL)


@pytest.fixture
def drive(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The files of the page, in a folder where we are."""
    page = (ROOT / "docs" / "own-components.md").read_text(encoding="utf-8")
    for block in _BLOCK.finditer(page):
        file = tmp_path / (block["file"] or "test_road.py")
        file.parent.mkdir(exist_ok=True)
        file.write_text(block["text"], encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_example_is_sound_and_runs(drive: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert sorted(path.name for path in drive.rglob("*.*")) == ["car.yaml", "project.yaml", "road.py", "test_road.py"]
    assert vicode("check", ".", "--strict") == 0
    assert vicode("run", "car.yaml", "--until-done") == 0
    out = capfd.readouterr().out
    assert "Car: Going → Standing" in out
    assert "stopped: done" in out
    assert "world: crashed False" in out


def test_its_tests_pass(drive: Path) -> None:
    code = "import test_road as t; print(len([f() for n, f in vars(t).items() if n.startswith('test_')]))"
    done = subprocess.run(
        [sys.executable, "-c", f"import sys; sys.path[:0] = [{str(drive)!r}, {str(ROOT)!r}]; {code}"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout) == (0, "2\n"), done.stderr


def test_the_page_is_found() -> None:
    assert "(own-components.md)" in (ROOT / "docs" / "design-format.md").read_text(encoding="utf-8")
