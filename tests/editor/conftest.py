"""A running editor on a copy of the forward player's project."""

import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from playwright.sync_api import Page

ROOT = Path(__file__).parents[2]


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A folder `designs/` with the project `forward` in it, free to be changed."""
    folder = tmp_path / "designs"
    shutil.copytree(ROOT / "designs" / "forward", folder / "forward", ignore=shutil.ignore_patterns("__pycache__"))
    return folder


@pytest.fixture
def editor(project: Path, tmp_path: Path) -> Iterator[str]:
    """The URL of an editor started as a user would start it."""
    with started_editor(project, tmp_path / "storage") as url:
        yield url


@pytest.fixture
def second_window(page: Page) -> Page:
    """A second window of the same person; a second tab would hide the first, and hidden pages hardly work."""
    with page.expect_popup() as opening:
        page.evaluate("void window.open('about:blank', '', 'popup')")
    return opening.value


@contextmanager
def started_editor(folder: Path, storage: Path, options: tuple[str, ...] = ("--no-tour",)) -> Iterator[str]:
    """An editor on a folder of projects; its URL. The tour is left out, as it would stand in the way of other tests."""
    # NiceGUI behaves differently when it thinks that a test runs it.
    environment = {key: value for key, value in os.environ.items() if not key.startswith(("PYTEST", "NICEGUI"))}
    environment["NICEGUI_STORAGE_PATH"] = str(storage)
    environment["VICODE_STATE"] = str(storage / "state")
    command = [sys.executable, "-m", "vicode", "edit", str(folder), "--no-open", "--port", "0", *options]
    storage.mkdir(parents=True, exist_ok=True)
    # Into a file: nobody reads on once the address is said, and a full pipe would stop the server.
    said = storage / "said.log"
    with said.open("w") as log:
        process = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT, env=environment, cwd=ROOT)
    try:
        yield _url(process, said)
    finally:
        process.kill()
        process.wait()


def _url(process: "subprocess.Popen[bytes]", said: Path) -> str:
    end_s = time.monotonic() + 60
    while time.monotonic() < end_s and process.poll() is None:
        found = re.search(r"http://\S+", said.read_text())
        if found:
            return found[0]
        time.sleep(0.02)
    pytest.fail("the editor did not start:\n" + said.read_text())
