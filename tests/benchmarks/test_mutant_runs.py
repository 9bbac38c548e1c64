"""Only a failed test kills a mutant, and the budget of tests includes what prepares them."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from benchmarks.mutants import Mutant, Reach, choose_tests, read_durations

ROOT = Path(__file__).parents[2]
SAMPLE = """\
def count(limit: int) -> int:
    index = 0
    while index < limit:
        index += 1
    unused = [3]
    return index
FIRST = [1][0]
"""
TEST = "from vicode.sample import count\n\ndef test_count() -> None:\n    assert (count(0), count(4)) == (0, 4)\n"


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """A checkout of one module and one test."""
    files = {"vicode/__init__.py": "", "vicode/sample.py": SAMPLE, "tests/test_count.py": TEST, "pytest.ini": ""}
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    (tmp_path / "benchmarks").mkdir()
    shutil.copy2(ROOT / "benchmarks" / "mutants.py", tmp_path / "benchmarks")
    subprocess.run(["git", "init", "-q"], cwd=tmp_path, check=True)
    return tmp_path


def run(checkout: Path, at: str, tests: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "benchmarks.mutants", "--at", at, "--limit", "2", "--tests", tests]
    return subprocess.run(command, cwd=checkout, capture_output=True, text=True, check=False)


def test_only_a_failed_test_kills(checkout: Path) -> None:
    lines = run(checkout, "vicode/sample.py", "tests").stdout.splitlines()
    # Killed are `index = 1`, `<=`, `while False`, `return None` and `[1][1]`; two loops never end.
    assert [line for line in lines if line[0] in "RSN+"] == [
        "Reached the time limit (1 tests): vicode/sample.py:3",
        "+     while True:",
        "Reached the time limit (1 tests): vicode/sample.py:4",
        "+         pass",
        "Survived (1 tests): vicode/sample.py:4",
        "+         index += 2",
        "Survived (1 tests): vicode/sample.py:5",
        "+     unused = [4]",
        "Survived (1 tests): vicode/sample.py:7",
        "+ FIRST = [2][0]",
    ]
    assert lines[-1] == "10 mutants: 5 killed, 3 survived, 2 reached the time limit, 0 not run."


def test_tests_must_pass_without_a_mutant(checkout: Path) -> None:
    (checkout / "tests" / "test_fails.py").write_text("def test_fails() -> None:\n    assert False\n")
    for tests, outcome in (("tests/test_missing.py", "not run"), ("tests/test_fails.py", "killed")):
        ended = run(checkout, "vicode/sample.py:6", tests)
        assert ended.returncode == 1
        assert ended.stderr.startswith(f"Without a mutant, the tests are {outcome}:")


def test_a_mutant_that_no_test_meets_is_not_killed(checkout: Path) -> None:
    """A test that the mutant renames is not found."""
    named = "import pytest\nfrom vicode.sample import count\n\n@pytest.mark.parametrize('end', [count(4)])\n"
    (checkout / "tests" / "test_named.py").write_text(f"{named}def test_end(end: int) -> None: ...\n")
    ended = run(checkout, "vicode/sample.py:6", "tests/test_named.py::test_end[4]")
    assert ended.stdout.splitlines()[-1] == "1 mutants: 0 killed, 0 survived, 0 reached the time limit, 1 not run."


def test_the_budget_includes_the_set_up() -> None:
    report = """
2.00s setup    tests/store/test_a.py::test_first
0.10s call     tests/store/test_a.py::test_first
0.50s call     tests/store/test_a.py::test_second[1 x]
0.25s teardown tests/store/test_a.py::test_second[1 x]
1.00s call     tests/store/test_b.py::test_other
"""
    seconds, setups = read_durations(report)
    a = ["tests/store/test_a.py::test_first", "tests/store/test_a.py::test_second[1 x]"]
    b = "tests/store/test_b.py::test_other"
    reach = Reach({"vicode/store/x.py:1": {*a, b}}, seconds, setups)
    mutant = Mutant("vicode/store/x.py", 1, 1, 0, 0, "")
    chosen = [choose_tests(mutant, reach, budget)[0] for budget in (0.9, 1.5, 2.5, 3.1, 4)]
    assert chosen == [[], [b], [b], [b, a[0]], [b, *a]]
