"""Golden cases: designs and their generated files, which also compile, are formatted and are reproducible.

`pytest --accept` rewrites the expected files.
"""

import shutil
from pathlib import Path

import pytest

from tests.generators.code_tools import format_diff, lint_errors, write_files
from vicode import regions
from vicode.check import check_project
from vicode.findings import Severity, render_text
from vicode.generators import generate, list_outputs
from vicode.output import OutputFile
from vicode.store import OpenProject, locate_findings, open_project

CASES = Path(__file__).parent / "cases"
NAMES = sorted(path.name for path in CASES.iterdir() if path.is_dir())


def open_case(name: str) -> OpenProject:
    opened = open_project(CASES / name)
    findings = locate_findings([*opened.findings, *check_project(opened.project)], opened)
    errors = [finding for finding in findings if finding.severity is Severity.ERROR]
    assert not errors, render_text(errors)
    return opened


def generate_case(name: str) -> tuple[OutputFile, ...]:
    opened = open_case(name)
    sources = {component: path.name for component, path in opened.files.items() if component}
    return generate(opened.project, sources=sources)


@pytest.mark.parametrize("name", NAMES)
def test_files_match_expected_files(name: str, accept: bool) -> None:
    folder = CASES / name / "generated"
    files = generate_case(name)
    if accept:
        shutil.rmtree(folder, ignore_errors=True)
        write_files(files, folder)
    expected = {
        path.relative_to(folder).as_posix(): path.read_text("utf-8") for path in folder.rglob("*") if path.is_file()
    }
    assert {file.path: file.text for file in files} == expected


@pytest.mark.parametrize("name", NAMES)
def test_code_is_formatted_and_has_no_lint_errors(name: str, tmp_path: Path) -> None:
    write_files(generate_case(name), tmp_path)
    assert format_diff(tmp_path) == ""
    assert lint_errors(tmp_path) == ""


@pytest.mark.parametrize("name", NAMES)
def test_code_compiles_and_region_marks_are_valid(name: str) -> None:
    for file in generate_case(name):
        comment = regions.get_comment_prefix(file.path)
        if file.path.endswith(".py"):
            compile(file.text, file.path, "exec")
        result = regions.find_regions(file.text, comment)
        assert not result.findings
        assert not any(regions.is_edited(region) for region in result.regions)
        assert regions.has_header(file.text)


@pytest.mark.parametrize("name", NAMES)
def test_generation_is_reproducible(name: str) -> None:
    files = generate_case(name)
    assert files == generate_case(name)
    assert {file.path for file in files} == set(list_outputs(open_case(name).project))
