"""The sessions of the manual print what the pages show."""

from pathlib import Path

import pytest

from tests.manual.code_blocks import PAGES, ROOT, code_blocks
from tests.manual.sessions import commands_of, play

SESSIONS = ("tutorial.md", "coming-from-xabsl.md", "coming-from-cpp.md")


@pytest.mark.parametrize("page", SESSIONS)
def test_the_session_prints_what_the_page_shows(
    page: str, tmp_path: Path, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, accept: bool
) -> None:
    monkeypatch.chdir(tmp_path)
    shown, played = play(page, capfd, monkeypatch)
    if accept:
        (ROOT / "docs" / page).write_text(played, encoding="utf-8")
        shown = played
    assert shown == played


def test_every_page_with_a_session_is_played() -> None:
    pages = {page.name for page in PAGES for block in code_blocks(page, "console") if [*commands_of(block)]}
    assert pages == set(SESSIONS)
