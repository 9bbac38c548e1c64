"""Code is exchanged while it runs: states, times and values stay; on an error, all stays as it was."""

import json
import socket
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.generators.code_tools import write_files
from vicode.bica import Observer, Root, SimulatedClock
from vicode.bica.loader import load_component
from vicode.bica.reload import Reloader
from vicode.generators import generate
from vicode.store import open_project

PROJECT = """\
vicode: 1
project: Reloaded
enumerations: {Side: [left, right]}
constants: {limit: 3}
components:
  Sensor: {implementation: "rig_of_reload:Sensor", outputs: {level: {type: float}}}
"""
LAMP = """\
vicode: 1
component: Lamp
uses: {sensor: Sensor}
outputs: {side: Side.left}
variables: {count: 0}
initial: Dark
states:
  Dark: {requires: [sensor], actions: [{set: {count: count + 1}}], transitions: [{to: Lit, when: sensor.level > limit}]}
  Lit: {requires: [sensor], actions: [{set: {count: count + 10, side: Side.right}}]}
"""
CALLER = """\
vicode: 1
component: Caller
frequency: 2
uses: {lamp: Lamp}
variables: {count: 0}
initial: On
states:
  On: {modulates: [lamp], actions: [{set: {count: count + 1}}]}
"""
RIG = """\
from vicode.bica import Component


class Sensor(Component):
    def __init__(self, root):
        super().__init__(root)
        self.level = 0.0
        self.opened = object()

    def work(self):
        self.level += 1
"""


class Run:
    """A root of generated code in a folder whose files change."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.write("project.yaml", PROJECT)
        self.write("lamp.yaml", LAMP)
        self.write("rig_of_reload.py", RIG)
        self.generate()
        self.observer = Observer(values=True)
        self.clock = SimulatedClock()
        lamp = load_component("reloaded.lamp:Lamp")
        self.root = Root(lamp, clock=self.clock, observer=self.observer, on_error="stop")
        self.reloader = Reloader(self.root, [str(folder / "out/python"), str(folder)])

    def write(self, name: str, text: str) -> None:
        (self.folder / name).write_text(text)

    def generate(self) -> None:
        write_files(generate(open_project(self.folder).project), self.folder / "out")

    def step(self, count: int = 1) -> None:
        for _step in range(count):
            self.root.step()
            self.clock.advance(100_000_000)

    def change(self, name: str, old: str, new: str) -> list[str]:
        text = (self.folder / name).read_text()
        assert old in text
        self.write(name, text.replace(old, new))
        self.generate()
        return self.reloader.reload()

    def value(self, name: str) -> object:
        return getattr(self.root.main, name)


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Run]:
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.syspath_prepend(str(tmp_path / "out/python"))
    made = Run(tmp_path)
    yield made
    for name in [*sys.modules]:
        if name.partition(".")[0] in ("reloaded", "rig_of_reload"):
            del sys.modules[name]


def test_state_time_and_values_stay(run: Run) -> None:
    run.step(6)
    assert (run.root.main.state, run.value("count")) == ("Lit", 33)
    time_s = run.root.main.state_time
    messages = run.change("lamp.yaml", "count + 10", "count + 100")
    assert len(messages) == 1
    assert "reloaded.lamp" in messages[0]
    assert (run.root.main.state, run.root.main.state_time) == ("Lit", time_s)
    run.step()
    assert run.value("count") == 133
    assert run.observer.records[-1]["tree"][0]["values"]["count"] == 133


def test_new_states_and_variables_begin_with_their_values(run: Run) -> None:
    run.step(2)
    run.change("lamp.yaml", "variables: {count: 0}", "variables: {count: 0, extra: 5}")
    run.change(
        "lamp.yaml",
        "when: sensor.level > limit}]}",
        "when: sensor.level > limit}, {to: New, when: extra > 4}]}\n  New: {}",
    )
    run.step()
    assert (run.value("extra"), run.value("count"), run.root.main.state) == (5, 2, "New")


def test_a_state_that_is_gone_is_told(run: Run) -> None:
    run.step(6)
    messages = run.change("lamp.yaml", "Lit", "Bright")
    assert messages[1:] == ["Lamp has no state Lit any more; it starts in Dark"]
    run.step()
    assert run.root.main.state == "Bright"


def test_constants_and_enumerations_change_everywhere(run: Run) -> None:
    run.step(6)
    run.change("project.yaml", "limit: 3", "limit: 300")
    assert str(run.value("side")) == "Side.right"
    assert run.value("side") is type(run.value("side"))["right"]
    assert type(run.value("side")) is sys.modules["reloaded.declarations"].Side
    assert sys.modules["reloaded.lamp"].limit == 300


def test_methods_of_hand_written_components_change_and_devices_stay(run: Run) -> None:
    run.step(2)
    sensor = run.root.components[0]
    device = vars(sensor)["opened"]
    messages = run.change("rig_of_reload.py", "self.level += 1", "self.level -= 1")
    assert messages[0].startswith("reloaded ")
    run.step()
    assert (vars(sensor)["level"], vars(sensor)["opened"]) == (1.0, device)
    assert run.root.components[0] is sensor
    words = run.change("rig_of_reload.py", "self.opened = object()", "self.opened = dict()")[1]
    assert words == "Sensor.__init__ has changed and was not run; restart to run it"


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("self.level += 1", "self.level += = 1"),
        ("class Sensor", "class Sensors"),
        ("from vicode", "raise OSError\nfrom vicode"),
    ],
)
def test_an_error_leaves_everything_as_it_was(run: Run, old: str, new: str) -> None:
    run.step(2)
    (message,) = run.change("rig_of_reload.py", old, new)
    assert message.startswith("not reloaded: ")
    assert message.endswith("; the old code keeps running")
    run.step()
    assert (run.value("count"), vars(run.root.components[0])["level"]) == (3, 3.0)
    assert run.change("rig_of_reload.py", new, old)[0].startswith("reloaded ")
    run.step()
    assert vars(run.root.components[0])["level"] == 4.0


def test_called_components_go_on_between_two_periods(run: Run) -> None:
    run.write("caller.yaml", CALLER)
    run.generate()
    root = Root(load_component("reloaded.caller:Caller"), clock=run.clock, on_error="stop")
    reloader = Reloader(root, [str(run.folder / "out/python"), str(run.folder)])
    for number in range(12):
        root.step()
        run.clock.advance(100_000_000)
        if number == 6:
            run.write("caller.yaml", CALLER.replace("count + 1", "count + 2"))
            run.generate()
            assert len(reloader.reload()) == 1
    lamp = next(component for component in root.components if type(component).__name__ == "Lamp")
    assert (lamp.state, round(lamp.component_time, 1)) == ("Lit", 1.1)


def test_nothing_is_reloaded_without_a_change(run: Run) -> None:
    assert run.reloader.reload() == []
    assert run.reloader.reload_if_asked() == []


def test_viewers_get_the_description_of_the_new_code(run: Run) -> None:
    server = run.root.watch()
    host, _colon, port = server.address.rpartition(":")
    with socket.create_connection((host, int(port)), timeout=20) as connection, connection.makefile("rb") as lines:
        connection.sendall(json.dumps({"token": server.token}).encode() + b"\n")
        hellos = (hello["robots"][0] for line in lines if "vicode-live" in (hello := json.loads(line)))
        old = next(hellos)
        run.change("lamp.yaml", "count: count + 10", "count: count + 20")
        new = next(hellos)
        assert new["components"]["Lamp"]["code"] != old["components"]["Lamp"]["code"]
        run.change("project.yaml", "limit: 3", "limit: 4")
        assert next(hellos)["shared"] != new["shared"]
    run.root.close()
