"""`vicode sample`: a copy that stands on its own."""

from pathlib import Path

import pytest

from tests.cli.command_runner import vicode
from vicode.samples import sample_names


@pytest.mark.parametrize("name", sample_names())
def test_a_copied_sample_is_generated_inside_its_folder(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert vicode("sample", "--name", name) == 0
    assert vicode("check", name) == 0
    assert vicode("gen", name) == 0
    assert [path.name for path in tmp_path.iterdir()] == [name]
    assert list((tmp_path / name / "generated").rglob("*.py"))


def test_the_sample_player_runs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "new" / "robot"
    assert vicode("sample", str(folder)) == 0
    assert f"vicode edit {folder}" in capsys.readouterr().out
    assert vicode("run", str(folder / "player.yaml"), "--seed", "1", "--ticks", "5") == 0


@pytest.mark.parametrize("taken", ["file", "folder"])
def test_a_target_with_content_is_refused_and_kept(
    taken: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "mine"
    kept = target if taken == "file" else target / "notes.txt"
    kept.parent.mkdir(exist_ok=True)
    kept.write_text("mine", encoding="utf-8")
    assert vicode("sample", str(target)) == 2
    assert f"{target}: exists and is not an empty folder" in capsys.readouterr().err
    assert kept.read_text(encoding="utf-8") == "mine"
    assert [path.name for path in tmp_path.iterdir()] == ["mine"]
