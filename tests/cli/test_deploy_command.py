"""vicode deploy: the folder runs on a machine without vicode, and nothing else is ever deleted."""

import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.command_runner import lamps, vicode

__all__ = ["lamps"]

PROJECT = """\
vicode: 1
project: Lamps
world: rig.sim:World
constants: {pause: 0.1}
components:
  Sensor: {implementation: "rig.sim:Sensor", outputs: {level: {type: float}}}
profiles:
  robot: {world: "rig.real:World", components: {Sensor: "rig.real:Sensor"}}
"""
LAMP = """\
vicode: 1
component: Lamp
uses: {sensor: Sensor}
initial: Dark
states:
  Dark: {requires: [sensor], transitions: [{to: Lit, when: sensor.level > 1}]}
  Lit: {final: true}
"""
MODULE = """\
import time
from pathlib import Path
from vicode.bica import Component


class World:
    def close(self):
        Path("log").mkdir(exist_ok=True)
        Path("log/closed").write_text(__name__)


class Sensor(Component):
    level = 0.0

    def work(self):
        self.level = LEVEL
"""


@pytest.fixture
def rig(lamps: Path) -> Path:
    (lamps / "project.yaml").write_text(PROJECT)
    (lamps / "lamp.yaml").write_text(LAMP)
    (lamps / "rig").mkdir()
    (lamps / "rig" / "sim.py").write_text(MODULE.replace("LEVEL", "0.0"))
    (lamps / "rig" / "real.py").write_text(MODULE.replace("LEVEL", "2.0"))
    return lamps


def run_deployed(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run the launched command with a Python that has no packages."""
    command = [sys.executable, "-S", "-m", "lamps", "Lamp", *arguments]
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False, env=environment, timeout=60)


def test_a_deployed_program_runs_without_vicode(rig: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("deploy", "lamps/lamp.yaml", "--to", "robot/") == 0
    assert "start it with robot/run" in capsys.readouterr().out
    done = run_deployed(tmp_path / "robot", "--ticks", "3")
    assert (done.returncode, done.stderr) == (0, "")
    assert "state: Dark" in done.stdout
    assert (tmp_path / "robot/log/closed").read_text() == "rig.sim"


def test_a_profile_exchanges_components_and_world(rig: Path, tmp_path: Path) -> None:
    assert vicode("deploy", "lamps/lamp.yaml", "--to", "robot", "--profile", "robot") == 0
    assert "state: Lit" in run_deployed(tmp_path / "robot", "--until-done").stdout
    assert (tmp_path / "robot/log/closed").read_text() == "rig.real"
    assert vicode("run", "lamps/lamp.yaml", "--profile", "robot", "--until-done", "--plain") == 0


def test_an_unknown_profile_names_the_known_ones(rig: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("run", "lamps/lamp.yaml", "--profile", "moon") == 2
    assert "unknown profile 'moon'; choose from: robot" in capsys.readouterr().err


def test_check_compares_the_classes_of_every_profile(rig: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (rig / "rig/real.py").write_text(MODULE.replace("level", "height"))
    assert vicode("check", "--strict", "lamps") == 1
    assert "real.py" in capsys.readouterr().out


def test_a_signal_closes_the_world(rig: Path, tmp_path: Path) -> None:
    vicode("deploy", "lamps/lamp.yaml", "--to", "robot", "--python", sys.executable)
    with subprocess.Popen([tmp_path / "robot/run"], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as robot:
        assert robot.poll() is None
        for _attempt in range(200):
            robot.send_signal(signal.SIGCONT)
            try:
                robot.wait(0.05)
            except subprocess.TimeoutExpired:
                maps = Path(f"/proc/{robot.pid}/cmdline").read_bytes()
                if b"lamps" in maps and _attempt > 20:
                    break
        robot.terminate()
        robot.communicate(timeout=30)
    assert robot.returncode == 128 + signal.SIGTERM
    assert (tmp_path / "robot/log/closed").exists()


def test_a_second_deployment_replaces_the_first(rig: Path, tmp_path: Path) -> None:
    vicode("deploy", "lamps/lamp.yaml", "--to", "robot")
    (tmp_path / "robot/rig/old.py").write_text("old")
    (tmp_path / "robot/log").mkdir()
    (tmp_path / "robot/log/match.jsonl").write_text("kept")
    assert vicode("deploy", "lamps/lamp.yaml", "--to", "robot") == 0
    assert not (tmp_path / "robot/rig/old.py").exists()
    assert (tmp_path / "robot/log/match.jsonl").read_text() == "kept"


def test_other_files_are_never_replaced(rig: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "home").mkdir()
    (tmp_path / "home/thesis.tex").write_text("mine")
    assert vicode("deploy", "lamps/lamp.yaml", "--to", "home") == 2
    assert "did not deploy" in capsys.readouterr().err
    assert [path.name for path in (tmp_path / "home").iterdir()] == ["thesis.tex"]


def test_a_dry_run_lists_the_files(rig: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("deploy", "lamps/lamp.yaml", "--to", "robot", "--dry-run") == 0
    listed = capsys.readouterr().out.splitlines()
    assert {"run", "lamps.service", "lamps/lamp.py", "rig/sim.py", "vicode/bica/root.py"} <= set(listed)
    assert not (tmp_path / "robot").exists()


def test_pipes_loops_and_earlier_deployments_are_not_copied(rig: Path, tmp_path: Path) -> None:
    os.mkfifo(rig / "pipe")
    (rig / "rig/loop").symlink_to("..")
    (rig / "shared").symlink_to("rig")
    for _time in range(2):
        assert vicode("deploy", "lamps/lamp.yaml", "--to", "lamps/robot") == 0
    robot = rig / "robot"
    assert (robot / "shared/sim.py").is_file()
    assert not {"pipe", "robot"} & {path.name for path in robot.iterdir()}
    assert not (robot / "rig/loop").exists()


@pytest.mark.parametrize("name", ["my robot", "50%", "$x", "it's", 'a "b"', "back\\slash", "ü"])
def test_systemd_accepts_the_unit(rig: Path, tmp_path: Path, name: str) -> None:
    program = shutil.which("systemd-analyze")
    if program is None:
        return  # nothing to read it with
    assert vicode("deploy", "lamps/lamp.yaml", "--to", f"{tmp_path}/{name}") == 0
    command = [program, "--user", "verify", f"{tmp_path}/{name}/lamps.service"]
    environment = {**os.environ, "XDG_RUNTIME_DIR": str(tmp_path)}
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment, timeout=60)
    assert (done.returncode, done.stderr) == (0, "")


def test_a_stopped_service_has_not_failed(rig: Path, tmp_path: Path) -> None:
    """The exit code after SIGTERM is one that the unit names."""
    assert vicode("deploy", "lamps/lamp.yaml", "--to", "robot", "--python", sys.executable) == 0
    unit = (tmp_path / "robot/lamps.service").read_text()
    assert f"\nSuccessExitStatus={128 + signal.SIGTERM}\n" in unit


SSH = '#!/bin/sh\n[ "$1" = -- ] && shift\nshift\nexec sh -c "$*"\n'
RSYNC = '#!/bin/sh\nfor last; do :; done\nwhile [ "$1" != -- ]; do shift; done\nexec cp -a "$2/." "${last#*:}"\n'


@pytest.mark.parametrize("has_rsync", [True, False])
def test_a_robot_is_reached_over_ssh(
    rig: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, has_rsync: bool
) -> None:
    programs = tmp_path / "bin"
    programs.mkdir()
    for name, text in [("ssh", SSH), *([("rsync", RSYNC)] if has_rsync else [])]:
        (programs / name).write_text(text)
        (programs / name).chmod(0o755)
    for name in ("sh", "cp", "tar", "mkdir", "ls", "find", "rm", "test"):
        (programs / name).symlink_to(f"/bin/{name}" if Path(f"/bin/{name}").exists() else f"/usr/bin/{name}")
    monkeypatch.setenv("PATH", str(programs))
    place = tmp_path / "on the robot"
    assert vicode("deploy", "lamps/lamp.yaml", "--to", f"nao@10.0.0.7:{place}") == 0
    assert (place / "lamps/lamp.py").exists()
    assert f"\nWorkingDirectory={place}\n" in (place / "lamps.service").read_text()
    (place / ".vicode-deployed").unlink()
    assert vicode("deploy", "lamps/lamp.yaml", "--to", f"nao@10.0.0.7:{place}") == 2


def test_the_home_folder_of_a_robot_is_left_alone(
    rig: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    home = tmp_path / "home"
    programs = tmp_path / "bin"
    (home / "mine").mkdir(parents=True)
    (home / "mine/notes").touch()
    programs.mkdir()
    for name, text in [("ssh", SSH.replace("exec sh", f"cd '{home}' && exec sh")), ("rsync", "#!/bin/sh\nexit 12\n")]:
        (programs / name).write_text(text)
        (programs / name).chmod(0o755)
    monkeypatch.setenv("PATH", f"{programs}{os.pathsep}{os.environ['PATH']}")
    assert vicode("deploy", "lamps/lamp.yaml", "--to", "nao@10.0.0.7:~/mine") == 2
    assert "has files that vicode did not deploy" in capsys.readouterr().err
    assert vicode("deploy", "lamps/lamp.yaml", "--to", "nao@10.0.0.7:~") == 2
    assert sorted(path.name for path in home.iterdir()) == ["mine"]


def test_a_robot_that_cannot_be_reached_is_told_from_a_full_folder(
    rig: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "ssh").write_text("#!/bin/sh\nexit 255\n")
    (tmp_path / "ssh").chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}{os.pathsep}{os.environ['PATH']}")
    assert vicode("deploy", "lamps/lamp.yaml", "--to", "nao@10.0.0.7:player") == 2
    assert "nao@10.0.0.7 cannot be reached with ssh" in capsys.readouterr().err


@pytest.mark.parametrize("target", ["nao@robot:", "nao@robot:~kim/x", "-oProxyCommand=x:dir", "two\nlines"])
def test_targets_are_no_options(rig: Path, target: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("deploy", "lamps/lamp.yaml", f"--to={target}") == 2
    assert "invalid target" in capsys.readouterr().err
