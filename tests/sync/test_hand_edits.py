"""Nothing a person did to a generated file is written over unseen."""

from pathlib import Path

import pytest

from vicode import regions
from vicode.output import OutputFile, compare_files
from vicode.sync import find_hand_edits, find_hand_edits_by_file


def text_of(body: str = "self.a = 1", name: str = "A") -> str:
    wrapped = regions.wrap_region("S.enter", body, indent="    ")
    return regions.add_header(f"class {name}:\n    def f(self):\n{wrapped}", "a.yaml")


def edits(tmp_path: Path, on_disk: str, fresh: str) -> list[tuple[str, int, str]]:
    (tmp_path / "a.py").write_text(on_disk, encoding="utf-8")
    findings = find_hand_edits(compare_files([OutputFile(path="a.py", text=fresh)], tmp_path), display_folder="out")
    assert all(finding.location and finding.location.file == "out/a.py" for finding in findings)
    return [
        (finding.rule.code, finding.location.line if finding.location else 0, finding.message) for finding in findings
    ]


def test_untouched_files_may_be_replaced(tmp_path: Path) -> None:
    assert edits(tmp_path, text_of(), text_of("self.a = 2", "B")) == []
    assert find_hand_edits(compare_files([OutputFile(path="new.py", text=text_of())], tmp_path)) == ()


def test_an_edited_region_is_named(tmp_path: Path) -> None:
    on_disk = text_of().replace("self.a = 1", "self.a = 3")
    assert edits(tmp_path, on_disk, text_of("self.a = 2")) == [
        ("G501", 4, "the code of region 'S.enter' was edited here")
    ]


def test_an_edit_that_the_design_has_already_is_none(tmp_path: Path) -> None:
    on_disk = text_of().replace("self.a = 1", "self.a = 3")
    assert edits(tmp_path, on_disk, text_of("self.a = 3", "B")) == []


def test_an_edit_outside_regions_is_seen(tmp_path: Path) -> None:
    on_disk = text_of().replace("def f(self)", "def g(self)")
    assert [code for code, _line, _message in edits(tmp_path, on_disk, text_of())] == ["G501"]
    assert edits(tmp_path, on_disk, on_disk.replace("class A", "class A")) == []


@pytest.mark.parametrize("change", [lambda text: text.replace("\n", "\r\n"), lambda text: text + "\n\n"])
def test_blanks_and_line_ends_are_no_edits(tmp_path: Path, change: object) -> None:
    assert callable(change)
    assert edits(tmp_path, change(text_of()), text_of("self.a = 2")) == []


def test_a_file_written_by_hand_is_in_the_way(tmp_path: Path) -> None:
    ((code, line, message),) = edits(tmp_path, "print('mine')\n", text_of())
    assert (code, line) == ("G501", 1)
    assert "was not generated" in message


def test_broken_marks_are_named_rather_than_guessed(tmp_path: Path) -> None:
    on_disk = text_of().replace("    # </vicode>\n", "")
    assert [code for code, _line, _message in edits(tmp_path, on_disk, text_of("self.a = 2"))] == ["G503"]


def test_a_stale_file_with_an_edit_is_kept(tmp_path: Path) -> None:
    package = tmp_path / "p"
    package.mkdir()
    (package / "old.py").write_text(text_of().replace("self.a = 1", "mine"), encoding="utf-8")
    (package / "gone.py").write_text(text_of(), encoding="utf-8")
    files = [OutputFile(path="p/new.py", text=text_of())]
    differences = compare_files(files, tmp_path, is_generated=regions.has_header)
    assert list(find_hand_edits_by_file(differences)) == ["p/old.py"]
