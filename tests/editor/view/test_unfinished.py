"""Warnings about a state that was just added are gray until it has a transition; errors never are."""

from dataclasses import replace

from tests.editor.session.conftest import open_design
from vicode.editor.view import make_scene
from vicode.editor.view.unfinished import is_unfinished
from vicode.findings import Finding, FindingSubject, get_rule
from vicode.model.design import Design, State
from vicode.model.edits import add_state, add_transition
from vicode.model.project import Project

DESIGN = Design(component="Player", initial="A", states=(State(name="A"),))


def finding(code: str, *path: str) -> Finding:
    return Finding(rule=get_rule(code), message="x", subject=FindingSubject(component="Player", path=path))


def test_a_state_is_unfinished_until_it_has_a_transition() -> None:
    document = open_design(DESIGN)
    assert document.shared.unfinished_states == frozenset()
    document.edit("add", lambda design: add_state(design, State(name="B")))
    assert document.shared.unfinished_states == {"B"}
    document.edit("connect", lambda design: add_transition(design, "B", "A"))
    assert document.shared.unfinished_states == frozenset()


def test_only_warnings_on_the_state_itself_are_gray() -> None:
    assert is_unfinished(finding("D422", "states", "B"), {"B"})
    assert not is_unfinished(finding("D422", "states", "A"), {"B"})
    assert not is_unfinished(finding("E303", "states", "B", "doc"), {"B"})
    assert not is_unfinished(replace(finding("D422"), subject=None), {"B"})


def test_the_drawing_says_severity_and_count_as_the_panel_does() -> None:
    found = (finding("E303", "states", "A"), finding("D422", "states", "A"), finding("E303", "states", "A", "doc"))
    (state,) = make_scene(Project(name="p"), DESIGN, found, 0, unfinished={"A"})["states"]
    assert (state["severity"], state["count"], state["unfinished"]) == ("error", 2, True)
    assert state["messages"] == ["error: x", "warning: x", "error: x"]
