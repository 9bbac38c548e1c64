"""Marks are at the characters of their findings."""

from vicode.check import check_design
from vicode.editor.session.code.code_marks import CodeMark, mark_assignments, mark_text
from vicode.model.design import Assign, Declaration, Design, Guard, State, Stay
from vicode.model.project import Project
from vicode.services.lint import LintWarning


def shown(text: str, marks: tuple[CodeMark, ...]) -> list[tuple[str, str, int]]:
    return [(text[mark.start : mark.end], mark.severity, mark.line) for mark in marks]


def checked(state: State) -> Design:
    variables = (Declaration(name="n", initial="0"),)
    return Design(component="A", initial="S", variables=variables, states=(state,))


def test_a_guard_is_marked_at_its_characters() -> None:
    text = "n > 3\nand m"
    design = checked(State(name="S", transitions=(Stay(guard=Guard(when=text)),)))
    path = ("states", "S", "transitions", 0, "when")
    marks = mark_text(text, path, check_design(Project(name="p"), design))
    assert shown(text, marks) == [("m", "error", 2)]
    assert marks[0].message == "'m' is not declared – declare it or correct the name"


def test_assignments_are_marked_at_the_name_or_in_the_value() -> None:
    values = (("n", "k + 1"), ("q", "1"))
    design = checked(State(name="S", actions=(Assign(values=values),)))
    text = "n = k + 1\n  q =  1"
    marks = mark_assignments(text, ("states", "S", "actions", 0, "set"), check_design(Project(name="p"), design))
    assert shown(text, marks) == [("k", "error", 1), ("q", "error", 2)]


def test_lint_warnings_have_severity_warning() -> None:
    marks = mark_text("foo()\n", (), (), [LintWarning(start=0, end=3, code="F821", message="Undefined name `foo`")])
    assert shown("foo()\n", marks) == [("foo", "warning", 1)]
    assert "F821" in marks[0].message


def test_a_span_beyond_the_text_is_clamped() -> None:
    marks = mark_text("ab", (), (), [LintWarning(start=1, end=99, code="X", message="")])
    assert shown("ab", marks) == [("b", "warning", 1)]
