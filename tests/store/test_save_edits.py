"""An edit only changes its own lines: laws on random texts with comments and on the example designs."""

from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from tests.strategies.commented_texts import commented_texts, fewer_examples, find_comments
from tests.strategies.designs import decisions, states
from vicode.model.design import Code as CodeOf
from vicode.model.design import Decision, Design, Guard, RunCode, State, Transition
from vicode.store import read_design, save_design

DESIGNS = sorted((Path(__file__).parents[2] / "designs").rglob("*.yaml"))
# Edits of what is derived are lost, see tests/model/test_lowering.py.
DESIGN_FILES = [path for path in DESIGNS if path.name != "project.yaml" and path.parent.name != "styles"]

EDITS: dict[str, Callable[[State], State]] = {
    "doc": lambda state: replace(state, doc=f"{state.doc} and more: much # more"),
    "position": lambda state: replace(state, at=(17.0, 4.5) if state.at != (17.0, 4.5) else (1.0, 1.0)),
    "final": lambda state: replace(state, final=not state.final),
    "id": lambda state: replace(state, id=f"{state.id}x"),
    "enter code": lambda state: replace(state, enter=(*state.enter, _run("begin()\n"))),
    "leave code": lambda state: replace(state, leave=(_run("one()\ntwo()\n"),)),
    "one transition more": lambda state: replace(state, transitions=(*state.transitions, Transition(to="Fresh"))),
    "one transition before": lambda state: replace(state, transitions=(Transition(to="Fresh"), *state.transitions)),
    "no transitions": lambda state: replace(state, transitions=()),
    "transitions turned": lambda state: replace(state, transitions=state.transitions[::-1]),
    "guards": lambda state: replace(state, transitions=tuple(map(_guarded, state.transitions))),
    "requires": lambda state: replace(state, requires=("fresh", *state.requires)),
    "actions turned": lambda state: replace(state, actions=state.actions[::-1]),
}


def _run(text: str) -> RunCode:
    return RunCode(code=CodeOf(texts=(("python", text),)))


def _guarded(decision: Decision) -> Decision:
    return replace(decision, guard=Guard(when="fresh < 1"))


@fewer_examples
@given(commented_texts(), st.data(), st.sampled_from(sorted(EDITS)))
def test_an_edit_of_a_state_touches_no_other_line(text: str, data: st.DataObject, edit: str) -> None:
    design = _design_in(text)
    _assert_is_local(text, design, data.draw(st.integers(0, len(design.states) - 1)), edit)


@pytest.mark.parametrize("edit", sorted(EDITS))
@pytest.mark.parametrize("path", DESIGN_FILES, ids=lambda path: path.stem)
def test_an_edit_of_a_shipped_design_touches_no_other_line(path: Path, edit: str) -> None:
    text = path.read_text(encoding="utf-8")
    design = _design_in(text)
    for number in range(len(design.states)):
        _assert_is_local(text, design, number, edit)


@fewer_examples
@given(commented_texts(), states, st.integers(0, 9))
def test_a_new_state_removes_no_line(text: str, state: State, place: int) -> None:
    design = _design_in(text)
    assume(state.name not in {each.name for each in design.states})
    new = replace(design, states=(*design.states[:place], state, *design.states[place:]))
    saved = _saved(new, text)
    assert not Counter(_lines(text)) - Counter(_lines(saved))
    assert _is_in_order(_lines(text), _lines(saved))


@fewer_examples
@given(commented_texts(), st.data())
def test_a_removed_state_takes_only_its_own_lines(text: str, data: st.DataObject) -> None:
    design = _design_in(text)
    assume(len(design.states) > 1)
    number = data.draw(st.integers(0, len(design.states) - 1))
    new = replace(design, states=design.states[:number] + design.states[number + 1 :])
    saved = _saved(new, text)
    assert _is_in_order(_lines(saved), _lines(text))
    start, end = _region(text, design, number)
    own = find_comments("\n".join(_lines(text)[start:end]))
    assert find_comments(text) - find_comments(saved) <= own | _attached_comments(_lines(text)[:start])


@fewer_examples
@given(commented_texts(), st.randoms(use_true_random=False))
def test_reordered_states_keep_their_lines(text: str, random: object) -> None:
    design = _design_in(text)
    order = list(design.states)
    random.shuffle(order)  # type: ignore[attr-defined]
    saved = _saved(replace(design, states=tuple(order)), text)
    filled = [line for line in _lines(text) if line.strip()]
    assert Counter(filled) == Counter(line for line in _lines(saved) if line.strip())


@fewer_examples
@given(commented_texts(), st.data(), st.lists(decisions, max_size=4).map(tuple))
def test_other_transitions_leave_all_comments_outside(
    text: str, data: st.DataObject, transitions: tuple[Decision, ...]
) -> None:
    design = _design_in(text)
    number = data.draw(st.integers(0, len(design.states) - 1))
    saved = _saved(_with_state(design, number, replace(design.states[number], transitions=transitions)), text)
    start, end = _region(text, design, number)
    outside = _lines(text)[:start] + _lines(text)[end:]
    assert find_comments("\n".join(outside)) <= find_comments(saved)


@pytest.mark.parametrize("path", DESIGN_FILES, ids=lambda path: path.stem)
def test_a_renamed_state_changes_only_lines_that_name_it(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    design = _design_in(text)
    for number, state in enumerate(design.states):
        saved = _saved(_with_state(design, number, replace(state, name="Renamed")), text)
        changed = [line for line, new in zip(_lines(text), _lines(saved), strict=True) if line != new]
        assert len(changed) == 1
        assert state.name in changed[0]


def _assert_is_local(text: str, design: Design, number: int, edit: str) -> None:
    state = EDITS[edit](design.states[number])
    if state == design.states[number]:
        return
    saved = _saved(_with_state(design, number, state), text)
    start, end = _region(text, design, number)
    before, after = _lines(text)[: start + 1], _lines(text)[end:]
    # What stands beside the key changes when the state holds nothing else.
    assert _lines(saved)[:start] == before[:-1]
    assert not after or _lines(saved)[-len(after) :] == after


def _saved(new: Design, text: str) -> str:
    saved = save_design(new, text)
    assert read_design(saved).design == new
    # Without it a block of code at the end would mean something else: only then a line break is added.
    assert saved.endswith("\n") or not text.endswith("\n")
    return saved


def _design_in(text: str) -> Design:
    design = read_design(text).design
    assert design is not None
    return design


def _with_state(design: Design, number: int, state: State) -> Design:
    return replace(design, states=(*design.states[:number], state, *design.states[number + 1 :]))


def _region(text: str, design: Design, number: int) -> tuple[int, int]:
    """Lines from a state's key to the next state's comments, as numbers of lines."""
    source = read_design(text).source_map
    keys = [source.locate(("states", state.name), of_key=True).line - 1 for state in design.states]
    lines = _lines(text)
    if number + 1 == len(keys):
        return keys[number], len(lines)
    end = keys[number + 1]
    return keys[number], end - len(_attached_lines(lines[:end]))


def _attached_lines(lines: list[str]) -> list[str]:
    attached: list[str] = []
    while lines and lines[-1].strip().startswith("#"):
        attached.append(lines.pop())
    return attached


def _attached_comments(lines: list[str]) -> set[str]:
    return find_comments("\n".join(_attached_lines(lines)))


def _lines(text: str) -> list[str]:
    return text.replace("\r\n", "\n").removesuffix("\n").split("\n")


def _is_in_order(part: list[str], whole: list[str]) -> bool:
    lines = iter(whole)
    return all(line in lines for line in part)
