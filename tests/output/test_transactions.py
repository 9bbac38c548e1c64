"""Several files are replaced together, whatever interrupts it."""

import json
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from vicode import transactions
from vicode.transactions import complete_interrupted, replace_files


def read(folder: Path) -> dict[str, str]:
    files = (path for path in folder.rglob("*") if path.is_file() and ".vicode" not in path.parts)
    return {path.relative_to(folder).as_posix(): path.read_text() for path in files}


def test_files_are_written_and_deleted(tmp_path: Path) -> None:
    (tmp_path / "old.py").write_text("old")
    replace_files(tmp_path, {"a/new.py": "1", "old.py": None, "never.py": None})
    assert read(tmp_path) == {"a/new.py": "1"}
    replace_files(tmp_path, {"a/new.py": "2"})
    assert read(tmp_path) == {"a/new.py": "2"}
    assert sorted(path.name for path in (tmp_path / ".vicode").iterdir()) == [".gitignore", "lock"]


def test_a_file_keeps_its_mode_and_its_link(tmp_path: Path) -> None:
    target = tmp_path / "target.py"
    target.write_text("old")
    target.chmod(0o640)
    (tmp_path / "link.py").symlink_to(target)
    replace_files(tmp_path, {"link.py": "new"})
    assert (tmp_path / "link.py").is_symlink()
    assert (target.read_text(), target.stat().st_mode & 0o777) == ("new", 0o640)


def test_a_link_to_nothing_creates_no_file_elsewhere(tmp_path: Path) -> None:
    root = tmp_path / "root"
    root.mkdir()
    (root / "link.py").symlink_to(tmp_path / "new/file.py")
    with pytest.raises(OSError, match="a link out of it"):
        replace_files(root, {"a.py": "new", "link.py": "new"})
    assert read(root) == {}
    assert not (tmp_path / "new").exists()


def test_one_obstacle_keeps_all_files(tmp_path: Path) -> None:
    (tmp_path / "a.py").write_text("old")
    (tmp_path / "b").write_text("a file in the way")
    with pytest.raises(NotADirectoryError, match="found a file"):
        replace_files(tmp_path, {"a.py": "new", "b/c.py": "new"})
    assert read(tmp_path) == {"a.py": "old", "b": "a file in the way"}
    replace_files(tmp_path, {"a.py": "newer"})
    assert read(tmp_path)["a.py"] == "newer"


def test_what_was_only_prepared_is_dropped(tmp_path: Path) -> None:
    pending = tmp_path / ".vicode/pending"
    pending.mkdir(parents=True)
    (pending / "0").write_text("half a text")
    complete_interrupted(tmp_path)
    assert read(tmp_path) == {}
    assert not pending.exists()


@pytest.mark.parametrize("path", ["../outside.py", "/tmp/outside.py", "a/../../outside.py"])
def test_a_journal_cannot_write_elsewhere(tmp_path: Path, path: str) -> None:
    root = tmp_path / "root"
    pending = root / ".vicode/pending"
    pending.mkdir(parents=True)
    (pending / "0").write_text("evil")
    (pending / "journal.json").write_text(json.dumps({path: "0"}))
    with pytest.raises(PermissionError, match="outside"):
        complete_interrupted(root)
    assert not (tmp_path / "outside.py").exists()


def leave_journal(root: Path, journal: object) -> Path:
    pending = root / ".vicode/pending"
    pending.mkdir(parents=True)
    (pending / "0").write_text("evil")
    (pending / "journal.json").write_text(journal if isinstance(journal, str) else json.dumps(journal))
    return pending


@pytest.mark.parametrize("path", ["link/outside.py", "inner/.git/hooks/pre-commit", ".GIT/config"])
def test_a_journal_cannot_write_through_a_link_or_into_git(tmp_path: Path, path: str) -> None:
    root = tmp_path / "root"
    leave_journal(root, {path: "0"})
    (root / "link").symlink_to(tmp_path)
    with pytest.raises(PermissionError, match="delete that folder"):
        complete_interrupted(root)
    assert read(root) == {}
    assert not (tmp_path / "outside.py").exists()


@pytest.mark.parametrize(
    "journal", [{"a": "../../../secret"}, {"a": 1}, {"a\0b": "0"}, ["a"], "{", "[" * 100_000], ids=range(6)
)
def test_what_is_no_journal_is_refused(tmp_path: Path, journal: object) -> None:
    (tmp_path / "secret").write_text("secret")
    pending = leave_journal(tmp_path / "root", journal)
    with pytest.raises(OSError, match="no journal of vicode; delete"):
        complete_interrupted(tmp_path / "root")
    assert read(tmp_path) == {"secret": "secret"}
    assert pending.is_dir()


@pytest.mark.parametrize("link", [".vicode", ".vicode/pending"])
def test_the_state_folder_is_no_link(tmp_path: Path, link: str) -> None:
    root = tmp_path / "root"
    (root / link).parent.mkdir(parents=True)
    (root / link).symlink_to(tmp_path)
    (tmp_path / "pending").mkdir()
    with pytest.raises(OSError, match="symbolic link; delete it"):
        replace_files(root, {"a.py": "new"})
    assert read(root) == {}


@pytest.mark.parametrize("moves", range(4))
def test_a_replacement_interrupted_after_the_journal_is_completed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, moves: int
) -> None:
    replace_files(tmp_path, {"a.py": "old", "b.py": "old", "c.py": "old"})
    left = moves

    def move(source: Path | None, target: Path) -> None:
        nonlocal left
        if not left:
            raise KeyboardInterrupt
        left -= 1
        original(source, target)

    original = transactions._move
    monkeypatch.setattr(transactions, "_move", move)
    texts = {"a.py": "new", "b.py": None, "c.py": "new"}
    if moves < len(texts):
        with pytest.raises(KeyboardInterrupt):
            replace_files(tmp_path, texts)
    else:
        replace_files(tmp_path, texts)
    monkeypatch.undo()
    complete_interrupted(tmp_path)
    assert read(tmp_path) == {"a.py": "new", "c.py": "new"}


@pytest.mark.parametrize("changed", ["a.py", "b.py"])
def test_an_edit_after_a_crash_is_not_overwritten(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, changed: str
) -> None:
    replace_files(tmp_path, {"a.py": "old", "b.py": "old"})

    def stop(source: Path | None, target: Path) -> None:
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(transactions, "_move", stop)
        with pytest.raises(KeyboardInterrupt):
            replace_files(tmp_path, {"a.py": "new", "b.py": None})
    (tmp_path / changed).write_text("edited")
    complete_interrupted(tmp_path)
    assert read(tmp_path) == ({"a.py": "edited"} if changed == "a.py" else {"a.py": "new", "b.py": "edited"})
    assert not (tmp_path / ".vicode/pending").exists()


@pytest.mark.parametrize("changed", ["a.py", "b.py", "new.py"])
def test_a_file_that_changes_in_the_last_moment_keeps_its_content(tmp_path: Path, changed: str) -> None:
    replace_files(tmp_path, {"a.py": "old", "b.py": "old"})
    texts = {"a.py": "new", "b.py": None, "new.py": "new"}

    @contextmanager
    def interfere() -> Iterator[None]:
        (tmp_path / changed).write_text("edited")
        yield

    with pytest.raises(OSError, match="changed at the same time"):
        replace_files(tmp_path, texts, prepare=interfere)
    expected = {path: text for path, text in (texts | {changed: "edited"}).items() if text is not None}
    assert read(tmp_path) == expected


def test_what_was_prepared_is_undone_if_nothing_is_moved(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    replace_files(tmp_path, {"a.py": "old"})
    said: list[str] = []

    @contextmanager
    def prepare() -> Iterator[None]:
        try:
            yield
        except OSError:
            said.append("undone")
            raise

    def fail(path: Path, content: str | bytes, *, is_durable: bool = True) -> None:
        if path.name == "journal.json":
            raise OSError("full")
        original(path, content, is_durable=is_durable)

    original = transactions.write_atomically
    with monkeypatch.context() as patch:
        patch.setattr(transactions, "write_atomically", fail)
        with pytest.raises(OSError, match="full"):
            replace_files(tmp_path, {"a.py": "new"}, prepare=prepare)
    assert (said, read(tmp_path)) == (["undone"], {"a.py": "old"})


WRITER = """
import sys
from pathlib import Path
from vicode.transactions import replace_files
root = Path(sys.argv[1])
print("ready", flush=True)
number = 0
while True:
    number += 1
    replace_files(root, {f"{name}.py": f"{number}" * 500 for name in "abcdefgh"})
"""


@pytest.mark.nightly
def test_files_belong_together_after_kill_9(tmp_path: Path) -> None:
    for attempt in range(200):
        writer = subprocess.Popen(
            [sys.executable, "-c", WRITER, str(tmp_path)], stdout=subprocess.PIPE, cwd=Path.cwd(), text=True
        )
        assert writer.stdout is not None
        writer.stdout.readline()
        time.sleep(0.002 * (attempt % 50))
        writer.send_signal(signal.SIGKILL)
        writer.wait()
        writer.stdout.close()
        complete_interrupted(tmp_path)
        assert len(set(read(tmp_path).values())) <= 1
        assert not (tmp_path / ".vicode/pending").exists()
