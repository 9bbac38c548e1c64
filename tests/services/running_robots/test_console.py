"""The commands of the console: their words, their names and values, and their effect on a running robot."""

import asyncio
import re
from collections.abc import Awaitable, Callable
from pathlib import Path

import pytest

from tests.editor.simulation.robot_program import RobotProgram, running_robot, write_robot
from tests.manual.code_blocks import ROOT
from vicode.model.project import Project
from vicode.robots import ComponentDescription, RobotDescription
from vicode.services.running_robots.console import ConsoleError, RobotConsole
from vicode.services.running_robots.robot_link import NO_CONTROL, LinkStatus, RobotLink
from vicode.services.running_robots.watched_robot import WatchedRobot
from vicode.store import open_project

LIMIT_S = 20.0
PROJECT = """\
vicode: 1
project: Unit
enumerations: {Side: [left, right]}
constants: {bright: {value: 10, tunable: true, range: [0, 50]}, fixed: 3}
components:
  Eye:
    implementation: hands:Eye
    outputs: {seen: bool, light: {type: float, unit: lx, range: [0, 100]}, side: Side, count: int}
  Floor: {implementation: world, outputs: {slope: float}}
"""
LAMP = """\
vicode: 1
component: Lamp
uses: {eye: Eye, floor: Floor}
variables: {level: 0.5}
initial: Dark
common: {transitions: [{to: Broken, id: fails, when: eye.count > 9}]}
states:
  Dark: {transitions: [{to: Lit, id: on, when: eye.seen}, {to: Lit, id: late, after: 9}]}
  Lit: {transitions: [{to: Dark, when: not eye.seen}]}
  Broken: {final: true}
"""


@pytest.fixture
def project(tmp_path: Path) -> Project:
    (tmp_path / "project.yaml").write_text(PROJECT, encoding="utf-8")
    (tmp_path / "lamp.yaml").write_text(LAMP, encoding="utf-8")
    return open_project(tmp_path).project


class SilentLink(RobotLink):
    """A connection that remembers requests; a robot of the program `Unit` and its first iteration are known."""

    def __init__(self) -> None:
        super().__init__()
        self.requests: list[tuple[str, dict[str, object]]] = []
        self.status, self.control, self.followed = LinkStatus.CONNECTED, True, "r1"
        lamp = ComponentDescription(states=("Dark", "Lit", "Broken"))
        components = {"Lamp": lamp, "Eye": ComponentDescription()}
        for name in ("r1", "r2"):
            robot = WatchedRobot(description=RobotDescription(name=name, root="Lamp", components=components))
            self.robots[name] = robot
            robot.add(message())

    async def request(self, do: str, **fields: object) -> str:
        self.requests.append((do, fields))
        return do


def message() -> dict[str, object]:
    step = {"by": "", "link": "root", "changed_from": None, "transition": None, "worked": True, "done": False}
    lamp = {"component": "Lamp", "state": "Dark", "state_time_ns": 5 * 10**9, "values": {"level": 0.5}, **step}
    values = {"seen": True, "light": 3.0, "side": "Side.left", "count": 2, "raw": 7, "label": "x"}
    eye = {"component": "Eye", "state": "", "state_time_ns": None, "values": values, **step}
    both = [{"parameters": {}, "conflict": False, **each} for each in (lamp, eye)]
    return {"kind": "iteration", "iteration": 1, "time_ns": 0, "tree": both, "inputs": {"Floor": {"slope": 0.1}}}


def run(project: Project, *lines: str) -> tuple[str, list[tuple[str, dict[str, object]]]]:
    """The last answer, and all requests."""
    link = SilentLink()
    console = RobotConsole(link, lambda: project)

    async def run_all() -> str:
        return [await console.run(line) for line in lines][-1]

    return asyncio.run(run_all()), link.requests


@pytest.mark.parametrize(
    ("line", "do", "fields"),
    [
        ("pause", "pause", {}),
        ("resume", "resume", {}),
        ("go", "resume", {}),
        ("c", "resume", {}),
        ("go Lit", "enter", {"component": "Lamp", "state": "Lit"}),
        ("go Lamp.Lit", "enter", {"component": "Lamp", "state": "Lit"}),
        ("step", "step", {"count": 1}),
        ("s 20", "step", {"count": 20}),
        ("set level 1", "set", {"component": "Lamp", "name": "level", "value": 1.0, "hold": False}),
        ("set eye.seen = false", "set", {"component": "Eye", "name": "seen", "value": False, "hold": False}),
        ("hold Eye.side right", "set", {"component": "Eye", "name": "side", "value": "Side.right", "hold": True}),
        ("set eye.raw 8", "set", {"component": "Eye", "name": "raw", "value": 8, "hold": False}),
        ("set eye.raw 8.5", "set", {"component": "Eye", "name": "raw", "value": 8.5, "hold": False}),
        ("set eye.label a b", "set", {"component": "Eye", "name": "label", "value": "a b", "hold": False}),
        ("set bright 50", "tune", {"name": "bright", "value": 50}),
        ("unset eye.light", "unset", {"component": "Eye", "name": "light"}),
        ("frequency Lamp 0.5", "frequency", {"component": "Lamp", "hz": 0.5}),
        ("raise Eye broken lens", "raise", {"component": "Eye", "message": "broken lens"}),
        ("raise Eye", "raise", {"component": "Eye", "message": ""}),
        ("break Lit", "break", {"places": [["Lamp", "Lit"]]}),
        ("break error", "break", {"places": [["", "error"]]}),
        ("b Dark->Lit", "break", {"places": [["Lamp", "Dark", "Lit", "on"], ["Lamp", "Dark", "Lit", "late"]]}),
        ("break Lamp.Lit → Lamp.Broken", "break", {"places": [["Lamp", "Lit", "Broken", "fails"]]}),
    ],
)
def test_a_command_is_a_request(project: Project, line: str, do: str, fields: dict[str, object]) -> None:
    assert run(project, line)[1] == [(do, fields)]


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("puase", "there is no command 'puase'; did you mean 'pause'?"),
        ("", "there is no command ''; known are help, pause"),
        ("pause now", "write: pause"),
        ("set level", "write: set NAME VALUE"),
        ("go Litt", "there is no state 'Litt'; did you mean 'Lit'?"),
        ("go Xyzzy", "there is no state 'Xyzzy'; known are Dark, Lit, Broken"),
        ("break Dark -> Dakr", "there is no transition from Dark to 'Dakr'; known are Broken, Lit"),
        ("clear Lit", "there is no breakpoint 'Lit'; break lists them"),
        ("step 0", "'0' is no number of iterations; write: step 10"),
        ("set eye.lihgt 3", "there is no value 'eye.lihgt'; did you mean 'eye.light'?"),
        ("set eye.seen 1", "'1' is no value of Eye.seen: it must be true or false"),
        ("set eye.count 1.5", "'1.5' is no value of Eye.count: it must be an integer"),
        ("set eye.light dark", "'dark' is no value of Eye.light: it must be a number from 0 to 100 lx"),
        ("set eye.light 101", "'101' is no value of Eye.light: it must be from 0 to 100 lx"),
        ("set eye.side up", "'up' is no value of Eye.side: it must be left, right"),
        ("set bright 51", "'51' is no value of bright: it must be from 0 to 50"),
        ("set fixed 4", "the constant fixed cannot be changed; declare it with tunable: true"),
        ("set floor.slope 1", "floor.slope cannot be set: the world provides it"),
        ("frequency Lmap 3", "there is no component 'Lmap'; did you mean 'Lamp'?"),
        ("frequency Lamp fast", "'fast' is no frequency in Hz; write: frequency Lamp 50"),
        ("robot r3", "there is no robot 'r3'; known are r1, r2"),
        ("print levle", "there is no value 'levle'; did you mean 'level'?"),
        ("print level +", "invalid syntax"),
        ("print level and eye.seen", "expected bool"),
    ],
)
def test_an_error_says_what_would_be_right(project: Project, line: str, words: str) -> None:
    with pytest.raises(ConsoleError, match=f"^{re.escape(words)}"):
        run(project, line)


@pytest.mark.parametrize(
    ("line", "answer"),
    [
        ("print level", "level = 0.5"),
        ("print", "level = 0.5"),
        ("p eye.light", "eye.light = 3 lx"),
        ("print floor.slope", "floor.slope = 0.1"),
        ("print bright", "bright = 10"),
        ("print eye.light < bright and eye.side == Side.left", "eye.light < bright and eye.side == Side.left = true"),
        ("print state_time", "state_time = 5"),
        ("states", "Lamp: Dark (of Dark, Lit, Broken)"),
        ("robot", "* r1  Dark\n  r2  Dark"),
        ("robot r2", "  r1  Dark\n* r2  Dark"),
        ("break", "breakpoints: none"),
    ],
)
def test_what_was_received_is_shown(project: Project, line: str, answer: str) -> None:
    assert run(project, line) == (answer, [])


def test_breakpoints_are_listed_and_removed(project: Project) -> None:
    set_ = ("break Lit", "break Dark -> Lit", "break error")
    assert run(project, *set_)[0] == "breakpoints: Lamp.Lit, Lamp.Dark -> Lit (on), Lamp.Dark -> Lit (late), error"
    assert run(project, *set_, "clear Lit", "clear error")[0] == (
        "breakpoints: Lamp.Dark -> Lit (on), Lamp.Dark -> Lit (late)"
    )
    answer, requests = run(project, *set_, "clear")
    assert answer == "breakpoints: none"
    assert requests[-1] == ("break", {"places": []})


def test_without_the_design_names_are_those_that_were_received() -> None:
    empty = Project(name="")
    assert run(empty, "set level 2")[1] == [("set", {"component": "Lamp", "name": "level", "value": 2, "hold": False})]
    assert run(empty, "print Eye.side")[0] == "Eye.side = Side.left"
    with pytest.raises(ConsoleError, match="the design of Lamp is not here"):
        run(empty, "break Dark -> Lit")


@pytest.mark.parametrize(
    ("line", "candidates"),
    [
        ("", None),
        ("s", ("set", "states", "step")),
        ("go L", ("Lit", "Lamp.Broken", "Lamp.Dark", "Lamp.Lit")),
        ("clear Dark -> L", ("Lit", "Lamp.Broken", "Lamp.Dark", "Lamp.Lit")),
        ("break e", ("error",)),
        ("set eye.s", ("eye.seen", "eye.side")),
        ("set Eye.seen ", ("false", "true")),
        ("hold eye.side Side.l", ("Side.left",)),
        ("print not (eye.se", ("eye.seen",)),
        ("frequency ", ("Eye", "Lamp")),
        ("robot ", ("r1", "r2")),
        ("pause ", ()),
        ("nonsense ", ()),
    ],
)
def test_names_are_completed(project: Project, line: str, candidates: tuple[str, ...] | None) -> None:
    console = RobotConsole(SilentLink(), lambda: project)
    assert console.complete(line) == (tuple(sorted(console.commands)) if candidates is None else candidates)


def test_a_console_without_a_robot_says_so() -> None:
    console = RobotConsole(RobotLink(), lambda: Project(name=""))
    assert console.complete("go ") == ()
    with pytest.raises(ConsoleError, match="there is no robot: attach to one first"):
        asyncio.run(console.run("states"))


def test_the_manual_lists_the_commands() -> None:
    manual = (ROOT / "docs/live.md").read_text(encoding="utf-8")
    for name, (arguments, _doc, _act) in RobotConsole(RobotLink(), lambda: Project(name="")).commands.items():
        assert f"`{name} {arguments}`".replace(" `", "`").replace("|", "\\|") in manual, name


def control(program: RobotProgram, act: Callable[[RobotConsole], Awaitable[None]]) -> None:
    """Run commands as a script does."""

    async def attached() -> None:
        link = RobotLink()
        link.open(program.address, "right")
        link.start()
        try:
            async with asyncio.timeout(LIMIT_S):
                while link.status is not LinkStatus.CONNECTED:
                    await asyncio.sleep(0.005)
                await act(RobotConsole(link, lambda: open_project(program.folder).project, waits=True))
        finally:
            link.close()

    asyncio.run(attached())


def test_a_robot_is_controlled(tmp_path: Path) -> None:
    async def act(console: RobotConsole) -> None:
        assert await console.run("pause") == "paused"
        number = program.root.iteration
        assert await console.run("set eye.seen true") == "set Eye.seen = True"
        # Nothing is received in a pause.
        assert await console.run("print eye.seen") == "eye.seen = true"
        assert await console.run("states") == "Lamp: Dark (of Dark, Lit)"
        await console.run("step 2")
        assert program.root.iteration == number + 2
        assert await console.run("states") == "Lamp: Lit (of Dark, Lit)"
        assert await console.run("go Dark") == "Lamp: Lit → Dark"
        assert await console.run("states") == "Lamp: Dark (of Dark, Lit)"
        await console.run("hold eye.light 20")
        assert await console.run("print eye.light < bright") == "eye.light < bright = false"
        assert await console.run("set bright 30") == "constant bright = 30"
        assert await console.run("print eye.light < bright") == "eye.light < bright = true"
        await console.run("break Lamp.Dark -> Lit")
        await console.run("go")
        while await console.run("robot") != "* Lamp  Lit  paused":
            await asyncio.sleep(0.005)
        await console.run("clear")
        await console.run("break error")
        await console.run("raise Eye oh no")
        assert program.root.errors.total() == 0
        await console.run("resume")
        while await console.run("robot") != "* Lamp  Lit  paused":
            await asyncio.sleep(0.005)
        assert program.root.errors.total() == 1

    with running_robot(write_robot(tmp_path / "lamps")) as program:
        control(program, act)


def test_a_robot_without_control_is_only_shown(tmp_path: Path) -> None:
    async def act(console: RobotConsole) -> None:
        assert await console.run("print eye.light") == "eye.light = 3 lx"
        for command in ("pause", "go Lit", "set eye.seen true", "break Lit"):
            with pytest.raises(ConsoleError, match=re.escape(NO_CONTROL)):
                await console.run(command)

    with running_robot(write_robot(tmp_path / "lamps"), control=False) as program:
        control(program, act)
