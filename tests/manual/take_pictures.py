"""Takes the pictures of the documents: `make pictures`."""

import sys
import tempfile
from pathlib import Path

from playwright.sync_api import sync_playwright

from tests.conftest import CHROMIUM_ARGUMENTS, find_chromium
from tests.manual.pictures import FOLDER, PICTURES, shown, take


def main() -> None:
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=find_chromium(playwright), args=CHROMIUM_ARGUMENTS)
        for name in sys.argv[1:] or PICTURES:
            page = browser.new_page()
            with tempfile.TemporaryDirectory() as folder, shown(name, page, Path(folder)):
                # Messages of the canvas disappear by themselves.
                page.wait_for_timeout(4000 if name == "editor.png" else 500)
                take(page, FOLDER / name)
            page.close()
        browser.close()


if __name__ == "__main__":
    main()
