"""The forward in C++ plays as the one in Python: the same trace on the same field."""

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest
from field.head import Head
from field.kicker import Kicker
from field.perception import Perception
from field.stand_up import StandUp
from field.walk import Walk
from field.world import World
from forward.declarations import Kick, Side
from forward.player import Player

from tests.cpp_tools import STANDARD, WARNINGS, find_gpp, outputs, start, write_project
from tests.designs.conftest import ROOT
from vicode.bica import Observer, Root, SimulatedClock

TICK_NS = 20_000_000
TICKS = 3000
OUTPUTS = {
    Perception: (
        *("ball_seen", "ball_x", "ball_y", "ball_distance", "ball_bearing", "ball_ahead", "ball_left", "ball_age"),
        *("net_seen", "net_bearing", "net_distance", "net_age", "bottom_camera", "neck_pan", "neck_tilt", "fallen"),
    ),
    Head: ("pan", "tilt"),
    Kicker: ("busy",),
    Walk: (),
    StandUp: (),
}
PARAMETERS = {Head: ("pan", "tilt"), Walk: ("forward", "lateral", "turn"), Kicker: ("kick", "side")}


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    gpp = find_gpp()
    out = tmp_path_factory.mktemp("forward")
    write_project(ROOT / "designs" / "forward", out)
    source = str(Path(__file__).with_name("forward_main.cpp"))
    sanitizers = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
    command = [gpp, *STANDARD, *WARNINGS, *sanitizers, "-I.", source, "forward_unit.cpp", "-o", "player"]
    outputs([start(command, out / "cpp")])
    return out / "cpp" / "player"


class Field:
    """Answers the requests of the program; its components are those of the Python project, which nothing steps."""

    def __init__(self, seed: int) -> None:
        self.world = World(seed=seed)
        self.clock = SimulatedClock()
        self.root = Root(Player, clock=self.clock, world=self.world)
        self.components = {each.__name__: self.root.component(each) for each in OUTPUTS}

    def answer(self, request: str) -> str:
        verb, name, *given = request.split()
        if verb == "advance":
            self.root.now_ns = int(name)
            is_finished = self.world.finished
            if not is_finished:
                self.world.advance(self.root.now_ns)
            return str(int(not is_finished))
        component: Any = self.components[name]
        if verb == "bearing_to":
            x, y = map(float.fromhex, given)
            return str(component.bearing_to(x=x, y=y).hex())
        if verb == "restart":
            component.restart()
        else:
            self._modulate(component, given)
            component.work()
        values = [getattr(component, output) for output in OUTPUTS[type(component)]]
        return " ".join(float(value).hex() for value in values)

    def _modulate(self, component: Any, given: list[str]) -> None:
        if isinstance(component, Kicker):
            component.modulate(kick=Kick[given[0]], side=Side[given[1]])
        elif given:
            names = PARAMETERS[type(component)]
            component.modulate(**dict(zip(names, map(float.fromhex, given), strict=True)))


def play_in_cpp(program: Path, *, seed: int, ticks: int, trace: str) -> tuple[Field, str]:
    """Run the program; return the field and what the program printed to standard error."""
    field = Field(seed)
    command = [str(program), str(ticks), trace]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=pipe, text=True) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        assert process.stderr is not None
        for request in process.stdout:
            if not request.startswith("kick "):
                process.stdin.write(field.answer(request) + "\n")
                process.stdin.flush()
        errors = process.stderr.read()
    assert process.returncode == 0, errors
    return field, errors


def play_in_python(seed: int, ticks: int) -> tuple[World, list[Any]]:
    world, clock, observer = World(seed=seed), SimulatedClock(), Observer(values=True)
    root = Root(Player, clock=clock, world=world, on_error="stop", observer=observer)
    for _ in range(ticks):
        if world.finished:
            break
        world.advance(clock.now_ns())
        root.step()
        clock.advance(TICK_NS)
    return world, json.loads(json.dumps(observer.records))


def steps_of(record: Any) -> list[Any]:
    """The activation tree; the values of hand-written components differ, since each language stores its own."""
    keys = ("component", "by", "link", "worked", "state", "state_time_ns", "changed_from", "transition", "done")
    written_by_hand = {each.__name__ for each in OUTPUTS}
    return [
        {key: step[key] for key in (*keys, "parameters", *([] if step["component"] in written_by_hand else ["values"]))}
        for step in record["tree"]
    ]


def test_it_scores_with_the_same_trace_as_in_python(program: Path, tmp_path: Path) -> None:
    field, _errors = play_in_cpp(program, seed=1, ticks=TICKS, trace=str(tmp_path / "trace.jsonl"))
    header, *lines = (tmp_path / "trace.jsonl").read_text("utf-8").splitlines()
    world, records = play_in_python(seed=1, ticks=TICKS)
    assert json.loads(header)["language"] == "cpp"
    assert len(lines) == len(records)
    for line, expected in zip(lines, records, strict=True):
        record = json.loads(line)
        assert (record["iteration"], record["time_ns"]) == (expected["iteration"], expected["time_ns"])
        assert steps_of(record) == steps_of(expected)
    assert field.world.summary() == world.summary()
    assert field.world.summary()["goals"] == 1


def test_no_memory_is_allocated_after_the_start(program: Path) -> None:
    _field, allocations = play_in_cpp(program, seed=1, ticks=1000, trace="-")
    assert allocations == "0"
