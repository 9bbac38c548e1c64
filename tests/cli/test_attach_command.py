"""`vicode attach` prints the state changes of a running robot, and says in one line why it cannot."""

import contextlib
import io
import os
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.cli.command_runner import vicode
from vicode.bica import Component, Root, State
from vicode.bica.live_server import LiveServer

LIMIT_S = 10.0


class Blinker(Component):
    """Changes its state in each iteration."""

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self._set_states(State("Dark", self._in_dark), State("Lit", self._in_lit))

    def _in_dark(self, decide: bool = True) -> None:
        if decide:
            self._change_to("Lit", "on")

    def _in_lit(self, decide: bool = True) -> None:
        if decide:
            self._change_to("Dark")


@contextlib.contextmanager
def blinking(steps_after_viewer: int) -> Iterator[LiveServer]:
    """A robot that ends some steps after someone watches it."""
    root = Root(Blinker)
    server = root.watch()

    def run() -> None:
        due_s = time.monotonic() + LIMIT_S
        left = steps_after_viewer
        while left and time.monotonic() < due_s:
            root.step()
            left -= "step" in vars(root.main)
            time.sleep(0.002)
        time.sleep(0.2)
        root.close()

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    try:
        yield server
    finally:
        thread.join(LIMIT_S)
        assert not thread.is_alive()


def test_state_changes_are_printed_until_the_robot_ends(capsys: pytest.CaptureFixture[str]) -> None:
    with blinking(30) as server:
        assert vicode("attach", server.address, "--token", server.token, "--print") == 1
    out, err = capsys.readouterr()
    assert f"attached to {server.address}: Blinker (may only be watched)" in err
    assert "vicode: the robot closed the connection" in err
    lines = out.splitlines()
    # The active state first, then each change, none lost although most iterations are.
    assert lines[0].split("  ")[-1] in ("Blinker: Dark", "Blinker: Lit")
    assert len(lines) > 20
    changes = [line.split(" s  ")[1] for line in lines[1:]]
    assert set(changes) == {"Blinker: Dark → Lit  (on)", "Blinker: Lit → Dark"}


def test_the_token_may_be_in_the_environment(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with blinking(3) as server:
        monkeypatch.setenv("VICODE_WATCH_TOKEN", server.token)
        assert vicode("attach", server.address, "--print") == 1
    assert "attached to" in capsys.readouterr().err


def test_the_editor_opens_the_design_of_the_robot(tmp_path: Path) -> None:
    for name in ("Blinker", "Anchor"):
        (tmp_path / f"{name.lower()}.yaml").write_text(f"vicode: 1\ncomponent: {name}\n", encoding="utf-8")
    agents = "{First: {root: Anchor}, Second: {root: Blinker}}"
    (tmp_path / "project.yaml").write_text(f"vicode: 1\nproject: Two\nagents: {agents}\n", encoding="utf-8")
    kept = {key: value for key, value in os.environ.items() if not key.startswith(("PYTEST", "NICEGUI"))}
    state = {"VICODE_STATE": str(tmp_path / "state"), "NICEGUI_STORAGE_PATH": str(tmp_path / "storage")}
    with Root(Blinker) as root:
        server = root.watch()
        options = ["attach", server.address, str(tmp_path), "--token", server.token, "--no-open"]
        command = [sys.executable, "-m", "vicode", *options]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env={**kept, **state}) as editor:
            try:
                assert editor.stdout is not None
                shown = [editor.stdout.readline() for _line in range(3)]
            finally:
                editor.kill()
    assert shown[-1].endswith(f"/design/{tmp_path.name}/Blinker\n"), shown


@pytest.mark.parametrize("options", [(), ("--print",)])
def test_a_wrong_token_is_one_line(options: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    with Root(Blinker) as root:
        server = root.watch()
        capsys.readouterr()
        assert vicode("attach", server.address, "--token", "wrong", *options) == 2
    assert "the token is wrong" in capsys.readouterr().err


def test_what_is_no_address(net_port: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("attach", "robot") == 2
    assert capsys.readouterr().err.splitlines() == [
        "vicode: there is no robot 'robot'; write PORT, HOST:PORT or unix:PATH"
    ]


@pytest.mark.parametrize(("settings", "words"), [("", "can be watched with 'live: true'"), ("live: true\n", "")])
def test_a_project_in_cpp_must_ask_for_the_live_view(
    tmp_path: Path, settings: str, words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "project.yaml").write_text(f"vicode: 1\nproject: Lamps\nlanguages: [cpp]\n{settings}")
    with Root(Blinker) as root:
        address = root.watch().address
    capsys.readouterr()
    assert vicode("attach", address, str(tmp_path)) == 2
    err = capsys.readouterr().err
    assert err.startswith("vicode: no robot listens")
    assert words in err
    assert ("live: true" in err) == bool(words)


@contextlib.contextmanager
def controlled() -> Iterator[LiveServer]:
    """A robot with control that runs until it is left."""
    root, is_over = Root(Blinker), threading.Event()
    server = root.watch(control=True, without_hold=True)

    def run() -> None:
        while not is_over.is_set():
            root.step()
            time.sleep(0.002)
        root.close()

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    try:
        yield server
    finally:
        is_over.set()
        thread.join(LIMIT_S)
        assert not thread.is_alive()


def console(server: LiveServer, folder: Path, script: str, monkeypatch: pytest.MonkeyPatch) -> int:
    monkeypatch.setattr(sys, "stdin", io.StringIO(script))
    return vicode("attach", server.address, str(folder), "--token", server.token, "--console")


def test_a_script_commands_a_robot(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with controlled() as server:
        assert console(server, tmp_path, "# twice\n\npause\nstep 2\ngo Lit\nstates\n", monkeypatch) == 0
    out, err = capsys.readouterr()
    assert f"attached to {server.address}: Blinker (with control)" in err
    lines = out.splitlines()
    assert lines[0].split("  ")[-1] in ("Blinker: Dark", "Blinker: Lit")
    assert "Blinker is paused" in lines
    answers = ("paused", "runs 2 iterations", "Blinker: Lit (of Dark, Lit)")
    assert [line for line in lines if line in answers] == list(answers)


def test_a_script_ends_at_the_first_command_that_fails(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with controlled() as server:
        assert console(server, tmp_path, "pause\n\ngo Litt\nresume\n", monkeypatch) == 1
    out, err = capsys.readouterr()
    assert "vicode: line 3: there is no state 'Litt'; did you mean 'Lit'?\n" in err
    assert "resumed" not in out


def test_a_console_needs_a_robot_with_control(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with Root(Blinker) as root:
        server = root.watch()
        root.step()
        assert console(server, tmp_path, "help\npause\n", monkeypatch) == 1
        assert vicode("attach", server.address, str(tmp_path), "--token", "wrong", "--console") == 2
    out, err = capsys.readouterr()
    assert "set NAME VALUE                  set an output" in out
    assert "line 2: The robot may only be watched. To control it, start it with --control" in err
    assert "the token is wrong" in err


def test_a_terminal_completes_names_and_ends_with_the_robot(tmp_path: Path) -> None:
    import pty

    terminal, inner = pty.openpty()
    with controlled() as server:
        options = ["attach", server.address, str(tmp_path), "--token", server.token, "--console"]
        command = [sys.executable, "-m", "vicode", *options]
        process = subprocess.Popen(command, stdin=inner, stdout=inner, stderr=inner)
        os.close(inner)
        shown = ""

        def read_until(words: str) -> None:
            nonlocal shown
            while words not in shown:
                shown += os.read(terminal, 4096).decode()

        read_until("> ")
        os.write(terminal, b"pau\t\r")
        read_until("\npaused")
        os.write(terminal, b"go Blinker.L\t\r")
        read_until("→ Lit\r\n")
        os.write(terminal, b"nonsense\r")
        read_until("there is no command 'nonsense'")
        os.write(terminal, b"resume\r")
        read_until("\nresumed")
    read_until("vicode: the robot closed the connection")
    assert process.wait(LIMIT_S) == 1
    os.close(terminal)
