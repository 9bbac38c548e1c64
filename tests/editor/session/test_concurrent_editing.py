"""Three people and another program at work on one file: always readable, nobody's edit lost, saved means equal."""

import shutil
import tempfile
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, rule

from vicode.editor.session import DiskConflictError, DocumentSession, Workspace
from vicode.model.design import Design, State
from vicode.model.edits import add_state, add_transition, move_nodes, remove_states, rename_state, update_state
from vicode.store import read_design, save_design

PEOPLE = ("ana", "ben", "cem")
SHARED = ("X", "Y", "Z", "New")
START = Design(
    component="Player",
    initial="X",
    states=tuple(State(name=name, at=(0, 0)) for name in (*PEOPLE, "disk", "X", "Y", "Z")),
)
EDITS = ("add", "rename", "move", "remove", "connect", "doc")
people = st.sampled_from(PEOPLE)
shared = st.sampled_from(SHARED)


def with_doc(design: Design, name: str, doc: str) -> Design:
    return update_state(design, name, lambda state: replace(state, doc=doc))


@dataclass
class Expected:
    """What one person may count on: the doc of the own state, and the docs that undo and redo lead to (None: same)."""

    doc: str = ""
    undo: list[tuple[str, str] | None] = field(default_factory=list)
    redo: list[tuple[str, str] | None] = field(default_factory=list)


class PeopleAtWork(RuleBasedStateMachine):
    """Each person says things in a state of the own name, and all change the shared ones."""

    @initialize()
    def begin(self) -> None:
        self.folder = Path(tempfile.mkdtemp())
        self.file = self.folder / "player.yaml"
        self.file.write_text(save_design(START))
        self.workspace = Workspace(self.folder, key="x")
        document = self.workspace.open_document("Player")
        assert document is not None
        self.clock = 0.0
        document.shared.clock = self.tick
        self.hands = {name: DocumentSession(document.shared, name) for name in PEOPLE}
        self.expected = {name: Expected() for name in PEOPLE}

    def tick(self) -> float:
        self.clock += 1.0
        return self.clock

    def teardown(self) -> None:
        shutil.rmtree(self.folder, ignore_errors=True)

    @rule(who=people, text=st.text("abc \n", max_size=6), is_typing=st.booleans())
    def say(self, who: str, text: str, is_typing: bool) -> None:
        hand, expected = self.hands[who], self.expected[who]
        steps, old = len(hand.history.entries), expected.doc
        typing_in = "doc" if is_typing else ""
        hand.edit(f"say {text}", lambda design: with_doc(design, who, text), coalesce_key=typing_in)
        if text == old:
            return
        if len(hand.history.entries) == steps:
            before = expected.undo.pop()
            assert before is not None
            old = before[0]
        expected.undo.append((old, text))
        expected.doc, expected.redo = text, []

    @rule(who=people, what=st.sampled_from(EDITS), one=shared, two=shared)
    def change_what_is_shared(self, who: str, what: str, one: str, two: str) -> None:
        changes: dict[str, Any] = {
            "add": lambda design: design if design.state(one) else add_state(design, State(name=one)),
            "rename": lambda design: rename_state(design, one, two),
            "move": lambda design: move_nodes(design, {one: (self.tick(), 0.0)}),
            "remove": lambda design: remove_states(design, [one]),
            "connect": lambda design: add_transition(design, one, two) if design.state(one) else design,
            "doc": lambda design: with_doc(design, one, f"{who} {self.tick()}"),
        }
        self.noting(who, lambda hand: hand.edit(f"{what} {one}", changes[what]))

    @rule(who=people)
    def undo(self, who: str) -> None:
        self.take(who, self.expected[who].undo, self.expected[who].redo, 0)

    @rule(who=people)
    def redo(self, who: str) -> None:
        self.take(who, self.expected[who].redo, self.expected[who].undo, 1)

    @rule(text=st.text("xyz", max_size=4), gone=st.none() | shared)
    def another_program_writes(self, text: str, gone: str | None) -> None:
        read = read_design(self.file.read_text(), "player.yaml").design
        assert read is not None
        changed = with_doc(remove_states(read, [gone] if gone else []), "disk", text)
        self.file.write_text(save_design(changed, self.file.read_text()))
        self.workspace.sync_from_disk()
        disk = self.hands["ana"].design.state("disk")
        assert self.hands["ana"].shared.disk_conflict is not None or (disk is not None and disk.doc == text)

    @rule(who=people, takes_theirs=st.booleans())
    def save(self, who: str, takes_theirs: bool) -> None:
        def act(hand: DocumentSession) -> None:
            try:
                self.workspace.save(hand)
            except DiskConflictError:
                assert hand.shared.conflicts
                self.workspace.resolve_conflict(
                    hand, [conflict.path for conflict in hand.shared.conflicts] if takes_theirs else []
                )
                self.workspace.save(hand)

        self.noting(who, act)
        read = read_design(self.file.read_text(), "player.yaml")
        assert read.design == self.hands[who].design
        assert self.hands[who].is_saved

    def noting(self, who: str, act: Any) -> None:
        """Do something that may add a step of this person."""
        hand = self.hands[who]
        newest = max(hand.history.entries)
        act(hand)
        new = [step for id_, step in hand.history.entries.items() if id_ > newest and step.user_id == who]
        if new:
            self.expected[who].undo += [None] * len(new)
            self.expected[who].redo = []

    def take(self, who: str, source: list[Any], target: list[Any], side: int) -> None:
        hand, before = self.hands[who], self.hands[who].design
        refused = hand.redo() if side else hand.undo()
        if not source:
            assert (refused, hand.design) == ("", before)
        elif refused:
            # Only what others changed as well is refused, and then nothing happens.
            assert source[-1] is None
            assert hand.design is before
        else:
            step = source.pop()
            target.append(step)
            if step is not None:
                self.expected[who].doc = step[side]

    @invariant()
    def nobodys_words_are_lost(self) -> None:
        for who, expected in getattr(self, "expected", {}).items():
            state = self.hands[who].design.state(who)
            assert state is not None
            assert state.doc == expected.doc

    @invariant()
    def the_design_is_readable(self) -> None:
        if hasattr(self, "hands"):
            design = self.hands["ana"].design
            assert read_design(save_design(design), "player.yaml").design == design


# Bounded where examples are; the nightly run takes many more of them.
PeopleAtWork.TestCase.settings = settings(stateful_step_count=30)
TestPeopleAtWork = PeopleAtWork.TestCase


def test_redo_ignores_a_transition_that_others_left_dangling(tmp_path: Path) -> None:
    (tmp_path / "player.yaml").write_text(save_design(START))
    document = Workspace(tmp_path, key="x").open_document("Player")
    assert document is not None
    ana, ben = (DocumentSession(document.shared, name) for name in ("ana", "ben"))
    ben.edit("write", lambda design: with_doc(design, "ben", "text"))
    assert ben.undo() == ""
    ana.edit("remove Y", lambda design: remove_states(design, ["Y"]))
    ana.edit("connect Z with Y", lambda design: add_transition(design, "Z", "Y"))
    assert ben.redo() == ""
    state = ben.design.state("ben")
    assert state is not None
    assert state.doc == "text"
