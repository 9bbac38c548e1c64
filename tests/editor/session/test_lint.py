"""A real linter reads the pieces of a design as one module; its words come back to the right characters."""

import subprocess
from pathlib import Path

import pytest
from hypothesis import given

from tests.strategies.designs import designs
from vicode.editor.session import lint
from vicode.editor.session.lint import LintWarnings, lint_design
from vicode.findings import DesignPath as ThingPath
from vicode.model.design import Code, Declaration, Design, Guard, RunCode, State, Stay
from vicode.model.project import Enumeration, Project
from vicode.model.texts import iter_texts
from vicode.store import open_project

ROOT = Path(__file__).parents[3]
ACTION: ThingPath = ("states", "S", "actions", 0, "code", "python")
GUARD: ThingPath = ("states", "S", "transitions", 0, "code", "python")


def python(text: str) -> Code:
    return Code(texts=(("python", text),))


def design_of(action: str, *, module: str = "", guard: str = "return True\n") -> Design:
    state = State(
        name="S", actions=(RunCode(code=python(action)),), transitions=(Stay(guard=Guard(code=python(guard))),)
    )
    return Design(component="A", initial="S", module=python(module) if module else Code(), states=(state,))


def remarks(lints: LintWarnings, design: Design) -> dict[ThingPath, list[tuple[str, str]]]:
    texts = {located.path: located.text for located in iter_texts(design)}
    return {path: [(item.code, texts[path][item.start : item.end]) for item in found] for path, found in lints.items()}


def test_a_remark_stands_at_its_characters_whatever_the_margin() -> None:
    design = design_of("if True:\n    self.x = ünknown + 1\n", guard="\n    y = 1\n    return nothing\n")
    found = remarks(lint_design(Project(name="p"), design), design)
    assert found[ACTION] == [("F821", "ünknown")]
    assert ("F821", "nothing") in found[GUARD]
    assert ("F841", "y") in found[GUARD]


def test_what_the_project_declares_and_the_module_imports_is_known() -> None:
    project = Project(
        name="p",
        enumerations=(Enumeration(name="Side", elements=(("left", ""),)),),
        constants=(Declaration(name="reach", initial="1"),),
    )
    design = design_of(
        "log.info(Side.left, reach, self.anything)\n", module="import logging\nlog = logging.getLogger()\n"
    )
    assert lint_design(project, design) == {}


def test_code_that_does_not_parse_hides_no_remark_on_other_code() -> None:
    design = design_of("if if\n", guard="return nothing\n")
    assert remarks(lint_design(Project(name="p"), design), design) == {GUARD: [("F821", "nothing")]}


def test_without_a_linter_there_are_no_remarks(monkeypatch: pytest.MonkeyPatch) -> None:
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
def test_any_line_of_the_module_leads_into_a_text_of_the_design(design: Design) -> None:
    """A linter that complains about everything: every remark lies inside the text it is said of."""

    def complain(source: str, _known: tuple[str, ...]) -> str:
        rows = [{"location": {"row": at, "column": 3}, "code": "X", "message": ""} for at in range(source.count("\n"))]
        return lint.json.dumps(rows)

    texts = {located.path: located.text for located in iter_texts(design)}
    for path, lints in lint_design(Project(name="p"), design, complain).items():
        assert all(0 <= lint.start <= len(texts[path]) for lint in lints)
