"""Opens a whole site in a browser, page by page from home, and tells everything that is wrong with it."""

from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import unquote, urldefrag

from playwright.sync_api import Page

# In a drawing's own pixels; rounded corners and italics may touch by less than this.
OVERLAPS = """() => {
  const apart = 1.5;
  const meet = (a, b) => a.x + apart < b.x + b.width && b.x + apart < a.x + a.width
    && a.y + apart < b.y + b.height && b.y + apart < a.y + a.height;
  const holds = (a, b) => a.x <= b.x + apart && b.x + b.width <= a.x + a.width + apart
    && a.y <= b.y + apart && b.y + b.height <= a.y + a.height + apart;
  const found = [];
  for (const svg of document.querySelectorAll("main svg[role]")) {
    const texts = [...svg.querySelectorAll("text")].map((node) => ({ node, box: node.getBBox() }));
    texts.forEach((one, at) => texts.slice(0, at).forEach((other) => {
      if (meet(one.box, other.box)) found.push(`${one.node.textContent} over ${other.node.textContent}`);
    }));
    for (const text of texts) {
      if (!holds(svg.viewBox.baseVal, text.box)) found.push(`${text.node.textContent} beyond the edge`);
    }
    for (const shape of svg.querySelectorAll(".state, .component, .common, .condition, .target, .stay")) {
      const box = shape.querySelector("path").getBBox();
      for (const text of texts) {
        if (shape.contains(text.node) && !holds(box, text.box)) found.push(`${text.node.textContent} out of its box`);
        if (!shape.contains(text.node) && meet(text.box, box)) found.push(`${text.node.textContent} over a box`);
      }
    }
  }
  return found;
}"""

_LINKS = (
    "() => [...document.querySelectorAll('a[href]')].map((link) => new URL(link.getAttribute('href'), location).href)"
)
_IDS = "() => [...document.querySelectorAll('[id]')].map((each) => each.id)"
_TOO_WIDE = "() => document.documentElement.scrollWidth - document.documentElement.clientWidth"


@dataclass
class BrowserCrawl:
    """What a site holds: `complaints` are those of the browser and ours, `pages` the files that links lead to."""

    complaints: list[str] = field(default_factory=list)
    pages: set[str] = field(default_factory=set)
    links: set[str] = field(default_factory=set)
    ids: dict[str, set[str]] = field(default_factory=dict)

    @property
    def broken_links(self) -> list[str]:
        """Links to places that are on no page."""
        inner = [link for link in self.links if link.startswith("file:") and "#" in link]
        return sorted(link for link in inner if unquote(urldefrag(link).fragment) not in self.ids[urldefrag(link).url])


def crawl_in_browser(page: Page, site: Path) -> BrowserCrawl:
    """Open the home of a site and everything that can be reached from it."""
    browsed = BrowserCrawl()
    complaints = browsed.complaints
    page.on("console", lambda message: complaints.append(f"{page.url}: {message.text}"))
    page.on("pageerror", lambda error: complaints.append(f"{page.url}: {error}"))
    page.on("requestfailed", lambda request: complaints.append(f"{page.url}: {request.url} failed"))
    home = (site / "index.html").as_uri()
    waiting, seen = [home], {home}
    while waiting:
        address = waiting.pop()
        page.goto(address)
        browsed.pages.add(unquote(address.rpartition("/")[2]))
        browsed.ids[address] = set(page.evaluate(_IDS))
        complaints += [f"{address}: {each}" for each in page.evaluate(OVERLAPS)]
        if page.evaluate(_TOO_WIDE) > 0:
            complaints.append(f"{address}: wider than the window")
        found = set(page.evaluate(_LINKS))
        browsed.links |= found
        fresh = {urldefrag(link).url for link in found if link.startswith("file:")} - seen
        seen |= fresh
        waiting += sorted(fresh)
    return browsed
