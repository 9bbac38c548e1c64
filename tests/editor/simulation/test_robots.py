"""The editor is attached to a running robot: what it receives, evaluates, compares and asks."""

import asyncio
from collections.abc import Awaitable, Callable
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import pytest

from tests.editor.simulation.robot_program import RobotProgram, running_robot, write_robot
from vicode.bica import Component, Root, SimulatedClock
from vicode.editor.panels.robots.robot_view import RobotView
from vicode.editor.panels.simulation.status_message import robot_message
from vicode.editor.session.simulation import Breakpoints
from vicode.editor.view import ItemRef
from vicode.model.design import Design, State
from vicode.model.project import Project
from vicode.runs import Recording, Simulation, prepare_view
from vicode.runs.design_trace import focus_iteration
from vicode.runs.guard_values import evaluate_guards
from vicode.services.robot_version import find_other_versions
from vicode.services.running_robots.robot_link import LinkStatus, RobotLink, RobotRequestError
from vicode.simulation import IterationResult
from vicode.store import open_project

LIMIT_S = 20.0
Act = Callable[[RobotLink], Awaitable[None]]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return write_robot(tmp_path / "lamps")


def project_and_lamp(folder: Path) -> tuple[Project, Design]:
    project = open_project(folder).project
    lamp = project.design("Lamp")
    assert lamp is not None
    return project, lamp


def attach(program: RobotProgram, act: Act, *, token: str = "right") -> None:
    async def run() -> None:
        link = RobotLink()
        link.open(program.address, token)
        link.start()
        try:
            await act(link)
        finally:
            link.close()

    asyncio.run(run())


async def until(link: RobotLink, fits: Callable[[], object]) -> None:
    """Wait until something is true; looked at after each message."""
    async with asyncio.timeout(LIMIT_S):
        while not fits():
            await asyncio.sleep(0.005)


async def first_iteration(link: RobotLink) -> IterationResult:
    await until(link, lambda: link.robot is not None and link.robot.iteration is not None)
    assert link.robot is not None
    assert link.robot.iteration is not None
    return link.robot.iteration


def test_the_active_state_is_followed_with_its_guards(folder: Path) -> None:
    project, lamp = project_and_lamp(folder)

    async def act(link: RobotLink) -> None:
        await first_iteration(link)
        robot = link.robot
        assert robot is not None
        recording = robot.recording("Lamp", lambda each: focus_iteration(each, lamp))
        simulation = Simulation(prepared=prepare_view(lamp), cwd=folder, live=recording)
        simulation.find_guards = lambda recording, number: guards_of(recording.iteration(number))

        def guards_of(iteration: IterationResult | None) -> dict[str, dict[str, object]]:
            assert iteration is not None
            return evaluate_guards(project, lamp, iteration, {name: each.step for name, each in robot.steps.items()})

        await until(link, lambda: len(recording) > 2)
        simulation.follow()
        assert simulation.shown_iteration is not None
        assert simulation.shown_iteration.state == "Dark"
        reads = {"eye.seen": False, "eye.light": 3.0}
        assert simulation.guards == {"Dark/0": {"holds": False, "parts": [False], "reads": reads}}
        program.eye.seen = True
        await until(link, lambda: recording.states[-1] == "Lit")
        simulation.follow()
        assert simulation.guards["Lit/0"]["holds"] is False
        # The key of the transition, although only its ends are known, and although iterations may be missed.
        assert recording.latest_transition(len(recording)) == "Dark/0"
        simulation.go_to(1)
        simulation.follow()
        assert simulation.cursor == 1
        assert not simulation.can_step or simulation.is_past

    with running_robot(folder) as program:
        attach(program, act)


def test_a_wrong_token_is_refused_for_good(folder: Path) -> None:
    async def act(link: RobotLink) -> None:
        await until(link, lambda: link.status is LinkStatus.REFUSED)
        assert "the token is wrong" in link.problem

    with running_robot(folder) as program:
        attach(program, act, token="wrong")


def test_requests_are_answered(folder: Path) -> None:
    async def act(link: RobotLink) -> None:
        await first_iteration(link)
        assert await link.request("pause") == "paused"
        await until(link, lambda: link.robot is not None and link.robot.is_paused)
        before = await first_iteration(link)
        await link.request("step", count=3)
        await until(link, lambda: link.robot.iteration.iteration == before.iteration + 3)  # type: ignore[union-attr]
        await link.set_breakpoints("Lamp", (("Lit",), ("NoSuchState",)))
        await link.request("set", component="Eye", name="seen", value=True, hold=True)
        await link.request("resume")
        await until(link, lambda: link.robot.is_paused and link.robot.root_state == "Lit")  # type: ignore[union-attr]
        with pytest.raises(RobotRequestError, match="no state 'Nowhere'"):
            await link.request("enter", component="Lamp", state="Nowhere")

    with running_robot(folder) as program:
        attach(program, act)
        assert program.root.main.state in ("Lit", "Dark")


def test_a_breakpoint_on_a_transition_stops_the_robot(folder: Path) -> None:
    _project, lamp = project_and_lamp(folder)
    breakpoints = Breakpoints().toggled(
        lamp, ItemRef(kind="transitions", id="Lit/0"), ItemRef(kind="states", id="Dark")
    )
    assert breakpoints.places(lamp) == (("Dark",), ("Lit", "Dark", None))
    transition = Breakpoints().toggled(lamp, ItemRef(kind="transitions", id="Lit/0"))

    async def act(link: RobotLink) -> None:
        await first_iteration(link)
        await link.set_breakpoints("Lamp", (*transition.places(lamp), ("Lit", "NoSuchState", None)))
        await link.request("set", component="Eye", name="seen", value=True, hold=True)
        await until(link, lambda: link.robot.root_state == "Lit")  # type: ignore[union-attr]
        assert not link.robot.is_paused  # type: ignore[union-attr]
        await link.request("set", component="Eye", name="seen", value=False, hold=True)
        await until(link, lambda: link.robot.is_paused and link.robot.root_state == "Dark")  # type: ignore[union-attr]

    with running_robot(folder) as program:
        attach(program, act)


def test_a_robot_without_control_says_so(folder: Path) -> None:
    async def act(link: RobotLink) -> None:
        await first_iteration(link)
        assert not link.control
        with pytest.raises(RobotRequestError, match="may only be watched"):
            await link.request("pause")

    with running_robot(folder, control=False) as program:
        attach(program, act)


def test_it_attaches_again_after_the_robot_was_restarted(folder: Path) -> None:
    async def act(link: RobotLink) -> None:
        await first_iteration(link)
        await asyncio.to_thread(program.stop)
        await until(link, lambda: link.status is LinkStatus.LOST)
        assert link.robot is not None
        assert link.robot.iteration is not None, "what was received stays visible"
        received_s = link.robot.received_s
        port = int(program.address.rpartition(":")[2])
        programs.enter_context(running_robot(folder, port=port))
        await until(link, lambda: link.status is LinkStatus.CONNECTED and link.robot is not None)
        await until(link, lambda: link.robot is not None and link.robot.received_s > received_s)

    with ExitStack() as programs:
        program = programs.enter_context(running_robot(folder))
        attach(program, act)


class Idle(Component):
    """Another robot of the same program."""


def test_each_robot_of_a_program_can_be_followed(folder: Path) -> None:
    async def act(link: RobotLink) -> None:
        await first_iteration(link)
        assert link.followed == "Lamp"
        other.step()
        await until(link, lambda: "spare" in link.robots)
        link.follow("spare")
        other.step()
        iteration = await first_iteration(link)
        assert iteration.tree[0]["component"] == "Idle"
        assert link.robots["Lamp"].root_state == "Dark"
        link.follow("nobody")
        assert link.followed == "spare"

    with running_robot(folder) as program, Root(Idle, clock=SimulatedClock()) as other:
        other._closing.callback(program.server.remove, program.server.add(other, "spare"))
        attach(program, act)


def test_a_design_that_the_robot_does_not_use_is_told(folder: Path) -> None:
    async def act(link: RobotLink) -> None:
        await first_iteration(link)
        design = replace(project_and_lamp(folder)[1], component="Radio")
        view = cast("RobotView", SimpleNamespace(link=link, robot=link.robot, design=design, other_versions=()))
        words = "Lamp does not use Radio. Choose another robot, or open Lamp."
        assert robot_message(view, None) == ("info", words)

    with running_robot(folder) as program:
        attach(program, act)


def test_the_last_window_that_leaves_ends_the_connection(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("vicode.services.running_robots.robot_link._LEAVE_DELAY_S", 0.0)

    async def act(link: RobotLink) -> None:
        leave_first = link.changes.subscribe(lambda: None)
        leave_second = link.changes.subscribe(lambda: None)
        await first_iteration(link)
        await link.request("pause")
        leave_first()
        link.leave()
        await asyncio.sleep(0.05)
        assert link.status is LinkStatus.CONNECTED
        leave_second()
        link.leave()
        await until(link, lambda: link.status is LinkStatus.CONNECTING)
        # The pause has ended with the connection.
        iteration = program.root.iteration
        await until(link, lambda: program.root.iteration > iteration + 2)
        link.start()
        await until(link, lambda: link.status is LinkStatus.CONNECTED)

    with running_robot(folder) as program:
        attach(program, act)


def test_a_value_that_was_written_back_is_no_other_version(folder: Path) -> None:
    project, _lamp = project_and_lamp(folder)
    constant = project.constants[0]

    def with_value(text: str) -> Project:
        return replace(project, constants=(replace(constant, initial=text), *project.constants[1:]))

    async def act(link: RobotLink) -> None:
        await first_iteration(link)
        robot = link.robot
        assert robot is not None
        key, sources = ("", constant.name), {"Lamp": "lamp.yaml"}
        robot.remember_written(key, constant.initial, "11")
        robot.remember_written(key, "11", "12")
        found = [
            find_other_versions(with_value(text), sources, robot.description, robot.written)
            for text in (constant.initial, "12", "13")
        ]
        assert found == [(), (), ("declarations.py",)]
        robot.held["Lamp", "limit"] = 3
        robot.remember_written(("Lamp", "limit"), "1", "3")
        robot.release_all()
        assert robot.written == {key: (constant.initial, "12")}

    with running_robot(folder) as program:
        attach(program, act)


def test_another_version_of_the_design_is_noticed(folder: Path) -> None:
    project, lamp = project_and_lamp(folder)

    async def act(link: RobotLink) -> None:
        await first_iteration(link)
        assert link.robot is not None
        described = link.robot.description
        sources = {"Lamp": "lamp.yaml"}
        assert find_other_versions(project, sources, described) == ()
        changed = replace(lamp, states=(*lamp.states, State(name="New")))
        assert find_other_versions(replace(project, designs=(changed,)), sources, described) == ("Lamp",)
        brighter = replace(project.constants[0], initial="11")
        assert find_other_versions(replace(project, constants=(brighter,)), sources, described) == ("declarations.py",)
        floor = replace(project.components[-1], doc="Changed.")
        components = (*project.components[:-1], floor)
        assert find_other_versions(replace(project, components=components), sources, described) == ("interfaces.py",)
        broken = replace(lamp, initial="Nowhere")
        assert find_other_versions(replace(project, designs=(broken,)), sources, described) is None

    with running_robot(folder) as program:
        attach(program, act)


def test_states_that_the_design_lacks_are_shown_as_text(folder: Path) -> None:
    project, lamp = project_and_lamp(folder)
    other = replace(lamp, states=(State(name="Off"),), initial="Off")

    async def act(link: RobotLink) -> None:
        iteration = focus_iteration(await first_iteration(link), other)
        assert iteration.state == "Dark"
        assert evaluate_guards(project, other, iteration, {}) == {}
        absent = focus_iteration(iteration, replace(other, component="Absent"))
        assert (absent.state, absent.changed_from, absent.transition) == ("", None, None)
        recording = Recording()
        recording.add(absent, {})
        assert recording.states == [""]

    with running_robot(folder) as program:
        attach(program, act)
