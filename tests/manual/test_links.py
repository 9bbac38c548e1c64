"""Links between the documents lead to files and headings that exist, and the index lists every page once."""

import re
from pathlib import Path

import pytest

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


def _without_blocks(page: Path) -> str:
    return re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)


def _anchors(page: Path) -> set[str]:
    """The anchors of the headings, as GitHub makes them."""
    titles = _HEADING.findall(_without_blocks(page))
    return {re.sub(r"[^\w -]", "", re.sub(r"`", "", title).lower()).replace(" ", "-") for title in titles}
