"""An option that cannot be written keeps its file and is reported; the others are written. Moved designs move files."""

from pathlib import Path

import pytest

from vicode.cli.entry_point import main

AGENTS = """\
include "Symbols/world.xabsl";
include "Symbols/acts.xabsl";
include "Options/play.xabsl";
include "Options/wait.xabsl"; // waits
agent player("Player", play);
"""
WORLD = """\
namespace world("World") {
  float input angle(float x; bool near;);
  float input distance [mm];
}
"""
ACTS = 'namespace acts("Acts") { behavior stand { } }\n'
PLAY = """\
option play {
  initial state one {
    decision {
      if (angle > 1) goto two;
      else if (1 <
        distance /* far */ )
        goto two;
      else stay;
    }
    action { stand(); }
  }
  state two { action { wait(); } }
}
"""
WAIT = """\
option wait {
  initial state only {
    decision {
      if (distance > 1) goto only;
      else stay;
    }
    action { stand(); }
  }
}
"""
TEXTS = {
    "agents.xabsl": AGENTS,
    "Symbols/world.xabsl": WORLD,
    "Symbols/acts.xabsl": ACTS,
    "Options/play.xabsl": PLAY,
    "Options/wait.xabsl": WAIT,
}
PLAY_DESIGN, WAIT_DESIGN = (Path("designs/Options", f"{name}.yaml") for name in ("play", "wait"))


@pytest.fixture(autouse=True)
def imported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> str:
    """The output of an import into the working directory."""
    monkeypatch.chdir(tmp_path)
    for name, text in TEXTS.items():
        Path("behavior", name).parent.mkdir(parents=True, exist_ok=True)
        Path("behavior", name).write_text(text, "utf-8")
    assert main(["import", "behavior/agents.xabsl", "--out", "designs"]) == 0
    return capsys.readouterr().out


def files() -> dict[str, str]:
    folder = Path("behavior")
    return {path.relative_to(folder).as_posix(): path.read_text("utf-8") for path in folder.rglob("*.xabsl")}


def replace_in(file: Path, old: str, new: str) -> None:
    text = file.read_text("utf-8")
    assert text.count(old) == 1, text
    file.write_text(text.replace(old, new), "utf-8")


def update(*options: str) -> int:
    return main(["xabsl", "update", "designs", *options])


def test_an_import_reports_what_the_designs_cannot_express(imported: str) -> None:
    assert imported.splitlines()[1:] == [
        "the designs cannot express 3 details of the XABSL files:",
        "  Symbols/world.xabsl:3: the range [mm] is not a pair of numbers: the design keeps it in the description",
        "  Options/play.xabsl:4: angle is read without arguments: the design calls it with the defaults",
        "  Options/play.xabsl:6: the design shows this comment above transition 2 of state one",
    ]


def test_a_function_read_without_arguments_does_not_stop_an_update(capsys: pytest.CaptureFixture[str]) -> None:
    assert "when: world_.angle() > 1" in PLAY_DESIGN.read_text("utf-8")
    assert update("--check") == 0
    replace_in(WAIT_DESIGN, "distance > 1", "distance > 2")
    assert update() == 0
    assert files() == TEXTS | {"Options/wait.xabsl": WAIT.replace("> 1", "> 2")}
    replace_in(PLAY_DESIGN, "angle() > 1", "angle(x=3) > 1")
    assert update() == 0
    assert files()["Options/play.xabsl"] == PLAY.replace("angle > 1", "angle(x = 3) > 1")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("angle() > 1", "angle > 1", "play.yaml:16:25: error E305"),
        ("initial: one", "initial: one\nresume: true", "play.yaml:10:9: error L701"),
        ("component: play", "component: play\nstates: [", "play.yaml:"),
    ],
)
def test_an_option_with_errors_does_not_stop_the_others(
    old: str, new: str, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    replace_in(PLAY_DESIGN, old, new)
    replace_in(WAIT_DESIGN, "distance > 1", "distance > 2")
    assert update("--check") == 1
    said = capsys.readouterr()
    assert said.out == "behavior/Options/wait.xabsl: would be changed\n"
    assert message in said.err
    assert update() == 1
    assert files() == TEXTS | {"Options/wait.xabsl": WAIT.replace("> 1", "> 2")}
    assert update() == 1
    assert "nothing written" in capsys.readouterr().err
    replace_in(PLAY_DESIGN, new, old)
    assert update("--check") == 0


def test_edits_that_depend_on_an_option_with_errors_are_not_written(capsys: pytest.CaptureFixture[str]) -> None:
    replace_in(PLAY_DESIGN, "angle() > 1", "angle > 1")
    for file in (PLAY_DESIGN, WAIT_DESIGN):
        file.write_text(file.read_text("utf-8").replace("wait", "rest"), "utf-8")
    assert update() == 1
    assert files() == TEXTS
    assert "nothing written" in capsys.readouterr().err


def test_a_moved_design_moves_its_option_and_the_include() -> None:
    Path("designs/Options/Calm").mkdir()
    WAIT_DESIGN.rename("designs/Options/Calm/wait.yaml")
    assert update("--check") == 1
    assert update() == 0
    expected = {name: text for name, text in TEXTS.items() if name != "Options/wait.xabsl"}
    agents = AGENTS.replace("Options/wait.xabsl", "Options/Calm/wait.xabsl")
    assert files() == expected | {"agents.xabsl": agents, "Options/Calm/wait.xabsl": WAIT}
    assert update("--check") == 0
    Path("designs/Options/Calm/wait.yaml").rename("designs/wait.yaml")
    replace_in(Path("designs/wait.yaml"), "distance > 1", "distance > 2")
    assert update() == 0
    assert files()["wait.xabsl"] == WAIT.replace("> 1", "> 2")


def test_a_design_is_not_moved_over_another_file(capsys: pytest.CaptureFixture[str]) -> None:
    Path("designs/Options/Calm").mkdir()
    WAIT_DESIGN.rename("designs/Options/Calm/wait.yaml")
    Path("behavior/Options/Calm").mkdir()
    Path("behavior/Options/Calm/wait.xabsl").write_text("// mine\n", "utf-8")
    assert update() == 1
    assert "Calm/wait.yaml:2:1: error: " in (said := capsys.readouterr().err)
    assert "already exists" in said
    assert files() == TEXTS | {"Options/Calm/wait.xabsl": "// mine\n"}


def test_changes_of_the_behavior_reach_a_moved_design() -> None:
    Path("designs/Options/Calm").mkdir()
    WAIT_DESIGN.rename("designs/Options/Calm/wait.yaml")
    replace_in(Path("behavior/Options/wait.xabsl"), "distance > 1", "distance > 3")
    assert main(["import", "behavior/agents.xabsl", "--out", "designs"]) == 0
    assert "distance > 3" in Path("designs/Options/Calm/wait.yaml").read_text("utf-8")
    assert update() == 0
    assert files()["Options/Calm/wait.xabsl"] == WAIT.replace("> 1", "> 3")


def test_comments_of_both_sides_are_merged() -> None:
    replace_in(WAIT_DESIGN, "      - call: stand", "      # ours\n      - call: stand")
    replace_in(WAIT_DESIGN, "distance > 1", "distance > 2")
    file = Path("behavior/Options/wait.xabsl")
    replace_in(file, "      if (", "      // theirs\n      if (")
    assert main(["import", "behavior/agents.xabsl", "--out", "designs"]) == 0
    assert "# theirs" in WAIT_DESIGN.read_text("utf-8")
    assert update() == 0
    text = file.read_text("utf-8")
    assert "      // theirs\n      if (distance > 2)" in text
    assert "// ours" in text
    replace_in(file, "      // theirs\n", "")
    assert main(["import", "behavior/agents.xabsl", "--out", "designs"]) == 0
    assert "# theirs" not in WAIT_DESIGN.read_text("utf-8")
    assert "# ours" in WAIT_DESIGN.read_text("utf-8")


def test_designs_of_an_earlier_version_keep_the_comments_of_xabsl(capsys: pytest.CaptureFixture[str]) -> None:
    record = Path("designs/imported-behavior.json")
    text = record.read_text("utf-8")
    record.write_text(text.replace(' "comments": true,\n', ""), "utf-8")
    replace_in(PLAY_DESIGN, "# far", "# near")
    assert update() == 0
    assert "their comments are not written" in capsys.readouterr().err
    assert files() == TEXTS
