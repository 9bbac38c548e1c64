"""The sites of all shipped designs, page by page from home: no link is dead, nothing complains, no texts overlap.

`VICODE_XABSL_BEHAVIORS` may name more behaviors, by their files with agents, separated by colons.
"""

import os
from pathlib import Path

import pytest
from playwright.sync_api import Page

from tests.docsite.browser_crawl import OVERLAPS, crawl_in_browser
from vicode.cli import main

ROOT = Path(__file__).parents[2]
SHIPPED = sorted(each for each in (ROOT / "designs").iterdir() if any(each.glob("*.yaml")))
BEHAVIOR = ROOT / "tests" / "xabsl" / "cases" / "programs" / "p1" / "agents.xabsl"
WRITTEN = [Path(path) for path in os.environ.get("VICODE_XABSL_BEHAVIORS", "").split(":") if path]


def site_of(path: Path, folder: Path) -> Path:
    assert main(["docs", str(path), "--out", str(folder)]) == 0
    return folder


@pytest.mark.parametrize(
    "path", [*SHIPPED, pytest.param(BEHAVIOR, marks=pytest.mark.nightly), *WRITTEN], ids=lambda path: path.stem
)
def test_all_pages_from_home(page: Page, tmp_path: Path, path: Path) -> None:
    site = site_of(path, tmp_path / "site")
    browsed = crawl_in_browser(page, site)
    assert not browsed.complaints
    assert browsed.pages == {file.name for file in site.glob("*.html")}
    assert not browsed.broken_links
    assert all(link.startswith(("file:", "https://")) for link in browsed.links)


def test_texts_that_overlap_are_found(page: Page, tmp_path: Path) -> None:
    site = site_of(ROOT / "designs" / "blink", tmp_path / "site")
    page.goto((site / "component-Blink.html").as_uri())
    assert page.evaluate(OVERLAPS) == []
    page.evaluate(
        """() => {
          const [one, other] = document.querySelectorAll("main svg[role] a.state text");
          one.setAttribute("x", other.getAttribute("x"));
          one.setAttribute("y", other.getAttribute("y"));
        }"""
    )
    assert page.evaluate(OVERLAPS)
