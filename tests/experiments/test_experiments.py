"""The experiments succeed behind a real bridge, as designs and as XABSL, and their pages show it."""

import contextlib
import re
import subprocess
import sys
import time
from pathlib import Path

import pytest

from vicode.cli import main
from vicode.experiments.definitions import EXPERIMENTS

NAMES = sorted(EXPERIMENTS)


def run_experiment(name: str, folder: Path, *arguments: str) -> str:
    assert main(["experiment", name, "--out", str(folder), *arguments]) == 0
    return (folder / f"{name}.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", NAMES)
def test_design_and_xabsl_succeed_and_do_the_same(name: str, tmp_path: Path) -> None:
    page = run_experiment(name, tmp_path, "--seeds", "1", "--no-real-time")
    runs = 2 * len(EXPERIMENTS[name].maps)
    assert f"{runs} of {runs} runs have succeeded." in page
    assert f"in {runs // 2} of {runs // 2} runs" in page
    assert page.count('class="path ') > runs
    assert ("Who waits for whom" in page) is (name == "meeting")
    assert ("The option as printed in the thesis succeeded in" in page) is (name == "corridor")


def test_a_page_is_one_file(tmp_path: Path) -> None:
    page = run_experiment("circle", tmp_path, "--seeds", "2", "--no-real-time")
    assert not re.search(r'(?:src|href)="|url\(|@import', page)
    overshoots = re.findall(r'<td class="number">([+-]\d+\.\d\d)</td>', page)
    assert len(overshoots) == 4
    assert all(abs(float(overshoot)) <= 5 for overshoot in overshoots)
    assert [path.name for path in tmp_path.iterdir()] == ["circle.html"]


def test_a_project_without_the_behavior_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "blink.yaml").write_text("vicode: 1\ninitial: a\nstates: {a: {}}\n")
    assert main(["experiment", "circle", "--out", str(tmp_path / "out"), "--project", str(tmp_path)]) == 2
    assert capsys.readouterr().err == f"vicode: {tmp_path} has no design 'drive_circle'\n"


def test_the_bridge_ends_with_the_experiment(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "vicode", "experiment", "meeting", "--out", str(tmp_path), "--seeds", "9"]
    with subprocess.Popen(command, stderr=subprocess.DEVNULL, start_new_session=True) as process:
        while (bridge := find_connected_child(process.pid)) is None:
            assert process.poll() is None
            time.sleep(0.05)
        process.terminate()
    assert process.returncode == 130
    assert not bridge.exists()


def find_connected_child(process_id: int) -> Path | None:
    """The process of the first child, as soon as it has a socket."""
    children = Path(f"/proc/{process_id}/task/{process_id}/children").read_text().split()
    for child in (Path("/proc", each) for each in children):
        with contextlib.suppress(OSError):
            if any(file.readlink().name.startswith("socket:") for file in (child / "fd").iterdir()):
                return child
    return None


@pytest.mark.nightly
@pytest.mark.parametrize("name", NAMES)
def test_twenty_seeds_succeed(name: str, tmp_path: Path) -> None:
    page = run_experiment(name, tmp_path, "--seeds", "20")
    runs = 40 * len(EXPERIMENTS[name].maps)
    assert f"{runs} of {runs} runs have succeeded." in page
    assert "the thesis: 30 s after one minute" in page
