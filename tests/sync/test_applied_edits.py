"""Edits that a design contains are no edits any more, although their file was not generated again."""

from dataclasses import replace
from pathlib import Path

from vicode import regions
from vicode.output import OutputFile, compare_files
from vicode.sync import FileEdits, RecordedEdit, find_file_edits, read_applied, record_applied
from vicode.transactions import STATE_FOLDER

PATH = "python/a.py"
KEY = (PATH, "S.enter")


def text_of(body: str) -> str:
    wrapped = regions.wrap_region("S.enter", body, indent="    ")
    return regions.add_header(f"class A:\n    def f(self):\n{wrapped}", "a.yaml")


GENERATED = text_of("a = 1")
APPLIED = RecordedEdit(checksum=regions.compute_checksum("a = 1"), file_text="a = 2", design_text="a = 1")


def find(folder: Path, in_file: str, in_design: str, applied: RecordedEdit | None = APPLIED) -> tuple[FileEdits, ...]:
    (folder / "python").mkdir(exist_ok=True)
    (folder / PATH).write_text(GENERATED.replace("a = 1", in_file), encoding="utf-8")
    files = [OutputFile(path=PATH, text=text_of(in_design), component="A")]
    return find_file_edits(compare_files(files, folder), files, lambda _path: [GENERATED], applied={KEY: applied})


def test_a_design_that_went_on_from_an_edit_has_it(tmp_path: Path) -> None:
    assert find(tmp_path, "a = 2", "a = 3", applied=None)[0].regions[0].is_conflict
    assert find(tmp_path, "a = 2", "a = 3") == ()


def test_a_later_edit_is_merged_with_the_design_that_has_the_first(tmp_path: Path) -> None:
    applied = replace(APPLIED, file_text="a = 2\nb = 1\nc = 1")
    (edit,) = find(tmp_path, "a = 2\nb = 1\nc = 4", "a = 3\nb = 1\nc = 1", applied=applied)[0].regions
    assert edit.merged == "a = 3\nb = 1\nc = 4"
    (edit,) = find(tmp_path, "a = 5", "a = 3")[0].regions
    assert (edit.base, edit.is_conflict) == ("a = 2", True)


def test_an_edit_that_the_design_has_lost_is_found_again(tmp_path: Path) -> None:
    (edit,) = find(tmp_path, "a = 2", "a = 1")[0].regions
    assert edit.merged == "a = 2"


def test_a_refused_edit_stays_refused_until_it_changes(tmp_path: Path) -> None:
    refused = RecordedEdit(checksum=APPLIED.checksum, file_text="a = 2", design_text=None)
    assert find(tmp_path, "a = 2", "a = 1", applied=refused) == ()
    assert find(tmp_path, "a = 7", "a = 1", applied=refused)[0].regions[0].is_conflict


def test_a_record_of_another_generation_does_not_apply(tmp_path: Path) -> None:
    other = RecordedEdit(checksum="00000000", file_text="a = 2", design_text="a = 1")
    assert find(tmp_path, "a = 2", "a = 3", applied=other)[0].regions[0].is_conflict


def test_records_survive_and_broken_ones_are_ignored(tmp_path: Path) -> None:
    record_applied(tmp_path, {KEY: APPLIED})
    assert read_applied(tmp_path) == {KEY: APPLIED}
    record_applied(tmp_path, {KEY: None})
    assert read_applied(tmp_path) == {}
    (tmp_path / STATE_FOLDER / "applied.json").write_text('[["a", "b", {"checksum": 1}]]')
    assert read_applied(tmp_path) == {}
