"""The process of `vicode edit`: leftovers of a killed one, the end of its terminal, and malformed messages."""

import asyncio
import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
import websockets

ROOT = Path(__file__).parents[2]
FRAMES = ("x", "42[not json", '42["event"]', '42["handshake",{}]', '42["javascript_response",3]', "4" + "9" * 200)

# Tests that were started by nohup inherit that the signal is ignored.
HEED_SIGHUP = (
    "import os, signal, sys; signal.signal(signal.SIGHUP, signal.SIG_DFL); os.execv(sys.argv[1], sys.argv[1:])"
)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    folder = tmp_path / "forward"
    shutil.copytree(ROOT / "designs" / "forward", folder)
    left = folder / ".player.yaml.0123abcd.tmp"
    left.write_text("half")
    os.utime(left, (0, 0))
    (folder / ".notes.tmp").write_text("of the user")
    return folder


@pytest.fixture
def editor(folder: Path, tmp_path: Path) -> Iterator[subprocess.Popen[str]]:
    kept = {key: value for key, value in os.environ.items() if not key.startswith(("PYTEST", "NICEGUI"))}
    state = {"VICODE_STATE": str(tmp_path / "state"), "NICEGUI_STORAGE_PATH": str(tmp_path / "storage")}
    state["PYTHONFAULTHANDLER"] = "1"
    command = [sys.executable, "-c", HEED_SIGHUP, sys.executable, "-m", "vicode", "edit", str(folder), "--no-open"]
    pipe = subprocess.PIPE
    process = subprocess.Popen(command, stdout=pipe, stderr=pipe, text=True, env={**kept, **state}, cwd=tmp_path)
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


def test_an_editor_cleans_up_reports_malformed_messages_in_lines_and_ends_on_hangup(
    editor: subprocess.Popen[str], folder: Path, tmp_path: Path
) -> None:
    assert editor.stdout is not None
    found = re.search(r"http://127.0.0.1:(\d+)", editor.stdout.readline())
    assert found is not None
    assert sorted(file.name for file in folder.iterdir() if file.suffix == ".tmp") == [".notes.tmp"]
    for frame in FRAMES:
        asyncio.run(_send(int(found[1]), frame))
    assert list((tmp_path / "state" / "unsaved").glob("*/lock"))
    editor.send_signal(signal.SIGHUP)
    errors = _wait_for_end(editor)
    assert len(errors.splitlines()) == len(FRAMES), errors
    assert errors.count("Malformed message from a browser") == len(FRAMES)
    # The journals were closed: the end was orderly.
    assert not list((tmp_path / "state" / "unsaved").glob("*/lock"))


def _wait_for_end(editor: subprocess.Popen[str]) -> str:
    """What the editor wrote to standard error; if it does not end, with the stacks of its threads."""
    try:
        return editor.communicate(timeout=60)[1]
    except subprocess.TimeoutExpired:
        editor.send_signal(signal.SIGABRT)
        return editor.communicate(timeout=60)[1]


async def _send(port: int, frame: str) -> None:
    address = f"127.0.0.1:{port}"
    url = f"ws://{address}/_nicegui_ws/socket.io/?EIO=4&transport=websocket"
    async with websockets.connect(url, origin=f"http://{address}") as socket:
        await socket.recv()
        await socket.send("40")
        await socket.recv()
        await socket.send(frame)
