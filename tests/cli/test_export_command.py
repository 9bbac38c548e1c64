"""`vicode export`: the form by the name of the output, and words for what cannot be drawn."""

import shutil
from pathlib import Path

import pytest

from vicode.cli import main

PLAYER = Path(__file__).parents[2] / "designs" / "forward" / "player.yaml"


def test_the_name_of_the_output_tells_the_form(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name, start in (("a.svg", b"<svg"), ("a.pdf", b"%PDF"), ("a.png", b"\x89PNG"), ("a.mmd", b"---\ntitle")):
        out = tmp_path / name
        assert main(["export", str(PLAYER), "-o", str(out)]) == 0
        assert out.read_bytes().startswith(start)
        assert f"wrote {out.as_posix()}" in capsys.readouterr().out


def test_text_can_be_printed(capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    assert main(["export", str(PLAYER), "--format", "plantuml", "-o", "-", "--states", "Kick,WatchBall"]) == 0
    text = capfdbinary.readouterr().out.decode()
    assert "Kick --> WatchBall" in text
    assert "LookForBall" not in text


def test_a_state_that_is_not_there(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", str(PLAYER), "-o", "-", "--states", "Kick,Dance"]) == 1
    assert "has no state Dance" in capsys.readouterr().err


def test_a_broken_design(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "broken.yaml"
    file.write_text("vicode: [")
    assert main(["export", str(file)]) == 1
    assert "Y101" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == [file]


MEETING = Path(__file__).parents[2] / "generated" / "xabsl" / "meeting"


def test_an_option_of_xabsl(capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    assert main(["export", str(MEETING / "Options" / "pass_door.xabsl"), "--format", "plantuml", "-o", "-"]) == 0
    assert "@startuml" in capfdbinary.readouterr().out.decode()


def test_an_xabsl_file_without_an_option(capsys: pytest.CaptureFixture[str]) -> None:
    file = MEETING / "Symbols" / "Robot.xabsl"
    assert main(["export", str(file), "-o", "-"]) == 1
    assert capsys.readouterr().err == f"vicode: {file} defines no option\n"


def test_errors_of_xabsl_are_relative_to_the_working_directory(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    shutil.copytree(MEETING, tmp_path / "team")
    option = Path("team", "Options", "pass_door.xabsl")
    monkeypatch.chdir(tmp_path)
    option.write_text(option.read_text("utf-8").replace("goto", "jump", 1), "utf-8")
    assert main(["export", str(option)]) == 1
    assert capsys.readouterr().err.startswith(f"{option}:")
    Path("alone.xabsl").write_text("option alone { initial state only { } }", "utf-8")
    assert main(["export", "alone.xabsl"]) == 2
    assert "no file with agents in the folder of alone.xabsl" in capsys.readouterr().err
