"""Every way out of a run closes the components and the world, and then asks the world for its summary."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
from pathlib import Path

import pytest

from vicode.bica import Component, ComponentError, Root, SimulatedClock

PROJECT = Path(__file__).parents[2]
# A process under nohup ignores SIGHUP, and so do its children.
SIGNALS = [signal.SIGINT, signal.SIGTERM, *([signal.SIGHUP] * (signal.getsignal(signal.SIGHUP) != signal.SIG_IGN))]
CLOSED = ["close Car", "close Wheels", "close Road", "summary"]
OWN = """\
import signal, sys, time
from vicode.bica import Component, State

class Road:
    finished = False
    def __init__(self):
        self.log = []
    def advance(self, now_ns):
        if now_ns and "advance" in sys.argv[-1]:
            raise OSError("no road")
        if now_ns and "world_exit" in sys.argv[-1]:
            sys.exit(5)
        self.finished = now_ns > 0 and "finished" in sys.argv[-1]
    def close(self):
        self.log.append("close Road")
    def summary(self):
        self.log.append("summary")
        return self.log

class Wheels(Component):
    def close(self):
        self.world.log.append("close Wheels")
        if "close" in sys.argv[-1]:
            raise OSError("no wheels")

class Car(Component):
    def __init__(self, root):
        super().__init__(root)
        self.wheels = root.component(Wheels)
        if "init" in sys.argv[-1]:
            self.wheels.close = lambda: print("close Wheels", file=sys.stderr)
            self.world.close = lambda: print("close Road", file=sys.stderr)
            raise OSError("no car")
        self._set_states(State("Only", self._in_only, final=True))
    def close(self):
        self.world.log.append("close Car")
    def _in_only(self, decide=True):
        mode = sys.argv[-1]
        if "error" in mode:
            raise KeyError("car")
        if mode == "exit":
            sys.exit(5)
        if "wait" in mode:
            print("waiting", flush=True)
            time.sleep(60)
        if "run" in mode:
            print("running", flush=True)
            time.sleep(0.01)
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "own.py").write_text(OWN, encoding="utf-8")
    return tmp_path


def start(folder: Path, *arguments: str) -> subprocess.Popen[str]:
    """Start a run; the last `--path` tells the code what to do."""
    command = [sys.executable, "-m", "vicode.bica", "own:Car", "--world", "own:Road", "--path", str(folder)]
    return subprocess.Popen(
        [*command, *arguments],
        env={**os.environ, "PYTHONPATH": str(PROJECT)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def read_summary(out: str) -> dict[str, object]:
    [line] = [line for line in out.splitlines() if line.startswith('{"summary"')]
    summary = json.loads(line)["summary"]
    assert isinstance(summary, dict)
    return summary


@pytest.mark.parametrize(
    ("arguments", "code", "stopped"),
    [
        (("--ticks", "2", "--path", "limit"), 0, "limit"),
        (("--until-done", "--path", "done"), 0, "done"),
        (("--path", "finished"), 0, "finished"),
        (("--on-error", "stop", "--path", "error"), 1, "error"),
        (("--ticks", "2", "--path", "error"), 0, "limit"),
        (("--path", "advance"), 2, "error"),
        (("--path", "world_exit"), 1, "error"),
        (("--on-error", "stop", "--path", "exit"), 1, "error"),
        (("--ticks", "2", "--path", "exit"), 0, "limit"),
        (("--ticks", "2", "--path", "close"), 0, "limit"),
    ],
)
def test_all_are_closed_before_the_summary(folder: Path, arguments: tuple[str, ...], code: int, stopped: str) -> None:
    process = start(folder, "--stream", *arguments)
    out, _err = process.communicate(timeout=60)
    assert process.returncode == code
    summary = read_summary(out)
    assert (summary["stopped"], summary["world"]) == (stopped, CLOSED)


@pytest.mark.parametrize("number", SIGNALS)
def test_a_signal_ends_the_run_after_the_iteration(folder: Path, number: signal.Signals) -> None:
    process = start(folder, "--stream", "--real-time", "--path", "run")
    assert process.stdout is not None
    process.stdout.readline()
    process.send_signal(number)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 128 + number, err
    assert (read_summary(out)["stopped"], read_summary(out)["world"]) == ("interrupted", CLOSED)


def test_a_signal_ends_a_run_that_a_viewer_has_paused(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("VICODE_WATCH", f"unix:{folder / 'live'}")
    monkeypatch.setenv("VICODE_WATCH_CONTROL", "without-hold")
    process = start(folder, "--stream", "--real-time", "--path", "run")
    assert process.stdout is not None
    process.stdout.readline()
    with socket.socket(socket.AF_UNIX) as viewer:
        viewer.connect(str(folder / "live"))
        viewer.sendall(b'{}\n{"id": 7, "robot": "Car", "do": "pause"}\n')
        with viewer.makefile() as lines:
            assert any('"answer":7' in line for line in lines)
        process.send_signal(signal.SIGTERM)
        try:
            out, err = process.communicate(timeout=30)
        finally:
            process.kill()
    assert process.returncode == 128 + signal.SIGTERM, err
    assert (read_summary(out)["stopped"], read_summary(out)["world"]) == ("interrupted", CLOSED)


def test_viewers_see_the_name_in_the_environment(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("VICODE_ROBOT", "r1")
    process = start(folder, "--stream", "--real-time", "--path", "run", "--watch", f"unix:{folder / 'live'}")
    try:
        assert process.stdout is not None
        process.stdout.readline()
        with socket.socket(socket.AF_UNIX) as viewer:
            viewer.connect(str(folder / "live"))
            viewer.sendall(b"{}\n")
            with viewer.makefile() as lines:
                description = json.loads(lines.readline())
    finally:
        process.terminate()
        process.communicate(timeout=30)
    assert [robot["name"] for robot in description["robots"]] == ["r1"]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_the_second_signal_ends_the_run_at_once(folder: Path, number: signal.Signals) -> None:
    process = start(folder, "--real-time", "--path", "wait")
    assert process.stdout is not None
    assert process.stderr is not None
    process.stdout.readline()
    process.send_signal(number)
    assert process.stderr.readline().startswith("stopping after this iteration")
    process.send_signal(number)
    out, err = process.communicate(timeout=30)
    assert process.returncode == 128 + number, err
    assert "stopped: interrupted\n" in out
    assert f"world: {json.dumps(CLOSED)}\n" in out


def test_a_reader_that_leaves_closes_all(folder: Path) -> None:
    process = start(folder, "--stream", "--real-time", "--path", "run")
    assert process.stdout is not None
    assert process.stderr is not None
    process.stdout.readline()
    process.stdout.close()
    with process.stderr as errors:
        text = errors.read()
    assert process.wait(timeout=60) == 1, text


def test_an_address_in_use_is_no_error_of_the_component(folder: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        address = f"127.0.0.1:{other.getsockname()[1]}"
        _out, err = start(folder, "--watch", address, "--path", "limit").communicate(timeout=60)
    assert err == f"error: viewers cannot connect to {address}: Address already in use; choose another --watch\n"


def test_a_failing_start_closes_what_was_created(folder: Path) -> None:
    process = start(folder, "--stream", "--path", "init")
    _out, err = process.communicate(timeout=60)
    assert process.returncode == 2
    assert err.splitlines()[:2] == ["close Wheels", "close Road"]


def test_a_full_disk_ends_the_trace_and_not_the_run(folder: Path) -> None:
    process = start(folder, "--stream", "--ticks", "300", "--trace", "/dev/full", "--path", "limit")
    out, err = process.communicate(timeout=60)
    assert process.returncode == 3
    assert err == "error: cannot write the trace /dev/full: No space left on device; the run continues without it\n"
    assert (read_summary(out)["iterations"], read_summary(out)["world"]) == (300, CLOSED)


@pytest.mark.parametrize("streams", ["2>&-", ">&- 2>&-", "<&- >&- 2>&-", "2>/dev/full"])
def test_missing_streams_do_not_matter(folder: Path, streams: str) -> None:
    command = f'"{sys.executable}" -m vicode.bica own:Car --world own:Road --ticks 3 --trace trace'
    done = subprocess.run(
        ["/bin/sh", "-c", f"{command} --path error {streams}"],
        env={**os.environ, "PYTHONPATH": f"{PROJECT}:{folder}"},
        cwd=folder,
        check=False,
        timeout=60,
        stdout=subprocess.PIPE,
    )
    assert done.returncode == 0
    lines = (folder / "trace").read_text(encoding="utf-8").splitlines()
    assert len([json.loads(line) for line in lines]) == 5


class Motor(Component):
    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.closed = 0

    def close(self) -> None:
        self.closed += 1
        raise OSError("no motor")


def test_a_root_is_closed_once() -> None:
    records: list[object] = []
    with Root(Motor, clock=SimulatedClock(), on_error=records.append) as root:
        root.step()
    root.close()
    assert root.component(Motor).closed == len(records) == 1


def test_errors_while_closing_stop_after_all_were_closed() -> None:
    class Car(Component):
        def __init__(self, root: Root) -> None:
            super().__init__(root)
            self.motor = root.component(Motor)

        def close(self) -> None:
            raise KeyError("car")

    root = Root(Car, clock=SimulatedClock(), on_error="stop")
    with pytest.raises(ComponentError):
        root.close()
    assert root.component(Motor).closed == 1
