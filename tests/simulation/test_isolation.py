"""A launched program ends with all its descendants; in the sandbox it sees only what it was given."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from vicode.simulation import isolation
from vicode.simulation.isolation import isolation_problem, launch_command, make_temporary

# A descendant in a session of its own, whose parent has ended.
DAEMON = """
import os, sys, time
reader, writer = os.pipe()
if os.fork() == 0:
    os.setsid()
    if os.fork() == 0:
        print(sys.argv[1], flush=True)
        os.write(writer, b"x")
        time.sleep(600)
    os._exit(0)
os.wait()
os.read(reader, 1)
"""
LOOK = """
import json, os, resource, socket, sys
def can(act):
    try:
        act()
    except OSError:
        return False
    return True
folder, temporary, editor = sys.argv[1:]
print(json.dumps({
    "outside": os.path.exists(os.path.join(folder, "..", "secret")),
    "shadow": os.path.exists("/etc/shadow"),
    "inside": open(os.path.join(folder, "own.txt")).read(),
    "write inside": can(lambda: open(os.path.join(folder, "new.txt"), "w")),
    "write temporary": can(lambda: open(os.path.join(temporary, "new.txt"), "w")),
    "network": can(lambda: socket.socket(socket.AF_INET, socket.SOCK_DGRAM).connect(("192.0.2.1", 9))),
    "interfaces": [name for _index, name in socket.if_nameindex()],
    "parents": can(lambda: os.kill(int(editor), 0)),
    "processes": resource.getrlimit(resource.RLIMIT_NPROC)[0] <= 64,
    "files": resource.getrlimit(resource.RLIMIT_FSIZE)[0] <= 1 << 30,
    "root": os.getuid() == 0,
}))
"""
isolated = pytest.mark.parametrize("is_isolated", [False, *([True] if not isolation_problem() else [])])


def test_it_does_not_depend_on_the_current_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir("/usr")
    problem = isolation_problem.__wrapped__()
    monkeypatch.chdir(tmp_path)
    assert isolation_problem.__wrapped__() == problem


def start(code: str, *arguments: str, is_isolated: bool, folder: Path) -> "subprocess.Popen[str]":
    command = launch_command(
        [sys.executable, "-c", code, *arguments], (str(folder),), make_temporary(), is_isolated=is_isolated
    )
    return subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=folder)


def is_running(mark: str) -> bool:
    commands = (process / "cmdline" for process in Path("/proc").iterdir() if process.name.isdigit())
    return any(mark in _read(command) for command in commands)


def _read(command: Path) -> str:
    try:
        return command.read_text(errors="replace")
    except OSError:
        return ""


@isolated
@pytest.mark.parametrize("is_ended", [True, False], ids=["ended", "terminated"])
def test_a_descendant_in_another_session_ends_too(tmp_path: Path, *, is_isolated: bool, is_ended: bool) -> None:
    mark = f"mark-{os.urandom(8).hex()}"
    code = DAEMON if is_ended else f"{DAEMON}\ntime.sleep(600)\n"
    with start(code, mark, is_isolated=is_isolated, folder=tmp_path) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == f"{mark}\n"
        if not is_ended:
            process.send_signal(signal.SIGTERM)
        assert process.wait() == (0 if is_ended else 128 + signal.SIGTERM)
    assert not is_running(mark)


@isolated
def test_a_descendant_ends_with_the_editor(tmp_path: Path, *, is_isolated: bool) -> None:
    mark = f"mark-{os.urandom(8).hex()}"
    command = launch_command(
        [sys.executable, "-c", f"{DAEMON}\ntime.sleep(600)", mark],
        (str(tmp_path),),
        make_temporary(),
        is_isolated=is_isolated,
    )
    starting = f"import subprocess\nsubprocess.Popen({command!r}).wait()"
    with subprocess.Popen([sys.executable, "-c", starting], stdout=subprocess.PIPE, text=True, cwd=tmp_path) as editor:
        assert editor.stdout is not None
        assert editor.stdout.readline() == f"{mark}\n"
        editor.kill()
    while is_running(mark):
        time.sleep(0.01)


@isolated
def test_the_exit_code_is_that_of_the_program(tmp_path: Path, *, is_isolated: bool) -> None:
    for code, expected in (("raise SystemExit(3)", 3), ("import os; os.abort()", -signal.SIGABRT)):
        with start(code, is_isolated=is_isolated, folder=tmp_path) as process:
            assert process.wait() == expected


@isolated
@pytest.mark.parametrize("code", [0, 3])
def test_the_files_of_a_failed_program_stay(tmp_path: Path, code: int, *, is_isolated: bool) -> None:
    temporary = make_temporary()
    command = [sys.executable, "-c", f"raise SystemExit({code})"]
    subprocess.run(
        launch_command(command, (str(tmp_path),), temporary, is_isolated=is_isolated), cwd=tmp_path, check=False
    )
    assert temporary.exists() == bool(code)
    shutil.rmtree(temporary, ignore_errors=True)


def test_the_sandbox_contains_only_what_was_given(tmp_path: Path) -> None:
    assert not isolation_problem() or sys.platform != "linux" or not Path("/proc/self/ns/user").exists()
    folder = tmp_path / "project"
    folder.mkdir()
    (folder / "own.txt").write_text("own")
    (tmp_path / "secret").write_text("secret")
    temporary = make_temporary()
    command = [sys.executable, "-c", LOOK, str(folder), str(temporary / "files"), str(os.getpid())]
    launched = launch_command(command, (str(folder),), temporary, is_isolated=True)
    done = subprocess.run(launched, capture_output=True, text=True, cwd=folder, check=True)
    assert json.loads(done.stdout) == {
        "outside": False,
        "shadow": False,
        "inside": "own",
        "write inside": False,
        "write temporary": True,
        "network": False,
        "interfaces": ["lo"],
        "parents": False,
        "processes": True,
        "files": True,
        "root": False,
    }


def test_the_sandbox_can_be_switched_off(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(isolation.SANDBOX_VARIABLE, "off")
    assert isolation_problem.__wrapped__() == "VICODE_SANDBOX is off"
