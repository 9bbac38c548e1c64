"""Three users and another program edit one file: it stays readable, no edit is lost, and saving writes the design."""

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

USERS = ("ana", "ben", "cem")
SHARED = ("X", "Y", "Z", "New")
START = Design(
    component="Player",
    initial="X",
    states=tuple(State(name=name, at=(0, 0)) for name in (*USERS, "disk", "X", "Y", "Z")),
)
EDITS = ("add", "rename", "move", "remove", "connect", "doc")
users = st.sampled_from(USERS)
shared = st.sampled_from(SHARED)


def with_doc(design: Design, name: str, doc: str) -> Design:
    return update_state(design, name, lambda state: replace(state, doc=doc))


@dataclass
class Expected:
    """The expected doc of the user's own state, and its docs (before, after) on both stacks; None for other edits."""

    doc: str = ""
    undo: list[tuple[str, str] | None] = field(default_factory=list)
    redo: list[tuple[str, str] | None] = field(default_factory=list)


class ConcurrentEditing(RuleBasedStateMachine):
    """Each user edits the doc of one state, and all users change the shared states."""

    @initialize()
    def set_up(self) -> None:
        self.folder = Path(tempfile.mkdtemp())
        self.file = self.folder / "player.yaml"
        self.file.write_text(save_design(START))
        self.workspace = Workspace(self.folder, key="x")
        document = self.workspace.open_document("Player")
        assert document is not None
        self.clock = 0.0
        document.shared.clock = self.tick
        self.sessions = {name: DocumentSession(document.shared, name) for name in USERS}
        self.expected = {name: Expected() for name in USERS}

    def tick(self) -> float:
        self.clock += 1.0
        return self.clock

    def teardown(self) -> None:
        shutil.rmtree(self.folder, ignore_errors=True)

    @rule(user=users, text=st.text("abc \n", max_size=6), is_typing=st.booleans())
    def say(self, user: str, text: str, is_typing: bool) -> None:
        session, expected = self.sessions[user], self.expected[user]
        steps, old = len(session.history.entries), expected.doc
        coalesce_key = "doc" if is_typing else ""
        session.edit(f"say {text}", lambda design: with_doc(design, user, text), coalesce_key=coalesce_key)
        if text == old:
            return
        if len(session.history.entries) == steps:
            before = expected.undo.pop()
            assert before is not None
            old = before[0]
        expected.undo.append((old, text))
        expected.doc, expected.redo = text, []

    @rule(user=users, what=st.sampled_from(EDITS), one=shared, two=shared)
    def edit_shared_states(self, user: str, what: str, one: str, two: str) -> None:
        changes: dict[str, Any] = {
            "add": lambda design: design if design.state(one) else add_state(design, State(name=one)),
            "rename": lambda design: rename_state(design, one, two),
            "move": lambda design: move_nodes(design, {one: (self.tick(), 0.0)}),
            "remove": lambda design: remove_states(design, [one]),
            "connect": lambda design: add_transition(design, one, two) if design.state(one) else design,
            "doc": lambda design: with_doc(design, one, f"{user} {self.tick()}"),
        }
        self.run_and_expect(user, lambda session: session.edit(f"{what} {one}", changes[what]))

    @rule(user=users)
    def undo(self, user: str) -> None:
        self.undo_or_redo(user, self.expected[user].undo, self.expected[user].redo, 0)

    @rule(user=users)
    def redo(self, user: str) -> None:
        self.undo_or_redo(user, self.expected[user].redo, self.expected[user].undo, 1)

    @rule(text=st.text("xyz", max_size=4), removed=st.none() | shared)
    def another_program_writes(self, text: str, removed: str | None) -> None:
        read = read_design(self.file.read_text(), "player.yaml").design
        assert read is not None
        changed = with_doc(remove_states(read, [removed] if removed else []), "disk", text)
        self.file.write_text(save_design(changed, self.file.read_text()))
        self.workspace.sync_from_disk()
        disk = self.sessions["ana"].design.state("disk")
        assert self.sessions["ana"].shared.disk_conflict is not None or (disk is not None and disk.doc == text)

    @rule(user=users, takes_theirs=st.booleans())
    def save(self, user: str, takes_theirs: bool) -> None:
        def act(session: DocumentSession) -> None:
            try:
                self.workspace.save(session)
            except DiskConflictError:
                assert session.shared.conflicts
                self.workspace.resolve_conflict(
                    session, [conflict.path for conflict in session.shared.conflicts] if takes_theirs else []
                )
                self.workspace.save(session)

        self.run_and_expect(user, act)
        read = read_design(self.file.read_text(), "player.yaml")
        assert read.design == self.sessions[user].design
        assert self.sessions[user].is_saved

    def run_and_expect(self, user: str, act: Any) -> None:
        """Run an action, and expect an entry on the undo stack for each that it adds."""
        session = self.sessions[user]
        newest = max(session.history.entries)
        act(session)
        new = [step for id_, step in session.history.entries.items() if id_ > newest and step.user_id == user]
        if new:
            self.expected[user].undo += [None] * len(new)
            self.expected[user].redo = []

    def undo_or_redo(self, user: str, source: list[Any], target: list[Any], side: int) -> None:
        session, before = self.sessions[user], self.sessions[user].design
        error = session.redo() if side else session.undo()
        if not source:
            assert (error, session.design) == ("", before)
        elif error:
            # Only edits of shared states may conflict.
            assert source[-1] is None
            assert session.design is before
        else:
            step = source.pop()
            target.append(step)
            if step is not None:
                self.expected[user].doc = step[side]

    @invariant()
    def no_edit_is_lost(self) -> None:
        for user, expected in getattr(self, "expected", {}).items():
            state = self.sessions[user].design.state(user)
            assert state is not None
            assert state.doc == expected.doc

    @invariant()
    def the_design_is_readable(self) -> None:
        if hasattr(self, "sessions"):
            design = self.sessions["ana"].design
            assert read_design(save_design(design), "player.yaml").design == design


# The nightly profile runs more examples.
ConcurrentEditing.TestCase.settings = settings(stateful_step_count=30)
TestConcurrentEditing = ConcurrentEditing.TestCase


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
