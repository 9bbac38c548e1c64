"""`check --deep`: states that alternate, judged with their callers; designs that no agent activates."""

import json
from pathlib import Path

import pytest

from vicode.check.behavior import find_behavior
from vicode.cli import main
from vicode.findings import Finding
from vicode.store import open_project

_PROJECT = """\
vicode: 1
project: game
components:
  Eyes: {implementation: world, outputs: {angle: {type: float, range: [-180, 180]}, seen: {type: bool}}}
agents: {player: {root: Player}}
"""
_TURN = """\
vicode: 1
component: Turn
uses: {eyes: Eyes}
initial: Look
states:
  Look: {transitions: [{to: Turn, when: abs(eyes.angle) > 40}]}
  Turn: {transitions: [{to: Look, when: eyes.angle < 30}]}
"""
_PLAYER = """\
vicode: 1
component: Player
uses: {eyes: Eyes, turn: Turn}
initial: Wait
states:
  Wait: {transitions: [{to: Play, when: %s}]}
  Play: {modulates: {turn: {}}, transitions: [{to: Wait, when: %s}]}
"""


def check(folder: Path, **files: str) -> tuple[Finding, ...]:
    for name, text in files.items():
        (folder / f"{name}.yaml").write_text(text, encoding="utf-8")
    return find_behavior(open_project(folder).project)


def find_turn(found: tuple[Finding, ...]) -> list[str]:
    return [each.rule.code for each in found if each.subject and each.subject.component == "Turn"]


def test_states_alternate_while_their_caller_stays(tmp_path: Path) -> None:
    (found,) = check(tmp_path, project=_PROJECT, turn=_TURN, player=_PLAYER % ("eyes.seen", "not eyes.seen"))
    assert found.rule.code == "D435"
    assert found.message.startswith(
        "'Look' and 'Turn' alternate in each iteration while the inputs hold still with Eyes"
    )
    assert found.subject is not None
    assert (found.subject.component, found.subject.path) == ("Turn", ("states", "Look", "transitions", 0))
    assert [note.subject.path for note in found.notes if note.subject] == [("states", "Turn", "transitions", 0)]


def test_a_caller_that_leaves_at_once_ends_the_alternation(tmp_path: Path) -> None:
    leaves = _PLAYER % ("eyes.seen", "abs(eyes.angle) > 20")
    assert find_turn(check(tmp_path, project=_PROJECT, turn=_TURN, player=leaves)) == []


def test_inputs_are_chosen_for_the_caller_too(tmp_path: Path) -> None:
    # Only from -180 to -100 both designs stay as they are.
    stays = _PLAYER % ("eyes.seen", "eyes.angle > -100")
    assert find_turn(check(tmp_path, project=_PROJECT, turn=_TURN, player=stays)) == ["D435"]


def test_guards_that_exclude_each_other_do_not_alternate(tmp_path: Path) -> None:
    fixed = _TURN.replace("eyes.angle < 30", "abs(eyes.angle) < 30")
    assert check(tmp_path, project=_PROJECT, turn=fixed, player=_PLAYER % ("eyes.seen", "not eyes.seen")) == ()


def test_a_minimum_time_ends_the_alternation(tmp_path: Path) -> None:
    slow = _TURN.replace("when: eyes.angle < 30", "when: eyes.angle < 30, after: 1")
    assert check(tmp_path, project=_PROJECT, turn=slow, player=_PLAYER % ("eyes.seen", "not eyes.seen")) == ()


def test_a_design_behind_a_dead_guard_is_inactive(tmp_path: Path) -> None:
    dead = _PLAYER % ("eyes.angle > 200", "not eyes.seen")
    codes = {
        (each.rule.code, each.subject.component)
        for each in check(tmp_path, project=_PROJECT, turn=_TURN.replace("< 30", "> 30"), player=dead)
        if each.subject
    }
    assert ("P214", "Turn") in codes
    assert ("P214", "Player") not in codes


def test_without_agents_every_design_is_active(tmp_path: Path) -> None:
    project = _PROJECT.replace("agents: {player: {root: Player}}\n", "")
    found = check(
        tmp_path, project=project, turn=_TURN.replace("< 30", "> 30"), player=_PLAYER % ("eyes.seen", "False")
    )
    assert "P214" not in {each.rule.code for each in found}


def test_hand_written_code_is_not_replayed(tmp_path: Path) -> None:
    code = _TURN.replace("states:\n", "members: 'def act(self): open(\"x\")'\nstates:\n").replace(
        "Look: {", "Look: {actions: [{code: self.act()}], "
    )
    assert check(tmp_path, project=_PROJECT, turn=code, player=_PLAYER % ("eyes.seen", "not eyes.seen")) == ()


_AGENTS = """\
include "symbols.xabsl";
include "turn.xabsl";
agent player("player", turn);
"""
_SYMBOLS = """\
namespace ball("ball")
{
  float input ball.angle [-180..180] "deg";
  bool input ball.seen "seen";
}
"""
_OPTION = """\
option turn
{
  initial state look
  {
    decision
    {
      if (ball.angle > 40 || ball.angle < -40)
        goto turn_to_it;
      else if (ball.angle > 50)
        goto rest;
      else
        stay;
    }
    action { }
  }
  state turn_to_it
  {
    decision
    {
      if (ball.angle < 30)
        goto look;
      else
        stay;
    }
    action { }
  }
  state rest
  {
    decision { stay; }
    action { }
  }
}
"""


def test_a_behavior_is_checked_without_an_import(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name, text in (("agents", _AGENTS), ("symbols", _SYMBOLS), ("turn", _OPTION)):
        (tmp_path / f"{name}.xabsl").write_text(text, encoding="utf-8")
    agents = str(tmp_path / "agents.xabsl")
    assert main(["xabsl", "check", agents]) == 0
    assert "D4" not in capsys.readouterr().out
    assert main(["xabsl", "check", "--deep", agents]) == 0
    shown = capsys.readouterr().out
    assert "turn.xabsl:9:12: warning D423" in shown
    assert "turn.xabsl:7:7: warning D435 alternating-states: 'look' and 'turn_to_it'" in shown
    assert "ball.angle = " in shown
    assert "turn.xabsl:27:3: warning D421" in shown


def test_what_is_never_active_is_marked(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    early = """\
vicode: 1
component: Early
initial: A
states:
  A: {transitions: [{stay: true, when: 1 > 2}, {to: C}]}
"""
    lost = "  B: {final: true, transitions: [{stay: true, when: 2 > 3}]}\n"
    player = early.replace("Early", "Player").replace(", {to: C}", "") + lost
    for name, text in {"project": _PROJECT, "early": early, "player": player}.items():
        (tmp_path / f"{name}.yaml").write_text(text, encoding="utf-8")
    assert main(["check", "--deep", "--json", str(tmp_path)]) == 1
    found = json.loads(capsys.readouterr().out)
    assert [(each["component"], each["code"], "(never active)" in each["message"]) for each in found] == [
        *(("Early", "P214", False), ("Early", "D433", True), ("Early", "D402", False)),
        *(("Player", "D422", False), ("Player", "D433", False), ("Player", "D421", False), ("Player", "D433", True)),
        ("", "P210", False),
    ]
