"""The comparison of languages of the editor: in a process of its own, on the design as it is in the editor."""

import asyncio
import json
import re
import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from vicode.conformance.process import ComparisonError, ComparisonProcess
from vicode.conformance.result import LanguageComparison, verdict
from vicode.model.design import CommonSection, Design
from vicode.model.project import Project
from vicode.simulation.isolation import isolation_problem
from vicode.store import open_project

PROJECT = """
vicode: 1
project: Counters
components:
  Eye: {outputs: {distance: float}}
"""
COUNTER = """
vicode: 1
component: Counter
uses: {eye: Eye}
outputs: {n: {type: int}}
initial: Near
states:
  Near:
    actions: [{set: {n: n + 1}}]
    transitions: [{to: Far, when: eye.distance > 7}]
  Far:
    actions: [{CODE}]
    transitions: [{to: Near, when: eye.distance < 3}]
"""


@pytest.fixture
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder in which programs create temporary folders."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder


def read_counter(folder: Path, code: str) -> tuple[Project, Design]:
    folder.mkdir(exist_ok=True)
    (folder / "project.yaml").write_text(PROJECT, encoding="utf-8")
    (folder / "counter.yaml").write_text(COUNTER.replace("{CODE}", code), encoding="utf-8")
    project = open_project(folder).project
    return project, project.designs[0]


def compare(
    folder: Path,
    code: str,
    on_language: Callable[[str], None] = lambda _language: None,
    *,
    change: Callable[[Design], Design] = lambda design: design,
    limit_s: float = 120,
) -> LanguageComparison:
    project, design = read_counter(folder, code)
    process = ComparisonProcess(
        project=project, design=change(design), folder=folder, on_language=on_language, limit_s=limit_s
    )
    return asyncio.run(process.run())


def test_the_design_of_the_editor_is_compared_and_not_its_file(tmp_path: Path, temporary: Path) -> None:
    def without_code(design: Design) -> Design:
        return replace(design, states=(design.states[0], replace(design.states[1], actions=())))

    languages: list[str] = []
    code = "{code: {python: self.n -= 1, cpp: n -= 2;}}"
    result = compare(tmp_path / "p", code, languages.append, change=without_code)
    assert re.fullmatch(
        r"reference, Python, C\+\+, XABSL(, JavaScript)? and simulator agree in 500 iterations of \d+ runs",
        verdict(result),
    )
    assert result.coverage is not None
    assert result.coverage.never == ()
    assert result.coverage.summary.startswith("2 of 2 guards true and false, 2 of 2 transitions, 2 of 2 states")
    assert [each for each in languages if each != "javascript"] == ["reference", "python", "cpp", "xabsl", "simulator"]
    assert not list(temporary.iterdir())
    assert sorted(path.name for path in (tmp_path / "p").iterdir()) == ["counter.yaml", "project.yaml"]


def test_a_difference_has_the_inputs_and_both_traces(tmp_path: Path) -> None:
    result = compare(tmp_path / "p", "{code: {python: self.n -= 1, cpp: n -= 2;}}")
    (difference,) = result.differences
    assert (difference.languages, difference.component, difference.field) == (
        ("reference", "cpp"),
        "Counter",
        "values.n",
    )
    assert [each.name for each in difference.inputs] == ["Eye.distance"]
    left, right = difference.rows[-1]
    assert left.text != right.text
    steps = [(left.component, left.state) for left, _right in difference.rows if left.state]
    assert steps[-1] == ("Counter", "Far")
    (absent,) = (each for each in result.absent if each.language != "javascript")
    assert (absent.language, absent.component, absent.path[:2]) == ("xabsl", "Counter", ("states", "Far"))


def test_code_that_does_not_compile_leaves_the_other_languages(tmp_path: Path) -> None:
    result = compare(tmp_path / "p", "{code: {python: self.n -= 1, cpp: no such thing;}}")
    assert {*result.languages} - {"javascript"} == {"reference", "python", "simulator"}
    (failed,) = result.failed
    assert failed.language == "cpp"
    assert failed.reason.startswith("the generated C++ does not compile\n")


def test_code_is_compiled_and_run_in_the_sandbox(tmp_path: Path) -> None:
    secret = tmp_path / "secret"
    secret.touch()
    code = {
        "python": f"import os\nself.n -= os.path.exists('{secret}')",
        "cpp": f'if (std::fopen("{secret}", "r")) n -= 2;\n#if __has_include("{secret}")\nn -= 4;\n#endif\n',
    }

    def run_in_each_iteration(design: Design) -> Design:
        """Inputs are chosen that avoid code which the reference interpreter cannot run: here none can."""
        return replace(design, common=CommonSection(actions=design.states[1].actions))

    result = compare(tmp_path / "p", json.dumps({"code": code}), change=run_in_each_iteration)
    # Without user namespaces, code sees the file, and each language counts differently.
    assert bool(result.differences) == bool(isolation_problem())
    assert set(result.languages) == {"python", "cpp", "simulator"}


def test_code_that_does_not_end_is_ended(tmp_path: Path, temporary: Path) -> None:
    with pytest.raises(ComparisonError, match="took longer than 3 s"):
        compare(tmp_path / "p", '{code: {python: "while True: pass", cpp: n -= 2;}}', limit_s=3)
    assert not list(temporary.iterdir())


def test_a_cancelled_comparison_leaves_nothing(tmp_path: Path, temporary: Path) -> None:
    project, design = read_counter(tmp_path / "p", '{code: {python: "while True: pass", cpp: n -= 2;}}')
    process = ComparisonProcess(project=project, design=design, folder=tmp_path / "p")
    process.on_language = lambda _language: process.cancel()
    with pytest.raises(ComparisonError, match="cancelled"):
        asyncio.run(process.run())
    assert not list(temporary.iterdir())
