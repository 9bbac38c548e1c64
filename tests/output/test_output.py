"""Files against a folder: new, changed, unchanged, stale; written whole or not at all."""

import errno
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from vicode import output
from vicode.output import (
    FileStatus,
    OutputFile,
    apply_diffs,
    compare_files,
    remove_leftovers,
    temporary_folder,
    write_atomically,
)
from vicode.transactions import replace_files

PROJECT = Path(__file__).parents[2]
HEADER = "# Ours.\n"


def compare(files: list[OutputFile], folder: Path, **arguments: list[str]) -> tuple[output.FileDiff, ...]:
    return output.compare_files(files, folder, is_generated=lambda text: text.startswith(HEADER), **arguments)


def statuses(files: list[OutputFile], folder: Path, **arguments: list[str]) -> dict[str, FileStatus]:
    return {each.path: each.status for each in compare(files, folder, **arguments)}


def write(folder: Path, path: str, text: str) -> Path:
    file = folder / path
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")
    return file


def test_every_status_is_told(tmp_path: Path) -> None:
    write(tmp_path, "p/same.py", HEADER)
    write(tmp_path, "p/other.py", HEADER + "old\n")
    write(tmp_path, "p/gone.py", HEADER)
    files = [OutputFile(path=f"p/{name}.py", text=HEADER) for name in ("same", "other", "fresh")]
    assert statuses(files, tmp_path) == {
        "p/fresh.py": FileStatus.NEW,
        "p/gone.py": FileStatus.STALE,
        "p/other.py": FileStatus.CHANGED,
        "p/same.py": FileStatus.UNCHANGED,
    }


def test_only_generated_sources_beside_ours_are_stale(tmp_path: Path) -> None:
    write(tmp_path, "p/mine.py", "# written by hand\n")
    write(tmp_path, "p/notes.txt", HEADER)
    write(tmp_path, "q/other.py", HEADER)
    write(tmp_path, "p/kept.py", HEADER)
    files = [OutputFile(path="p/new.py", text=HEADER)]
    assert statuses(files, tmp_path, kept_paths=["p/kept.py"]) == {"p/new.py": FileStatus.NEW}


def test_applying_makes_the_folder_agree(tmp_path: Path) -> None:
    write(tmp_path, "python/p/gone.py", HEADER)
    write(tmp_path, "python/p/a.py", HEADER + "old\n")
    files = [OutputFile(path="python/p/a.py", text=HEADER), OutputFile(path="python/p/sub/b.py", text=HEADER + "é\n")]
    touched = output.apply_diffs(compare(files, tmp_path), tmp_path)
    assert [path.name for path in touched] == ["a.py", "gone.py", "b.py"]
    assert set(statuses(files, tmp_path).values()) == {FileStatus.UNCHANGED}
    assert sorted(path.name for path in tmp_path.rglob("*.*")) == ["a.py", "b.py"]


def test_carriage_returns_of_a_checkout_are_no_change(tmp_path: Path) -> None:
    (tmp_path / "a.py").write_bytes(HEADER.replace("\n", "\r\n").encode())
    assert statuses([OutputFile(path="a.py", text=HEADER)], tmp_path) == {"a.py": FileStatus.UNCHANGED}


def test_the_difference_reads_as_a_diff(tmp_path: Path) -> None:
    write(tmp_path, "a.py", "one\ntwo\n")
    (changed,) = output.compare_files([OutputFile(path="a.py", text="one\nthree\n")], tmp_path)
    assert output.format_diff(changed).splitlines() == [
        "--- a/a.py",
        "+++ b/a.py",
        "@@ -1,2 +1,2 @@",
        " one",
        "-two",
        "+three",
    ]


def test_a_failed_write_leaves_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = write(tmp_path, "a.py", "old")

    def fail(_descriptor: int) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", fail)
    with pytest.raises(OSError, match="No space left on device") as told:
        output.write_atomically(file, "new")
    assert told.value.filename == str(file)
    assert file.read_text() == "old"
    assert list(tmp_path.iterdir()) == [file]


def test_a_write_keeps_permissions_and_follows_links(tmp_path: Path) -> None:
    file = write(tmp_path, "a.py", "old")
    file.chmod(0o640)
    link = tmp_path / "link.py"
    link.symlink_to(file)
    output.write_atomically(link, "new")
    assert link.is_symlink()
    assert (file.read_text(), file.stat().st_mode & 0o777) == ("new", 0o640)


def test_a_pipe_in_the_output_folder_is_reported_not_opened(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "a.py")
    with pytest.raises(OSError, match="not a regular file"):
        output.compare_files([OutputFile(path="a.py", text="x")], tmp_path)


def test_leftovers_are_removed_but_not_files_being_written(tmp_path: Path) -> None:
    left, others = tmp_path / ".a.py.01234567.tmp", (tmp_path / ".c.tmp", tmp_path / "d.01234567.tmp")
    for file in (left, *others):
        file.write_text("half")
        os.utime(file, (0, 0))
    written = tmp_path / ".b.py.89abcdef.tmp"
    written.write_text("half")
    remove_leftovers(tmp_path)
    assert sorted(tmp_path.iterdir()) == sorted((written, *others))


def run_and_kill(code: str) -> None:
    """Run code that prints when it is ready, then kill it."""
    child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, cwd=PROJECT)
    assert child.stdout is not None
    assert child.stdout.readline()
    child.kill()
    child.communicate()


def test_the_next_write_removes_what_a_killed_one_left(tmp_path: Path) -> None:
    run_and_kill(
        "import os, time; from pathlib import Path; from vicode import output\n"
        "os.fsync = lambda _file: (print('ready', flush=True), time.sleep(60))\n"
        f"output.write_atomically(Path({str(tmp_path)!r}) / 'a.py', 'half')"
    )
    (left,) = tmp_path.iterdir()
    os.utime(left, (0, 0))
    write_atomically(tmp_path / "b.py", "whole")
    assert [file.name for file in tmp_path.iterdir()] == ["b.py"]


def test_the_next_temporary_folder_removes_one_of_a_killed_program(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    run_and_kill(
        "import time; from vicode.output import temporary_folder\n"
        "with temporary_folder('run') as folder:\n"
        "    (folder / 'a.py').write_text('')\n"
        "    print('ready', flush=True); time.sleep(60)"
    )
    (abandoned,) = tmp_path.iterdir()
    (tmp_path / "vicode-run-of-a-user").mkdir()
    with temporary_folder("run") as held:
        # One that was just made may not be locked yet.
        assert abandoned.exists()
        for folder in tmp_path.iterdir():
            os.utime(folder, (0, 0))
        with temporary_folder("run"):
            assert held.exists()
            assert not abandoned.exists()
    assert [folder.name for folder in tmp_path.iterdir()] == ["vicode-run-of-a-user"]


def make_link_out(tmp_path: Path) -> tuple[Path, Path]:
    """A folder with links to a file, a folder, and nothing, all outside."""
    root, outside = tmp_path / "root", tmp_path / "outside"
    root.mkdir()
    outside.mkdir()
    write(outside, "file.py", "old")
    for name, target in {"file.py": "file.py", "folder": "", "lost.py": "lost.py", "lost": "lost"}.items():
        (root / name).symlink_to(outside / target)
    return root, outside


@pytest.mark.parametrize("path", ["file.py", "folder/new.py", "lost.py", "lost/new.py", "../outside/new.py"])
def test_links_do_not_lead_files_out_of_a_folder(tmp_path: Path, path: str) -> None:
    root, outside = make_link_out(tmp_path)
    with pytest.raises(OSError, match="link"):
        apply_diffs(compare_files([OutputFile(path=path, text="new")], root), root)
    with pytest.raises(OSError, match="link"):
        replace_files(root, {path: "new", "other.py": "new"})
    assert [(file.name, file.read_text()) for file in outside.iterdir()] == [("file.py", "old")]
    assert not (root / "other.py").exists()


def test_a_link_to_nothing_is_not_written_through(tmp_path: Path) -> None:
    root, outside = make_link_out(tmp_path)
    with pytest.raises(OSError, match="does not exist; delete it"):
        write_atomically(root / "lost.py", "new")
    back_up = write(root, "a.py", "edited")
    (root / "a.py.edited").symlink_to(outside / "copy")
    assert output.back_up_edited(back_up).name == "a.py.edited2"
    assert [file.name for file in outside.iterdir()] == ["file.py"]
