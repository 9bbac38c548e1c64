"""Lint warnings of a real linter are mapped back to the characters of each code block."""

import subprocess
from pathlib import Path

import pytest
from hypothesis import given

from tests.strategies.designs import designs
from vicode.findings import DesignPath
from vicode.model.design import Code, Declaration, Design, Guard, RunCode, State, Stay
from vicode.model.project import Enumeration, Project
from vicode.model.texts import iter_texts
from vicode.services import lint
from vicode.services.lint import LintWarnings, lint_design
from vicode.store import open_project

ROOT = Path(__file__).parents[2]
ACTION: DesignPath = ("states", "S", "actions", 0, "code", "python")
GUARD: DesignPath = ("states", "S", "transitions", 0, "code", "python")


def python(text: str) -> Code:
    return Code(texts=(("python", text),))


def design_of(action: str, *, module: str = "", guard: str = "return True\n") -> Design:
    state = State(
        name="S", actions=(RunCode(code=python(action)),), transitions=(Stay(guard=Guard(code=python(guard))),)
    )
    return Design(component="A", initial="S", module=python(module) if module else Code(), states=(state,))


def warnings_by_path(lints: LintWarnings, design: Design) -> dict[DesignPath, list[tuple[str, str]]]:
    texts = {located.path: located.text for located in iter_texts(design)}
    return {
        path: [(item.code, texts[path][item.start : item.end]) for item in warnings] for path, warnings in lints.items()
    }


def test_a_warning_is_at_its_characters_at_any_indentation() -> None:
    design = design_of("if True:\n    self.x = ünknown + 1\n", guard="\n    y = 1\n    return nothing\n")
    warnings = warnings_by_path(lint_design(Project(name="p"), design), design)
    assert warnings[ACTION] == [("F821", "ünknown")]
    assert ("F821", "nothing") in warnings[GUARD]
    assert ("F841", "y") in warnings[GUARD]


def test_declared_and_imported_names_are_defined() -> None:
    project = Project(
        name="p",
        enumerations=(Enumeration(name="Side", elements=(("left", ""),)),),
        constants=(Declaration(name="reach", initial="1"),),
    )
    design = design_of(
        "log.info(Side.left, reach, self.anything)\n", module="import logging\nlog = logging.getLogger()\n"
    )
    assert lint_design(project, design) == {}


def test_invalid_code_hides_no_warnings_about_other_code() -> None:
    design = design_of("if if\n", guard="return nothing\n")
    assert warnings_by_path(lint_design(Project(name="p"), design), design) == {GUARD: [("F821", "nothing")]}


def test_without_a_linter_there_are_no_warnings(monkeypatch: pytest.MonkeyPatch) -> None:
    def never(*_arguments: object, **_options: object) -> None:
        raise subprocess.TimeoutExpired("ruff", 2)

    monkeypatch.setattr(lint.subprocess, "run", never)
    assert lint_design(Project(name="p"), design_of("x\n")) == {}
    assert lint_design(Project(name="p"), design_of("x\n"), lambda _source, _known: "no json") == {}
    assert lint_design(Project(name="p"), design_of("x\n"), lambda _source, _known: '[{"location": 1}]') == {}


def test_the_shipped_designs_are_clean() -> None:
    project = open_project(ROOT / "designs" / "forward").project
    assert {design.component: lint_design(project, design) for design in project.designs} == {
        design.component: {} for design in project.designs
    }


@given(designs)
def test_every_line_of_the_module_maps_into_a_text(design: Design) -> None:
    """Let the linter report a warning at every position."""

    def complain(source: str, _known: tuple[str, ...]) -> str:
        rows = [{"location": {"row": at, "column": 3}, "code": "X", "message": ""} for at in range(source.count("\n"))]
        return lint.json.dumps(rows)

    texts = {located.path: located.text for located in iter_texts(design)}
    for path, lints in lint_design(Project(name="p"), design, complain).items():
        assert all(0 <= lint.start <= len(texts[path]) for lint in lints)
