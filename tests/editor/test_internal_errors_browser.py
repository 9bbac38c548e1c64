"""A fault of vicode's own is told to the person who met it, and the page goes on."""

import os
import re
import subprocess
import sys
import time
from pathlib import Path

from playwright.sync_api import Page, expect

from tests.editor.player_page import open_player

FAILING = """\
import sys
from vicode.cli import main
from vicode.editor.session import Workspace

def fail(*_arguments):
    raise ZeroDivisionError("a fault")

Workspace.prepare_output = fail
main(sys.argv[1:])
"""


def test_a_fault_is_told_and_the_page_goes_on(page: Page, project: Path, tmp_path: Path) -> None:
    said = tmp_path / "said.log"
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("PYTEST", "NICEGUI"))}
    environment = {**kept, "NICEGUI_STORAGE_PATH": str(tmp_path), "VICODE_STATE": str(tmp_path / "state")}
    command = [sys.executable, "-c", FAILING, "edit", str(project), "--no-open", "--port", "0", "--no-tour"]
    with said.open("w") as log, subprocess.Popen(command, stdout=log, stderr=log, env=environment) as server:
        try:
            while not (found := re.search(r"http://\S+", said.read_text())):
                assert server.poll() is None
                time.sleep(0.05)
            open_player(page, found[0])
            page.get_by_role("button", name="Generate", exact=True).click()
            expect(page.get_by_text("Internal error")).to_be_visible()
            page.get_by_role("tab", name="History").click()
            expect(page.get_by_role("tab", name="History", selected=True)).to_be_visible()
        finally:
            server.kill()
    assert "ZeroDivisionError: a fault" in said.read_text()
