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


def test_edits_outside_regions_are_kept(generated: Path, capsys: pytest.CaptureFixture[str]) -> None:
    edit(SOURCE, "state_ = next;", "state_ = next;  // here")
    assert vicode("gen", "lamps") == 1
    assert "G50" in capsys.readouterr().err
    assert "// here" in SOURCE.read_text()
