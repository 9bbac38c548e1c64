"""Copy, duplicate and paste: copied text is a smaller design file, pasted text is untrusted."""

from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.editor.session.conftest import open_design
from vicode.editor.session import DocumentSession, EditResult, apply_edit
from vicode.editor.session.gestures import clipboard
from vicode.editor.view import ItemRef
from vicode.model.design import (
    Assign,
    Code,
    CommonSection,
    Declaration,
    Design,
    Guard,
    RunCode,
    State,
    Transition,
    Use,
)
from vicode.store import read_design

DESIGN = Design(
    component="Player",
    initial="A",
    uses=(Use(alias="head", component="Head"),),
    common=CommonSection(at=(9, 9), transitions=(Transition(to="C"),)),
    states=(
        State(
            name="A",
            at=(100, 100),
            requires=("head",),
            transitions=(Transition(to="B", guard=Guard(when="head.up"), label_at=(0.3, 20)), Transition(to="C")),
        ),
        State(name="B", at=(300, 100), transitions=(Transition(to="A"),)),
        State(name="C"),
    ),
)
KNOWN = {"Head", "Player"}


def items(**named: str) -> tuple[ItemRef, ...]:
    return tuple(ItemRef(kind=kind, id=identity) for kind, ids in named.items() for identity in ids.split())


def paste(document: DocumentSession, text: Any, *onto: str, x: float = 0, y: float = 0) -> EditResult:
    targets = [ItemRef(kind="states", id=name) for name in onto]
    return clipboard.paste(document, text, (x, y), KNOWN, targets)


def duplicate(document: DocumentSession, items: tuple[ItemRef, ...]) -> EditResult:
    return apply_edit(document, clipboard.DuplicateGesture(items=items))


def names(document: DocumentSession) -> list[str]:
    return [state.name for state in document.design.states]


def test_copied_text_is_a_readable_design_file() -> None:
    text = clipboard.copy_as_text(DESIGN, items(states="A B"))
    assert text is not None
    assert text.startswith("vicode: 1\ncomponent: Player\nuses:\n  head: {component: Head, at:")
    read = read_design(text)
    assert read.findings == ()
    assert read.design is not None
    assert read.design.states == DESIGN.states[:2]


def test_an_empty_selection_is_not_copied() -> None:
    assert clipboard.copy_as_text(DESIGN, []) is None
    assert clipboard.copy_as_text(DESIGN, items(components="head", states="Ghost", transitions="A/9")) is None
    twins = replace(DESIGN, states=(DESIGN.states[0], DESIGN.states[0]))
    assert clipboard.copy_as_text(twins, items(states="A")) is None


def test_paste_is_one_edit_centered_at_the_pointer(document: DocumentSession) -> None:
    text = clipboard.copy_as_text(DESIGN, items(states="A B"))
    outcome = paste(document, text, x=1003, y=498)
    assert outcome.new_selection == (ItemRef(kind="states", id="A2"), ItemRef(kind="states", id="B2"))
    assert [document.design.states[index].at for index in (3, 4)] == [(900, 500), (1100, 500)]
    assert document.undo_label == "paste 2 states"
    document.undo()
    assert document.design == DESIGN


def test_pasting_twice_covers_no_state(document: DocumentSession) -> None:
    text = clipboard.copy_as_text(DESIGN, items(states="A"))
    for _time in range(3):
        paste(document, text, x=500, y=500)
    assert len({state.at for state in document.design.states}) == 6


def test_a_section_of_a_file_can_be_pasted(document: DocumentSession) -> None:
    assert paste(document, "states:\n  D: {transitions: [{to: A}]}\n").error == ""
    assert names(document) == ["A", "B", "C", "D"]


def test_paste_reports_missing_components() -> None:
    other = open_design(Design(component="Other"))
    text = "states:\n  D: {requires: [wheels]}\nuses: {wheels: Wheels}\n"
    assert "Wheels" in paste(other, text).note
    assert other.design.uses == ()


def test_paste_brings_the_declarations_that_it_needs() -> None:
    source = replace(
        DESIGN,
        parameters=(Declaration(name="speed", initial="limit / 2"), Declaration(name="unused")),
        outputs=(Declaration(name="near", type="bool"),),
        variables=(Declaration(name="tries", type="int"), Declaration(name="limit")),
        states=(
            replace(
                DESIGN.states[0],
                actions=(Assign(values=(("near", "speed > 3"),)),),
                enter=(RunCode(code=Code(texts=(("python", "self.tries += 1"),))),),
            ),
            *DESIGN.states[1:],
        ),
    )
    text = clipboard.copy_as_text(source, items(states="A"))
    document = open_design(Design(component="Player", initial="S", states=(State(name="S"),)))
    outcome = paste(document, text)
    assert outcome.note == ("Also added: component head, parameter speed, output near, variable tries, variable limit")
    assert [(section, each) for section, each in document.design.declarations()] == [
        ("parameters", source.parameters[0]),
        ("outputs", source.outputs[0]),
        *(("variables", each) for each in source.variables),
    ]
    # The second time nothing is missing; one step takes all of it back.
    assert paste(document, text, x=500).note == ""
    document.undo()
    document.undo()
    assert list(document.design.declarations()) == []
    assert document.design.uses == ()


def test_a_declared_name_keeps_its_meaning_and_transitions_bring_theirs() -> None:
    own = Declaration(name="tries", initial="7")
    source = replace(
        DESIGN,
        variables=(Declaration(name="tries", type="int"), Declaration(name="limit")),
        states=(State(name="A", transitions=(Transition(to="A", guard=Guard(when="tries > limit")),)),),
    )
    document = open_design(replace(DESIGN, variables=(own,)))
    outcome = paste(document, clipboard.copy_as_text(source, items(transitions="A/0")), "B")
    assert outcome.note == "Also added: variable limit"
    assert document.design.variables == (own, source.variables[1])


def test_transitions_are_pasted_into_the_selected_states(document: DocumentSession) -> None:
    text = clipboard.copy_as_text(DESIGN, items(transitions="A/0"))
    assert text is not None
    assert "select the states" in paste(document, text).error
    paste(document, text, "B", "C", "Ghost")
    assert [len(state.transitions) for state in document.design.states] == [2, 2, 1]
    assert document.undo_label == "paste transitions"


def test_the_common_section_can_be_copied(document: DocumentSession) -> None:
    other = open_design(Design(component="Other", states=(State(name="C"),)))
    paste(other, clipboard.copy_as_text(DESIGN, items(common="@common")))
    assert other.design.common.transitions == (Transition(to="C"),)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("hello", "the clipboard contains no part of a design"),
        ("states: [", "the clipboard contains no part of a design: "),
        ("states: {A: {transitions: [{to: A, twice: 1}]}}", "unknown key 'twice'"),
        ("states: {A: &a {}, B: *a}", "the clipboard contains no part of a design: "),
        ("states: {'<img src=x onerror=alert(1)>': {}}", "is not a valid name"),
        ("states: {A: {}}\nuses: {'a b': Head}", "is not a valid name"),
        ("states: !!python/object/apply:os.system ['true']", "the clipboard contains no part of a design: "),
        ("vicode: 99\nstates: {A: {}}", "the clipboard contains no part of a design: "),
        ("states: {}", "the clipboard contains no part of a design"),
        ("states: " + "[" * 100_000, "the clipboard contains no part of a design"),
        ("states: {A: {}}" + " " * 400_000, "the clipboard contains no part of a design"),
    ],
)
def test_invalid_clipboard_text_is_an_error(document: DocumentSession, text: str, message: str) -> None:
    assert message in paste(document, text).error
    assert document.design == DESIGN


@given(st.text(max_size=60).map(lambda text: "states: " + text) | st.text(max_size=60))
def test_any_text_is_pasted_or_rejected(text: str) -> None:
    document = open_design(DESIGN)
    paste(document, text)
    if document.undo_label:
        document.undo()
    assert document.design == DESIGN


def test_duplicates_are_shifted_in_one_edit(document: DocumentSession) -> None:
    outcome = duplicate(document, items(states="A B", transitions="A/0", components="head"))
    assert outcome.new_selection == (ItemRef(kind="states", id="A2"), ItemRef(kind="states", id="B2"))
    assert [state.at for state in document.design.states[3:]] == [(140, 190), (340, 190)]
    assert document.undo_label == "duplicate 2 states"


def test_duplicated_transitions_follow_the_original(document: DocumentSession) -> None:
    assert duplicate(document, items(transitions="A/0")).new_selection == (ItemRef(kind="transitions", id="A/1"),)
    duplicate(document, items(transitions="A/0 B/0"))
    assert [len(state.transitions) for state in document.design.states] == [4, 2, 0]
    assert document.undo_label == "duplicate 2 transitions"
    assert duplicate(document, items(components="head")).error
