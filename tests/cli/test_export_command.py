"""`vicode export`: the form by the name of the output, and words for what cannot be drawn."""

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
    assert main(["export", str(MEETING / "Symbols" / "Robot.xabsl"), "-o", "-"]) == 1
    assert capsys.readouterr().err == "vicode: Robot.xabsl defines no option\n"
