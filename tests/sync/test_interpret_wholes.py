"""Edits of a generated file that are the same code, that are taken whole, and that stay whole in the patch."""

from pathlib import Path

import pytest

from tests.sync.patches import apply_patch
from tests.sync.player_edits import FORWARD, PLAYER, Replacement, edited_player, interpret, player, text_of
from vicode.sync.interpret import Interpretation
from vicode.sync.interpret.verification import is_same_program

SEEN = "if decide and self.perception.ball_seen:"
LOOK = f'        {SEEN}\n            self._change_to("FollowBall")\n            return\n'
CALL = "        self._call(self.search_ball)\n"
KICKED = "bearing)\n        # </vicode>\n"
LAST_STATE = '            State("GetUp", self._in_get_up, requires=(self.perception,)),\n'
FIRST_VALUE = "        self.kicks = 0\n"
COMMON = "    def _decide_common("
GET_UP = PLAYER[PLAYER.index("    def _in_get_up(") :]
DANCE = '''

    def _in_dance(self, decide: bool = True) -> None:
        """Dance a little."""
        if decide and self._decide_common():
            return
        # danced
        if decide and self.state_time > 3:
            self._change_to("LookForBall")
            return
        self._call(self.walk, forward=0.0, lateral=0.0, turn=20.0)
        self.cheer()

    def cheer(self) -> None:
        log.info("cheer")
'''
END = "        self._call(self.stand_up)\n"

SAME_CODE: dict[str, tuple[Replacement, ...]] = {
    "whole number": (("speed=210.0", "speed=210"),),
    "renamed action": (
        ("        self._do_kick_enter()", "        self._do_entry()"),
        ("def _do_kick_enter", "def _do_entry"),
    ),
    "is True": ((SEEN, "if decide and self.perception.ball_seen is True:"),),
    "is False": (("not self.kicker.busy", "self.kicker.busy is False"),),
    "is not True": (("not self.kicker.busy", "self.kicker.busy is not True"),),
    "elif behind a return": (
        ("            # ball at the feet\n            if (", "            # ball at the feet\n            elif ("),
    ),
    "else behind a return": ((LOOK + CALL, f"{LOOK}        else:\n    {CALL}"),),
    "assignment with an operator": (("self.kicks += 1", "self.kicks = self.kicks + 1"),),
}


@pytest.mark.parametrize("name", SAME_CODE)
def test_the_same_code_is_no_edit(name: str) -> None:
    assert interpret(edited_player(*SAME_CODE[name])) == Interpretation(design=player())


TAKEN: dict[str, tuple[tuple[Replacement, ...], list[str]]] = {
    "truth of a number": (
        ((SEEN, "if decide and self.perception.ball_seen and self.kicks:"),),
        ["guard of LookForBall → FollowBall: perception.ball_seen and kicks != 0"],
    ),
    "in": (
        ((SEEN, "if decide and self.kick in (Kick.front, Kick.lateral):"),),
        ["guard of LookForBall → FollowBall: kick == Kick.front or kick == Kick.lateral"],
    ),
    "not in a list": (
        ((SEEN, "if decide and self.kick not in [Kick.front, Kick.lateral]:"),),
        ["guard of LookForBall → FollowBall: kick != Kick.front and kick != Kick.lateral"],
    ),
    "round": (
        (("speed=210.0", "speed=round(self.perception.ball_distance)"),),
        ["modulation of follow_ball in state FollowBall: speed: round(perception.ball_distance)"],
    ),
    "int": (
        (("self.kicks += 1", "self.kicks = int(self.perception.ball_distance)"),),
        ["enter action of state Kick: set kicks: int(perception.ball_distance)"],
    ),
    "elif": (
        (
            (
                LOOK,
                (
                    f'{LOOK}        elif decide and self.kicks > 3:\n            self._change_to("GetUp")\n'
                    "            return\n"
                ),
            ),
        ),
        ["added transition LookForBall → GetUp: when kicks > 3"],
    ),
    "statement behind a region": (
        ((KICKED, f'{KICKED}        log.info("kicked")\n'),),
        ['enter action of state Kick: log.info("kicked")'],
    ),
    "deleted state with its common transition": (
        (
            (LAST_STATE, ""),
            (GET_UP, ""),
            (
                (
                    '        # fallen\n        if self.perception.fallen:\n            self._change_to("GetUp")\n'
                    "            return True\n"
                ),
                "",
            ),
        ),
        ["removed transition common → GetUp: when perception.fallen", "removed state GetUp: 1 transition"],
    ),
    "parameter": (
        (
            (FIRST_VALUE, f"        self.pace = 2.5\n{FIRST_VALUE}"),
            (COMMON, f"    def modulate(self, *, pace: float = 2.5) -> None:\n        self.pace = pace\n\n{COMMON}"),
        ),
        ["added parameter pace: float 2.5"],
    ),
    "unused import": (
        (("from typing import", "from math import pi\nfrom typing import"),),
        ["module code: python: from math import pi …"],
    ),
    "component": (
        (
            ("from field.kicker", "from field.head import Head\nfrom field.kicker"),
            ("        self.stand_up = ", "        self.head = root.component(Head)\n        self.stand_up = "),
        ),
        ["added use head: Head"],
    ),
}


@pytest.mark.parametrize("name", TAKEN)
def test_an_edit_is_taken_whole(name: str) -> None:
    replacements, words = TAKEN[name]
    edited = edited_player(*replacements)
    result = interpret(edited)
    assert ([edit.words for edit in result.edits], result.leftover) == (words, "")
    assert is_same_program(text_of(FORWARD, result.design), edited)


def test_a_pasted_state_is_taken_with_its_helper() -> None:
    listed = (LAST_STATE, f'{LAST_STATE}            State("Dance", self._in_dance),\n')
    result = interpret(edited_player(listed, (END, END.rstrip("\n") + DANCE)))
    state = result.design.state("Dance")
    assert result.leftover == ""
    assert state is not None
    assert [transition.doc for transition in state.transitions] == ["danced"]
    assert "def cheer(" in (result.design.members.in_language("python") or "")
    assert "_in_dance" not in (result.design.members.in_language("python") or "")


def test_code_in_another_language_stays() -> None:
    result = interpret(edited_player(*TAKEN["statement behind a region"][0]))
    old, new = (design.state("Kick") for design in (player(), result.design))
    assert old is not None
    assert new is not None
    texts = [
        [action.code.in_language("cpp") for action in each.enter if hasattr(action, "code")] for each in (old, new)
    ]
    assert texts[0] == texts[1] != []


LEFT: dict[str, tuple[Replacement, ...]] = {
    "renamed call of an action": (("        self._do_kick_enter()", "        self._do_entry()"),),
    "renamed definition of an action": (("def _do_kick_enter", "def _do_entry"),),
    "action called twice": (("        self._do_kick_enter()\n", "        self._do_kick_enter()\n" * 2),),
    "nested guard": (
        (
            (
                "500_000_000 and not self.kicker.busy:  # after 0.5 s\n"
                '            self._change_to("WatchBall")\n            return\n'
            ),
            (
                "500_000_000:  # after 0.5 s\n            if not self.kicker.busy and self.is_ready():\n"
                '                self._change_to("WatchBall")\n                return\n'
            ),
        ),
    ),
    "decision between calls": ((CALL, CALL + LOOK + CALL),),
    "deleted state that is a target": ((LAST_STATE, ""), (GET_UP, "")),
    "pasted state that is not listed": ((END, END.rstrip("\n") + DANCE),),
    "import of a statement that stays": (
        ("from typing import", "import math\nfrom typing import"),
        (SEEN, "if decide and math.isfinite(self.perception.ball_age):"),
    ),
}


@pytest.mark.parametrize("name", LEFT)
def test_an_edit_stays_whole(name: str, tmp_path: Path) -> None:
    edited = edited_player(*LEFT[name])
    result = interpret(edited)
    assert (result.design, result.edits) == (player(), ())
    assert is_same_program(apply_patch(PLAYER, result.leftover, tmp_path), edited)
