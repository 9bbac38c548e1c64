"""Each error is reported at its line: comments `# E:` in the files of cases/ give the expected codes."""

import re
from pathlib import Path

import pytest

from vicode.findings import Finding
from vicode.store import read_design, read_project_file

CASES = sorted((Path(__file__).parent / "cases").glob("*.yaml"))
EXPECTED = re.compile(r"# E: ((?:Y\d+ ?)+)")


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_errors_are_reported_at_their_lines(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    lines = text.splitlines()
    expected = {
        (number, code)
        for number, line in enumerate(lines, start=1)
        for match in EXPECTED.finditer(line)
        for code in match.group(1).split()
    }
    findings = _read(path.name, text)
    assert {(_line(finding), finding.rule.code) for finding in findings} == expected


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_findings_have_a_message_and_location(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    for finding in _read(path.name, text):
        assert finding.message
        assert finding.location is not None
        assert finding.location.file == path.name
        line = text.splitlines()[finding.location.line - 1]
        assert 1 <= finding.location.column <= len(line)
        assert finding.location.column + finding.location.length - 1 <= len(line)


def _read(name: str, text: str) -> tuple[Finding, ...]:
    read = read_project_file if name.startswith("project") else read_design
    return read(text, name).findings


def _line(finding: Finding) -> int:
    assert finding.location is not None
    return finding.location.line
