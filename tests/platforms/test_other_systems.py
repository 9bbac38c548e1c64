"""Every command and the processes behind Simulate on what looks like Windows and macOS to vicode."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

PROJECT = Path(__file__).parents[2]
HERE = Path(__file__).parent
SHARED = ("tests/output", "tests/editor/session/test_recovery.py", "tests/editor/session/test_two_editors.py")
TESTS = {
    "windows": (*SHARED, "tests/commands", "tests/runs", "tests/simulation/test_limits.py"),
    "macos": (*SHARED, "tests/runs"),
}


@pytest.mark.parametrize("system", TESTS)
@pytest.mark.timeout(600)
def test_without_the_names_of_posix(system: str, tmp_path: Path) -> None:
    options = [
        "-q",
        "-p",
        "no:cacheprovider",
        "-m",
        "not browser and not nightly",
        "--basetemp",
        str(tmp_path / "base"),
    ]
    done = subprocess.run(
        [sys.executable, "-m", "pytest", *options, *TESTS[system]],
        cwd=PROJECT,
        env=_environment(system),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout[-5000:]


def _environment(system: str) -> dict[str, str]:
    kept = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST_")}
    return {**kept, "VICODE_TEST_SYSTEM": system, "PYTHONPATH": f"{HERE / 'other_system'}{os.pathsep}{PROJECT}"}


@pytest.mark.parametrize(("system", "code"), [("windows", "import fcntl"), ("macos", "ctypes.CDLL(None).prctl")])
def test_the_names_are_hidden_from_vicode(system: str, code: str, tmp_path: Path) -> None:
    """Otherwise, the tests above would prove nothing."""
    module = f"import ctypes\ntry:\n    {code}\nexcept (ImportError, AttributeError):\n    print('hidden')\n"
    program = f"exec(compile({module!r}, 'x', 'exec'), {{'__name__': 'vicode.probe'}})"
    done = subprocess.run(
        [sys.executable, "-c", program], env=_environment(system), capture_output=True, text=True, check=True
    )
    assert done.stdout == "hidden\n"
