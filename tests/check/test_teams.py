"""`check --deep` for teams: robots that wait forever, synchronized states that are never entered."""

from pathlib import Path

import pytest

from vicode.analysis import teams
from vicode.check.behavior import find_behavior
from vicode.findings import Finding
from vicode.store import open_project

MEETING = Path(__file__).parents[2] / "designs" / "meeting"
_PROJECT = """\
vicode: 1
project: carry
components: {Eyes: {implementation: world, outputs: {at_box: {type: bool}}}}
agents: {carrier: {root: Carrier}%s}
"""
_CARRIER = """\
vicode: 1
component: Carrier
uses: {eyes: Eyes, lift: Lift}
initial: Search
states:
  Search: {transitions: [{to: Work, when: eyes.at_box}]}
  Work: {modulates: {lift: {}}, transitions: [%s]}
  Rest: {final: true}
"""
_LIFT = """\
vicode: 1
component: Lift
initial: Wait
states:
  Wait: {transitions: [{to: Up}]}
  Up: {synchronized: 2, transitions: [{to: Down, after: 2}]}
  Down: {final: true}
"""
_BACK, _GIVES_UP = "{to: Search, when: %s}", "{to: Rest, after: 5}"


def check(folder: Path, **files: str) -> list[Finding]:
    for name, text in files.items():
        (folder / f"{name}.yaml").write_text(text, encoding="utf-8")
    return [each for each in find_behavior(open_project(folder).project) if each.rule.code in ("D436", "D437", "P215")]


def check_player(folder: Path, states: str, head: str = "") -> list[Finding]:
    design = f"vicode: 1\ncomponent: Player\n{head}initial: Wait\nstates:\n{states}"
    return check(folder, project="vicode: 1\nproject: game\n", player=design)


def check_carriers(folder: Path, back: str, lift: str = _LIFT) -> list[Finding]:
    return check(folder, project=_PROJECT % "", carrier=_CARRIER % (_BACK % back), lift=lift)


def test_the_meeting_has_no_end_in_which_robots_wait() -> None:
    assert find_behavior(open_project(MEETING).project) == ()


def test_a_timeout_before_the_meeting_is_explained_by_the_states_of_the_robots(tmp_path: Path) -> None:
    text = (MEETING / "meet.yaml").read_text(encoding="utf-8")
    arrived = "      - {to: wait_for_others, when: robot.arrived}\n"
    meet = text.replace(arrived, arrived + "      - {to: stop, after: 20}\n")
    files = {each: (MEETING / f"{each}.yaml").read_text(encoding="utf-8") for each in ("project", "pass_door")}
    (found,) = check(tmp_path, meet=meet, **files)
    assert found.rule.code == "D436"
    assert found.message == (
        "a robot can wait forever in 'wait_for_others' for 'meeting', which 4 robots enter together: "
        "robots 1, 2 and 3 in 'wait_for_others', robot 4 in 'stop'"
    )
    assert found.subject is not None
    assert (found.subject.component, found.subject.path) == ("meet", ("states", "wait_for_others", "transitions", 0))
    (note,) = found.notes
    assert note.message.startswith(
        "a run of 4 robots: robots 1, 2, 3 and 4 enter 'wait_at_door'; robot 1 enters 'door', 'to_meeting'; robot 2"
    )


def test_one_of_two_agents_gives_up(tmp_path: Path) -> None:
    helper = (_CARRIER % f"{_BACK % 'done(lift)'}, {_GIVES_UP}").replace("Carrier", "Helper")
    carrier = _CARRIER % (_BACK % "done(lift)")
    project = _PROJECT % ", helper: {root: Helper}"
    (found,) = check(tmp_path, project=project, carrier=carrier, helper=helper, lift=_LIFT)
    assert found.message == (
        "a robot can wait forever in 'Wait' of Lift for 'Up' of Lift, which 2 robots enter together: "
        "robot 1 in 'Work' of Carrier and 'Wait' of Lift, robot 2 in 'Rest' of Helper"
    )
    assert [each.message for each in found.notes] == [
        "a run of 2 robots: robot 1 enters 'Work' of Carrier; robot 2 enters 'Work' of Helper, 'Rest' of Helper"
    ]


def test_two_barriers_are_waited_for_crosswise(tmp_path: Path) -> None:
    found = check_player(
        tmp_path,
        """\
  Wait: {transitions: [{to: Left, when: go}, {to: Right}]}
  Left: {transitions: [{to: Both}]}
  Right: {transitions: [{to: All}]}
  Both: {synchronized: 2, final: true}
  All: {synchronized: 2, final: true}
""",
        "parameters: {go: bool}\n",
    )
    assert [each.message for each in found] == [
        f"a robot can wait forever in '{state}' for '{place}', which 2 robots enter together: "
        "robot 1 in 'Left', robot 2 in 'Right'"
        for state, place in (("Left", "Both"), ("Right", "All"))
    ]


def test_a_state_with_capacity_is_never_left(tmp_path: Path) -> None:
    (found,) = check_player(tmp_path, "  Wait: {transitions: [{to: Door}]}\n  Door: {capacity: 1, final: true}\n")
    assert found.message == (
        "a robot can wait forever in 'Wait' for 'Door', which 1 can be in: robot 1 in 'Door', robot 2 in 'Wait'"
    )
    assert found.fix == "before this transition, add one that leaves 'Wait', or let the other robots leave it"


def test_a_robot_that_is_done_does_not_wait(tmp_path: Path) -> None:
    assert check_player(tmp_path, "  Wait: {final: true, transitions: [{to: Door}]}\n  Door: {capacity: 1}\n") == []


def test_a_barrier_behind_a_door_for_one_is_never_met(tmp_path: Path) -> None:
    (found,) = check_player(
        tmp_path,
        """\
  Wait: {transitions: [{to: Door}]}
  Door: {capacity: 1, transitions: [{to: Lift}]}
  Lift: {synchronized: 2, final: true}
""",
    )
    assert (found.rule.code, found.message) == ("D437", "no run of 2 robots ever makes 2 of them enter 'Lift' together")
    assert found.subject is not None
    assert found.subject.path == ("states", "Lift", "synchronized")


_BREAKS = """\
vicode: 1
component: Lift
uses: {eyes: Eyes}
initial: Approach
states:
  Approach: {transitions: [{to: Wait, when: eyes.at_box}, {to: Broken, after: 5}]}
  Wait: {transitions: [{to: Up}]}
  Up: {synchronized: 2, transitions: [{to: Down, after: 2}]}
  Down: {final: true}
  Broken: {}
"""


@pytest.mark.parametrize("back", ["done(lift)", "action_done", "done(lift) and eyes.at_box"])
def test_a_caller_stays_until_its_component_is_done(tmp_path: Path, back: str) -> None:
    (found,) = check_carriers(tmp_path, back, _BREAKS)
    assert "'Broken' of Lift" in found.message


@pytest.mark.parametrize("back", ["eyes.at_box", "not done(lift)", "not action_done"])
def test_a_component_restarts_when_its_caller_comes_back(tmp_path: Path, back: str) -> None:
    assert check_carriers(tmp_path, back, _BREAKS) == []


@pytest.mark.parametrize("is_found", [False, True])
def test_others_wait_while_a_component_resumes_where_it_is_done(tmp_path: Path, *, is_found: bool) -> None:
    skips = _BREAKS.replace("to: Broken", "to: Down").replace("  Broken: {}\n", "")
    lift = skips.replace("initial:", "resume: true\ninitial:") if is_found else skips
    found = check_carriers(tmp_path, "done(lift)", lift)
    assert [each.message.partition(",")[0] for each in found] == (
        ["a robot can wait forever in 'Wait' of Lift for 'Up' of Lift"] if is_found else []
    )


@pytest.mark.parametrize(("guard", "is_found"), [("team_size < 2", True), ("team_size == 2", False), ("go", False)])
def test_the_team_is_complete(tmp_path: Path, guard: str, *, is_found: bool) -> None:
    found = check_player(
        tmp_path,
        f"""\
  Wait: {{transitions: [{{to: Rest, when: go}}, {{to: Ready, after: 1}}]}}
  Ready: {{transitions: [{{to: Rest, when: {guard}, after: 2}}, {{to: Lift}}]}}
  Lift: {{synchronized: 2, final: true}}
  Rest: {{final: true}}
""",
        "parameters: {go: bool}\n",
    )
    assert bool(found) is is_found


def test_a_team_with_too_many_configurations_is_not_decided(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(teams, "MOST_CONFIGURATIONS", 3)
    (found,) = check_player(tmp_path, "  Wait: {transitions: [{to: Door}]}\n  Door: {capacity: 3, final: true}\n")
    assert found.rule.code == "P215"
    assert found.message.endswith("4 robots have too many configurations")
