"""Charts of experiments: paths, ages of data, who waits for whom; and runs that fail."""

import asyncio
from dataclasses import replace

from tests.simulated_robot.fake_bridge import fake_bridge
from vicode.experiments.age_chart import build_age_chart
from vicode.experiments.definitions import EXPERIMENTS
from vicode.experiments.path_chart import build_path_chart, number_states
from vicode.experiments.runs import RunResult, run_once, run_real_time
from vicode.experiments.wait_chart import build_wait_chart, find_waiting_states
from vicode.simulated_robot.arena import Arena
from vicode.simulated_robot.session import RobotTrack, TrackPoint
from vicode.simulated_robot.world_map import Circle, WorldMap
from vicode.store import read_design

BOX = WorldMap(
    walls=(((0.0, 0.0), (10.0, 0.0), (10.0, 2.0), (0.0, 2.0), (0.0, 0.0)),), goals=(Circle(at=(9, 1), radius=1),)
)
GATE = """\
vicode: 1
component: gate
initial: wait
states:
  wait: {transitions: [{to: inside, when: true}]}
  inside: {capacity: 1, transitions: [{to: gather, after: 1}]}
  gather: {transitions: [{to: meet, when: true}]}
  meet: {synchronized: 2}
"""


def make_tracks(*states: str) -> tuple[RobotTrack, ...]:
    """Robots with one state per second, as in "wait inside"."""
    arena = Arena(BOX, robots=len(states))
    tracks = []
    for robot, names in zip(arena.robots, states, strict=True):
        points = [
            TrackPoint(time_s=float(second), at=(float(second), 1.0), yaw=0.0, active=(("gate", name),), age_ms=2.0)
            for second, name in enumerate(names.split())
        ]
        tracks.append(RobotTrack(robot, points=points))
    return tuple(tracks)


def test_a_path_is_colored_by_state() -> None:
    tracks = make_tracks("wait wait inside inside")
    colors = number_states(tracks)
    assert colors == {"wait": 0, "inside": 1}
    chart = build_path_chart("title", BOX, tracks, (), colors)
    assert (chart.width, chart.height) == (520, 120)
    assert chart.walls == ("10,110 510,110 510,10 10,10 10,110",)
    assert [(part.points, part.color) for part in chart.parts] == [("10,60 60,60", 0), ("60,60 110,60 160,60", 1)]
    assert [(goal.x, goal.y, goal.radius) for goal in chart.goals] == [(460, 60, 50)]


def test_the_age_chart_has_the_line_of_the_thesis() -> None:
    chart = build_age_chart([("design", make_tracks("wait wait wait")[0].points)])
    thesis, own = chart.lines
    assert thesis.kind == "thesis"
    assert thesis.points.split()[-1].startswith(f"{chart.right:g},")
    assert len(own.points.split()) == 3
    assert [mark.label for mark in chart.y_marks] == ["0.1 ms", "1 ms", "10 ms", "100 ms", "1 s", "10 s"]


def test_waiting_states_lead_to_cooperative_states_only() -> None:
    design = read_design(GATE).design
    assert design is not None
    assert find_waiting_states(design) == {"wait": ("inside", True), "gather": ("meet", False)}


def test_bars_name_the_robots_that_are_waited_for() -> None:
    tracks = make_tracks("inside inside gather gather meet", "wait wait inside gather meet")
    waiting = {"wait": ("inside", True), "gather": ("meet", False)}
    first, second = build_wait_chart(tracks, waiting, {}).rows
    assert [(bar.label, bar.is_waiting) for bar in first.bars] == [
        ("inside", False),
        ("waits for 2", True),
        ("gather", False),
        ("", False),
    ]
    assert [bar.label for bar in second.bars] == ["waits for 1", "inside", "gather", ""]


def run_circle(**changes: object) -> RunResult:
    experiment = replace(EXPERIMENTS["circle"], **changes)

    async def run() -> RunResult:
        async with fake_bridge() as port:
            return await run_once(experiment, experiment.load_maps()[0], 1, port=port)

    return asyncio.run(run())


def test_a_circle_is_measured_when_the_robot_stands() -> None:
    result = run_circle()
    assert result.problem == ""
    assert result.overshoot_deg is not None
    assert 0 < result.overshoot_deg < 5
    assert result.tracks[0].points[-1].time_s > result.time_s


def test_a_run_that_takes_too_long_has_failed() -> None:
    assert run_circle(seconds=2.0).problem == "not finished after 2 s"


def test_contacts_fail_a_run() -> None:
    assert run_circle(robots=60, seconds=0.5).problem == "touched a wall or another robot"


def test_in_real_time_ages_are_recorded() -> None:
    experiment = EXPERIMENTS["circle"]

    async def run() -> tuple[RobotTrack, ...]:
        async with fake_bridge() as port:
            return await run_real_time(experiment, experiment.load_maps()[0], port=port, seconds=0.2)

    (track,) = asyncio.run(run())
    assert {point.age_ms for point in track.points} <= {None, 1.5}
    assert track.points[-1].age_ms == 1.5
