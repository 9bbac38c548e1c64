"""The folder of a program is built and copied without a command line."""

from pathlib import Path

import pytest

from vicode.deployment.program import ProgramOptions, build_program, list_files
from vicode.deployment.target import command_at, copy_program
from vicode.store import OpenProject, open_project

LAMP = "vicode: 1\ncomponent: Lamp\ninitial: Dark\nstates: {Dark: {transitions: [{to: Lit, after: 1}]}, Lit: {}}\n"


@pytest.fixture
def lamps(tmp_path: Path) -> OpenProject:
    folder = tmp_path / "lamps"
    folder.mkdir()
    (folder / "lamp.yaml").write_text(LAMP, encoding="utf-8")
    (folder / "rig.py").write_text("LEVEL = 1\n", encoding="utf-8")
    return open_project(folder)


@pytest.mark.parametrize(
    ("target", "folder"),
    [
        ("nao@robot:player", "%h/player"),
        ("nao@robot:~/my player", "%h/my player"),
        ("nao@robot:/opt/50%/$x", "/opt/50%%/$x"),
    ],
)
def test_the_unit_names_the_folder_as_systemd_reads_it(
    lamps: OpenProject, tmp_path: Path, target: str, folder: str
) -> None:
    build_program(lamps, "Lamp", tmp_path / "built", ProgramOptions(target=target, arguments=""))
    unit = (tmp_path / "built/lamps.service").read_text()
    assert f"\nWorkingDirectory={folder}\n" in unit
    assert "\nExecStart=/bin/sh run\n" in unit


def test_a_program_has_hand_written_and_generated_files_and_keeps_the_log(lamps: OpenProject, tmp_path: Path) -> None:
    built, robot = tmp_path / "built", tmp_path / "robot"
    build_program(lamps, "Lamp", built, ProgramOptions(target=str(robot)))
    copy_program(built, str(robot))
    (robot / "log").mkdir()
    (robot / "log" / "kept").touch()
    (robot / "old.py").touch()
    copy_program(built, str(robot))
    assert {"rig.py", "run", "lamps.service", "lamps/__main__.py"} <= set(list_files(built))
    assert set(list_files(robot)) == {*list_files(built), "log/kept"}


def test_a_folder_with_other_files_is_refused(tmp_path: Path) -> None:
    (tmp_path / "thesis.txt").touch()
    with pytest.raises(OSError, match="files that vicode did not deploy"):
        copy_program(tmp_path, str(tmp_path))


def test_a_command_on_a_robot_runs_in_a_terminal_of_ssh() -> None:
    assert command_at("nao@robot:my player", "run") == "ssh -t nao@robot ''\"'\"'my player/run'\"'\"''"
    assert command_at("robot", "run") == "robot/run"
