"""`vicode edit --host`: an editor that others can reach asks for its token, and gives memory back when they leave."""

import os
import re
import subprocess
import sys
import urllib.error
import urllib.request
from collections.abc import Iterator
from http.cookiejar import CookieJar
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture
def served(tmp_path: Path) -> Iterator[tuple[str, int]]:
    """The address that such an editor prints, and its process."""
    kept = {
        key: value for key, value in os.environ.items() if not key.startswith(("PYTEST", "NICEGUI", "PYTHONMALLOC"))
    }
    state = {"VICODE_STATE": str(tmp_path / "state"), "NICEGUI_STORAGE_PATH": str(tmp_path / "storage")}
    command = [sys.executable, "-m", "vicode", "edit", "designs/forward", "--host", "0.0.0.0", "--no-open"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env={**kept, **state}, cwd=ROOT)
    try:
        assert process.stdout is not None
        url = next(found[0] for line in process.stdout if (found := re.search(r"http://\S+token=\S+", line)))
        yield url, process.pid
    finally:
        process.kill()
        process.communicate()


def test_it_prints_the_address_that_opens_it_and_runs_with_the_allocator_of_the_system(served: tuple[str, int]) -> None:
    url, process = served
    browser = urllib.request.build_opener(urllib.request.HTTPCookieProcessor(CookieJar()))
    with browser.open(url) as answer:
        assert answer.status == 200
        assert "token" not in answer.url
    with browser.open(url.partition("?")[0]) as answer:
        assert answer.status == 200
    with pytest.raises(urllib.error.HTTPError, match="403"):
        urllib.request.urlopen(url.partition("?")[0])
    if sys.platform == "linux":
        assert b"PYTHONMALLOC=malloc" in Path(f"/proc/{process}/environ").read_bytes().split(b"\0")
