"""Golden cases: design in, files out; each also proves that the code compiles, is formatted, and is always the same.

`pytest --accept` rewrites what is expected; read it as a diff.
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
from vicode.sync import find_hand_edits

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
    sources = {each: path.name for each, path in opened.files.items() if each}
    return generate(opened.project, sources=sources)


@pytest.mark.parametrize("name", NAMES)
def test_the_files_are_as_expected(name: str, accept: bool) -> None:
    folder = CASES / name / "generated"
    files = generate_case(name)
    if accept:
        shutil.rmtree(folder, ignore_errors=True)
        write_files(files, folder)
    found = {
        path.relative_to(folder).as_posix(): path.read_text("utf-8") for path in folder.rglob("*") if path.is_file()
    }
    assert {file.path: file.text for file in files} == found


@pytest.mark.parametrize("name", NAMES)
def test_the_code_is_what_the_tools_would_leave(name: str, tmp_path: Path) -> None:
    write_files(generate_case(name), tmp_path)
    assert format_diff(tmp_path) == ""
    assert lint_errors(tmp_path) == ""


@pytest.mark.parametrize("name", NAMES)
def test_the_code_compiles_and_its_marks_are_whole(name: str) -> None:
    for file in generate_case(name):
        comment = regions.get_comment_prefix(file.path)
        if file.path.endswith(".py"):
            compile(file.text, file.path, "exec")
        found = regions.find_regions(file.text, comment)
        assert not found.findings
        assert not any(regions.is_edited(region) for region in found.regions)
        assert regions.has_header(file.text)
        assert not regions.is_edited_outside_regions(file.text, comment)


@pytest.mark.parametrize("name", NAMES)
def test_the_same_project_gives_the_same_bytes(name: str) -> None:
    files = generate_case(name)
    assert files == generate_case(name)
    assert {file.path for file in files} == set(list_outputs(open_case(name).project))
    assert find_hand_edits([]) == ()
