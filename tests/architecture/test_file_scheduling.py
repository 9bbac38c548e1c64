"""A test process that dies costs a second try, not the run."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
OPTIONS = ["-n", "2", "--dist", "loadfile", "--max-worker-restart", "1", "--no-loadscope-reorder"]

ENDS_ITS_PROCESS = """
import os, pathlib

def test_before(): pass

def test_ends_its_process():
    tries = pathlib.Path(__file__).with_name("tries")
    count = int(tries.read_text()) if tries.exists() else 0
    tries.write_text(str(count + 1))
    if count < {times}: os._exit(1)

def test_after(): pass
"""


@pytest.mark.parametrize(("times", "result"), [(1, "21 passed"), (2, "1 failed")], ids=["once", "twice"])
def test_a_process_that_dies_late_does_not_hold_up_the_run(tmp_path: Path, times: int, result: str) -> None:
    for number in range(8):
        tests = "def test_one(): pass\n" + "def test_two(): pass\ndef test_three(): pass\n" * (number % 3)
        (tmp_path / f"test_file{number}.py").write_text(tests)
    (tmp_path / "test_last.py").write_text(ENDS_ITS_PROCESS.format(times=times))
    (tmp_path / "pytest.ini").write_text("[pytest]\n")
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("PYTEST", "VICODE"))}
    command = [sys.executable, "-m", "pytest", "-p", "xdist", "-p", "tests.file_scheduling", *OPTIONS]
    run = subprocess.run(
        [*command, str(tmp_path)],
        cwd=tmp_path,
        env={**environment, "PYTHONPATH": str(ROOT), "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"},
        check=False,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert result in run.stdout, run.stdout
    assert "test_ends_its_process ended its process and is tried again" in run.stdout
    assert (run.returncode == 0) == (times == 1), run.stdout
