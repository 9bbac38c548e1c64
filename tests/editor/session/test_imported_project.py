"""An imported XABSL behavior is drawn, completed, previewed, edited and saved like any project."""

from dataclasses import replace

import pytest

from tests.xabsl.xabsl_cases import CASES
from vicode.check import check_design
from vicode.cli.entry_point import main
from vicode.editor.session.code.code_preview import preview_code
from vicode.editor.view.scene import make_scene
from vicode.editor.view.table import make_table
from vicode.findings import Severity
from vicode.model.completion import complete_assignments, complete_expression
from vicode.model.design import Assign
from vicode.model.edits import rename_state
from vicode.model.expressions import build_scope
from vicode.model.rename import rename_alias
from vicode.store import OpenProject, find_design_files, open_project, read_design, save_design


@pytest.fixture(scope="module")
def opened(tmp_path_factory: pytest.TempPathFactory) -> OpenProject:
    out = tmp_path_factory.mktemp("imported") / "ours"
    assert main(["import", str(CASES / "programs" / "p1" / "agents.xabsl"), "--out", str(out)]) == 0
    return open_project(out)


def test_every_option_is_drawn_listed_and_previewed(opened: OpenProject) -> None:
    for design in opened.project.designs:
        findings = check_design(opened.project, design)
        scene = make_scene(opened.project, design, findings, 0)
        assert [state["name"] for state in scene["states"]] == [state.name for state in design.states]
        assert make_table(design, findings)["rows"]
        preview = preview_code(opened.project, design, {})
        assert any(file.path.endswith(".py") for file in preview.files)


def test_an_edit_changes_its_own_lines_only(opened: OpenProject) -> None:
    for path in find_design_files(opened.folder):
        text = path.read_text(encoding="utf-8")
        design = read_design(text).design
        assert design is not None
        assert save_design(design, text) == text
        state = design.states[0].name
        renamed = save_design(rename_state(design, state, "other_name"), text)
        changed = [(old, new) for old, new in zip(text.splitlines(), renamed.splitlines(), strict=True) if old != new]
        assert changed
        assert all(state in old and "other_name" in new for old, new in changed)


def test_variables_of_components_are_completed_and_renamed(opened: OpenProject) -> None:
    design, name = next(
        (design, name)
        for design in opened.project.designs
        for state in design.states
        for action in state.actions
        if isinstance(action, Assign)
        for name, _value in action.values
    )
    alias, _dot, variable = name.partition(".")
    offered = complete_expression(opened.project, design, f"{alias}.", len(alias) + 1)
    assert variable in {option.label for option in offered.options}
    settable = build_scope(opened.project, design).find_assignable(name)
    assert settable is not None
    pairs = complete_assignments(opened.project, design, [settable], f"{alias}.{variable[:1]}", len(alias) + 2)
    assert pairs.start == 0
    renamed = rename_alias(design, alias, "elsewhere")
    targets = {
        target
        for state in renamed.states
        for action in state.actions
        if isinstance(action, Assign)
        for target, _value in action.values
    }
    assert f"elsewhere.{variable}" in targets
    assert not any(target.startswith(f"{alias}.") for target in targets)


def test_invalid_assignments_to_components_are_findings(opened: OpenProject) -> None:
    design = opened.project.designs[0]
    state = design.states[0]
    alias = design.uses[0].alias
    bad = replace(state, actions=(Assign(values=((f"{alias}.nothing", "1"), ("nobody.x", "1"))),))
    findings = check_design(opened.project, replace(design, states=(bad, *design.states[1:])))
    errors = [finding for finding in findings if finding.severity is Severity.ERROR and finding.rule.code == "E303"]
    assert len(errors) == 2
