"""The words say every difference, each once: empty only for equal values, and never the same on both sides."""

import copy
import random
from collections import Counter
from dataclasses import fields, is_dataclass
from typing import Any

import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.strategies.commented_texts import commented_texts
from tests.strategies.designs import projects
from tests.strategies.designs import written_designs as designs
from tests.strategies.field_changes import NOT_WRITTEN, full_value, iter_changes
from tests.strategies.value_edits import ValueEdit, draw_edit
from vicode.model import design as design_model
from vicode.model.design import Design
from vicode.model.diff import Change, ChangeKind, changed_lines, describe_change, diff_designs, diff_projects
from vicode.model.project import Project
from vicode.services.design_diff.file_differences import FileDifference, compare_pair
from vicode.services.design_diff.file_pairs import FileVersion, VersionPair

SINGLE = {"insert": "+", "remove": "-", "regroup": ">"}


def edits(values: Any) -> Any:
    """Pairs of a value and an edit of it."""
    return st.tuples(values, values, st.integers(0, 2**32)).map(
        lambda drawn: (drawn[0], draw_edit(random.Random(drawn[2]), drawn[0], drawn[1]))
    )


def assert_sound(changes: tuple[Change, ...]) -> None:
    """No change has the same text on both sides, and no item is both removed and added."""
    signed = Counter[str](), Counter[str]()
    for change in changes:
        line = describe_change(change)
        assert "\n" not in line
        assert change.old != change.new or change.kind in (ChangeKind.ADDED, ChangeKind.REMOVED)
        if change.kind in (ChangeKind.CHANGED, ChangeKind.MOVED):
            old, arrow, new = line.rpartition(" → ")
            # The old value may end as the new one, such as "cpp: go()" and "go()".
            label = (change.subject or change.attribute).removeprefix("transition ")
            assert (arrow and not old.endswith(f"{label}: {new}")) or changed_lines(change)
        if change.kind in (ChangeKind.ADDED, ChangeKind.REMOVED):
            signed[change.kind is ChangeKind.ADDED][line[2:]] += 1
    assert not signed[0] & signed[1]


def assert_said_once(edit: ValueEdit, changes: tuple[Change, ...]) -> None:
    signs = [describe_change(change)[0] for change in changes]
    if edit.kind in SINGLE:
        assert signs == [SINGLE[edit.kind]]
    elif edit.kind == "move":
        assert signs in ([">"], ["~"])


@given(edits(designs))
def test_each_edit_of_a_design_is_said_once(case: tuple[Any, ValueEdit | None]) -> None:
    old, edit = case
    changes = diff_designs(old, old if edit is None else edit.value)
    assert bool(changes) == (edit is not None)
    assert_sound(changes)
    if edit is not None:
        assert_said_once(edit, changes)


@given(edits(projects))
def test_each_edit_of_a_project_is_said_once(case: tuple[Any, ValueEdit | None]) -> None:
    old, edit = case
    changes = diff_projects(old, old if edit is None else edit.value)
    assert bool(changes) == (edit is not None)
    assert_sound(changes)
    if edit is not None:
        assert_said_once(edit, changes)


def dataclasses_in(value: Any) -> set[type]:
    inner = [getattr(value, field.name) for field in fields(value)] if is_dataclass(value) else value
    below = (dataclasses_in(each) for each in inner) if is_dataclass(value) or isinstance(value, tuple) else ()
    return set().union(*below, {type(value)} if is_dataclass(value) else ())


def test_a_change_of_any_field_of_a_design_is_a_difference() -> None:
    design = full_value(Design)
    declared = {each for each in vars(design_model).values() if isinstance(each, type) and is_dataclass(each)}
    assert dataclasses_in(design) == declared
    assert diff_designs(design, full_value(Design)) == ()
    changes = list(iter_changes(design))
    assert {step for place, _changed in changes for step in place if isinstance(step, str)} == {
        field.name for kind in declared for field in fields(kind) if field.name != NOT_WRITTEN
    }
    for place, other in changes:
        for old, new in ((design, other), (other, design)):
            assert diff_designs(old, new) != (), place
            assert_sound(diff_designs(old, new))


def test_a_change_of_any_field_of_a_project_is_a_difference() -> None:
    project = full_value(Project)
    assert diff_projects(project, full_value(Project)) == ()
    # Designs are compared each by itself, files that cannot be read as texts.
    for place, other in iter_changes(project, frozenset({"designs", "unreadable"})):
        # A profile sets it in the components of a run, no project does.
        if (place[0], place[2:3]) != ("components", ("remote",)):
            assert diff_projects(project, other) != (), place
            assert diff_projects(other, project) != (), place


@given(designs, st.randoms(use_true_random=False))
def test_a_change_of_one_field_is_a_difference(design: Design, chance: random.Random) -> None:
    assert diff_designs(design, copy.deepcopy(design)) == ()
    place, other = chance.choice(list(iter_changes(design)))
    assert diff_designs(design, other) != (), place


@given(designs, designs)
def test_the_words_of_different_designs_are_sound(old: Any, new: Any) -> None:
    changes = diff_designs(old, new)
    assert bool(changes) == (old != new)
    assert_sound(changes)
    assert_sound(diff_designs(new, old))


def compare_texts(old: str, new: str) -> FileDifference:
    versions = (FileVersion(name="a.yaml", content=text.encode()) for text in (old, new))
    return compare_pair(VersionPair(old=next(versions), new=next(versions), is_explicit=True))


def yaml_content(text: str) -> list[tuple[str, str]]:
    """What YAML reads: neither comments nor notation."""
    return [(type(event).__name__, getattr(event, "value", "")) for event in yaml.parse(text, yaml.SafeLoader)]


@settings(max_examples=settings().max_examples // 2)
@given(commented_texts(), st.integers(0, 2**32))
def test_texts_without_words_have_the_same_content(text: str, seed: int) -> None:
    chance = random.Random(seed)
    lines = text.splitlines(keepends=True)
    at = chance.randrange(len(lines))
    indent = lines[at][: len(lines[at]) - len(lines[at].lstrip())]
    edited = chance.choice(
        (
            [*lines[:at], f"{indent}colour: red\n", *lines[at:]],
            [*lines[:at], f"{indent}# comment\n", *lines[at:]],
            [*lines[:at], lines[at].replace(":", "s:", 1), *lines[at + 1 :]],
        )
    )
    difference = compare_texts(text, "".join(edited))
    if not difference.errors:
        is_same = yaml_content(text) == yaml_content("".join(edited))
        assert bool(difference.changes) != is_same
        assert any("only comments" in line for line in difference.lines()) == (is_same and edited != lines)
