"""Edits in generated files are found, and nothing else is taken for one."""

from collections.abc import Callable
from pathlib import Path

import pytest

from vicode import regions
from vicode.output import OutputFile, compare_files
from vicode.sync import FileEdits, describe_edits, find_file_edits


def text_of(body: str = "self.a = 1", name: str = "A", region: str = "S.enter") -> str:
    wrapped = regions.wrap_region(region, body, indent="    ")
    return regions.add_header(f"class {name}:\n    def f(self):\n{wrapped}", "a.yaml")


def find(folder: Path, on_disk: str, fresh: str, *generated_before: str) -> tuple[FileEdits, ...]:
    (folder / "python").mkdir(exist_ok=True)
    (folder / "python/a.py").write_text(on_disk, encoding="utf-8")
    files = [OutputFile(path="python/a.py", text=fresh, component="A")]
    return find_file_edits(compare_files(files, folder), files, lambda _path: generated_before, display_folder="out")


def describe(*arguments: Path | str) -> list[tuple[str, int, str]]:
    findings = describe_edits(find(*arguments), "out")  # type: ignore[arg-type]
    places = [(finding, finding.location) for finding in findings]
    assert all(place is not None and place.file == "out/python/a.py" for _finding, place in places)
    return [(finding.rule.code, place.line if place else 0, finding.message) for finding, place in places]


def test_unedited_files_may_be_replaced(tmp_path: Path) -> None:
    assert describe(tmp_path, text_of(), text_of("self.a = 2")) == []
    assert describe(tmp_path, text_of(), text_of("self.a = 2", "B"), text_of()) == []


def test_an_edited_region_is_named(tmp_path: Path) -> None:
    on_disk = text_of().replace("self.a = 1", "self.a = 3")
    assert describe(tmp_path, on_disk, text_of()) == [("G501", 4, "the code of region 'S.enter' was edited here")]


def test_an_edit_that_the_design_has_already_is_none(tmp_path: Path) -> None:
    on_disk = text_of().replace("self.a = 1", "self.a = 3")
    assert describe(tmp_path, on_disk, text_of("self.a = 3")) == []


def test_an_edit_outside_regions_is_found(tmp_path: Path) -> None:
    on_disk = text_of().replace("def f(self)", "def g(self)")
    assert [code for code, _line, _message in describe(tmp_path, on_disk, text_of(), text_of())] == ["G501"]


def test_a_file_of_unknown_origin_counts_as_edited(tmp_path: Path) -> None:
    assert [code for code, _line, _message in describe(tmp_path, text_of(), text_of(name="B"))] == ["G501"]


def test_statements_that_git_merged_are_no_edit(tmp_path: Path) -> None:
    """Both branches changed the design and generated; git merged both files; this one generated last."""

    def generated(first: int, last: int) -> str:
        return regions.add_header(f"a = {first}\nb = 0\nc = 0\nd = {last}\n", "a.yaml")

    merged = generated(1, 2)
    assert describe(tmp_path, merged, merged + "e = 0\n", generated(1, 0)) == []
    assert describe(tmp_path, merged.replace("b = 0", "b = 7"), merged, generated(1, 0)) != []


@pytest.mark.parametrize("change", [lambda text: text.replace("\n", "\r\n"), lambda text: text + "\n\n"])
def test_blanks_and_line_ends_are_no_edits(tmp_path: Path, change: Callable[[str], str]) -> None:
    assert describe(tmp_path, change(text_of()), text_of("self.a = 2")) == []


def test_a_file_written_by_hand_is_in_the_way(tmp_path: Path) -> None:
    ((code, line, message),) = describe(tmp_path, "print('mine')\n", text_of())
    assert (code, line) == ("G501", 1)
    assert "was not generated" in message


def test_broken_marks_are_reported(tmp_path: Path) -> None:
    on_disk = text_of().replace("    # </vicode>\n", "")
    assert [code for code, _line, _message in describe(tmp_path, on_disk, text_of("self.a = 2"))] == ["G503"]


def test_an_edit_in_a_stale_file_is_reported(tmp_path: Path) -> None:
    package = tmp_path / "python"
    package.mkdir()
    (package / "old.py").write_text(text_of().replace("self.a = 1", "mine"), encoding="utf-8")
    files = [OutputFile(path="python/new.py", text=text_of("self.b = 1"))]
    differences = compare_files(files, tmp_path, is_generated=regions.has_header)
    (edits,) = find_file_edits(differences, files, lambda _path: [text_of()])
    assert [finding.rule.code for finding in describe_edits([edits])] == ["G504"]
    assert "no longer contains this code" in next(describe_edits([edits])).message


def test_an_edit_follows_a_renamed_state_and_component(tmp_path: Path) -> None:
    on_disk = text_of().replace("self.a = 1", "self.a = 3")
    (edits,) = find(tmp_path, on_disk, text_of(region="T.enter"))
    assert [(region.id, region.target, region.merged) for region in edits.regions] == [
        ("S.enter", "T.enter", "self.a = 3")
    ]


THREE = "self.a = 1\nself.b = 1\nself.c = 1"


def test_edits_of_both_sides_are_merged(tmp_path: Path) -> None:
    on_disk = text_of(THREE).replace("a = 1", "a = 3")
    (edits,) = find(tmp_path, on_disk, text_of(THREE.replace("c = 1", "c = 5")), text_of(THREE))
    assert [region.merged for region in edits.regions] == ["self.a = 3\nself.b = 1\nself.c = 5"]
    assert all(region.is_merged for region in edits.regions)


def test_edits_of_the_same_line_are_a_conflict_with_both_sides(tmp_path: Path) -> None:
    on_disk = text_of().replace("a = 1", "a = 3")
    (edits,) = find(tmp_path, on_disk, text_of("self.a = 5"), text_of())
    (region,) = edits.regions
    assert (region.base, region.file_text, region.design_text) == ("self.a = 1", "self.a = 3", "self.a = 5")
    assert region.is_conflict
    assert [code for code, _line, _message in describe(tmp_path, on_disk, text_of("self.a = 5"), text_of())] == ["G504"]


def conflict(ours: str, theirs: str, base: str | None = None) -> str:
    ancestor = "" if base is None else f"||||||| base\n{base}"
    return f"<<<<<<< HEAD\n{ours}{ancestor}=======\n{theirs}>>>>>>> other\n"


@pytest.mark.parametrize("base", [None, "    self.b = 1\n"])
def test_conflict_markers_stop_everything_else(tmp_path: Path, base: str | None) -> None:
    """Both sides of the region differ in one line; the file is also edited outside regions."""
    inside = conflict("    self.b = 2\n", "    self.b = 3\n", base)
    on_disk = text_of(THREE).replace("    self.b = 1\n", inside).replace("def f(", "def g(")
    assert inside in on_disk
    (edits,) = find(tmp_path, on_disk, text_of(THREE), text_of(THREE))
    assert (edits.regions, edits.is_edited_outside) == ((), False)
    (merge,) = edits.merge_conflicts
    assert (merge.regions, merge.ours, merge.theirs) == (("S.enter",), "    self.b = 2\n", "    self.b = 3\n")
    marked = tuple(number for number, line in enumerate(on_disk.split("\n"), 1) if line[:7] in MARKERS)
    assert merge.lines == marked
    (found,) = describe(tmp_path, on_disk, text_of(THREE))
    assert (found[0], found[1]) == ("G504", marked[0])
    assert ", ".join(map(str, marked)) in found[2]


MARKERS = ("<" * 7, "|" * 7, "=" * 7, ">" * 7)


@pytest.mark.parametrize("marker", ["<<<<<<< HEAD", "||||||| 1234", ">>>>>>> other", ">>>>>>>>> other"])
def test_a_marker_that_was_left_is_found(tmp_path: Path, marker: str) -> None:
    on_disk = text_of(THREE).replace("    self.b = 1\n", f"{marker}\n    self.b = 1\n")
    assert [code for code, _line, _message in describe(tmp_path, on_disk, text_of(THREE))] == ["G505"]
    assert [code for code, _line, _message in describe(tmp_path, f"{marker}\n{text_of()}", text_of())] == ["G505"]


def test_generated_lines_are_no_markers(tmp_path: Path) -> None:
    body = 'self.a = """\n<<<<<<< begin\n=======\n>>>>>>> end\n"""'
    assert describe(tmp_path, text_of(body), text_of(body)) == []
    assert describe(tmp_path, text_of(body), text_of(f"{body}\nself.b = 1"), text_of(body)) == []
    assert describe(tmp_path, text_of(), text_of().replace("def f", "def g"), text_of()) == []


def test_several_conflicts_are_told_apart(tmp_path: Path) -> None:
    text = text_of(THREE).replace("    self.b = 1\n", conflict("    self.b = 2\n", "", "    self.b = 1\n"))
    text = text.replace("class A:", conflict("class B:\n    pass\n", "class C:\n") + "class A:")
    found = describe(tmp_path, text, text_of(THREE), text_of(THREE))
    assert [code for code, _line, _message in found] == ["G505", "G504"]
    assert "lines 2, 5, 7" in found[0][2]
    assert "'S.enter'" in found[1][2]
