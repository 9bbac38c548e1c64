"""The examples of docs/internals are run: what the pages print is what the code prints."""

import re
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

import pytest

from tests.manual.code_blocks import ROOT, code_blocks

PAGES = sorted((ROOT / "docs/internals").glob("*.md"))
_PATH = re.compile(r"`((?:vicode|tests|templates|docs|designs)/[\w/.-]*)`")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_examples_print_what_the_page_shows(
    page: Path, accept: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    text = page.read_text(encoding="utf-8")
    names: dict[str, Any] = {}
    played = text
    for block in code_blocks(page, "pycon"):
        played = played.replace(block.text, _play(block.text, names, str(block)), 1)
    if accept:
        page.write_text(played, encoding="utf-8")
        text = played
    assert text == played


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_files_of_the_page_exist(page: Path) -> None:
    paths = set(_PATH.findall(page.read_text(encoding="utf-8")))
    assert paths
    assert [path for path in paths if not (ROOT / path).exists()] == []


def _play(text: str, names: dict[str, Any], where: str) -> str:
    """Run the statements of a session; return it with what they print."""
    played = []
    for match in re.finditer(r"^>>> .*\n(?:\.\.\.(?: .*)?\n)*", text, re.MULTILINE):
        source = re.sub(r"^(?:>>>|\.\.\.) ?", "", match[0], flags=re.MULTILINE)
        printed = StringIO()
        with redirect_stdout(printed):
            exec(compile(source, where, "single"), names)
        played.append(match[0] + printed.getvalue())
    return "".join(played)
