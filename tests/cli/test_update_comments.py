"""Comments of imported designs are written back to XABSL, place by place; what has no place there is reported."""

from pathlib import Path

import pytest

from tests.services.imported_behavior.kickoff_behavior import KICKOFF, TEXTS
from vicode.cli.entry_point import main

OPTION = "behavior/Options/SetPlays/kickoff.xabsl"
DESIGN = "designs/Options/SetPlays/kickoff.yaml"
BLOCK = "\t\t\t// slowly\n\t\t\tspeed=10;   // mm/s\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def import_texts(kickoff: str = KICKOFF, symbols: str = TEXTS["Symbols/ball.xabsl"]) -> None:
    """Import the behavior with other texts of its option or symbols."""
    texts = {**TEXTS, "Options/SetPlays/kickoff.xabsl": kickoff, "Symbols/ball.xabsl": symbols}
    for name, text in texts.items():
        file = Path("behavior", name)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, "utf-8")
    assert main(["import", "behavior/agents.xabsl", "--out", "designs", "--force"]) == 0


def replace_in(file: str, old: str, new: str) -> None:
    text = Path(file).read_text("utf-8")
    assert text.count(old) == 1, text
    Path(file).write_text(text.replace(old, new), "utf-8")


def update(*options: str) -> int:
    return main(["xabsl", "update", "designs", *options])


def assert_updated(old: str, new: str) -> None:
    """Assert that an update replaces a text of the option, and that both sides agree afterwards."""
    before = Path(OPTION).read_text("utf-8")
    assert before.count(old) == 1
    assert update() == 0
    assert Path(OPTION).read_text("utf-8") == before.replace(old, new)
    assert update("--check") == 0
    design = Path(DESIGN).read_text("utf-8")
    assert main(["import", "behavior/agents.xabsl", "--out", "again"]) == 0
    again = Path("again/Options/SetPlays/kickoff.yaml").read_text("utf-8")
    comments = [
        [line.strip() for line in text.splitlines() if line.strip(" ").startswith("# ")] for text in (design, again)
    ]
    assert comments[0] == comments[1]


def test_a_comment_above_several_assignments_stays_when_the_first_is_deleted(folder: Path) -> None:
    block = "\t\t\t/* both\n\t\t\t   slowly */\n\t\t\tspeed=10;\n\t\t\tturn=1;\n"
    symbols = TEXTS["Symbols/ball.xabsl"].replace("float output speed;", "float output speed;\n\tfloat output turn;")
    import_texts(kickoff=KICKOFF.replace(BLOCK, block), symbols=symbols)
    replace_in(DESIGN, "- set: {ball.speed: 10, ball.turn: 1}", "- set: {ball.turn: 1}")
    assert_updated("\t\t\tspeed=10;\n", "")


def test_a_comment_goes_with_its_action_if_the_design_does_not_show_it_any_more(folder: Path) -> None:
    import_texts()
    replace_in(DESIGN, "      # slowly\n      # mm/s\n      - set: {ball.speed: 10}\n", "")
    assert_updated(BLOCK, "")


def test_an_assignment_with_a_comment_is_an_action_of_its_own(folder: Path) -> None:
    import_texts(kickoff=KICKOFF.replace(BLOCK, f"\t\t\tspeed=1;\n{BLOCK}"))
    assert "- set: {ball.speed: 1}\n      # slowly\n      # mm/s\n      - set: {ball.speed: 10}" in Path(
        DESIGN
    ).read_text("utf-8")


def test_a_changed_comment_keeps_its_markers_and_its_place(folder: Path) -> None:
    import_texts()
    replace_in(DESIGN, "# mm/s", "# cm/s")
    assert_updated("speed=10;   // mm/s", "speed=10;   // cm/s")
    replace_in(DESIGN, "# to the left", "# to the right")
    assert_updated("/* to the left */ goto turn;", "/* to the right */ goto turn;")


def test_a_deleted_comment_is_deleted(folder: Path) -> None:
    import_texts()
    replace_in(DESIGN, "      # mm/s\n", "")
    assert_updated("speed=10;   // mm/s", "speed=10;")
    replace_in(DESIGN, "      # is it near?\n", "")
    assert_updated("\t\t\t// is it near?\n", "")
    replace_in(DESIGN, "      # to the left\n", "")
    assert_updated("/* to the left */ goto turn;", "goto turn;")


@pytest.mark.parametrize(
    ("place", "before", "after"),
    [
        ("component: kickoff", "/** Plays the", "// new\n/** Plays the"),
        ("  reach: {", '\tfloat @reach "mm";', '\t// new\n\tfloat @reach "mm";'),
        ("  turn:", "\tstate turn {\n", "\tstate turn {\n\t\t// new\n"),
        (
            "      - {to: turn, when",
            "/* to the left */ goto turn;",
            "/* to the left */\n\t\t\t\t// new\n\t\t\t\tgoto turn;",
        ),
        (
            "      - call: walk\n        with: {speed",
            "\t\t\twalk(speed=ball.x*2,",
            "\t\t\t// new\n\t\t\twalk(speed=ball.x*2,",
        ),
        ("    actions:\n      # slowly", "\t\taction {\n\t\t\t// slowly", "\t\t// new\n\t\taction {\n\t\t\t// slowly"),
        ("      # slowly", "\t\t\t// slowly", "\t\t\t// new\n\t\t\t// slowly"),
        ("vicode: 1", "/** Plays the", "/***\nnew\n*/\n/** Plays the"),
    ],
)
def test_an_added_comment_is_written_above_its_element(folder: Path, place: str, before: str, after: str) -> None:
    import_texts()
    text = Path(DESIGN).read_text("utf-8")
    start = text.index(place)
    indent = place[: len(place) - len(place.lstrip(" "))]
    Path(DESIGN).write_text(f"{text[:start]}{indent}# new\n{text[start:]}", "utf-8")
    assert_updated(before, after)


def test_a_comment_behind_one_that_ends_a_line_is_written_above_both(folder: Path) -> None:
    import_texts()
    replace_in(DESIGN, "      # mm/s\n", "      # mm/s\n      # new\n")
    assert_updated("speed=10;   // mm/s\n", "// mm/s\n\t\t\t// new\n\t\t\tspeed=10;\n")


def test_comments_of_symbols_are_written(folder: Path) -> None:
    import_texts()
    replace_in("designs/project.yaml", "# field", "# the field")
    replace_in("designs/project.yaml", "      speed: {type", "      # new\n      speed: {type")
    assert update() == 0
    symbols = TEXTS["Symbols/ball.xabsl"].replace("// field", "// the field")
    expected = symbols.replace("\tfloat output speed;", "\t// new\n\tfloat output speed;")
    assert Path("behavior/Symbols/ball.xabsl").read_text("utf-8") == expected


def test_lines_of_a_block_comment_are_edited_one_by_one(folder: Path) -> None:
    block = "\t\t\t/* one {\n\t\t\t *   two\n\t\t\t *\n\t\t\t *   three\n\t\t\t * } */\n"
    import_texts(kickoff=KICKOFF.replace("\t\t\t// is it near?\n", block))
    replace_in(DESIGN, "      #   two\n", "      #   2\n      #   2.5\n")
    replace_in(DESIGN, "      #   three\n", "")
    assert_updated("\t\t\t *   two\n\t\t\t *\n\t\t\t *   three\n", "\t\t\t *   2\n\t\t\t *\n\t\t\t *   2.5\n")


def test_a_comment_without_a_place_is_reported_and_the_others_are_written(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    import_texts()
    replace_in(DESIGN, "initial: wait", "# nowhere\ninitial: wait")
    replace_in(DESIGN, "# mm/s", "# cm/s")
    line = Path(DESIGN).read_text("utf-8").split("\n").index("# nowhere") + 1
    capsys.readouterr()
    assert update("--check") == 1
    said = capsys.readouterr()
    assert said.out == f"{OPTION}: would be changed\n"
    assert said.err.startswith(f"{DESIGN}:{line}: error: the comment 'nowhere' is not written to XABSL: XABSL has no")
    assert update() == 1
    assert "// cm/s" in Path(OPTION).read_text("utf-8")
    assert "nowhere" in Path(DESIGN).read_text("utf-8")
    assert update("--check") == 1


def test_a_comment_that_would_become_a_description_is_reported(folder: Path) -> None:
    import_texts()
    replace_in(DESIGN, "# state old { }", "# an old remark")
    assert update() == 1
    assert "/* state old { } */" in Path(OPTION).read_text("utf-8")


def test_a_description_without_a_place_is_reported(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    import_texts()
    replace_in(
        DESIGN, "      - {to: wait, after: 500}", "      - {to: wait, after: 500}\n      - {to: turn, doc: always}"
    )
    assert update("--check") in (0, 1)
    text = Path(DESIGN).read_text("utf-8")
    Path(DESIGN).write_text(text.replace("initial: wait", "initial: wait\ncommon: {doc: whatever}"), "utf-8")
    capsys.readouterr()
    assert update("--check") == 1
    assert "error: the description of the common section is not written to XABSL" in capsys.readouterr().err


def test_a_transition_behind_a_comment_is_removed_without_joining_lines(folder: Path) -> None:
    decision = "\t\t\tif(state_time>=500) goto wait; // soon\n\t\t\telse if(ball.seen) goto kick; else stay;\n"
    old = "\t\t\tif(state_time>=500) goto wait;\n\t\t\telse stay;\n"
    import_texts(kickoff=KICKOFF.replace(old, decision))
    replace_in(DESIGN, "      - {to: kick, when: ball.ball_seen}\n", "")
    assert_updated("\t\t\telse if(ball.seen) goto kick; else stay;\n", "\t\t\telse stay;\n")


def test_a_changed_and_an_added_transition_of_one_state_are_written(folder: Path) -> None:
    described = "\t\t\t/** in time */\n\t\t\tif(state_time>=500) goto wait;\n"
    import_texts(kickoff=KICKOFF.replace("\t\t\tif(state_time>=500) goto wait;\n", described))
    new = "{to: wait, when: component_time > 1, doc: in time}\n      - {to: wait, when: state_time > 500}"
    replace_in(DESIGN, "{to: wait, after: 500, doc: in time}", new)
    assert update() == 0
    text = Path(OPTION).read_text("utf-8")
    assert "/** in time */\n\t\t\tif (option_time > 1)\n\t\t\t\tgoto wait;\n\t\t\telse if (state_time > 500)" in text
