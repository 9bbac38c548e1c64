"""The sites of all shipped designs, page by page from home: no link is dead, nothing complains, no texts overlap."""

from pathlib import Path
from urllib.parse import unquote, urldefrag

import pytest
from playwright.sync_api import Page

from vicode.cli import main

DESIGNS = Path(__file__).parents[2] / "designs"

# In a drawing's own pixels; rounded corners and italics may touch by less than this.
OVERLAPS = """() => {
  const apart = 1.5;
  const meet = (a, b) => a.x + apart < b.x + b.width && b.x + apart < a.x + a.width
    && a.y + apart < b.y + b.height && b.y + apart < a.y + a.height;
  const found = [];
  for (const svg of document.querySelectorAll("main svg[role]")) {
    const texts = [...svg.querySelectorAll("text")].map((node) => ({ node, box: node.getBBox() }));
    texts.forEach((one, at) => texts.slice(0, at).forEach((other) => {
      if (meet(one.box, other.box)) found.push(`${one.node.textContent} over ${other.node.textContent}`);
    }));
    for (const shape of svg.querySelectorAll(".state, .component, .common, .condition, .target, .stay")) {
      const box = shape.querySelector("path").getBBox();
      for (const text of texts) {
        if (!shape.contains(text.node) && meet(text.box, box)) found.push(`${text.node.textContent} over a box`);
      }
    }
  }
  return found;
}"""

LINKS = (
    "() => [...document.querySelectorAll('a[href]')].map((link) => new URL(link.getAttribute('href'), location).href)"
)


def site_of(name: str, folder: Path) -> Path:
    assert main(["docs", str(DESIGNS / name), "--out", str(folder)]) == 0
    return folder


@pytest.mark.parametrize("name", sorted(each.name for each in DESIGNS.iterdir() if any(each.glob("*.yaml"))))
def test_all_pages_from_home(page: Page, tmp_path: Path, name: str) -> None:
    site = site_of(name, tmp_path / "site")
    complaints: list[str] = []
    page.on("console", lambda message: complaints.append(f"{page.url}: {message.text}"))
    page.on("pageerror", lambda error: complaints.append(f"{page.url}: {error}"))
    page.on("requestfailed", lambda request: complaints.append(f"{page.url}: {request.url} failed"))
    home = (site / "index.html").as_uri()
    waiting, seen = [home], {home}
    links: set[str] = set()
    ids: dict[str, set[str]] = {}
    while waiting:
        address = waiting.pop()
        page.goto(address)
        ids[address] = set(page.evaluate("() => [...document.querySelectorAll('[id]')].map((each) => each.id)"))
        complaints += [f"{address}: {each}" for each in page.evaluate(OVERLAPS)]
        found = set(page.evaluate(LINKS))
        links |= found
        fresh = {urldefrag(link).url for link in found if link.startswith("file:")} - seen
        seen |= fresh
        waiting += sorted(fresh)
    assert not complaints
    assert {unquote(address.rpartition("/")[2]) for address in seen} == {file.name for file in site.glob("*.html")}
    dead = [
        link
        for link in links
        if link.startswith("file:")
        and "#" in link
        and unquote(urldefrag(link).fragment) not in ids[urldefrag(link).url]
    ]
    assert not dead
    assert all(link.startswith(("file:", "https://")) for link in links)


def test_texts_that_overlap_are_found(page: Page, tmp_path: Path) -> None:
    site = site_of("blink", tmp_path / "site")
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
