"""A running editor on a copy of the forward player's project."""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

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


@contextmanager
def started_editor(folder: Path, storage: Path, options: tuple[str, ...] = ("--no-tour",)) -> Iterator[str]:
    """An editor on a folder of projects; its URL. The tour is left out, as it would stand in the way of other tests."""
    # NiceGUI behaves differently when it thinks that a test runs it.
    environment = {key: value for key, value in os.environ.items() if not key.startswith(("PYTEST", "NICEGUI"))}
    environment["NICEGUI_STORAGE_PATH"] = str(storage)
    environment["VICODE_STATE"] = str(storage / "state")
    command = [sys.executable, "-m", "vicode", "edit", str(folder), "--no-open", "--port", "0", *options]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment, cwd=ROOT
    ) as process:
        try:
            yield _url(process)
        finally:
            process.kill()


def _url(process: "subprocess.Popen[str]") -> str:
    assert process.stdout is not None
    said: list[str] = []
    for line in process.stdout:
        said.append(line)
        found = re.search(r"http://[^\s]+", line)
        if found:
            return found.group(0)
    pytest.fail("the editor did not start:\n" + "".join(said))
