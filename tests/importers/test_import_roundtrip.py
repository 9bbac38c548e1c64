"""Importing a behavior and generating XABSL from the result gives the same program."""

import os
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given

from tests.importers.differential_harness import import_checked
from tests.importers.test_import_differential import NESTED, NESTING, SUPPORT, TEAM, TOGETHER, agents
from tests.importers.test_imported_designs import texts
from tests.strategies.xabsl_behaviors import behaviors
from tests.xabsl.xabsl_cases import CASES, PROGRAMS, load_texts, parse_words, read_probes
from vicode.check import check_project
from vicode.findings import Finding, Severity, render_text
from vicode.generators import generate
from vicode.model.project import Project
from vicode.xabsl import tree
from vicode.xabsl.compiler import compile_source
from vicode.xabsl.engine.code_writer import write_code
from vicode.xabsl.printer import print_file
from vicode.xabsl.source_loader import ProgramSource, load_source

PROBES = {
    probe.name: probe.files for probe in read_probes() if compile_source(load_texts(probe.files)).program is not None
}

ODD = {
    "names": texts(),
    "nested calls": {"agents.xabsl": agents("s.xabsl", "main.xabsl"), "s.xabsl": NESTED, "main.xabsl": NESTING},
    "teams": {
        "agents.xabsl": agents("s.xabsl", "main.xabsl", "support.xabsl"),
        "s.xabsl": TEAM,
        "main.xabsl": TOGETHER,
        "support.xabsl": SUPPORT,
    },
}
WRITTEN = [path for path in os.environ.get("VICODE_XABSL_BEHAVIORS", "").split(":") if path]
SLIPS = {"X651", "X652"}
"""Errors that the original compiler or its engines report."""


def texts_of(project: Project) -> dict[str, str]:
    """Generate the XABSL files of a project, by path relative to its folder."""
    files = generate(project, languages=["xabsl"])
    root = next(file.path for file in files if file.path.endswith("/agents.xabsl")).removesuffix("agents.xabsl")
    return {file.path.removeprefix(root): file.text for file in files}


def assert_is_the_same(source: ProgramSource) -> None:
    imported, before = import_checked(source)
    assert before.program is not None
    project = replace(imported.project, languages=("xabsl",))
    errors = [finding for finding in check_project(project) if finding.severity is Severity.ERROR]
    assert not errors, render_text(errors)
    after = compile_source(load_texts(texts_of(project)))
    assert after.program is not None, render_text(after.findings)
    assert parse_words(write_code(after.program)) == parse_words(write_code(before.program))
    assert after.program.title == (before.program.title or "behavior")
    assert _slips(after.findings) <= _slips(before.findings)
    known = {finding.rule.code for finding in before.findings}
    new = [
        finding
        for finding in after.findings
        if finding.rule.code not in known and finding.severity is not Severity.NOTE
    ]
    assert not new, render_text(new)


def _slips(findings: Iterable[Finding]) -> int:
    return sum(finding.rule.code in SLIPS for finding in findings)


@pytest.mark.parametrize("name", [name for name in PROGRAMS if (CASES / "programs" / name / "agents.xabsl").exists()])
def test_complete_programs(name: str) -> None:
    assert_is_the_same(load_source(CASES / "programs" / name / "agents.xabsl"))


@pytest.mark.parametrize("name", sorted(PROBES))
def test_tiny_programs(name: str) -> None:
    assert_is_the_same(load_texts(PROBES[name]))


@given(behaviors(with_functions=True))
def test_random_programs(files: dict[str, tree.FileNode]) -> None:
    assert_is_the_same(load_texts({name: print_file(file) for name, file in files.items()}))


@pytest.mark.parametrize("name", ODD)
def test_unusual_programs(name: str) -> None:
    assert_is_the_same(load_texts(ODD[name]))


@pytest.mark.parametrize("path", WRITTEN or [str(CASES / "programs" / "drive_circle" / "agents.xabsl")])
def test_team_behaviors(path: str) -> None:
    assert_is_the_same(load_source(Path(path)))
