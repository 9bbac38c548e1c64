"""vicode sync with generated C++: edits reach the version in C++ of the design's code."""

from pathlib import Path

import pytest

from tests.cli.command_runner import vicode
from tests.cli.test_sync_command import edit

PROJECT = "vicode: 1\nproject: Lamps\nlanguages: [python, cpp]\n"
LAMP = """
vicode: 1
component: Lamp
outputs: {count: 0}
module: {cpp: "#include <cmath>"}
initial: Dark
states:
  Dark:
    enter:
      python: |
        self.count = 1
      cpp: |
        const char* text = "a b";
        count = 1;
    transitions:
      - {to: Bright, code: return self.count > 3}
  Bright:
    actions: self.count += 1
"""
SOURCE = Path("lamps/generated/cpp/lamps/lamp.cpp")
HEADER = Path("lamps/generated/cpp/lamps/lamp.hpp")
DESIGN = Path("lamps/lamp.yaml")


@pytest.fixture
def generated(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Path:
    monkeypatch.chdir(tmp_path)
    folder = tmp_path / "lamps"
    folder.mkdir()
    (folder / "project.yaml").write_text(PROJECT)
    (folder / "lamp.yaml").write_text(LAMP)
    assert vicode("gen", "lamps") == 0
    capsys.readouterr()
    return folder


def test_an_edit_goes_into_the_version_in_cpp(generated: Path, capsys: pytest.CaptureFixture[str]) -> None:
    edit(SOURCE, "    count = 1;", "    count = 2;  // two\n    count += 1;")
    edit(HEADER, "#include <cmath>", "#include <cmath>\n#include <cstdlib>")
    assert vicode("gen", "--check", "lamps") == 1
    assert "region 'Dark.enter' was edited here" in capsys.readouterr().out
    assert vicode("sync", "lamps") == 0
    text = DESIGN.read_text()
    assert "        count = 2;  // two\n        count += 1;\n" in text
    assert "        self.count = 1\n" in text
    assert "#include <cstdlib>" in text
    assert vicode("gen", "--check", "lamps") == 0


def test_a_space_in_a_string_is_an_edit(generated: Path) -> None:
    edit(SOURCE, '"a b"', '"a  b"')
    assert vicode("sync", "lamps") == 0
    assert '"a  b"' in DESIGN.read_text()


def test_layout_is_no_edit(generated: Path) -> None:
    edit(SOURCE, "    count = 1;", "\tcount   =   1;")
    assert vicode("sync", "--check", "lamps") == 0


def test_an_edit_of_translated_code_adds_a_version_in_cpp(generated: Path) -> None:
    edit(SOURCE, "count += 1;", "count += 2;")
    edit(SOURCE, "return count > 3;", "return count > 4;")
    assert vicode("sync", "lamps") == 0
    text = DESIGN.read_text()
    assert "python: self.count += 1" in text
    assert "cpp: count += 2;" in text
    assert "return self.count > 3" in text
    assert "return count > 4;" in text
    assert vicode("gen", "--check", "lamps") == 0


def test_edits_of_both_sides_are_merged_or_conflict(generated: Path, capsys: pytest.CaptureFixture[str]) -> None:
    edit(DESIGN, "        count = 1;\n", "        count = 1;\n\n        count -= 1;\n")
    assert vicode("gen", "lamps") == 0
    edit(SOURCE, "    count = 1;", "    count = 2;")
    edit(DESIGN, "count -= 1;", "count -= 3;")
    assert vicode("sync", "lamps") == 0
    assert "count = 2;\n\n        count -= 3;\n" in DESIGN.read_text()
    edit(SOURCE, "count = 2;", "count = 5;")
    edit(DESIGN, "count = 2;", "count = 6;")
    capsys.readouterr()
    assert vicode("sync", "lamps") == 1
    assert "error G504" in capsys.readouterr().err
    assert vicode("sync", "lamps", "--take", "file") == 0
    assert "count = 5;" in DESIGN.read_text()


def test_edits_outside_regions_are_refused_with_their_line(generated: Path, capsys: pytest.CaptureFixture[str]) -> None:
    edit(SOURCE, "state_ = next;", "state_ = next;  // here")
    line = SOURCE.read_text()[: SOURCE.read_text().index("// here")].count("\n") + 1
    shared = Path("lamps/generated/cpp/bica.hpp")
    edit(shared, "#pragma once", "#pragma once\n#define MINE")
    assert vicode("gen", "lamps") == 1
    refused = capsys.readouterr().err
    assert f"{SOURCE.as_posix()}:{line}:1: error G501" in refused
    assert f"{shared.as_posix()}:7:1: error G501" in refused
    assert "no design can contain the edit" in refused
    assert "// here" in SOURCE.read_text()


TREE = """
vicode: 1
component: Lamp
uses: {motor: Motor}
outputs: {count: 0, on: {initial: false}}
initial: Dark
states:
  Dark:
    actions: [{set: {count: count + 1}}]
    transitions:
      - {to: Bright, when: count > 3, doc: Enough.}
      - {to: Off, after: 2}
  Bright:
    actions: [{call: motor, with: {speed: 0.5 * count}}]
    transitions:
      - {to: Dark, after: 0.5}
      - when: on
        then: [{to: Off, when: count > 30 and state_time > 0.1}]
  Off:
    modulates: {motor: {speed: "-1"}}
"""
MOTOR = "components: {Motor: {parameters: {speed: float}}}\n"
READ_BACK = [
    ("count > 3)", "count > 4)", "when: count > 4,"),
    ("count > 3)", "count > 3 && !on)", "when: count > 3 and not on,"),
    ("count > 3)", "on || count > 3)", "when: on or count > 3,"),
    ("state_time() > 0.1", "state_time() < 0.25", "when: count > 30 and state_time < 0.25"),
    (" && state_time() > 0.1", "", "when: count > 30}"),
    ("2'000'000'000", "2'500'000'000", "after: 2.5}"),
    ("State::Off);", "State::Dark);", "{to: Dark, when: count > 30 and"),
    ("count += 1;", "count += 2;", "set: {count: count + 2}"),
    ("count += 1;", "count -= 1;", "set: {count: count - 1}"),
    ("-1.0", "-2.0", 'speed: "-2"'),
    ("0.5 *", "0.75 *", "speed: 0.75 * count"),
    ("-1.0", "-2", 'speed: "-2"'),
    ("> 0.1)", "> 2 && on)", "when: count > 30 and state_time > 2 and on}"),
]


@pytest.fixture
def tree(generated: Path, capsys: pytest.CaptureFixture[str]) -> Path:
    (generated / "project.yaml").write_text(PROJECT + MOTOR)
    (generated / "lamp.yaml").write_text(TREE)
    assert vicode("gen", "lamps", "--force") == 0
    capsys.readouterr()
    return generated


@pytest.mark.parametrize(("old", "new", "expected"), READ_BACK)
def test_changed_tokens_are_read_back(
    tree: Path, old: str, new: str, expected: str, capsys: pytest.CaptureFixture[str]
) -> None:
    text = SOURCE.read_text()
    at = text.rindex(old)
    SOURCE.write_text(text[:at] + new + text[at + len(old) :])
    assert vicode("sync", "lamps") == 1
    assert "the design can express: " in capsys.readouterr().err
    assert DESIGN.read_text() == TREE
    assert vicode("sync", "lamps", "--outside-regions") == 0
    assert expected in DESIGN.read_text()
    assert vicode("gen", "--check", "lamps") == 0


def test_transitions_are_added_and_removed(tree: Path) -> None:
    edit(
        SOURCE,
        "                change_to(State::Bright);\n                return;\n            }\n",
        "                change_to(State::Bright);\n                return;\n            }\n"
        "            if (on && count < 2) {\n                change_to(State::Off);\n"
        "                return;\n            }\n",
    )
    edit(
        SOURCE,
        "            if (state_time_ns() >= 500'000'000) {\n                change_to(State::Dark);\n"
        "                return;\n            }\n",
        "",
    )
    assert vicode("sync", "lamps", "--outside-regions") == 0
    text = DESIGN.read_text()
    assert "{to: Bright, when: count > 3, doc: Enough.}\n      - {to: Off, when: on and count < 2}\n" in text
    assert "after: 0.5" not in text
    assert vicode("gen", "--check", "lamps") == 0


def test_what_the_design_cannot_express_is_kept_as_a_patch(tree: Path, capsys: pytest.CaptureFixture[str]) -> None:
    edit(SOURCE, "count > 3)", "count > 4)")
    edit(SOURCE, "state_ = next;", "state_ = next;\n    log(next);")
    edit(HEADER, "    void start();", "    void start();\n    void log(State state);")
    assert vicode("sync", "lamps", "--outside-regions") == 1
    assert "when: count > 4," in DESIGN.read_text()
    patch = SOURCE.with_name("lamp.cpp.patch").read_text()
    assert "+    log(next);" in patch
    assert "count" not in patch
    assert "+    void log(State state);" in HEADER.with_name("lamp.hpp.patch").read_text()
    assert "log(next)" not in SOURCE.read_text()
