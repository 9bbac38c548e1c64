"""vicode sync where both sides changed the same, or a text editor saves again: nothing is lost or half done."""

import shutil
import subprocess
from pathlib import Path

import pytest

from tests.cli.command_runner import LAMP, lamps, vicode
from tests.cli.test_sync_command import DESIGN, FILE, edit, generated
from vicode import transactions
from vicode.sync import generation

__all__ = ["generated", "lamps"]

GUARDED = LAMP.replace("{to: Lit, after: pause}", "{to: Lit, when: count > 1}").replace(
    "uses:", "variables:\n  count: 0\n  total: 0\nuses:"
)
TEST = "if self.count > 1:"


@pytest.fixture
def guarded(generated: Path, capsys: pytest.CaptureFixture[str]) -> Path:
    """The lamp with a test in its generated code."""
    DESIGN.write_text(GUARDED)
    assert vicode("gen", "lamps") == 0
    capsys.readouterr()
    assert TEST in FILE.read_text().replace("decide and ", "")
    return generated


def line_of(text: str) -> int:
    return FILE.read_text().split(text)[0].count("\n") + 1


@pytest.mark.parametrize("command", ["gen", "sync"])
def test_conflict_markers_stop_a_file(generated: Path, capsys: pytest.CaptureFixture[str], command: str) -> None:
    edit(FILE, "200_000_000", "400_000_000")
    edit(FILE, "        self.count = 1\n", "<<<<<<< a\n        self.count = 2\n=======\n        x = 3\n>>>>>>> b\n")
    edit(FILE, "class Lamp", "<<<<<<< a\nclass Lamp")
    before = FILE.read_text()
    assert vicode(command, "lamps") == 1
    err = capsys.readouterr().err
    assert f"{FILE}:{line_of('<<<<<<< a')}:1: error G505" in err
    assert "error G504 region-conflict: merge conflict in the code of region 'Dark.enter'" in err
    assert "-        self.count = 2\n+        x = 3\n" in err
    assert (FILE.read_text(), DESIGN.read_text()) == (before, LAMP)
    assert vicode("run", "lamps/lamp.yaml", "--ticks", "2", "--plain") == 1
    assert vicode("gen", "lamps", "--force") == 0
    assert FILE.with_name("lamp.py.edited").read_text() == before


def test_the_same_guard_in_file_and_design_is_a_conflict(guarded: Path, capsys: pytest.CaptureFixture[str]) -> None:
    edit(FILE, "self.count > 1", "self.count > 22")
    edit(DESIGN, "count > 1", "count > 33")
    before = (FILE.read_text(), DESIGN.read_text())
    for options in ([], ["--outside-regions"]):
        assert vicode("sync", "lamps", *options) == 1
        err = capsys.readouterr().err
        assert f"{FILE}:{line_of('> 22')}:1: error G504" in err
        assert err.count("error") == 1
        for text in ("> 1:", "> 22:", "> 33:"):
            assert text in err
        assert (FILE.read_text(), DESIGN.read_text()) == before


@pytest.mark.parametrize(("side", "kept"), [("file", 22), ("design", 33)])
@pytest.mark.parametrize("is_item", [False, True])
def test_a_side_is_taken_for_statements(
    guarded: Path, capsys: pytest.CaptureFixture[str], side: str, kept: int, is_item: bool
) -> None:
    edit(FILE, "self.count > 1", "self.count > 22")
    edit(DESIGN, "count > 1", "count > 33")
    edited, designed = FILE.read_text(), DESIGN.read_text()
    choice = f"{side}={FILE}:{line_of('> 22')}" if is_item else side
    assert vicode("sync", "lamps", "--outside-regions", "--take", choice) == 0
    assert f"when: count > {kept}" in DESIGN.read_text()
    assert f"self.count > {kept}" in FILE.read_text()
    # What was dropped is shown, and stays in a copy.
    assert f"> {55 - kept}" in capsys.readouterr().out
    copy, text = (FILE, edited) if side == "design" else (DESIGN, designed)
    assert [file.name for file in Path("lamps").rglob("*.edited")] == [f"{copy.name}.edited"]
    assert copy.with_name(f"{copy.name}.edited").read_text() == text
    assert vicode("gen", "--check", "lamps") == 0


def test_each_conflict_has_its_own_choice(guarded: Path, capsys: pytest.CaptureFixture[str]) -> None:
    edit(FILE, "self.count > 1", "self.count > 22")
    edit(DESIGN, "count > 1", "count > 33")
    edit(FILE, "self.count = 1", "self.count = 5")
    edit(DESIGN, "self.count = 1", "self.count = 6")
    before = (FILE.read_text(), DESIGN.read_text())
    assert vicode("sync", "lamps", "--take", "file=Dark.enter") == 1
    assert (FILE.read_text(), DESIGN.read_text()) == before
    capsys.readouterr()
    assert vicode("sync", "lamps", "--take", "file=Dark.leave") == 2
    assert "no conflict 'Dark.leave'" in capsys.readouterr().err
    item = f"lamp.py:{line_of('> 22')}"
    assert vicode("sync", "lamps", "--take", "file=Dark.enter", "--take", f"design={item}") == 0
    assert "self.count = 5" in DESIGN.read_text()
    assert "count > 33" in DESIGN.read_text()
    assert vicode("gen", "--check", "lamps") == 0


@pytest.mark.parametrize("choice", ["both", "file=", "=Dark.enter"])
def test_a_choice_names_a_side(generated: Path, capsys: pytest.CaptureFixture[str], choice: str) -> None:
    assert vicode("sync", "lamps", "--take", choice) == 2
    assert "expected file, design, file=ITEM or design=ITEM" in capsys.readouterr().err


def test_what_becomes_of_each_edit_is_said(guarded: Path, capsys: pytest.CaptureFixture[str]) -> None:
    edit(FILE, "self.count > 1", "self.count > 22")
    edit(FILE, "self.count = 1", "self.count = 5")
    assert vicode("sync", "lamps") == 1
    err = capsys.readouterr().err
    assert f"{FILE}:{line_of('<vicode Dark.enter')}: the edit of region 'Dark.enter' can be applied to {DESIGN}" in err
    assert f"{FILE}:{line_of('> 22')}: the design can express: guard of Dark → Lit: count > 22" in err
    assert "nothing was written; 'vicode sync --outside-regions' applies these edits" in err


def test_without_an_ancestor_each_difference_is_a_conflict(guarded: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Whether the file or the design was edited is not known: neither is overwritten without a choice."""
    shutil.rmtree("lamps/generated/.vicode")
    edit(DESIGN, "count > 1", "count > 33")
    before = (FILE.read_text(), DESIGN.read_text())
    assert vicode("sync", "lamps", "--outside-regions") == 1
    err = capsys.readouterr().err
    assert f"{FILE}:{line_of('> 1:')}:1: error G504 region-conflict: this code differs from the design" in err
    assert (FILE.read_text(), DESIGN.read_text()) == before
    assert vicode("sync", "lamps", "--take", "design") == 0
    assert "self.count > 33" in FILE.read_text()


def test_a_read_only_design_keeps_its_files(generated: Path) -> None:
    edit(FILE, "self.count = 1", "self.count = 2")
    before = FILE.read_text()
    DESIGN.chmod(0o444)
    assert vicode("sync", "lamps") == 2
    assert (FILE.read_text(), DESIGN.read_text()) == (before, LAMP)
    DESIGN.chmod(0o644)
    assert vicode("sync", "lamps") == 0
    assert "self.count = 2" in DESIGN.read_text()


def test_patches_are_kept_until_they_are_applied(generated: Path, capsys: pytest.CaptureFixture[str]) -> None:
    plain = FILE.read_text()
    patches = []
    for number in (1, 2, 1):
        FILE.write_text(FILE.read_text() + f"\n\nfor x in range({number}):\n    print(x)\n")
        assert vicode("sync", "lamps", "--outside-regions") == 1
        assert FILE.read_text() == plain
        patches = sorted(file.name for file in FILE.parent.glob("*.patch"))
    assert patches == ["lamp.py.2.patch", "lamp.py.patch"]
    capsys.readouterr()
    for command in (["check"], ["gen", "--check"], ["sync", "--check"]):
        assert vicode(*command, "lamps") == 1
        out = capsys.readouterr().out
        assert f"{FILE}.patch:1:1: error G506" in out
        assert f"{FILE}.2.patch:1:1: error G506" in out
    patch = FILE.with_name("lamp.py.2.patch").relative_to("lamps")
    subprocess.run(["git", "apply", str(patch)], cwd="lamps", check=True)
    assert "range(2)" in FILE.read_text()
    assert vicode("check", "lamps") == 1
    assert "2.patch" not in capsys.readouterr().out
    assert vicode("gen", "lamps", "--force") == 0
    assert vicode("sync", "lamps") == 0
    for name in patches:
        FILE.with_name(name).unlink()
    assert vicode("check", "lamps") == 0


def test_a_patch_of_a_project_beside_its_generated_files(generated: Path) -> None:
    edit(Path("lamps/project.yaml"), "languages", "generated: ../out\nlanguages")
    assert vicode("gen", "lamps") == 0
    file = Path("out/python/lamps/lamp.py")
    file.write_text(file.read_text() + "\n\nfor x in range(3):\n    print(x)\n")
    assert vicode("sync", "lamps", "--outside-regions") == 1
    subprocess.run(["git", "apply", f"{file}.patch"], check=True)
    assert "range(3)" in file.read_text()


def test_a_file_saved_again_from_an_old_buffer_is_no_conflict(generated: Path) -> None:
    """A text editor keeps the marks of the file that it has read."""
    edit(DESIGN, "self.count = 1", "self.count = 1\n      pass\n      self.more = 1")
    assert vicode("gen", "lamps") == 0
    start = DESIGN.read_text()
    buffer = FILE.read_text()
    for number in range(2, 6):
        old = f"self.count = {number - 1}"
        buffer = buffer.replace(old, f"self.count = {number}")
        FILE.write_text(buffer)
        assert vicode("sync", "lamps") == 0
        assert DESIGN.read_text() == start.replace("self.count = 1", f"self.count = {number}")
    edit(DESIGN, "self.more = 1", "self.more = 2")
    assert vicode("gen", "lamps") == 0
    FILE.write_text(buffer.replace("self.count = 5", "self.count = 7"))
    assert vicode("sync", "lamps") == 0
    assert "self.count = 7\n      pass\n      self.more = 2" in DESIGN.read_text()


def test_an_edit_that_was_taken_back_in_the_design_can_be_made_again(generated: Path) -> None:
    for _again in range(2):
        edit(FILE, "self.count = 1", "self.count = 2")
        assert vicode("sync", "lamps") == 0
        DESIGN.write_text(LAMP)
        assert vicode("gen", "lamps") == 0
    edit(DESIGN, "self.count = 1", "self.count = 3")
    edit(FILE, "self.count = 1", "self.count = 2")
    assert vicode("sync", "lamps") == 1
    assert "self.count = 2" in FILE.read_text()


@pytest.mark.parametrize("changed", [FILE, DESIGN])
def test_a_change_in_the_last_moment_is_kept(
    generated: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], changed: Path
) -> None:
    edit(FILE, "self.count = 1", "self.count = 2")
    before = {file: file.read_text() for file in (FILE, DESIGN)}

    def interfere(*arguments: object) -> None:
        original(*arguments)  # type: ignore[arg-type]
        changed.write_text(before[changed] + "# more\n")

    original = generation.require_unchanged
    with monkeypatch.context() as patch:
        patch.setattr("vicode.sync.generation.require_unchanged", interfere)
        assert vicode("sync", "lamps") == 2
    assert changed.read_text() == before[changed] + "# more\n"
    assert "self.count = 2" in FILE.read_text()
    if changed == FILE:
        edit(FILE, "# more\n", "")
        edit(FILE, "self.count = 2", "self.count = 3")
    assert vicode("sync", "lamps") == 0
    assert f"self.count = {3 if changed == FILE else 2}" in DESIGN.read_text()


def test_a_full_disk_leaves_design_and_files(generated: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    edit(FILE, "self.count = 1", "self.count = 2")
    before = {file: file.read_text() for file in (FILE, DESIGN)}

    def write(path: Path, content: str | bytes, *, is_durable: bool = True) -> None:
        if path.name == "journal.json":
            raise OSError(28, "No space left on device", str(path))
        original(path, content, is_durable=is_durable)

    original = transactions.write_atomically
    with monkeypatch.context() as patch:
        patch.setattr(transactions, "write_atomically", write)
        assert vicode("sync", "lamps") == 2
    assert {file: file.read_text() for file in (FILE, DESIGN)} == before
    assert vicode("sync", "lamps") == 0
    assert "self.count = 2" in DESIGN.read_text()
