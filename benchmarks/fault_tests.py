"""Runs the tests that concern a planted fault, in the copy of the checkout that contains it."""

import os
import re
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from benchmarks.fault_table import Fault

_RUNTIME = (
    *("test_component_semantics", "test_arithmetic", "test_team", "test_component_errors", "test_int_inputs"),
    *("test_if_elif_equivalence", "test_observer"),
)
_GENERATED = ("test_generator_cases", "test_generated_behavior", "test_expression_evaluation", "test_int_ranges")
_CPP = ("test_cpp_generator", "test_cpp_library", "test_cpp_configurations")


def _files(folder: str, names: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(f"tests/{folder}/{name}.py" for name in names)


TESTS = {
    "vicode/bica/": _files("bica", _RUNTIME),
    "vicode/generators/cpp/": _files("generators", (*_GENERATED, *_CPP)),
    "vicode/generators/": _files("generators", (*_GENERATED, "test_xabsl_generator")),
    "templates/cpp/": _files("generators", _CPP),
    "vicode/simulation/": _files("simulation", ("test_worker",)),
}
"""The test files by the beginning of the fault's file; the first entry that fits.

tests/conformance is not among them: what it compares is the column `cases`.
"""

LONGEST_S = 3000
_TESTS_FAILED = 1
"""The exit code of pytest. Others are usage errors, errors of pytest and interruptions."""
_FAILED = re.compile(r"^(?:FAILED|ERROR) .*$", re.MULTILINE)


class FaultTests:
    """Runs tests in a copy of the checkout.

    Args:
        copy: The copy.
        faults: The faults to try. All their tests run once without a fault; those that fail are left out.

    Raises:
        ValueError: pytest does not end as it should.
    """

    def __init__(self, copy: Path, faults: Sequence[Fault]) -> None:
        self._copy = copy
        files = dict.fromkeys(file for fault in faults for file in _find_files(fault))
        code, output = self._call(list(files))
        failing = _FAILED.findall(output)
        if code and (code != _TESTS_FAILED or not failing):
            raise ValueError(f"without a fault, pytest ends with {code}: {output[-2000:]}")
        self._left_out = [option for line in failing for option in ("--deselect", line.split()[1])]
        if failing:
            print("left out, because they fail without a fault:", *failing, sep="\n  ", flush=True)

    def run(self, fault: Fault) -> dict[str, str]:
        """Run the tests until one fails; return it as "tests", or why nothing is known as "failed"."""
        code, output = self._call(["-x", *self._left_out, *_find_files(fault)])
        failed = _FAILED.findall(output)
        if code == 0:
            return {}
        if code != _TESTS_FAILED or not failed or "Timeout" in failed[0]:
            return {"failed": f"pytest ends with {code}: {output.strip()[-300:]}"}
        return {"tests": failed[0]}

    def _call(self, arguments: list[str]) -> tuple[int, str]:
        # pytest-timeout would end the tests of a busy machine.
        options = ["-q", "-n", "0", "--timeout", "0", "-m", "not browser and not nightly"]
        command = [sys.executable, "-m", "pytest", *options, *arguments]
        environment = {**os.environ, "PYTHONPATH": str(self._copy)}
        try:
            done = subprocess.run(
                command,
                cwd=self._copy,
                env=environment,
                capture_output=True,
                text=True,
                check=False,
                timeout=LONGEST_S,
            )
        except subprocess.TimeoutExpired:
            return -1, "the tests take too long"
        return done.returncode, done.stdout


def _find_files(fault: Fault) -> tuple[str, ...]:
    return next(files for start, files in TESTS.items() if fault.file.startswith(start))
