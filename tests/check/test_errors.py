"""Finding errors alone, without rules that find only warnings."""

import shutil
from pathlib import Path

import pytest

from tests.check.test_rule_cases import CASES
from vicode.check import check_design, check_project, find_design_errors, find_errors
from vicode.findings import Severity
from vicode.store import open_project


@pytest.mark.parametrize("case", sorted(CASES.iterdir()), ids=lambda path: path.stem)
def test_errors_are_those_of_the_whole_check(case: Path, tmp_path: Path) -> None:
    folder = tmp_path / case.stem
    shutil.copytree(case, folder) if case.is_dir() else shutil.copy(case, folder.with_suffix(".yaml"))
    project = open_project(folder if case.is_dir() else tmp_path).project
    errors = [each for each in check_project(project) if each.severity is Severity.ERROR]
    assert list(find_errors(project)) == errors
    for design in project.designs:
        errors = [each for each in check_design(project, design) if each.severity is Severity.ERROR]
        assert list(find_design_errors(project, design)) == errors
