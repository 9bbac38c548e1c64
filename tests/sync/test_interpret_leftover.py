"""Edits of a generated file without a clear meaning in the design stay a patch of the generated code."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.sync.patches import apply_patch
from tests.sync.player_edits import FORWARD, PLAYER, edited_player, interpret, text_of
from vicode.generators import component_generator
from vicode.model.design import Assign, DecisionGroup, Declaration, Design, Guard, State, Transition, Use
from vicode.model.project import Project
from vicode.sync.interpret import interpret_edits, search
from vicode.sync.same_code import is_same_code

SPEED = ("speed=210.0", "speed=250")

# Replacements in the generated file that have no clear meaning in the design.
LEFT_OVER = {
    "statement in a decision": (
        '            self._change_to("GetUp")',
        '            log.info("x")\n            self._change_to("GetUp")',
    ),
    "comment with another time": ("# after 0.5 s", "# after 0.7 s"),
    "comment": ("        self.kicks += 1\n", "        # once more\n        self.kicks += 1\n"),
    "base class": ("class Player(Component):", "class Player(Component, Mixin):"),
    "undeclared name": ("perception.ball_seen:", "perception.ball_color:"),
    "function": ("perception.ball_seen:", "perception.look(3):"),
    "another state": ('self._change_to("FollowBall")', 'self._change_to("Nowhere")'),
    "local name": (
        "        self._call(self.stand_up)\n",
        "        tries = 3\n        self._call(self.stand_up)\n        log.info(tries)\n",
    ),
    "return": (
        "        self._call(self.stand_up)\n",
        "        if self.kicks:\n            return\n        self._call(self.stand_up)\n",
    ),
    "removed import": ("from field.walk import Walk\n", ""),
    "annotation": ("self.kicks = 0", "self.kicks: int = 0"),
    "generated method": ("def _in_kick(self, decide: bool = True)", "def _in_kick(self, decide: bool = False)"),
    "decorator": ("    def _in_kick(", "    @override\n    def _in_kick("),
}


@pytest.mark.parametrize("name", LEFT_OVER)
def test_an_edit_that_stays_a_patch(name: str, tmp_path: Path) -> None:
    edited = edited_player(LEFT_OVER[name], SPEED)
    result = interpret(edited)
    assert [edit.words for edit in result.edits] == ["modulation of follow_ball in state FollowBall: speed: 250"]
    changed = [line for line in result.leftover.split("\n") if line[:1] in "+-" and line[:3] not in ("+++", "---")]
    assert 1 <= len(changed) <= 4
    patched = apply_patch(text_of(FORWARD, result.design), result.leftover, tmp_path)
    assert is_same_code(patched, edited.replace("speed=250", "speed=250.0"))


REASONS = {
    "statement in a decision": """_decide_common(): no edit of the design produces 'log.info('x')'""",
    "comment with another time": "# after 0.7 s'",
    "comment": "_enter_kick(): no edit of the design produces '# once more'",
    "base class": "class Player: no edit of the design produces 'class Player(Component, Mixin):'",
    "undeclared name": "_in_look_for_ball(): no edit of the design produces 'if self.perception.ball_color:'",
    "function": "_in_look_for_ball(): no edit of the design produces 'if self.perception.look(3):'",
    "another state": """_in_look_for_ball(): no edit of the design produces 'self._change_to('Nowhere')'""",
    "local name": "_in_get_up(): no edit of the design produces 'tries = 3'",
    "return": "_in_get_up(): no edit of the design produces 'if self.kicks:'",
    "removed import": "no edit of the design removes 'from field.walk import Walk'",
    "annotation": "__init__(): no edit of the design produces 'self.kicks: int = 0'",
    "generated method": "_in_kick(): no edit of the design produces 'def _in_kick(self, decide: bool=False) -> None:'",
    "decorator": "_in_kick(): no edit of the design produces '@override'",
}


@pytest.mark.parametrize("name", LEFT_OVER)
def test_a_reason_names_the_first_statement_that_no_edit_gives(name: str) -> None:
    (reason,) = interpret(edited_player(LEFT_OVER[name], SPEED)).reasons
    assert reason.endswith(REASONS[name])


def test_a_reason_is_given_where_nothing_is_read() -> None:
    assert interpret(edited_player(("def _in_kick(", "def ("))).reasons == ("line 225 is not Python: invalid syntax",)
    assert interpret(edited_player(("class Player(", "class Plyer("))).reasons == ("class Player is missing",)


def test_the_search_ends_after_some_proposals(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(search, "_MIN_TRIES", 20)
    monkeypatch.setattr(search, "_MAX_LINES", 0)
    written: list[Design] = []

    def count(*values: object) -> Callable[[Design], object]:
        write = component_generator(*values)  # type: ignore[arg-type]
        return lambda design: written.append(design) or write(design)  # type: ignore[func-returns-value]

    monkeypatch.setattr(search, "component_generator", count)
    edited = re.sub(r"self\.(?!_)(\w+)", r"self.\1_now", PLAYER)
    result = interpret(edited)
    assert len(written) == 20
    assert "_in_get_up(): the search ended after 20 proposals; make fewer edits at once" in result.reasons
    assert is_same_code(apply_patch(text_of(FORWARD, result.design), result.leftover, tmp_path), edited)


def test_text_that_is_not_python_is_a_patch(tmp_path: Path) -> None:
    edited = edited_player(("def _in_kick(", "def ("))
    result = interpret(edited)
    assert result.edits == ()
    assert apply_patch(PLAYER, result.leftover, tmp_path) == edited


def test_a_text_of_another_design_is_a_patch() -> None:
    older = PLAYER.replace("speed=210.0", "speed=200.0")
    assert interpret_edits(FORWARD, "Player", generated=older, edited=PLAYER).edits == ()
    with pytest.raises(ValueError, match="Nobody"):
        interpret_edits(FORWARD, "Nobody", generated="", edited="")


def test_imports_in_place_of_others_stay(tmp_path: Path) -> None:
    edited = edited_player(
        ("from field.walk import Walk", "from field.gait import Walk"),
        ("import annotations", "import (annotations, generators)"),
    )
    result = interpret(edited)
    assert result.edits == ()
    assert is_same_code(apply_patch(PLAYER, result.leftover, tmp_path), edited)


def test_a_part_of_a_decision_is_no_decision(tmp_path: Path) -> None:
    # Line by line, the edited code contains the change of the state without its test.
    group = DecisionGroup(guard=Guard(after="2"), then=(Transition(to="B", guard=Guard(when="speed > 2")),))
    speed = Declaration(name="speed", type="float")
    states = (State(name="A", transitions=(group,)), State(name="B"))
    design = Design(component="Player", initial="A", parameters=(speed,), states=states)
    project = Project(name="small", designs=(design,))
    text = text_of(project, design)
    method = text.index("    def _in_a"), text.index("    def _in_b")
    edited = f"""{text[: method[0]]}    def _in_a(self, decide: bool = True) -> None:
        if decide and self.is_near():
            self._change_to("B")
            return

{text[method[1] :]}"""
    result = interpret_edits(project, "Player", generated=text, edited=edited)
    assert result.edits == ()
    assert is_same_code(apply_patch(text, result.leftover, tmp_path), edited)


def test_an_edit_that_breaks_another_design() -> None:
    counter = Design(
        component="Counter",
        initial="A",
        outputs=(Declaration(name="count", initial="0"),),
        states=(State(name="A"),),
    )
    user = Design(
        component="User",
        initial="A",
        uses=(Use(alias="counter", component="Counter"),),
        variables=(Declaration(name="n", type="int"),),
        states=(State(name="A", enter=(Assign(values=(("n", "counter.count"),)),)),),
    )
    project = Project(name="two", designs=(counter, user))
    text = text_of(project, counter)
    for value, count in (("7", 1), ("0.5", 0)):
        edited = text.replace("self.count = 0", f"self.count = {value}")
        result = interpret_edits(project, "Counter", generated=text, edited=edited, file="python/two/counter.py")
        assert len(result.edits) == count
        assert result.leftover.startswith("" if count else "--- a/python/two/counter.py\n")
        assert bool(result.leftover) == (not count)


def test_a_default_that_is_not_understood_stays_where_it_was_written(tmp_path: Path) -> None:
    speed = Declaration(name="speed", type="float", initial="1")
    design = Design(component="Player", initial="A", parameters=(speed,), states=(State(name="A"),))
    project = Project(name="small", designs=(design,))
    text = text_of(project, design)
    edited = text.replace("self.speed = 1.0", "self.speed = read_speed()")
    result = interpret_edits(project, "Player", generated=text, edited=edited)
    assert result.edits == ()
    assert apply_patch(text, result.leftover, tmp_path) == edited
