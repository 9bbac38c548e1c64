"""Takes the pictures of the documentation from the editor with the sample projects: `make pictures`."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from playwright.sync_api import Page, sync_playwright

from tests.conftest import CHROMIUM_ARGUMENTS, find_chromium
from tests.editor.player_page import open_player, select_state

ROOT = Path(__file__).parents[2]
PICTURES = ROOT / "docs/pictures"


def main() -> None:
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        designs = shutil.copytree(ROOT / "designs", Path(folder, "designs"))
        command = [sys.executable, "-m", "vicode", "edit", str(designs), "--no-open", "--no-tour"]
        # The state folder remembers answers of the user, which the pictures must not show.
        environment = {**os.environ, "XDG_STATE_HOME": folder}
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=ROOT, env=environment) as editor:
            try:
                browser = playwright.chromium.launch(executable_path=find_chromium(playwright), args=CHROMIUM_ARGUMENTS)
                take_editor(browser.new_page(), _address(editor))
                browser.close()
            finally:
                editor.terminate()


def take_editor(page: Page, url: str) -> None:
    open_player(page, url)
    select_state(page, "WatchBall")
    page.mouse.move(0, 0)
    # Messages of the canvas disappear by themselves.
    page.wait_for_timeout(4000)
    page.screenshot(path=PICTURES / "editor.png")


def _address(editor: "subprocess.Popen[str]") -> str:
    assert editor.stdout is not None
    for line in editor.stdout:
        if match := re.search(r" at (http://\S+/) ", line):
            return match.group(1)
    raise RuntimeError("the editor did not start")


if __name__ == "__main__":
    main()
