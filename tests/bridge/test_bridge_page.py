"""The programs of docs/bridge.md connect to the command and drive a circle; its world fits the page."""

import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from vicode.bridge.world import World
from vicode.cli import main
from vicode.store import read_project_file

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "bridge.md").read_text(encoding="utf-8")
LIMIT_S = 60


def example(language: str, number: int = 0) -> str:
    return re.findall(rf"```{language}\n(.*?)```", PAGE, re.DOTALL)[number]


@pytest.fixture(scope="module")
def bridge() -> Iterator[tuple["subprocess.Popen[str]", str]]:
    """The command as users start it, and its port."""
    design = "designs/rescue/drive_circle.yaml"
    command = [sys.executable, "-m", "vicode", "bridge", design, "--port", "0", "--tick-ms", "5"]
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        port = re.search(r"127\.0\.0\.1:(\d+)", process.stdout.readline())
        assert port is not None
        yield process, port[1]
        process.kill()


def drive(command: list[str], program: str, port: str) -> str:
    result = subprocess.run(
        [*command, "-", port], input=program, capture_output=True, text=True, timeout=LIMIT_S, check=False
    )
    assert result.returncode == 0, result.stderr
    return result.stdout


def test_the_client_in_node(bridge: tuple["subprocess.Popen[str]", str]) -> None:
    if shutil.which("node") is None:
        return  # nothing to run it with
    turned = re.fullmatch(r"turned (\d+) degrees\n", drive(["node"], example("js"), bridge[1]))
    assert turned is not None
    assert 360 <= int(turned[1]) < 400


def test_the_client_in_python_and_the_end_of_the_command(bridge: tuple["subprocess.Popen[str]", str]) -> None:
    process, port = bridge
    assert drive([sys.executable], example("python"), port).splitlines() == [
        "Robot connection accepted",
        '{"welcome":{"robot":"r1","behavior":"drive_circle","tick_ms":5}}',
        "turned 360 degrees in 12.05 s",
    ]
    process.send_signal(signal.SIGTERM)
    output, errors = process.communicate(timeout=LIMIT_S)
    assert (process.returncode, errors) == (128 + signal.SIGTERM, "")
    assert re.search(r"r1: connected from 127\.0\.0\.1:\d+\n.* r1: runs drive_circle\n.* r1: disconnected", output)
    assert "commands sent" in output
    assert "age of the data: median" in output


def test_the_world_of_the_page() -> None:
    namespace: dict[str, object] = {}
    module = example("python", 1)
    exec(compile(module, "bridge.py", "exec"), namespace)
    world_class = namespace["RescueWorld"]
    assert isinstance(world_class, type)
    assert issubclass(world_class, World)
    world = world_class()
    assert world.bridge.targets == ("LASER", "INS", "BATTERY", "WHISTLE")
    assert world.laser_min_n == 0
    assert read_project_file(example("yaml")).findings == ()


def test_all_options_are_described(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["bridge", "--help"])
    options = set(re.findall(r"^ +(--[a-z-]+)", capsys.readouterr().out, re.MULTILINE))
    described = PAGE[PAGE.index("## Options") : PAGE.index("## Protocol")]
    assert len(options) > 10
    assert options <= set(re.findall(r"--[a-z-]+", described))


def test_the_tests_of_the_page(tmp_path: Path) -> None:
    (tmp_path / "test_world.py").write_text(example("python", 2), encoding="utf-8")
    path = os.pathsep.join((str(ROOT / "designs" / "rescue"), str(ROOT / "generated" / "python"), str(ROOT)))
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "test_world.py"]
    result = subprocess.run(
        command,
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
        check=False,
    )
    assert "3 passed" in result.stdout, result.stdout
