"""The pictures of the documents show what can still be shown, and are small."""

import re
from pathlib import Path

import pytest
from playwright.sync_api import Page

from tests.manual.code_blocks import PAGES
from tests.manual.pictures import FOLDER, MAX_BYTES, PICTURES, shown, take


@pytest.mark.parametrize("name", PICTURES)
def test_the_picture_can_be_taken(name: str, page: Page, tmp_path: Path) -> None:
    with shown(name, page, tmp_path):
        take(page, tmp_path / name)
    assert (tmp_path / name).stat().st_size <= MAX_BYTES


def test_every_picture_is_small_and_shown() -> None:
    files = {path.name for path in FOLDER.iterdir()}
    shown_on_pages = re.findall(r"!\[[^\]]+\]\([\w./]*pictures/([\w-]+\.png)\)", "".join(map(Path.read_text, PAGES)))
    assert files == set(shown_on_pages)
    assert PICTURES.keys() <= files
    assert [path.name for path in FOLDER.iterdir() if path.stat().st_size > MAX_BYTES] == []
