"""Renames in the files of a project, planned without an editor or a command line."""

from pathlib import Path

from vicode.model.rename import SymbolRef
from vicode.services.rename.files import plan_rename, write_changes
from vicode.services.rename.project_files import FilesOnDisk
from vicode.store import open_project

PLAYER = "vicode: 1\ncomponent: Player\ninitial: Walk\nuses: {walker: Walker}\nstates: {Walk: {do: [walker]}}\n"
WALKER = "vicode: 1\ncomponent: Walker\ninitial: Go\nstates: {Go: {}}  # slow\n"
COMPONENT = SymbolRef(section="components", name="Walker")


def open_files(folder: Path) -> FilesOnDisk:
    (folder / "player.yaml").write_text(PLAYER, encoding="utf-8")
    (folder / "walker.yaml").write_text(WALKER, encoding="utf-8")
    return FilesOnDisk(opened=open_project(folder))


def test_a_plan_writes_nothing_and_all_files_when_applied(tmp_path: Path) -> None:
    files = open_files(tmp_path)
    plan = plan_rename(files, COMPONENT, "Runner")
    assert (tmp_path / "walker.yaml").read_text(encoding="utf-8") == WALKER
    write_changes(plan.changes, plan.removed)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["player.yaml", "runner.yaml"]
    assert (tmp_path / "runner.yaml").read_text(encoding="utf-8") == WALKER.replace("Walker", "Runner")
    assert (tmp_path / "player.yaml").read_text(encoding="utf-8") == PLAYER.replace("Walker", "Runner")


def test_a_file_that_changed_after_it_was_read_is_not_written(tmp_path: Path) -> None:
    files = open_files(tmp_path)
    (tmp_path / "player.yaml").write_text(PLAYER + "# edited\n", encoding="utf-8")
    assert "player.yaml" in plan_rename(files, COMPONENT, "Runner").error


def test_unreadable_files_are_named_relative_to_the_folder(tmp_path: Path) -> None:
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "arm.yaml").write_text("vicode: 1\ncomponent: Arm\nstates: [", encoding="utf-8")
    files = open_files(tmp_path)
    assert files.broken_file_names == ("parts/arm.yaml",)
    assert plan_rename(files, COMPONENT, "Runner").error.startswith("parts/arm.yaml cannot be read")
