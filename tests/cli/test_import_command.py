"""`vicode import`: as one types it."""

import shutil
from pathlib import Path

import pytest

from tests.xabsl.xabsl_cases import CASES
from vicode.cli.entry_point import main
from vicode.services.imported_behavior.import_record import RECORD_FILE
from vicode.store import open_project

PROGRAM = CASES / "programs" / "p1"


def test_a_behavior_becomes_a_project_that_is_checked_and_generated(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "designs" / "ours"
    assert main(["import", str(PROGRAM / "agents.xabsl"), "--out", str(out)]) == 0
    assert capsys.readouterr().out.startswith(f"wrote {out.as_posix()}: ")
    opened = open_project(out)
    assert opened.project.name == "ours"
    options = sorted(path.stem for path in PROGRAM.rglob("Options/*.xabsl"))
    assert sorted(design.component for design in opened.project.designs) == options
    assert all(state.at for design in opened.project.designs for state in design.states)
    assert main(["check", str(out)]) == 0
    capsys.readouterr()
    (root, *_others) = [agent.root for agent in opened.project.agents]
    (file,) = out.rglob(f"{root}.yaml")
    assert main(["run", str(file), "--seconds", "1"]) == 0
    assert "errors: 0" in capsys.readouterr().out
    assert main(["gen", str(out), "--language", "python", "--out", str(tmp_path / "generated")]) == 0
    assert (tmp_path / "generated" / "python" / "ours" / "interfaces.py").exists()
    assert main(["gen", str(out), "--language", "python", "--out", str(tmp_path / "generated"), "--check"]) == 0


def test_nothing_that_is_there_is_lost(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "ours"
    assert main(["import", str(PROGRAM / "agents.xabsl"), "--out", str(out), "--name", "Best"]) == 0
    (out / "project.yaml").write_text("vicode: 1\nproject: Mine\n")
    (out / "robot.py").write_text("# filled in\n")
    # Without the record of the import, its changes cannot be merged.
    (out / RECORD_FILE).unlink()
    before = {path: path.read_bytes() for path in out.rglob("*.yaml")}
    assert main(["import", str(PROGRAM / "agents.xabsl"), "--out", str(out)]) == 1
    assert "would be overwritten; use --force" in capsys.readouterr().err
    assert {path: path.read_bytes() for path in out.rglob("*.yaml")} == before
    assert main(["import", str(PROGRAM / "agents.xabsl"), "--out", str(out), "--name", "Best", "--force"]) == 0
    assert open_project(out).project.name == "Best"
    assert (out / "robot.py").read_text() == "# filled in\n"


def test_a_behavior_with_mistakes_is_not_imported(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shutil.copytree(CASES / "programs" / "drive_circle", tmp_path / "circle")
    file = tmp_path / "circle" / "Options" / "drive_circle.xabsl"
    file.write_text(file.read_text().replace("goto stop", "goto stopp"))
    assert main(["import", str(tmp_path / "circle" / "agents.xabsl"), "--out", str(tmp_path / "out")]) == 1
    said = capsys.readouterr().err
    assert "did you mean 'stop'?" in said
    assert "nothing written" in said
    assert not (tmp_path / "out").exists()
