"""`vicode xabsl update` and a second `vicode import`: as one types them."""

from pathlib import Path

import pytest

from tests.importers.test_imported_designs import texts
from vicode.cli.entry_point import main
from vicode.services.imported_behavior.import_record import RECORD_FILE
from vicode.store import open_project

Paths = tuple[Path, Path]


@pytest.fixture
def paths(tmp_path: Path) -> Paths:
    """A behavior in Windows-1252 with line breaks of Windows, and the designs imported from it."""
    behavior, designs = tmp_path / "behavior", tmp_path / "designs"
    for name, text in texts().items():
        file = behavior / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(text.replace("// faster", "// schnell, für „immer“").replace("\n", "\r\n").encode("cp1252"))
    assert main(["import", str(behavior / "agents.xabsl"), "--out", str(designs)]) == 0
    return behavior, designs


def contents(folder: Path) -> dict[str, bytes]:
    files = (path for path in folder.rglob("*") if path.is_file() and ".vicode" not in path.parts)
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}


def replace_in(file: Path, old: str, new: str) -> None:
    text = file.read_bytes().decode("utf-8")
    assert text.count(old) == 1, text
    file.write_bytes(text.replace(old, new).encode("utf-8"))


def test_without_edits_nothing_is_written(paths: Paths, capsys: pytest.CaptureFixture[str]) -> None:
    behavior, designs = paths
    before = contents(behavior), contents(designs)
    capsys.readouterr()
    assert main(["xabsl", "update", str(designs)]) == 0
    assert capsys.readouterr().out == "no changes\n"
    assert (contents(behavior), contents(designs)) == before


def test_an_edited_guard_changes_one_line(paths: Paths, capsys: pytest.CaptureFixture[str]) -> None:
    behavior, designs = paths
    before = contents(behavior)
    replace_in(
        designs / "Options/main.yaml", "ball_symbols.ball_distance < 100 and", "ball_symbols.ball_distance < 150 and"
    )
    assert main(["xabsl", "update", str(designs), "--check"]) == 1
    assert contents(behavior) == before
    capsys.readouterr()
    assert main(["xabsl", "update", str(designs), "--diff"]) == 1
    shown = [
        line for line in capsys.readouterr().out.splitlines() if line[:1] in "+-" and line[:3] not in ("+++", "---")
    ]
    assert [line.split() for line in shown] == [
        ["-", "if", "(ball.distance", "<", "100", "&&", "!class)", "{"],
        ["+", "if", "(ball.distance", "<", "150", "&&", "!class)", "{"],
    ]
    assert main(["xabsl", "update", str(designs)]) == 0
    changed = b"distance < 150"
    expected = before | {"Options/main.xabsl": before["Options/main.xabsl"].replace(b"distance < 100", changed)}
    assert contents(behavior) == expected
    assert main(["xabsl", "update", str(designs), "--check"]) == 0


def test_a_renamed_state_is_renamed_everywhere(paths: Paths) -> None:
    behavior, designs = paths
    before = contents(behavior)["Options/main.xabsl"]
    file = designs / "Options/main.yaml"
    file.write_text(file.read_text("utf-8").replace("lost", "nowhere"), "utf-8")
    assert main(["xabsl", "update", str(designs)]) == 0
    expected = before.replace(b"goto lost", b"goto nowhere").replace(b"state lost", b"state nowhere")
    assert contents(behavior)["Options/main.xabsl"] == expected.replace(b"all is lost", b"all is nowhere")


def test_a_new_design_becomes_a_file_that_is_included(paths: Paths) -> None:
    behavior, designs = paths
    before = contents(behavior)
    new = "vicode: 1\ncomponent: wait\narithmetic: xabsl\ntime_unit: ms\ninitial: idle\nstates: {idle: {final: true}}\n"
    (designs / "Options/Skills/wait.yaml").write_text(new, "utf-8")
    assert main(["xabsl", "update", str(designs)]) == 0
    after = contents(behavior)
    written = after.pop("Options/Skills/wait.xabsl")
    assert written.split() == b"option wait { initial target state idle { action { } } }".split()
    assert b"\r\n" in written
    include = b'include "Options/Skills/helper.xabsl";\r\n'
    expected = before["agents.xabsl"].replace(include, include + b'include "Options/Skills/wait.xabsl";\r\n')
    assert after == before | {"agents.xabsl": expected}
    (designs / "Options/Skills/wait.yaml").unlink()
    assert main(["xabsl", "update", str(designs)]) == 0
    assert contents(behavior) == before


def test_a_character_that_the_encoding_lacks_is_an_error(paths: Paths, capsys: pytest.CaptureFixture[str]) -> None:
    behavior, designs = paths
    before = contents(behavior)
    replace_in(designs / "Options/main.yaml", "doc: otherwise", "doc: otherwise →")
    assert main(["xabsl", "update", str(designs)]) == 2
    assert "main.xabsl is in Windows-1252, which does not have '→'" in capsys.readouterr().err
    assert contents(behavior) == before


def test_designs_with_errors_are_not_written(paths: Paths, capsys: pytest.CaptureFixture[str]) -> None:
    behavior, designs = paths
    before = contents(behavior)
    replace_in(designs / "Options/main.yaml", "final: true}", "final: true, resume: 1}")
    assert main(["xabsl", "update", str(designs)]) == 1
    said = capsys.readouterr().err
    assert "main.yaml:" in said
    assert "nothing written" in said
    assert contents(behavior) == before


def test_an_existing_file_is_not_overwritten(paths: Paths, capsys: pytest.CaptureFixture[str]) -> None:
    behavior, designs = paths
    new = "vicode: 1\ncomponent: wait\narithmetic: xabsl\ntime_unit: ms\ninitial: idle\nstates: {idle: {}}\n"
    (designs / "Options/Skills/wait.yaml").write_text(new, "utf-8")
    (behavior / "Options/Skills/wait.xabsl").write_text("// a note\n", "utf-8")
    before = contents(behavior)
    assert main(["xabsl", "update", str(designs)]) == 1
    assert "wait.xabsl already exists" in capsys.readouterr().err
    assert contents(behavior) == before


def test_a_changed_behavior_is_merged_before_an_update(paths: Paths, capsys: pytest.CaptureFixture[str]) -> None:
    behavior, designs = paths
    replace_in(
        designs / "Options/main.yaml", "ball_symbols.ball_distance < 100 and", "ball_symbols.ball_distance < 150 and"
    )
    helper = behavior / "Options/Skills/helper.xabsl"
    helper.write_bytes(helper.read_bytes().replace(b"state only", b"target state only"))
    before = contents(behavior)
    assert main(["xabsl", "update", str(designs)]) == 1
    assert "has changed since the import; merge the changes first: vicode import" in capsys.readouterr().err
    assert contents(behavior) == before
    assert main(["import", str(behavior / "agents.xabsl"), "--out", str(designs)]) == 0
    assert capsys.readouterr().out == f"merged {(designs / 'Options/Skills/helper.yaml').as_posix()}\n"
    project = open_project(designs).project
    merged = project.design("helper")
    assert merged is not None
    assert merged.states[0].final
    assert merged.states[0].at
    assert "150" in (designs / "Options/main.yaml").read_text("utf-8")
    assert main(["xabsl", "update", str(designs)]) == 0
    old = before["Options/main.xabsl"]
    assert contents(behavior) == before | {"Options/main.xabsl": old.replace(b"distance < 100", b"distance < 150")}


def test_conflicts_of_a_merge_are_marked(paths: Paths, capsys: pytest.CaptureFixture[str]) -> None:
    behavior, designs = paths
    replace_in(
        designs / "Options/main.yaml", "ball_symbols.ball_distance < 100 and", "ball_symbols.ball_distance < 150 and"
    )
    file = behavior / "Options/main.xabsl"
    file.write_bytes(file.read_bytes().replace(b"distance < 100", b"distance < 90"))
    capsys.readouterr()
    assert main(["import", str(behavior / "agents.xabsl"), "--out", str(designs)]) == 1
    assert "Options/main.yaml: conflict in" in capsys.readouterr().err
    text = (designs / "Options/main.yaml").read_text("utf-8")
    assert "<<<<<<<" in text
    assert "< 150" in text
    assert "< 90" in text
    assert main(["xabsl", "update", str(designs)]) == 1


def test_an_option_removed_from_the_behavior_is_removed_unless_it_was_edited(
    paths: Paths, capsys: pytest.CaptureFixture[str]
) -> None:
    behavior, designs = paths
    agents, file = behavior / "agents.xabsl", behavior / "Options/main.xabsl"
    agents.write_bytes(agents.read_bytes().replace(b'include "Options/Skills/helper.xabsl";\r\n', b""))
    file.write_bytes(file.read_bytes().replace(b"helper(a = 1, side = memory);", b""))
    design = designs / "Options/Skills/helper.yaml"
    text = design.read_text("utf-8")
    design.write_text(f"{text}doc: mine\n", "utf-8")
    assert main(["import", str(agents), "--out", str(designs)]) == 1
    assert "helper.yaml: changed here, deleted in the behavior" in capsys.readouterr().err
    assert design.exists()


def test_a_damaged_record_is_reported(paths: Paths, capsys: pytest.CaptureFixture[str]) -> None:
    _behavior, designs = paths
    (designs / RECORD_FILE).write_text("{}", "utf-8")
    assert main(["xabsl", "update", str(designs)]) == 2
    assert "is damaged" in capsys.readouterr().err
    (designs / RECORD_FILE).unlink()
    assert main(["xabsl", "update", str(designs)]) == 2
    assert "specify the XABSL file with --into" in capsys.readouterr().err
