"""What a trace says about its origin, and which projects need a bridge, without running anything."""

from pathlib import Path

from tests.cli.git_folder import commit, init
from vicode.services.run_preparation import find_origin, needs_bridge
from vicode.store import open_project

WALKER = "vicode: 1\ncomponent: Walker\nuses: {eye: Eye}\ninitial: Go\nstates: {Go: {}}\n"
PROJECT = "vicode: 1\nproject: P\n{}components: {{Eye: {{implementation: world, outputs: {{near: bool}}}}}}\n"


def write_project(folder: Path, keys: str = "") -> None:
    (folder / "walker.yaml").write_text(WALKER, encoding="utf-8")
    (folder / "project.yaml").write_text(PROJECT.format(keys), encoding="utf-8")


def test_the_revision_says_whether_the_project_was_modified(tmp_path: Path) -> None:
    write_project(tmp_path)
    outside = find_origin(open_project(tmp_path), "Walker")
    assert outside.revision == ""
    init(tmp_path)
    revision = commit(tmp_path, "walker")
    committed = find_origin(open_project(tmp_path), "Walker")
    assert (committed.design, committed.revision) == (outside.design, revision)
    (tmp_path / "walker.yaml").write_text(f"{WALKER}# slow\n", encoding="utf-8")
    edited = find_origin(open_project(tmp_path), "Walker")
    assert (edited.design, edited.revision) == (outside.design, f"{revision}-dirty")


def test_only_a_world_of_the_bridge_needs_one(tmp_path: Path) -> None:
    needs = {}
    for keys in ("", "world: a:B\n", "bridge: {world: a:B}\n", "world: a:B\nbridge: {world: a:B}\n"):
        write_project(tmp_path, keys)
        needs[keys] = needs_bridge(open_project(tmp_path).project, "Walker")
    assert [keys for keys, is_needed in needs.items() if is_needed] == ["bridge: {world: a:B}\n"]
