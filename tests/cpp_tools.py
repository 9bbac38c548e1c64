"""Compiles generated C++; tests that need a compiler use the fixture `gpp`."""

import shutil
import subprocess
from collections.abc import Iterable, Sequence
from pathlib import Path

import pytest

from tests.generators.code_tools import write_files
from vicode.check import check_project
from vicode.conformance.cpp import CppTools
from vicode.findings import Severity, render_text
from vicode.generators import generate
from vicode.store import locate_findings, open_project

WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror")
STANDARD = ("-std=c++17",)


def find_gpp() -> str:
    """The compiler; without one, the test is skipped."""
    if path := shutil.which("g++"):
        return path
    pytest.skip("g++ is missing: run .ci/gpp, or 'sudo apt install g++'")


def unoptimized(compiler: str) -> CppTools:
    """A compiler that saves time with large programs."""
    return CppTools(compiler=(compiler, "-O0"))


def write_project(folder: Path, out: Path) -> str:
    """Generate the C++ of a project without errors; return the name of its package."""
    opened = open_project(folder)
    findings = locate_findings([*opened.findings, *check_project(opened.project)], opened)
    # Other languages of the project have errors of their own.
    errors = [each for each in findings if each.severity is Severity.ERROR and each.rule.code != "D414"]
    assert not errors, render_text(errors)
    sources = {component: path.name for component, path in opened.files.items() if component}
    write_files(generate(opened.project, languages=["cpp"], sources=sources), out)
    (package,) = (path.name for path in (out / "cpp").iterdir() if path.is_dir())
    write_unit(out / "cpp", package)
    return package


def write_unit(folder: Path, package: str) -> None:
    """Write one translation unit with all sources of a package, which compiles faster than many."""
    sources = sorted(path.name for path in (folder / package).glob("*.cpp"))
    lines = [f'#include "{package}/components.hpp"', *(f'#include "{package}/{name}"' for name in sources)]
    (folder / f"{package}_unit.cpp").write_text("\n".join(lines) + "\n", encoding="utf-8")


def start(command: Sequence[str], folder: Path) -> subprocess.Popen[str]:
    return subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def outputs(started: Iterable[subprocess.Popen[str]]) -> list[str]:
    """What the commands printed, which run at the same time; each must succeed."""
    printed = []
    for process in started:
        output, _error = process.communicate(timeout=300)
        assert process.returncode == 0, f"{process.args}\n{output}"
        printed.append(output)
    return printed
