"""The undo history: users undo their own edits only, and conflicts are reported."""

from dataclasses import replace

import pytest

from tests.editor.session.conftest import open_design
from vicode.editor.session import DocumentSession
from vicode.editor.session.history import MAX_ENTRIES
from vicode.model.design import Design, State, Transition
from vicode.model.edits import add_state, add_transition, rename_state, update_state

DESIGN = Design(component="Player", initial="A", states=(State(name="A"), State(name="B")))


@pytest.fixture
def sessions() -> tuple[DocumentSession, DocumentSession]:
    """The sessions of Ana and Ben on one design."""
    ticks = iter(range(100_000))
    shared = open_design(DESIGN, clock=lambda: float(next(ticks))).shared
    for name in ("ana", "ben"):
        shared.users.get_or_create_user(name, name.title())
    return DocumentSession(shared, "ana"), DocumentSession(shared, "ben")


def say(document: DocumentSession, state: str, doc: str, *, typing: bool = False) -> None:
    def change(design: Design) -> Design:
        return update_state(design, state, lambda old: replace(old, doc=doc))

    document.edit(f"say {doc}", change, coalesce_key=f"doc of {state}" if typing else "")


def docs(document: DocumentSession) -> list[str]:
    return [state.doc for state in document.design.states]


def labels(document: DocumentSession) -> list[str]:
    return [step.label for step in document.history.path[1:]]


def test_a_new_edit_after_undo_starts_a_branch(
    sessions: tuple[DocumentSession, DocumentSession],
) -> None:
    ana, _ben = sessions
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


def test_undo_keeps_later_edits_of_others(sessions: tuple[DocumentSession, DocumentSession]) -> None:
    ana, ben = sessions
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


def test_undo_reports_a_conflict_with_a_later_edit(sessions: tuple[DocumentSession, DocumentSession]) -> None:
    ana, ben = sessions
    say(ana, "A", "mine")
    say(ben, "B", "theirs")
    say(ben, "A", "changed")
    before = ana.design
    message = ana.undo()
    assert message == "Cannot undo “say mine”: Ben has since changed description of state A (“say changed”)"
    assert ana.design is before
    assert ben.undo() == ""
    assert ana.undo() == ""
    assert docs(ana) == ["", "theirs"]


def test_undo_of_a_state_that_became_a_target_is_a_conflict(
    sessions: tuple[DocumentSession, DocumentSession],
) -> None:
    ana, ben = sessions
    ana.edit("add state C", lambda design: add_state(design, State(name="C")))
    ben.edit("connect", lambda design: add_transition(design, "A", "C"))
    assert "Ben has since changed state C" in ana.undo()
    assert ana.design.state("C") is not None


def test_undo_of_a_rename_keeps_edits_of_the_state(sessions: tuple[DocumentSession, DocumentSession]) -> None:
    ana, ben = sessions
    ana.edit("rename", lambda design: rename_state(design, "A", "Begin"))
    say(ben, "Begin", "theirs")
    ben.edit("connect", lambda design: add_transition(design, "B", "Begin"))
    assert ana.undo() == ""
    assert ana.design.initial == "A"
    assert ana.design.states == (State(name="A", doc="theirs"), State(name="B", transitions=(Transition(to="A"),)))
    assert ana.redo() == ""
    assert ana.design.initial == "Begin"


def test_typing_of_two_users_is_one_entry_each(sessions: tuple[DocumentSession, DocumentSession]) -> None:
    ana, ben = sessions
    for text in ("h", "he", "hel"):
        say(ana, "A", text, typing=True)
        say(ben, "B", text.upper(), typing=True)
    assert docs(ana) == ["hel", "HEL"]
    assert len(ana.history.path) == 3
    assert ana.undo() == ""
    assert docs(ana) == ["", "HEL"]


def test_another_edit_or_a_pause_starts_a_new_entry(
    sessions: tuple[DocumentSession, DocumentSession],
) -> None:
    ana, ben = sessions
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
    sessions: tuple[DocumentSession, DocumentSession], pause_s: float, entry_count: int
) -> None:
    ana, _ben = sessions
    ana.shared.clock = lambda: 1000.0
    say(ana, "A", "a", typing=True)
    ana.shared.clock = lambda: 1000.0 + pause_s
    say(ana, "A", "ab", typing=True)
    assert len(ana.history.path) == 1 + entry_count
    # The pause is measured from the last keystroke, not from the first.
    ana.shared.clock = lambda: 1059.0 + pause_s
    say(ana, "A", "abc", typing=True)
    assert len(ana.history.path) == 1 + entry_count


def test_the_history_keeps_its_newest_entries(sessions: tuple[DocumentSession, DocumentSession]) -> None:
    ana, _ben = sessions
    for number in range(MAX_ENTRIES + 20):
        say(ana, "A", str(number))
    assert len(ana.history.entries) == MAX_ENTRIES
    for _step in range(MAX_ENTRIES + 20):
        assert ana.undo() == ""
    assert docs(ana)[0] == "20"
