"""Designs with expected codes in comments at the end of the line, such as `# E: D421 D422`."""

import re
import shutil
from pathlib import Path

import pytest

from vicode.check import check_project
from vicode.findings import Finding, render_text
from vicode.store import locate_findings, open_project

CASES = Path(__file__).parent / "cases"
EXPECTED = re.compile(r"# E: ([A-Z0-9 ]+)$")

Codes = set[tuple[str, int, str]]
"""File name, line, code."""


@pytest.mark.parametrize("case", sorted(CASES.iterdir()), ids=lambda path: path.stem)
def test_findings_are_on_the_expected_lines(case: Path, tmp_path: Path) -> None:
    folder = tmp_path / case.stem
    if case.is_dir():
        shutil.copytree(case, folder)
    else:
        folder.mkdir()
        shutil.copy(case, folder)
    opened = open_project(folder)
    findings = locate_findings((*opened.findings, *check_project(opened.project)), opened)
    assert _found(findings) == _expected(folder), render_text(findings)


def _expected(folder: Path) -> Codes:
    return {
        (file.name, number, code)
        for file in folder.iterdir()
        for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), start=1)
        if (match := EXPECTED.search(line))
        for code in match.group(1).split()
    }


def _found(findings: tuple[Finding, ...]) -> Codes:
    locations = [(finding.location, finding.rule.code) for finding in findings]
    return {
        (Path(location.file).name, location.line, code) if location else ("", 0, code) for location, code in locations
    }
