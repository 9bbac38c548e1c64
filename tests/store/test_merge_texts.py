"""Merges of texts: comments of both sides survive, conflicts are marked around exactly the entries in conflict."""

from dataclasses import replace

import pytest
from hypothesis import assume, given, settings

from tests.strategies.designs import designs, projects
from vicode.model.design import Design
from vicode.model.merge import merge_designs
from vicode.model.project import Project
from vicode.store import (
    find_conflicts,
    merge_file_texts,
    read_design,
    resolve_conflicts,
    save_design,
    save_project_file,
)

BASE = """\
# Plays.
vicode: 1
component: Player
initial: Search
states:
  # Turns until it sees the ball.
  Search:
    at: [0, 0]
    transitions:
    - {to: Follow, when: ball.seen}  # soon
    - {to: Wait, after: 5}
  Follow:
    at: [100, 0]
    doc: walks
    transitions: [{to: Search, when: not ball.seen}]
  Wait:
    at: [0, 100]
    transitions: [{to: Search, after: 1}]
"""


def edited(*replacements: tuple[str, str]) -> str:
    text = BASE
    for old, new in replacements:
        assert old in text
        text = text.replace(old, new)
    return text


def merged(ours: str, theirs: str, base: str = BASE) -> str:
    """Merge without conflicts."""
    result = merge_file_texts(base, ours, theirs)
    assert result is not None
    assert result.conflicts == ()
    return result.text


def test_comments_of_both_sides_survive() -> None:
    ours = edited(("ball.seen}  # soon", "ball.near}  # later"))
    theirs = edited(("doc: walks", "# It is fast.\n    doc: runs"), ("Wait:\n", "Wait:  # tired\n"))
    assert merged(ours, theirs) == edited(
        ("ball.seen}  # soon", "ball.near}  # later"),
        ("doc: walks", "# It is fast.\n    doc: runs"),
        ("Wait:\n", "Wait:  # tired\n"),
    )


def test_changes_of_neighboring_lines_are_merged() -> None:
    ours = edited(("when: ball.seen}", "when: ball.near}"))
    theirs = edited(("after: 5", "after: 6"))
    assert merged(ours, theirs) == edited(("when: ball.seen}", "when: ball.near}"), ("after: 5", "after: 6"))


def test_both_sides_add_a_state_at_the_same_place() -> None:
    end = "transitions: [{to: Search, after: 1}]\n"
    ours = edited((end, f"{end}  # mine\n  Kick: {{final: true}}\n"))
    theirs = edited((end, f"{end}  # yours\n  Shoot: {{final: true}}\n"))
    assert merged(ours, theirs) == edited(
        (end, f"{end}  # mine\n  Kick: {{final: true}}\n  # yours\n  Shoot: {{final: true}}\n")
    )


def test_positions_that_both_sides_changed_are_ours() -> None:
    ours, theirs = edited(("[0, 0]", "[1, 1]")), edited(("[0, 0]", "[2, 2]"), ("walks", "runs"))
    assert merged(ours, theirs) == edited(("[0, 0]", "[1, 1]"), ("walks", "runs"))


def test_windows_line_ends_are_kept() -> None:
    ours = edited(("when: ball.seen}", "when: ball.near}")).replace("\n", "\r\n")
    expected = edited(("when: ball.seen}", "when: ball.near}"), ("after: 5", "after: 6")).replace("\n", "\r\n")
    assert merged(ours, edited(("after: 5", "after: 6"))) == expected


def test_a_conflict_is_marked_around_its_entry() -> None:
    ours = edited(("when: ball.seen}", "when: ball.near}"), ("walks", "strolls"))
    theirs = edited(("when: ball.seen}", "when: ball.far}"), ("after: 5", "after: 6"))
    result = merge_file_texts(BASE, ours, theirs)
    assert result is not None
    assert result.conflicts == ("transition 1 of state Search, when",)
    marked = """\
<<<<<<< ours: transition 1 of state Search, when
    - {to: Follow, when: ball.near}  # soon
=======
    - {to: Follow, when: ball.far}  # soon
>>>>>>> theirs: transition 1 of state Search, when
"""
    assert result.text == edited(
        ("    - {to: Follow, when: ball.seen}  # soon\n", marked), ("after: 5", "after: 6"), ("walks", "strolls")
    )


def test_conflicts_in_neighboring_lines_are_separate() -> None:
    ours = edited(("when: ball.seen}", "when: a}"), ("after: 5", "after: 6"))
    theirs = edited(("when: ball.seen}", "when: b}"), ("after: 5", "after: 7"))
    result = merge_file_texts(BASE, ours, theirs)
    assert result is not None
    first, second = find_conflicts(result.text)
    mixed = resolve_conflicts(resolve_conflicts(result.text, [second], takes_theirs=True), [first], takes_theirs=False)
    assert mixed == edited(("when: ball.seen}", "when: a}"), ("after: 5", "after: 7"))


def test_conflicts_in_one_line_are_one() -> None:
    ours = edited(("{to: Wait, after: 5}", "{to: Wait, after: 6, doc: x}"))
    theirs = edited(("{to: Wait, after: 5}", "{to: Wait, after: 7, doc: y}"))
    result = merge_file_texts(BASE, ours, theirs)
    assert result is not None
    assert result.conflicts == ("transition 2 of state Search, after, transition 2 of state Search, description",)


def test_all_parts_of_a_rename_are_one_conflict() -> None:
    ours, theirs = BASE.replace("Search", "Look"), BASE.replace("Search", "Seek")
    result = merge_file_texts(BASE, ours, theirs)
    assert result is not None
    assert result.conflicts == ("name of state Search",)
    (conflict,) = find_conflicts(result.text)
    assert resolve_conflicts(result.text, [conflict], takes_theirs=False) == ours
    assert resolve_conflicts(result.text, [conflict], takes_theirs=True) == theirs


def test_a_removed_state_that_the_other_side_needs() -> None:
    ours = edited(("    - {to: Wait, after: 5}\n", ""))
    ours = ours[: ours.index("  Wait:\n")]
    theirs = edited(("not ball.seen}]", "not ball.seen}, {to: Wait}]"))
    result = merge_file_texts(BASE, ours, theirs)
    assert result is not None
    assert result.conflicts == ("state Wait",)
    (conflict,) = find_conflicts(result.text)
    assert conflict.ours == ""
    assert conflict.theirs.startswith("  Wait:\n    at: [0, 100]\n")


def test_each_conflict_is_one_finding_at_its_line() -> None:
    ours = edited(("when: ball.seen}", "when: a}"), ("walks", "runs"))
    theirs = edited(("when: ball.seen}", "when: b}"), ("    doc: walks\n", ""))
    result = merge_file_texts(BASE, ours, theirs)
    assert result is not None
    read = read_design(result.text, "player.yaml")
    assert read.design is None
    lines = [(each.rule.code, each.location.line if each.location else 0, each.message) for each in read.findings]
    first = "unresolved merge conflict in transition 1 of state Search, when:"
    assert lines == [
        ("Y113", 10, f"{first} ours '- {{to: Follow, when: a}} # soon', theirs '- {{to: Follow, when: b}} # soon'"),
        ("Y113", 18, "unresolved merge conflict in description of state Follow: ours 'doc: runs', theirs nothing"),
    ]


def test_conflicts_that_git_wrote() -> None:
    text = "a\n<<<<<<< HEAD\nb\n||||||| base\nc\n=======\nd\n>>>>>>> topic\ne\n<<<<<<< HEAD\nf\n=======\n>>>>>>> topic"
    first, second = find_conflicts(text)
    assert (first.name, first.ours, first.theirs) == ("", "b\n", "d\n")
    assert (second.ours, second.theirs) == ("f\n", "")
    assert resolve_conflicts(text, [first, second], takes_theirs=True) == "a\nd\ne\n"
    assert resolve_conflicts(text, [second], takes_theirs=False).endswith("e\nf\n")


@pytest.mark.parametrize("text", ["<<<<<<< a\nb\n", "<<<<<<< a\n>>>>>>> b\n", "=======\n>>>>>>> b\n", "  <<<<<<< a\n"])
def test_incomplete_markers_are_no_conflict(text: str) -> None:
    assert find_conflicts(text) == ()


def test_versions_with_errors_are_not_merged() -> None:
    assert merge_file_texts(BASE, BASE, f"{BASE}unknown: 1\n") is None
    assert merge_file_texts(BASE, "states: [", BASE) is None


def test_both_sides_add_the_file() -> None:
    assert merged(BASE, BASE, base="") == BASE
    result = merge_file_texts("", BASE, edited(("after: 5", "after: 6")))
    assert result is not None
    assert len(result.conflicts) == 1


def test_project_files() -> None:
    base = "vicode: 1\nproject: P\n\nconstants:\n  a: 1  # one\n  b: 2\n"
    ours, theirs = base.replace("a: 1", "a: 3"), base.replace("b: 2", "b: 4\n  # new\n  c: 5")
    result = merge_file_texts(base, ours, theirs, is_project_file=True)
    assert result is not None
    assert result.text == "vicode: 1\nproject: P\n\nconstants:\n  a: 3  # one\n  b: 4\n  # new\n  c: 5\n"
    result = merge_file_texts(base, ours, base.replace("a: 1", "a: 9"), is_project_file=True)
    assert result is not None
    assert result.conflicts == ("value of constant a",)


@given(designs, designs, designs)
@settings(max_examples=settings().max_examples // 4)
def test_each_side_of_all_conflicts_is_a_merge(base: Design, ours: Design, theirs: Design) -> None:
    ours, theirs = replace(ours, component=base.component), replace(theirs, component=base.component)
    result = merge_file_texts(save_design(base), save_design(ours), save_design(theirs))
    assume(result is not None)
    assert result is not None
    conflicts = find_conflicts(result.text)
    taken = read_design(resolve_conflicts(result.text, conflicts, takes_theirs=False))
    assert taken.design == merge_designs(base, ours, theirs).design
    assert not read_design(resolve_conflicts(result.text, conflicts, takes_theirs=True)).findings


@given(projects, projects, projects)
@settings(max_examples=settings().max_examples // 4)
def test_projects_are_merged(base: Project, ours: Project, theirs: Project) -> None:
    texts = [save_project_file(each) for each in (base, ours, theirs)]
    result = merge_file_texts(*texts, is_project_file=True)
    assert result is None or len(find_conflicts(result.text)) == len(result.conflicts)
