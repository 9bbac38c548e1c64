"""Edits of a generated file are read back as edits of its design."""

from dataclasses import replace

import pytest

from tests.sync.player_edits import FORWARD, PLAYER, Replacement, edited_player, interpret, player, text_of
from vicode.generators import component_generator
from vicode.model.design import Declaration, Design, Guard, RunCode, State, Stay, Transition
from vicode.model.project import Project
from vicode.sync.interpret import Interpretation, interpret_edits

KICKER_CALL = "        self._call(self.kicker, kick=self.kick, side=self.side)\n"
SEEN = (
    '        if decide and self.perception.ball_seen:\n            self._change_to("FollowBall")\n            return\n'
)
OLD = '        if decide and self.perception.ball_age > 3:\n            self._change_to("GetUp")\n            return\n'

# A replacement in the generated file, and the edit of the design in words.
UNDERSTOOD = {
    "threshold": (
        ("y=0.0)) < 30", "y=0.0)) < 40"),
        "guard of CircleBall → SearchNet: abs(perception.bearing_to(x=net_x, y=0)) < 40 or state_time > 10",
    ),
    "whole number": (
        ("y=0.0)) < 30", "y=77)) < 30"),
        "guard of CircleBall → SearchNet: abs(perception.bearing_to(x=net_x, y=77)) < 30 or state_time > 10",
    ),
    "sum in place of a number": (
        ("y=0.0)) < 30", "y=0.0)) < 30 + net_x"),
        "guard of CircleBall → SearchNet: abs(perception.bearing_to(x=net_x, y=0)) < 30 + net_x or state_time > 10",
    ),
    "operator": (
        ("decide and not self.perception.fallen", "decide and self.perception.ball_age > 3 * (1 + net_x)"),
        "guard of GetUp → LookForBall: perception.ball_age > 3 * (1 + net_x)",
    ),
    "common guard": (
        ("if self.perception.fallen:", "if self.perception.fallen and self.state_time > 1:"),
        "guard of common → GetUp: perception.fallen and state_time > 1",
    ),
    "guard that reads the team": (
        ("if self.perception.fallen:", "if self.perception.fallen and self.root.team.size < 3:"),
        "guard of common → GetUp: perception.fallen and team_size < 3",
    ),
    "nested guard": (
        ("(self.perception.net_bearing) < lateral_limit", "(self.perception.net_bearing) <= lateral_limit"),
        "guard of SearchNet → AlignLateral: abs(perception.net_bearing) <= lateral_limit",
    ),
    "guard of a group": (
        ("if self.search_net.found:", "if self.search_net.found and self.state_time > 0.5:"),
        "guard of decision of SearchNet: search_net.found and state_time > 0.5",
    ),
    "timer": ((">= 500_000_000", ">= 700_000_000"), "time of Kick → WatchBall: 0.7"),
    "timer and comment": (
        ("500_000_000 and not self.kicker.busy:  # after 0.5 s", "1500000000 and not self.kicker.busy:  # after 1.5 s"),
        "time of Kick → WatchBall: 1.5",
    ),
    "target": (
        (
            'self.search_net.complete:\n                self._change_to("CircleBall")',
            'self.search_net.complete:\n                self._change_to("LookForBall")',
        ),
        "target of SearchNet → LookForBall: LookForBall",
    ),
    "added transition": ((SEEN, SEEN + OLD), "added transition LookForBall → GetUp: when perception.ball_age > 3"),
    "added transition with a comment": (
        (SEEN, SEEN + "        # old ball\n" + OLD),
        "added transition LookForBall → GetUp: when perception.ball_age > 3",
    ),
    "removed transition": (
        ("        # ball seen\n" + SEEN, ""),
        "removed transition LookForBall → FollowBall: when perception.ball_seen",
    ),
    "argument": (("speed=210.0", "speed=250"), "modulation of follow_ball in state FollowBall: speed: 250"),
    "call": (
        (KICKER_CALL, KICKER_CALL + "        self._call(self.walk, forward=10.0, lateral=0.0, turn=0.0)\n"),
        "added modulation of walk in state Kick: forward: 10.0, lateral: 0.0, turn: 0.0",
    ),
    "removed call": (("        self._call(self.stand_up)\n", ""), "removed modulation of stand_up in state GetUp"),
    "assigned value": (("self.kicks += 1", "self.kicks += 2"), "enter action of state Kick: set kicks: kicks + 2"),
    "added assignment": (
        ("        self._do_kick_enter()\n", "        self._do_kick_enter()\n        self.side = Side.left\n"),
        "added enter action of state Kick: set side: Side.left",
    ),
    "initial value": (("self.kicks = 0", "self.kicks = 3"), "value of output kicks: 3"),
    "added variable": (
        ("        self.kicks = 0\n", "        self.kicks = 0\n        self.tries = 5\n"),
        "added variable tries: 5",
    ),
    "frequency": (("frequency_hz = 10", "frequency_hz = 12.5"), "frequency: 12.5"),
    "resume": (("frequency_hz = 10\n", "frequency_hz = 10\n    resume = True\n"), "resume: yes"),
    "requirement": (
        (
            '"GetUp", self._in_get_up, requires=(self.perception,)',
            '"GetUp", self._in_get_up, requires=(self.perception, self.walk)',
        ),
        "added requirement walk of state GetUp",
    ),
    "final": (
        (
            '"GetUp", self._in_get_up, requires=(self.perception,)',
            '"GetUp", self._in_get_up, requires=(self.perception,), final=True',
        ),
        "final of state GetUp: yes",
    ),
    "doc of the component": (
        ("shoots with one of six kicks.", "shoots with one of four kicks."),
        "description: " + player().doc.replace("six", "four"),
    ),
    "doc of a declaration": (
        ("kicks: Kicks so far.", "kicks: Kicks until now."),
        "description of output kicks: Kicks until now.",
    ),
    "doc of a state": (("Kick, with the eyes on the ball.", "Kick."), "description of state Kick: Kick."),
    "comment above a test": (
        ("# ball seen", "# the ball is\n        # in view"),
        "description of LookForBall → FollowBall: the ball is in view",
    ),
    "docstring of a predicate": (
        ("ball at rest", "ball lies still"),
        "description of WatchBall → FollowBall: ball lies still",
    ),
    "import": (("from typing import", "import math\nfrom typing import"), "module code: python: import math …"),
    "method": (
        (
            "        self._call(self.stand_up)\n",
            "        self._call(self.stand_up)\n\n    def helper(self) -> int:\n        return 3\n",
        ),
        "class code: python: def helper(self) -> int: …",
    ),
    "method between methods": (
        ("    def _in_kick(", "    def helper(self) -> int:\n        return 3\n\n    def _in_kick("),
        "class code: python: def helper(self) -> int: …",
    ),
    "constant of the module": (
        ("# </vicode>\n\n\nclass", "# </vicode>\nLIMIT = 3\n\n\nclass"),
        "module code: LIMIT = 3",
    ),
    "code before an assignment": (
        ("        self.kicks += 1\n", '        log.info("kick")\n        self.kicks += 1\n'),
        'added enter action of state Kick: log.info("kick")',
    ),
    "code before the calls": (
        (
            "        self._call(self.face_ball)\n" + KICKER_CALL,
            "        for word in self.words:\n            log.info(word)\n        self._call(self.face_ball)\n"
            + KICKER_CALL,
        ),
        "added action of state Kick: for word in self.words: log.info(word)",
    ),
    "rename": (('State("GetUp"', 'State("StandUp"'), "renamed state GetUp → StandUp"),
}


@pytest.mark.parametrize("name", UNDERSTOOD)
def test_an_edit_of_the_design(name: str) -> None:
    replacement, words = UNDERSTOOD[name]
    result = interpret(edited_player(replacement))
    assert ([edit.words for edit in result.edits], result.leftover) == ([words], "")
    assert result.design != player()
    # The generated code of the new design needs no other edit.
    text = text_of(FORWARD, result.design)
    project = replace(
        FORWARD, designs=tuple(result.design if each.component == "Player" else each for each in FORWARD.designs)
    )
    again = interpret_edits(project, "Player", generated=text, edited=text)
    assert again == Interpretation(design=result.design)


def test_all_edits_at_once() -> None:
    names = [
        name
        for name in UNDERSTOOD
        if name not in ("removed transition", "removed call", "added transition with a comment", "final")
    ]
    result = interpret(
        edited_player(
            *(
                UNDERSTOOD[name][0]
                for name in names
                if name
                in (
                    "threshold",
                    "timer",
                    "argument",
                    "assigned value",
                    "frequency",
                    "doc of a state",
                    "comment above a test",
                    "import",
                    "method",
                )
            )
        )
    )
    assert len(result.edits) == 9
    assert result.leftover == ""


def test_lines_are_those_of_the_edited_file() -> None:
    removed = UNDERSTOOD["removed transition"][0]
    edited = edited_player(("from typing", "import math\nfrom typing"), ("speed=210.0", "speed=250.0"), removed)
    lines = edited.split("\n")
    found = {edit.words.split(" ")[0]: lines[edit.line - 1].strip() for edit in interpret(edited).edits}
    assert found == {
        "modulation": "self._call(self.follow_ball, speed=250.0)",
        "module": "import math",
        # The first statement of the method behind what was removed.
        "removed": "self._call(self.search_ball)",
    }


def test_a_rename_is_followed() -> None:
    names = (
        ('State("GetUp", self._in_get_up', 'State("StandUp", self._in_stand_up'),
        ("def _in_get_up", "def _in_stand_up"),
    )
    target = ('self._change_to("GetUp")', 'self._change_to("StandUp")')
    for replacements in (names, (*names, target), (UNDERSTOOD["rename"][0], target)):
        result = interpret(edited_player(*replacements, ("not self.perception.fallen", "self.perception.fallen")))
        assert [edit.words for edit in result.edits] == [
            UNDERSTOOD["rename"][1],
            "guard of StandUp → LookForBall: perception.fallen",
        ]
        assert result.leftover == ""


def test_regions_keep_their_ids_after_a_rename() -> None:
    result = interpret(edited_player(('State("FollowBall"', 'State("Approach"')))
    assert result.leftover == ""
    assert [line for line in text_of(FORWARD, result.design).split("\n") if "# <vicode" in line] == [
        line for line in PLAYER.split("\n") if "# <vicode" in line
    ]


def test_bodies_of_regions_are_ignored() -> None:
    assert interpret(PLAYER.replace("log.info(", "log.debug(((")) == Interpretation(design=player())
    result = interpret(edited_player(("log.info(", "log.debug((("), UNDERSTOOD["timer"][0]))
    assert [edit.words for edit in result.edits] == [UNDERSTOOD["timer"][1]]
    assert result.leftover == ""


@pytest.mark.parametrize("layout", [lambda text: text.replace("\n", "\r\n"), lambda text: text.replace("    ", "\t")])
def test_layout_is_no_edit(layout: object) -> None:
    assert callable(layout)
    assert interpret(layout(PLAYER)) == Interpretation(design=player())
    result = interpret(layout(edited_player(UNDERSTOOD["timer"][0], UNDERSTOOD["code before an assignment"][0])))
    assert (len(result.edits), result.leftover) == (2, "")


def test_the_order_of_actions_is_kept() -> None:
    behind = KICKER_CALL + '        log.info("kicked")\n'
    result = interpret(edited_player((KICKER_CALL, behind)))
    state = result.design.state("Kick")
    assert result.leftover == ""
    assert state is not None
    assert isinstance(state.actions[-1], RunCode)
    assert [type(action).__name__ for action in state.actions] == ["Call", "Call", "RunCode"]
    assert state.modulates == ()


def test_an_edit_may_depend_on_another_one() -> None:
    # The guard is read before the variable that it needs, which stands further down.
    variable = ("        self.side = Side.left\n", "        self.side = Side.left\n        self.tries = 5\n")
    result = interpret(edited_player(("if self.perception.fallen:", "if self.tries > 3:"), variable))
    assert [edit.words for edit in result.edits] == ["added variable tries: 5", "guard of common → GetUp: tries > 3"]
    assert result.leftover == ""


def test_an_import_that_the_generator_adds_is_no_edit() -> None:
    declared = ("    front_limit,\n", "    diagonal_angle,\n    front_limit,\n")
    edited = edited_player(
        ("    diagonal_angle,\n", ""), declared, ("if self.perception.fallen:", "if self.perception.ball_age > far:")
    )
    constants = (*FORWARD.constants, Declaration(name="far", initial="9"))
    project = replace(FORWARD, constants=constants)
    # The person may have added the import of a constant or not.
    for text in (edited, edited.replace("    front_limit,", "    far,\n    front_limit,", 1)):
        result = interpret_edits(project, "Player", generated=PLAYER, edited=text)
        assert [edit.words for edit in result.edits] == ["guard of common → GetUp: perception.ball_age > far"]
        assert result.leftover == ""


def test_a_package_with_its_own_runtime() -> None:
    code = component_generator(FORWARD, "python", {"Player": "player.yaml"})(player())
    assert code is not None
    old, new = UNDERSTOOD["timer"][0]
    result = interpret_edits(FORWARD, "Player", generated=code.file.text, edited=code.file.text.replace(old, new))
    assert (len(result.edits), result.leftover) == (1, "")


SMALL = Design(
    component="Player",
    initial="A",
    parameters=(Declaration(name="speed", type="float", initial="1"),),
    states=(
        State(name="A", transitions=(Stay(guard=Guard(when="speed > 2")), Transition(to="B", guard=Guard(after="3")))),
        State(name="B", doc="first line\n\nsecond paragraph"),
        State(name="C"),
    ),
)


@pytest.mark.parametrize(
    ("replacements", "words"),
    [
        (
            (("speed: float = 1.0", "speed: float = 2.5"), ("self.speed = 1.0", "self.speed = 2.5")),
            ["value of parameter speed: 2.5"],
        ),
        (
            (("self._stay()", 'self._change_to("B")'),),
            ["removed stay in A: when speed > 2", "added transition A → B: when speed > 2"],
        ),
        (
            (("            if self.speed > 2:\n                self._stay()\n                return\n", ""),),
            ["removed stay in A: when speed > 2"],
        ),
        (
            (('self._change_to("B")', "self._stay()"),),
            ["removed transition A → B: after 3", "added stay in A: after 3"],
        ),
        ((("second paragraph", "third\n        paragraph"),), ["description of state B: third paragraph"]),
        ((("        pass\n", "        print(self.speed)\n"),), ["added action of state C: print(self.speed)"]),
        ((("3_000_000_000", "250_000_000"),), ["time of A → B: 0.25"]),
    ],
)
def test_a_small_design(replacements: tuple[Replacement, ...], words: list[str]) -> None:
    project = Project(name="small", designs=(SMALL,))
    text = edited = text_of(project, SMALL)
    for old, new in replacements:
        edited = edited.replace(old, new, 1)
    result = interpret_edits(project, "Player", generated=text, edited=edited)
    assert edited != text
    assert ([edit.words for edit in result.edits], result.leftover) == (words, "")
