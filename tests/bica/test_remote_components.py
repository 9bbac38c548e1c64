"""Components of other robots: outputs, parameters, activation, and wrong messages."""

import json
import signal
import subprocess
import sys
from collections.abc import Callable
from math import inf
from pathlib import Path
from typing import Any

import pytest

from tests.bica.net_robots import (
    Eyes,
    Idle,
    MakeRoot,
    ReliableEyes,
    RemoteEyes,
    RemoteWatch,
    Side,
    Watch,
    step_until,
)
from vicode.bica import Component, Observer, Root
from vicode.bica.errors import NetworkError
from vicode.bica.net_session import open_session


def eyes(root: Root) -> Any:
    return root.main


def test_outputs_are_read_and_parameters_sent(make_root: MakeRoot) -> None:
    robot, caller = make_root(Eyes, "striker"), make_root(RemoteEyes)
    seen = eyes(caller)
    assert (seen.is_alive, seen.data_age) == (False, inf)
    seen.modulate(zoom=2.5, seek=Side.right)
    step_until(lambda: seen.distance == 2.5, caller, robot)
    assert (seen.side, seen.seen, seen.is_alive) == (Side.right, False, True)
    assert 0 < seen.steps <= eyes(robot).steps
    assert seen.data_age < inf


def test_a_called_component_works_as_long_as_it_is_called(make_root: MakeRoot) -> None:
    robot, caller = make_root(Idle, "striker"), make_root(RemoteEyes)
    served = robot.component(Eyes)
    robot.step()
    assert served.steps == 0
    step_until(lambda: served.steps, caller, robot)
    assert served.starts == 1
    # Nothing calls it any more: after a while, it is not stepped.
    step_until(lambda: served._stepped_in < robot.iteration, robot)
    # Called again, it starts again.
    step_until(lambda: served.starts == 2, caller, robot)


def test_a_new_activation_restarts_a_component_and_forgets_that_it_was_done(make_root: MakeRoot) -> None:
    robot, caller = make_root(Idle, "striker"), make_root(RemoteWatch)
    watch, seen = robot.component(Watch), caller.main
    step_until(lambda: seen.is_done, caller, robot)
    assert seen.state == "End"
    caller.iteration += 2  # iterations in which it was not stepped
    caller.step()
    assert not seen.is_done
    robot.step()
    assert watch.state == "End"
    assert watch._started_ns == robot.now_ns
    step_until(lambda: seen.is_done, caller, robot)


def test_the_robot_itself_has_precedence(make_root: MakeRoot) -> None:
    class Owner(Component):
        def __init__(self, root: Root) -> None:
            super().__init__(root)
            self.eyes = root.component(Eyes)

        def work(self) -> None:
            self._call(self.eyes, zoom=7.0)

    robot, caller = make_root(Owner, "striker"), make_root(RemoteEyes)
    eyes(caller).modulate(zoom=2.0)
    step_until(lambda: eyes(caller).steps > 5, caller, robot)
    assert set(robot.component(Eyes).history) == {7.0}
    assert robot.component(Eyes).steps == robot.iteration


def test_newest_only_skips_what_reliable_delivers(make_root: MakeRoot) -> None:
    robot = make_root(Eyes, "striker")
    newest, reliable = make_root(RemoteEyes), make_root(ReliableEyes)
    step_until(lambda: eyes(newest).steps and eyes(reliable).steps, newest, reliable, robot)
    step_until(lambda: eyes(reliable).steps == eyes(robot).steps, reliable)
    for _ in range(5):
        robot.step()
    newest.step()
    before = eyes(reliable).steps
    seen = []
    for _ in range(5):
        reliable.step()
        seen.append(eyes(reliable).steps - before)
    assert eyes(newest).steps == eyes(robot).steps
    assert seen == [1, 2, 3, 4, 5]


def test_each_change_of_parameters_counts_for_reliable_callers(make_root: MakeRoot) -> None:
    robot, caller = make_root(Eyes, "striker"), make_root(ReliableEyes)
    step_until(lambda: eyes(caller).steps, caller, robot)
    for zoom in (2.0, 3.0, 4.0):
        eyes(caller).modulate(zoom=zoom)
        caller.step()
    step_until(lambda: eyes(robot).distance == 4.0, robot)
    assert list(dict.fromkeys(eyes(robot).history)) == [1.0, 2.0, 3.0, 4.0]


def test_more_than_can_wait_is_reported_as_lost(make_root: MakeRoot, capsys: pytest.CaptureFixture[str]) -> None:
    robot, caller = make_root(Eyes, "striker"), make_root(ReliableEyes)
    step_until(lambda: eyes(caller).steps, caller, robot)
    for _ in range(400):
        robot.step()
    step_until(lambda: eyes(caller).steps == eyes(robot).steps, caller)
    assert "striker/Eyes sent messages that were lost" in capsys.readouterr().err


JUNK = [
    b"",
    b"\xff\xfe",
    b"[" * 60_000,
    b"x" * 70_000,
    b"[]",
    b"null",
    b'{"number": 1, "state": 3, "values": {}}',
    b'{"number": 1, "state": "", "values": []}',
    b'{"activation": "", "for": "long", "parameters": {"zoom": 1}}',
    b'{"activation": "", "for": 1, "parameters": {"zoom": "__import__(\'os\')"}}',
    b'{"activation": "", "for": 1, "parameters": {"self": 1}}',
    b'{"activation": "", "for": 1, "parameters": {"seek": "Side.__class__"}}',
    b'{"activation": "", "for": 1, "parameters": [' + b"9" * 5000 + b"]}",
]


def test_junk_changes_nothing_and_stops_nobody(make_root: MakeRoot, capsys: pytest.CaptureFixture[str]) -> None:
    robot, caller = make_root(Eyes, "striker"), make_root(RemoteEyes)
    step_until(lambda: eyes(caller).steps, caller, robot)
    attacker = open_session()
    distance = eyes(robot).distance
    for junk in JUNK:
        for key in ("output/Eyes", "call/Eyes/newest", "call/Eyes/each", "call/Nobody/each", "call/root/newest"):
            attacker.sender(f"vicode/striker/{key}").put(junk)
            caller.step()
        robot.step()
    attacker.close()
    assert eyes(robot).distance == distance
    step_until(lambda: eyes(caller).steps == eyes(robot).steps, robot, caller)
    assert not robot.errors
    printed = capsys.readouterr().err
    assert "striker/Eyes sends what is no message" in printed
    assert "a call of Eyes was refused: ValueError: zoom: __import__('os') is no float" in printed
    assert "a call of Eyes was refused: ValueError: unknown parameter 'self'" in printed


def test_wrong_outputs_keep_their_values_and_the_others_are_read(
    make_root: MakeRoot, capsys: pytest.CaptureFixture[str]
) -> None:
    caller = make_root(RemoteEyes)
    other = open_session()
    values = {"distance": "far", "side": "Side.up", "seen": 0, "steps": 2}
    other.sender("vicode/striker/output/Eyes").put(json.dumps({"number": 1, "state": "", "values": values}))
    step_until(lambda: eyes(caller).steps == 2, caller)
    other.close()
    seen = eyes(caller)
    assert (seen.distance, seen.side, seen.seen) == (0.0, Side.left, True)
    printed = capsys.readouterr().err
    assert "striker/Eyes sends a wrong 'distance': far is no float" in printed
    assert "striker/Eyes sends a wrong 'side': Side.up is no Side" in printed


def test_an_exception_of_the_component_is_reported_by_its_robot(
    make_root: MakeRoot, capsys: pytest.CaptureFixture[str]
) -> None:
    robot, caller = make_root(Eyes, "striker"), make_root(RemoteEyes)
    eyes(caller).modulate(zoom=13.0)
    step_until(lambda: robot.errors, caller, robot)
    assert "RuntimeError: unlucky" in capsys.readouterr().err


def test_a_killed_process_is_noticed_and_its_data_kept(
    make_root: MakeRoot, start_robot: Callable[[str], "subprocess.Popen[str]"]
) -> None:
    caller = make_root(RemoteEyes)
    process = start_robot("striker")
    seen = eyes(caller)
    seen.modulate(zoom=2.5)
    step_until(lambda: seen.is_alive and seen.distance == 2.5, caller)
    process.send_signal(signal.SIGKILL)
    # The data is not old enough to be the reason.
    step_until(lambda: not seen.is_alive, caller)
    assert seen.data_age < seen.MAX_AGE
    steps, age = seen.steps, seen.data_age
    caller.step()
    assert (seen.distance, seen.steps) == (2.5, steps)
    assert seen.data_age > age
    # It counts its steps from 0 when it comes back, at the port that became free.
    start_robot("striker")
    step_until(lambda: seen.is_alive and seen.steps < steps, caller)


def test_a_robot_that_stands_still_is_not_alive_for_long(make_root: MakeRoot) -> None:
    class ImpatientEyes(RemoteEyes):
        MAX_AGE = 0.02

    robot, caller = make_root(Eyes, "striker"), make_root(ImpatientEyes)
    step_until(lambda: eyes(caller).is_alive, caller, robot)
    step_until(lambda: not eyes(caller).is_alive, caller)
    step_until(lambda: eyes(caller).is_alive, caller, robot)


@pytest.mark.parametrize(
    ("name", "message"), [("", "no name"), ("a/b", "no name"), ("*", "no name"), ("x" * 65, "no name")]
)
def test_names_that_are_no_keys_are_refused(make_root: MakeRoot, name: str, message: str) -> None:
    with pytest.raises(NetworkError, match=message):
        make_root(Idle).connect(name)


def test_a_root_has_one_name(make_root: MakeRoot) -> None:
    with pytest.raises(NetworkError, match="connected as r1"):
        make_root(Idle, "r1").connect("r2")


def test_a_missing_extra_is_one_line(net_port: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "zenoh", None)
    with pytest.raises(NetworkError, match=r"pip install 'vicode-fsm\[net\]'"):
        Root(RemoteEyes)


def test_a_bad_configuration_names_its_file(
    net_port: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "net.json5"
    file.write_text("{mode: 'sideways'}")
    monkeypatch.setenv("VICODE_NET_CONFIG", str(file))
    monkeypatch.setenv("VICODE_NET", "r1")
    with Root(Idle) as root:
        root.step()
        assert root.network is None
    assert f"error: VICODE_NET_CONFIG={file}: " in capsys.readouterr().err


def test_a_program_that_does_not_close_its_root_ends(net_port: str) -> None:
    program = "from tests.bica.net_robots import *; Root(RemoteEyes).step(); Root(Idle).connect('r1', team='blue')"
    subprocess.run([sys.executable, "-c", program], cwd=Path(__file__).parents[2], check=True, timeout=60)


def test_the_live_view_and_records_show_the_age(make_root: MakeRoot) -> None:
    make_root(Eyes, "striker").step()
    records: list[Any] = []
    with Root(RemoteEyes, observer=Observer(records.append, values=True)) as caller:
        caller.step()
    values = records[0]["tree"][0]["values"]
    assert {"data_age", "is_alive", "distance", "zoom"} <= values.keys()
