"""A write is atomic: after a failure or crash, a file has its old or its new content."""

import errno
import os
import random
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from vicode.store import FileChangedError, read_design, replace_text, save_design, write_text
from vicode.store.durable_write import is_read_only

TOP = Path(__file__).parents[2]
SAVING = """\
import sys
from dataclasses import replace
from pathlib import Path
from vicode.store import read_design, save_design, write_text
path = Path(sys.argv[1])
number = 0
while True:
    text = path.read_bytes().decode()
    design = read_design(text).design
    number += 1
    write_text(path, save_design(replace(design, doc=f"{number} " + "word " * 2000), text))
    print(number, flush=True)
"""


def test_a_file_is_replaced(tmp_path: Path) -> None:
    path = tmp_path / "a.yaml"
    write_text(path, "one\r\n")
    assert path.read_bytes() == b"one\r\n"
    path.chmod(0o640)
    write_text(path, "\ufefftwö\n")
    assert path.read_bytes() == "\ufefftwö\n".encode()
    assert path.stat().st_mode & 0o777 == 0o640
    assert [each.name for each in tmp_path.iterdir()] == ["a.yaml"]


def test_a_link_stays_a_link(tmp_path: Path) -> None:
    (tmp_path / "real.yaml").write_text("old")
    link = tmp_path / "link.yaml"
    link.symlink_to("real.yaml")
    write_text(link, "new")
    assert link.is_symlink()
    assert (tmp_path / "real.yaml").read_text() == "new"


@pytest.mark.parametrize("old", ["old", None])
@pytest.mark.parametrize("is_renamed", [False, True])
def test_a_change_while_the_file_is_written_is_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, old: str | None, is_renamed: bool
) -> None:
    path, other = tmp_path / "a.yaml", tmp_path / "other"
    if old is not None:
        path.write_text(old)
    flush = os.fsync

    def change_and_flush(descriptor: int) -> None:
        (other if is_renamed else path).write_text("now")
        if is_renamed:
            other.replace(path)
        flush(descriptor)

    monkeypatch.setattr(os, "fsync", change_and_flush)
    with pytest.raises(FileChangedError):
        replace_text(path, old, "new")
    assert path.read_text() == "now"
    assert [each.name for each in tmp_path.iterdir()] == ["a.yaml"]


@pytest.mark.parametrize("has_links", [True, False])
def test_a_new_file_is_created(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, has_links: bool) -> None:
    def refuse(*_paths: object) -> None:
        raise PermissionError(errno.EPERM, "no hard links")

    if not has_links:
        monkeypatch.setattr(os, "link", refuse)
    replace_text(tmp_path / "a.yaml", None, "new")
    assert [(each.name, each.read_text()) for each in tmp_path.iterdir()] == [("a.yaml", "new")]
    with pytest.raises(FileChangedError):
        replace_text(tmp_path / "a.yaml", None, "newer")
    assert (tmp_path / "a.yaml").read_text() == "new"


def test_a_failed_write_names_the_file(monkeypatch: pytest.MonkeyPatch) -> None:
    with tempfile.TemporaryDirectory() as folder, monkeypatch.context() as changed:
        path = Path(folder, "a.yaml")
        path.write_text("old")
        path.chmod(0o644)
        Path(folder).chmod(0o755)
        if os.geteuid() == 0:
            # Root may write everywhere: be somebody else for a while.
            changed.setattr(os, "access", _as_nobody(os.access))
            changed.setattr(os, "supports_effective_ids", {os.access})
        else:
            path.chmod(0o444)
        assert is_read_only(path)
        with pytest.raises(PermissionError, match="the file is read-only"):
            write_text(path, "new")
        path.unlink()
        Path(folder).chmod(0o555)
        with pytest.raises(PermissionError, match="its folder is read-only"):
            write_text(path, "new")
        Path(folder).chmod(0o755)


def _as_nobody(ask: Callable[..., bool]) -> Callable[..., bool]:
    def asked(*given: Any, **named: Any) -> bool:
        os.seteuid(65534)
        try:
            return ask(*given, **named)
        finally:
            os.seteuid(0)

    return asked


def test_a_failure_keeps_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "a.yaml"
    path.write_text("old")

    def refuse(_descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", refuse)
    with pytest.raises(OSError, match="No space"):
        write_text(path, "new")
    assert path.read_text() == "old"
    assert [each.name for each in tmp_path.iterdir()] == ["a.yaml"]


def test_a_read_only_file_is_not_replaced(tmp_path: Path) -> None:
    path = tmp_path / "a.yaml"
    path.write_text("old")
    path.chmod(0o444)
    with pytest.raises(PermissionError, match="read-only"):
        write_text(path, "new")
    assert path.read_text() == "old"


def test_killed_while_saving(tmp_path: Path) -> None:
    _kill_while_saving(tmp_path, times=25)


@pytest.mark.nightly
def test_killed_while_saving_200_times(tmp_path: Path) -> None:
    _kill_while_saving(tmp_path, times=200)


def _kill_while_saving(folder: Path, times: int) -> None:
    path = folder / "player.yaml"
    path.write_text("# kept\nvicode: 1\ncomponent: Player\ndoc: 0\nstates:\n  A: {}  # also kept\n", encoding="utf-8")
    moments = random.Random(1)
    saved = 0
    for _kill in range(times):
        process = subprocess.Popen([sys.executable, "-c", SAVING, str(path)], cwd=TOP, stdout=subprocess.PIPE)
        assert process.stdout is not None
        assert process.stdout.readline() == b"1\n"
        time.sleep(moments.random() * 0.02)
        process.kill()
        saved += len(process.stdout.read().split()) + 1
        process.stdout.close()
        process.wait()
        text = path.read_text(encoding="utf-8")
        read = read_design(text)
        assert read.findings == ()
        assert read.design is not None
        assert save_design(read.design, text) == text
        assert "# kept\n" in text
        assert "# also kept\n" in text
    assert saved >= times
