"""`vicode docs --watch` where files and folders come and go: it says what is wrong, goes on, and ends when told to."""

import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from vicode.services.file_changes import iter_changes

ROOT = Path(__file__).parents[2]


@dataclass
class WatchProcess:
    """`vicode docs --watch` in a separate process; `lines` is its output."""

    project: Path
    out: Path
    process: "subprocess.Popen[str] | None" = None
    lines: list[str] = field(default_factory=list)

    def start(self) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-m", "vicode", "docs", str(self.project), "--out", str(self.out), "--watch", "--no-open"],
            cwd=ROOT,
            env={**os.environ, "VICODE_CACHE": str(self.project.parent / "cache")},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        # After the initial check for changes, it reacts to every change.
        self.wait_for("press Ctrl-C to stop")
        self.wait_for("0 changed")

    def wait_for(self, text: str) -> None:
        """Read what it says until it says this."""
        assert self.process is not None
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self.lines.append(line)
            if text in line:
                return
        pytest.fail(f"ended without saying {text!r}: {''.join(self.lines)}")

    def edit(self, old: str, new: str) -> None:
        file = self.project / "blink.yaml"
        file.write_text(file.read_text("utf-8").replace(old, new), "utf-8")

    def page(self) -> str:
        return (self.out / "component-Blink.html").read_text("utf-8")


@pytest.fixture
def watching(tmp_path: Path) -> Iterator[WatchProcess]:
    shutil.copytree(ROOT / "designs" / "blink", tmp_path / "Blink")
    watched = WatchProcess(project=tmp_path / "Blink", out=tmp_path / "site")
    yield watched
    if watched.process is not None:
        assert watched.process.stdout is not None
        watched.process.kill()
        watched.process.stdout.close()
        watched.process.wait()


def test_a_site_in_the_folder_of_its_designs_follows_them(watching: WatchProcess) -> None:
    watching.out = watching.project / "site"
    watching.start()
    watching.edit("Bright", "Lit")
    watching.wait_for("no findings")
    assert "state-Lit" in watching.page()


def test_a_folder_that_is_put_in_the_place_of_another_is_followed(watching: WatchProcess) -> None:
    watching.start()
    shutil.rmtree(watching.project)
    watching.wait_for("No such file or directory")
    shutil.copytree(ROOT / "designs" / "blink", watching.project)
    watching.wait_for("0 changed")
    watching.edit("Bright", "Lit")
    watching.wait_for("no findings")
    while "0 changed" in watching.lines[-1]:
        watching.wait_for("no findings")
    assert "state-Lit" in watching.page()


def test_a_folder_in_the_place_of_another_is_known_though_it_could_have_its_number(tmp_path: Path) -> None:
    folder = tmp_path / "Blink"
    folder.mkdir()
    changes = iter_changes([folder])
    next(changes)
    folder.rmdir()
    folder.mkdir()
    assert next(changes, "over") == "over"


def test_what_cannot_be_written_is_said_and_it_goes_on(watching: WatchProcess) -> None:
    watching.start()
    page = watching.out / "component-Blink.html"
    page.unlink()
    (page / "mine").mkdir(parents=True)
    watching.edit("Bright", "Lit")
    watching.wait_for("component-Blink.html: Is a directory")
    shutil.rmtree(page)
    (watching.out / "index.html").write_text("mine", "utf-8")
    watching.edit("Lit", "Bright")
    watching.wait_for("index.html was not written by vicode docs; choose another --out")
    (watching.out / "index.html").unlink()
    watching.edit("Bright", "Shining")
    watching.wait_for("no findings")
    assert "state-Shining" in watching.page()


def test_ctrl_c_ends_it_without_a_word(watching: WatchProcess) -> None:
    watching.start()
    assert watching.process is not None
    watching.process.send_signal(signal.SIGINT)
    assert watching.process.communicate(timeout=60)[0] == ""
    assert watching.process.returncode == 0
