"""Links between the documents lead somewhere, the index lists every page once, and every row belongs to a table."""

import re
from pathlib import Path

import pytest
from markdown_it import MarkdownIt

from tests.manual.code_blocks import ROOT

DOCS = ROOT / "docs"
PAGES = sorted({ROOT / "README.md", ROOT / "CONTRIBUTING.md", *DOCS.rglob("*.md")})
_LINK = re.compile(r"\]\((?!https?:)([^)#\s]*)(?:#([^)\s]*))?\)")
_HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page: Path) -> None:
    broken = []
    for path, anchor in _LINK.findall(re.sub(r"`[^`\n]*`", "code", _without_blocks(page))):
        target = (page.parent / path).resolve() if path else page
        if not target.exists() or (anchor and anchor not in _anchors(target)):
            broken.append(f"{path}#{anchor}")
    assert broken == []


def test_the_index_lists_every_page_once() -> None:
    links = [path for path, _ in _LINK.findall((DOCS / "index.md").read_text(encoding="utf-8"))]
    pages = [path.relative_to(DOCS).as_posix() for path in DOCS.rglob("*.md") if path.name != "index.md"]
    assert sorted(links) == sorted([*pages, "../CONTRIBUTING.md"])


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_row_belongs_to_a_table(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    shown: set[int] = set()
    for token in MarkdownIt().enable("table").parse(text):
        if token.type in ("table_open", "fence") and token.map:
            shown.update(range(*token.map))
    rows = [number for number, line in enumerate(text.split("\n")) if line.startswith("|")]
    assert [number + 1 for number in rows if number not in shown] == []


def _without_blocks(page: Path) -> str:
    return re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)


def _anchors(page: Path) -> set[str]:
    """The anchors of the headings, as GitHub makes them."""
    titles = _HEADING.findall(_without_blocks(page))
    return {re.sub(r"[^\w -]", "", re.sub(r"`", "", title).lower()).replace(" ", "-") for title in titles}
