"""A running editor on a copy of the forward player's project."""

import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page

from tests.conftest import close_all_but, opened_beside, page_that_stays_open
from tests.editor.slow_connection import SlowConnection

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
def line(page: Page) -> SlowConnection:
    """What lies between the page and the editor."""
    return SlowConnection(page)


@pytest.fixture
def second_window(page: Page) -> Page:
    """A second window of the same person."""
    return opened_beside(page)


@pytest.fixture(scope="module")
def first_page_of_other(chromium: Browser) -> Iterator[Page]:
    with page_that_stays_open(chromium) as page:
        yield page


@pytest.fixture
def other(first_page_of_other: Page) -> Iterator[Page]:
    """The page of another person."""
    page = opened_beside(first_page_of_other)
    page.set_viewport_size({"width": 1366, "height": 768})
    yield page
    close_all_but(first_page_of_other)


@contextmanager
def started_editor(
    folder: Path,
    storage: Path,
    options: tuple[str, ...] = ("--no-tour",),
    *,
    is_trusted: bool = True,
    autosave_s: float = 3600,
    command: tuple[str, ...] = (),
) -> Iterator[str]:
    """An editor on a folder of projects, started by `vicode edit` or another command; its URL.

    The tour is left out, as it would stand in the way of other tests, and nothing is saved by itself: what is unsaved
    stays so until the test has looked at it.
    """
    environment = {
        **_environment(),
        "NICEGUI_STORAGE_PATH": str(storage),
        "VICODE_STATE": str(storage / "state"),
        "VICODE_AUTOSAVE_S": str(autosave_s),
    }
    (storage / "state").mkdir(parents=True, exist_ok=True)
    if is_trusted:
        (storage / "state" / "trusted").write_text(f"{folder.resolve()}\n")
    said = storage / "said.log"
    said.write_text("")
    arguments = [*(command or ("edit", str(folder))), "--no-open", "--port", _port(), *options]
    brood = _fork_server()
    assert brood.stdin is not None
    assert brood.stdout is not None
    brood.stdin.write(json.dumps({"arguments": arguments, "environment": environment, "log": str(said)}) + "\n")
    brood.stdin.flush()
    process = int(brood.stdout.readline())
    try:
        yield _url(process, said)
    finally:
        if _lives(process):
            os.kill(process, signal.SIGKILL)
        while _lives(process):
            time.sleep(0.01)
    log = said.read_text()
    assert "Traceback" not in log, "the editor told of an exception:\n" + log


def _port() -> str:
    """The same port for all editors of this test process that run one after another.

    The browser then finds the scripts of the editor in its cache. An editor beside another one chooses its port.
    """
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(("127.0.0.1", _first_port()))
        except OSError:
            return "0"
    return str(_first_port())


@cache
def _first_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


@cache
def _fork_server() -> "subprocess.Popen[str]":
    """What all editors of this test process split off from; it ends with it."""
    command = [sys.executable, "-m", "tests.editor.fork_server"]
    pipe = subprocess.PIPE
    return subprocess.Popen(command, stdin=pipe, stdout=pipe, text=True, env=_environment(), cwd=ROOT)


def _environment() -> dict[str, str]:
    """NiceGUI behaves differently when it thinks that a test runs it."""
    return {key: value for key, value in os.environ.items() if not key.startswith(("PYTEST", "NICEGUI"))}


def _lives(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    return True


def _url(process: int, said: Path) -> str:
    end_s = time.monotonic() + 60
    while time.monotonic() < end_s and _lives(process):
        found = re.search(r"http://\S+", said.read_text())
        if found:
            return found[0]
        time.sleep(0.02)
    pytest.fail("the editor did not start:\n" + said.read_text())
