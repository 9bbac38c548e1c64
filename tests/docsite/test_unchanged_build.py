"""A second run without changes reads the inputs and builds nothing; every change that matters is noticed."""

import os
import re
import shutil
from pathlib import Path

import pytest

from vicode.cli import main
from vicode.services.docs import inputs as docs_inputs

DESIGNS = Path(__file__).parents[2] / "designs"
BEHAVIOR = DESIGNS.parent / "tests" / "xabsl" / "cases" / "programs" / "p1"


class Builds:
    """Builds of a project; `loads` counts those that read its designs."""

    def __init__(self, path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        self.folder, self.out, self.loads = path / "team", path / "team" / "site", 0
        shutil.copytree(DESIGNS / "forward", self.folder)
        load = docs_inputs.load_site_inputs

        def count(paths: list[Path], encoding: str) -> object:
            self.loads += 1
            return load(paths, encoding)

        monkeypatch.setattr(docs_inputs, "load_site_inputs", count)

    def run(self, *options: str) -> int:
        return main(["docs", str(self.folder), "--out", str(self.out), *options])


@pytest.fixture
def builds(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Builds:
    monkeypatch.setenv("VICODE_CACHE", str(tmp_path / "cache"))
    return Builds(tmp_path, monkeypatch)


def test_without_a_change_nothing_is_read_again(builds: Builds, capsys: pytest.CaptureFixture[str]) -> None:
    assert builds.run() == 0
    first = capsys.readouterr().out
    assert builds.run() == builds.run("--strict") == 0
    assert builds.loads == 1
    for line in capsys.readouterr().out.splitlines():
        assert re.sub(r"\d+ changed", "", line) == re.sub(r"\d+ changed", "", first.rstrip())
        assert ", 0 changed," in line
    assert builds.run("--fresh") == 0
    assert builds.loads == 2


EDITS = {
    "a design": lambda builds: append(builds.folder / "player.yaml", "# more\n"),
    "a hand-written class": lambda builds: append(builds.folder / "field" / "walk.py", "# more\n"),
    "a new design": lambda builds: shutil.copy(builds.folder / "turn.yaml", builds.folder / "field" / "spin.yaml"),
    "a design that is gone": lambda builds: (builds.folder / "turn.yaml").unlink(),
    "a project file above": lambda builds: (builds.folder.parent / "project.yaml").write_text("vicode: 1\n"),
    "a page": lambda builds: append(builds.out / "index.html", "\n"),
    "a page that is gone": lambda builds: (builds.out / "agents.html").unlink(),
    "a page whose time was set back": lambda builds: replace_keeping_time(
        builds.out / "index.html", "Forward", "Goalie!"
    ),
    "a design in the output folder": lambda builds: shutil.copy(builds.folder / "turn.yaml", builds.out / "spin.yaml"),
    "a folder that is no project": lambda builds: (builds.folder / "field" / ".vicode-deployed").touch(),
    "a repository": lambda builds: (builds.folder / ".git").mkdir(),
    "a stale page": lambda builds: shutil.copy(builds.out / "agents.html", builds.out / "old.html"),
}


@pytest.mark.parametrize("edit", EDITS)
def test_every_change_is_noticed(builds: Builds, edit: str) -> None:
    builds.run()
    EDITS[edit](builds)
    builds.run()
    assert builds.loads == 2
    assert not (builds.out / "old.html").exists()


def test_a_class_in_a_linked_folder_is_an_input(builds: Builds) -> None:
    elsewhere = (builds.folder / "field").rename(builds.folder.parent / "elsewhere")
    (builds.folder / "field").symlink_to(elsewhere)
    builds.run()
    append(elsewhere / "walk.py", "# more\n")
    builds.run()
    assert builds.loads == 2


def test_options_are_inputs(builds: Builds) -> None:
    builds.run()
    builds.run("--title", "Another")
    assert "Another" in (builds.out / "index.html").read_text("utf-8")
    builds.run("--format", "markdown")
    assert (builds.out / "index.md").is_file()
    assert not (builds.out / "index.html").exists()


def test_errors_are_reported_by_every_build(builds: Builds, capsys: pytest.CaptureFixture[str]) -> None:
    append(builds.folder / "turn.yaml", "states: 3\n")
    assert builds.run() == builds.run() == 0
    assert builds.loads == 2
    assert capsys.readouterr().err.count("turn.yaml") >= 2


def test_an_included_file_of_a_behavior_is_an_input(builds: Builds) -> None:
    shutil.rmtree(builds.folder)
    shutil.copytree(BEHAVIOR, builds.folder)
    builds.run()
    builds.run()
    assert builds.loads == 1
    append(builds.folder / "Options" / "opt0.xabsl", "// more\n")
    builds.run()
    assert builds.loads == 2


def test_hidden_folders_hold_no_behaviors(builds: Builds) -> None:
    shutil.rmtree(builds.folder)
    shutil.copytree(BEHAVIOR, builds.folder)
    shutil.copytree(BEHAVIOR, builds.folder / ".backup")
    assert builds.run() == 0


def replace_keeping_time(file: Path, old: str, new: str) -> None:
    status = file.stat()
    file.write_text(file.read_text("utf-8").replace(old, new), "utf-8")
    os.utime(file, ns=(status.st_atime_ns, status.st_mtime_ns))


def append(file: Path, text: str) -> None:
    file.write_text(file.read_text("utf-8") + text, "utf-8")
