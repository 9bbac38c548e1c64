"""No edit loses content that was not understood, or comments of what it keeps."""

from collections.abc import Callable
from dataclasses import replace

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from tests.store.test_save_edits import EDITS
from tests.strategies.commented_texts import fewer_examples
from tests.strategies.designs import designs_with_states
from tests.strategies.strange_texts import find_marks, strange_texts
from vicode.model.design import DecisionGroup, Design, Guard, State
from vicode.store import UnreadContentError, read_design, read_project_file, save_design, save_project_file


def _grouped(state: State) -> State:
    return replace(state, transitions=(DecisionGroup(guard=Guard(when="ready"), then=state.transitions),))


def _ungrouped(state: State) -> State:
    groups = (item for item in state.transitions if isinstance(item, DecisionGroup))
    return replace(state, transitions=tuple(inner for group in groups for inner in group.then))


_EDITS: dict[str, Callable[[State], State]] = {
    **EDITS,
    "grouped": _grouped,
    "ungrouped": _ungrouped,
    "renamed": lambda state: replace(state, name="Renamed"),
    "no position": lambda state: replace(state, at=None),
}

HEAD = "vicode: 1\ncomponent: Player\ninitial: A\n"


@given(strange_texts(), st.data(), st.sampled_from(sorted(_EDITS)))
def test_an_edit_keeps_what_was_not_understood_or_is_refused(text: str, data: st.DataObject, edit: str) -> None:
    design = _design_in(text)
    number = data.draw(st.integers(0, len(design.states) - 1))
    _assert_kept(_with_state(design, number, _EDITS[edit](design.states[number])), text)


@fewer_examples
@given(strange_texts(), designs_with_states)
def test_any_other_design_keeps_it_or_is_refused(text: str, new: Design) -> None:
    _assert_kept(new, text)


@pytest.mark.parametrize("edit", sorted({*_EDITS} - {"no transitions"}))
@pytest.mark.parametrize(
    "state",
    [
        "{at: [1, 2], transitons: [{to: B}], transitions: [{to: B, when: x}]}",
        "{doc: a, doc: b, transitions: [{to: B, when: x}]}",
        "\n    doc: a\n    transitons:\n      - to: B\n    transitions:\n      - {to: B, wen: y, when: x}",
    ],
)
def test_an_edit_of_a_state_keeps_its_unknown_keys(edit: str, state: str) -> None:
    text = f"{HEAD}states:\n  A: {state}\n  B: {{}}\n"
    design = _design_in(text)
    changed = _with_state(design, 0, _EDITS[edit](design.states[0]))
    try:
        saved = save_design(changed, text)
    except UnreadContentError as error:
        assert "line " in str(error)  # noqa: PT017
        return
    before, after = read_design(text), read_design(saved)
    assert after.design == changed
    assert len(after.findings) == len(before.findings)


def test_a_state_that_holds_unknown_keys_is_not_removed() -> None:
    text = f"{HEAD}states:\n  A: {{}}\n  B:\n    transitons: [{{to: A}}]\n"
    design = _design_in(text)
    with pytest.raises(UnreadContentError, match=r"line 7, 'transitons: \[{to: A}\]', was not understood"):
        save_design(replace(design, states=design.states[:1]), text)


def test_an_unreadable_file_is_not_replaced() -> None:
    design = _design_in(f"{HEAD}states: {{A: {{}}}}\n")
    with pytest.raises(UnreadContentError, match="not readable"):
        save_design(design, "vicode: 1\nstates: {A: {\n")


def test_duplicate_and_unknown_keys_of_a_project_survive() -> None:
    text = "vicode: 1\nenumerations:\n  Side: {elements: [left]}\n  Side: {elements: [right]}\nnme: x\n"
    project = read_project_file(text, "project.yaml").project
    assert project is not None
    changed = replace(project, world="sim:World", enumerations=(*project.enumerations, project.enumerations[0]))
    renamed = replace(changed, enumerations=(project.enumerations[0], replace(project.enumerations[0], name="Way")))
    saved = save_project_file(renamed, text)
    assert "nme: x" in saved
    assert "right" in saved


def test_comments_beside_a_position_in_block_style_survive() -> None:
    text = f"{HEAD}states:\n  A:\n    at:  # fixed\n      - 1  # x\n      # down\n      - 2  # y\n"
    design = _design_in(text)
    saved = save_design(_with_state(design, 0, replace(design.states[0], at=(5.0, 6.0))), text)
    assert saved == text.replace("- 1", "- 5").replace("- 2", "- 6")


def test_comments_around_transitions_that_become_a_group_survive() -> None:
    moved = (
        "# first\n      - {to: B, when: x}  # beside\n      # second\n      - to: A  # target\n        when: y  # why\n"
    )
    text = f"{HEAD}states:\n  A:\n    transitions:\n      {moved}  B: {{}}\n"
    design = _design_in(text)
    grouped = _with_state(design, 0, _grouped(design.states[0]))
    saved = save_design(grouped, text)
    assert read_design(saved).design == grouped
    inner = "".join(f"    {line}\n" for line in ("      " + moved).splitlines())
    assert saved == f"{HEAD}states:\n  A:\n    transitions:\n      - when: ready\n        then:\n{inner}  B: {{}}\n"
    assert save_design(design, saved) == text


def _assert_kept(new: Design, text: str) -> None:
    try:
        saved = save_design(new, text)
    except UnreadContentError:
        return
    except ValueError:
        assume(False)
        raise
    assert read_design(saved).design == new
    assert find_marks(saved) == find_marks(text)


def _design_in(text: str) -> Design:
    design = read_design(text).design
    assert design is not None
    return design


def _with_state(design: Design, number: int, state: State) -> Design:
    return replace(design, states=(*design.states[:number], state, *design.states[number + 1 :]))
