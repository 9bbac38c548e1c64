"""History as a tree: undo takes back one's own steps only, and says so when another changed what they did."""

from dataclasses import replace
from pathlib import Path

import pytest

from vicode.editor.session import DocumentSession, SharedDocument
from vicode.editor.session.history import MAX_ENTRIES
from vicode.model.design import Design, State, Transition
from vicode.model.edits import add_state, add_transition, rename_state, update_state

DESIGN = Design(component="Player", initial="A", states=(State(name="A"), State(name="B")))


@pytest.fixture
def hands() -> tuple[DocumentSession, DocumentSession]:
    """Ana's and Ben's hold on one design."""
    ticks = iter(range(100_000))
    sheet = SharedDocument(
        file=Path("player.yaml"),
        disk_text="",
        saved=DESIGN,
        check=lambda _design: (),
        clock=lambda: float(next(ticks)),
    )
    for name in ("ana", "ben"):
        sheet.users.get_or_create_user(name, name.title())
    return DocumentSession(sheet, "ana"), DocumentSession(sheet, "ben")


def say(document: DocumentSession, state: str, doc: str, *, typing: bool = False) -> None:
    def change(design: Design) -> Design:
        return update_state(design, state, lambda old: replace(old, doc=doc))

    document.edit(f"say {doc}", change, coalesce_key=f"doc of {state}" if typing else "")


def docs(document: DocumentSession) -> list[str]:
    return [state.doc for state in document.design.states]


def labels(document: DocumentSession) -> list[str]:
    return [step.label for step in document.history.path[1:]]


def test_undo_of_the_last_step_goes_back_and_a_new_edit_makes_a_branch(
    hands: tuple[DocumentSession, DocumentSession],
) -> None:
    ana, _ben = hands
    say(ana, "A", "one")
    say(ana, "A", "two")
    ana.undo()
    assert docs(ana) == ["one", ""]
    say(ana, "A", "three")
    assert labels(ana) == ["say one", "say three"]
    assert ana.redo_label == ""
    left = next(step for step in ana.history.entries.values() if step.label == "say two")
    ana.jump_to(left.id)
    assert docs(ana) == ["two", ""]
    ana.jump_to(999)
    assert docs(ana) == ["two", ""]


def test_undo_takes_ones_own_step_out_of_what_others_did_since(hands: tuple[DocumentSession, DocumentSession]) -> None:
    ana, ben = hands
    say(ana, "A", "mine")
    say(ben, "B", "theirs")
    assert ana.undo() == ""
    assert docs(ana) == ["", "theirs"]
    assert labels(ana) == ["say mine", "say theirs", "undo say mine"]
    assert ana.undo_label == ""
    assert ben.undo() == ""
    assert docs(ana) == ["", ""]
    assert ana.redo() == ""
    assert ben.redo() == ""
    assert docs(ana) == ["mine", "theirs"]
    assert (ana.undo_label, ben.undo_label) == ("redo say mine", "redo say theirs")


def test_undo_refuses_in_words_what_another_changed_since(hands: tuple[DocumentSession, DocumentSession]) -> None:
    ana, ben = hands
    say(ana, "A", "mine")
    say(ben, "B", "theirs")
    say(ben, "A", "changed")
    before = ana.design
    words = ana.undo()
    assert words == "Cannot undo “say mine”: Ben has since changed doc of state A (“say changed”)"
    assert ana.design is before
    assert ben.undo() == ""
    assert ana.undo() == ""
    assert docs(ana) == ["", "theirs"]


def test_undo_of_a_state_that_another_leads_to_is_refused(hands: tuple[DocumentSession, DocumentSession]) -> None:
    ana, ben = hands
    ana.edit("add state C", lambda design: add_state(design, State(name="C")))
    ben.edit("connect", lambda design: add_transition(design, "A", "C"))
    assert "Ben has since changed state C" in ana.undo()
    assert ana.design.state("C") is not None


def test_a_rename_taken_back_keeps_what_others_did_to_the_state(hands: tuple[DocumentSession, DocumentSession]) -> None:
    ana, ben = hands
    ana.edit("rename", lambda design: rename_state(design, "A", "Begin"))
    say(ben, "Begin", "theirs")
    ben.edit("connect", lambda design: add_transition(design, "B", "Begin"))
    assert ana.undo() == ""
    assert ana.design.initial == "A"
    assert ana.design.states == (State(name="A", doc="theirs"), State(name="B", transitions=(Transition(to="A"),)))
    assert ana.redo() == ""
    assert ana.design.initial == "Begin"


def test_typing_of_two_people_is_one_step_each(hands: tuple[DocumentSession, DocumentSession]) -> None:
    ana, ben = hands
    for text in ("h", "he", "hel"):
        say(ana, "A", text, typing=True)
        say(ben, "B", text.upper(), typing=True)
    assert docs(ana) == ["hel", "HEL"]
    assert len(ana.history.path) == 3
    assert ana.undo() == ""
    assert docs(ana) == ["", "HEL"]


def test_typing_goes_on_as_a_new_step_after_another_edit_and_after_a_pause(
    hands: tuple[DocumentSession, DocumentSession],
) -> None:
    ana, ben = hands
    say(ana, "A", "a", typing=True)
    say(ben, "B", "drag")
    say(ana, "A", "ab", typing=True)
    assert len(ana.history.path) == 4
    later = iter(range(10_000, 20_000))
    ana.shared.clock = lambda: float(next(later))
    say(ana, "A", "abc", typing=True)
    assert len(ana.history.path) == 5


@pytest.mark.parametrize(("pause_s", "entry_count"), [(59.0, 1), (60.0, 2)])
def test_typing_coalesces_until_a_pause_of_a_minute(
    hands: tuple[DocumentSession, DocumentSession], pause_s: float, entry_count: int
) -> None:
    ana, _ben = hands
    ana.shared.clock = lambda: 1000.0
    say(ana, "A", "a", typing=True)
    ana.shared.clock = lambda: 1000.0 + pause_s
    say(ana, "A", "ab", typing=True)
    assert len(ana.history.path) == 1 + entry_count
    # The pause is measured from the last keystroke, not from the first.
    ana.shared.clock = lambda: 1059.0 + pause_s
    say(ana, "A", "abc", typing=True)
    assert len(ana.history.path) == 1 + entry_count


def test_the_history_keeps_its_newest_steps(hands: tuple[DocumentSession, DocumentSession]) -> None:
    ana, _ben = hands
    for number in range(MAX_ENTRIES + 20):
        say(ana, "A", str(number))
    assert len(ana.history.entries) == MAX_ENTRIES
    for _step in range(MAX_ENTRIES + 20):
        assert ana.undo() == ""
    assert docs(ana)[0] == "20"
