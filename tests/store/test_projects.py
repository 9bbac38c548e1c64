"""Projects: the files that belong to a project, and the findings on files that do not."""

import os
from pathlib import Path

import pytest

from vicode.store import find_projects, open_project
from vicode.store.projects import DEPLOYED_MARKER, find_design_files

PROJECT = "vicode: 1\nproject: Forward\nconstants: {reach: 2}\n"


def _design(component: str) -> str:
    return f"vicode: 1\ncomponent: {component}\ninitial: A\nstates: {{A: {{}}}}\n"


def _write(folder: Path, **texts: str) -> None:
    for name, text in texts.items():
        path = folder / f"{name.replace('__', '/')}.yaml"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def test_a_folder_is_a_project_with_all_its_designs(tmp_path: Path) -> None:
    _write(tmp_path, project=PROJECT, player=_design("Player"), kicks__left=_design("KickLeft"), ci="jobs: []\n")
    _write(tmp_path, **{"inner__project": PROJECT, "inner__other": _design("Other"), ".hidden__x": _design("Hidden")})
    project = open_project(tmp_path)
    assert project.findings == ()
    assert project.broken_files == ()
    assert project.project.name == "Forward"
    assert [design.component for design in project.project.designs] == ["KickLeft", "Player"]
    assert set(project.files) == set(project.sources) == set(project.texts) == {"", "KickLeft", "Player"}
    assert project.files[""] == tmp_path / "project.yaml"
    assert project.find_component(tmp_path / "kicks" / ".." / "player.yaml") == "Player"


def test_a_design_file_opens_the_project_above_it(tmp_path: Path) -> None:
    _write(tmp_path, project=PROJECT, player=_design("Player"), kicks__left=_design("KickLeft"))
    project = open_project(tmp_path / "kicks" / "left.yaml")
    assert project.project.name == "Forward"
    assert "Player" in project.files


def test_a_folder_without_project_file_is_a_project(tmp_path: Path) -> None:
    _write(tmp_path / "my-robot", player=_design("Player"))
    for path in (tmp_path / "my-robot", tmp_path / "my-robot" / "player.yaml"):
        project = open_project(path)
        assert project.project.name == "my_robot"
        assert "" not in project.files
        assert set(project.files) == {"Player"}


def test_an_unrelated_project_file_above_is_ignored(tmp_path: Path) -> None:
    _write(tmp_path, project="name: something else\n", robot__player=_design("Player"))
    assert open_project(tmp_path / "robot" / "player.yaml").project.name == "robot"


def test_broken_files_stay_visible(tmp_path: Path) -> None:
    _write(tmp_path, player=_design("Player"), broken="vicode: 1\ncomponent: [\n", second=_design("Player"))
    project = open_project(tmp_path)
    assert [path.name for path in project.broken_files] == ["broken.yaml", "second.yaml"]
    assert [finding.rule.code for finding in project.findings] == ["Y101", "P201"]
    assert project.files["Player"].name == "player.yaml"
    note = project.findings[1].notes[0]
    assert note.location is not None
    assert note.location.file.endswith("player.yaml")
    assert note.location.line == 2


def test_an_explicit_file_is_always_read(tmp_path: Path) -> None:
    _write(tmp_path, notes="just: notes\n")
    project = open_project(tmp_path / "notes.yaml")
    assert {finding.rule.code for finding in project.findings} == {"Y102", "Y104"}
    with pytest.raises(FileNotFoundError):
        open_project(tmp_path / "missing.yaml")


def test_links_do_not_lead_out_of_the_folder(tmp_path: Path) -> None:
    _write(tmp_path / "outside", secret=_design("Secret"))
    _write(tmp_path / "inside", player=_design("Player"))
    (tmp_path / "inside" / "secret.yaml").symlink_to(tmp_path / "outside" / "secret.yaml")
    (tmp_path / "inside" / "folder").symlink_to(tmp_path / "outside")
    assert set(open_project(tmp_path / "inside").files) == {"Player"}


def test_an_unreadable_file_is_a_finding(tmp_path: Path) -> None:
    _write(tmp_path, player=_design("Player"))
    os.mkfifo(tmp_path / "pipe.yaml")
    (tmp_path / "folder.yaml").mkdir()
    (tmp_path / "lost.yaml").symlink_to(tmp_path / "nowhere")
    project = open_project(tmp_path)
    assert set(project.files) == {"Player"}


def test_all_projects_of_a_folder_are_found(tmp_path: Path) -> None:
    _write(tmp_path, forward__project=PROJECT, forward__kicks__left=_design("KickLeft"), blink__blink=_design("Blink"))
    _write(tmp_path, notes__list="just: notes\n")
    assert find_projects(tmp_path) == (tmp_path / "blink", tmp_path / "forward")
    assert find_projects(tmp_path / "forward" / "kicks" / "left.yaml")[0].samefile(tmp_path / "forward")
    assert find_projects(tmp_path / "blink") == (tmp_path / "blink",)


def test_a_deployed_program_is_no_project(tmp_path: Path) -> None:
    _write(tmp_path, project=PROJECT, player=_design("Player"))
    _write(tmp_path / "robot", project=PROJECT, player=_design("Player"))
    (tmp_path / "robot" / DEPLOYED_MARKER).touch()
    assert find_projects(tmp_path) == (tmp_path,)
    assert find_design_files(tmp_path) == (tmp_path / "player.yaml",)
    assert find_projects(tmp_path / "robot") == (tmp_path / "robot",)


def test_a_design_in_another_encoding_is_reported(tmp_path: Path) -> None:
    (tmp_path / "player.yaml").write_bytes(_design("Player").encode("utf-16"))
    project = open_project(tmp_path)
    assert project.broken_files == (tmp_path / "player.yaml",)
    assert [finding.rule.code for finding in project.findings] == ["Y110"]


def test_an_unchanged_file_is_not_parsed_again(tmp_path: Path) -> None:
    _write(tmp_path, a=_design("A"), b=_design("B"))
    before = open_project(tmp_path)
    _write(tmp_path, b=_design("B") + "doc: other\n")
    after = open_project(tmp_path)
    assert after.sources["A"] is before.sources["A"]
    assert [design.doc for design in after.project.designs] == ["", "other"]
