"""Reads a site as a browser would: which addresses it holds, where they lead, what could run."""

from collections import Counter
from dataclasses import dataclass, field
from functools import cache
from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit

from vicode.output import OutputFile

_RUNNING = ("javascript:", "data:", "vbscript:")


@dataclass
class ReadPage:
    """What one page holds."""

    ids: Counter[str] = field(default_factory=Counter)
    links: list[str] = field(default_factory=list)
    loaded: list[str] = field(default_factory=list)
    tags: Counter[str] = field(default_factory=Counter)
    handlers: list[str] = field(default_factory=list)
    styles: int = 0
    text: str = ""


class _Reader(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.page = ReadPage()
        self.texts: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = {name: value or "" for name, value in attrs}
        self.page.tags[tag] += 1
        self.page.handlers += [name for name in values if name.startswith("on")]
        self.page.styles += "style" in values or tag == "style"
        if "id" in values:
            self.page.ids[values["id"]] += 1
        if tag == "a":
            self.page.links.append(values.get("href", ""))
        elif "href" in values:
            self.page.loaded.append(values["href"])
        if "src" in values:
            self.page.loaded.append(values["src"])

    def handle_data(self, data: str) -> None:
        self.texts.append(data)


@cache
def read_page(text: str) -> ReadPage:
    """What a page holds."""
    reader = _Reader()
    reader.feed(text)
    reader.close()
    reader.page.text = "".join(reader.texts)
    return reader.page


def read_pages(files: tuple[OutputFile, ...]) -> dict[str, ReadPage]:
    """All pages of a site by path."""
    return {file.path: read_page(file.text) for file in files if file.path.endswith(".html")}


def find_broken_links(files: tuple[OutputFile, ...]) -> list[str]:
    """Return all broken links and all links to files outside the folder."""
    pages = read_pages(files)
    paths = {file.path for file in files}
    broken = []
    for path, page in pages.items():
        for address in page.links + page.loaded:
            parts = urlsplit(address)
            target = unquote(parts.path) or path
            anchor = unquote(parts.fragment)
            is_lost = target not in paths or (anchor and anchor not in pages[target].ids)
            if parts.scheme or parts.netloc or is_lost or not address:
                broken.append(f"{path}: {address!r}")
    return broken


def find_unsafe_content(files: tuple[OutputFile, ...]) -> list[str]:
    """Whatever could run or load something, but for the two scripts of every page."""
    found = []
    for path, page in read_pages(files).items():
        found += [f"{path}: {name}" for name in page.handlers]
        found += [f"{path}: {address}" for address in page.links if address.strip().lower().startswith(_RUNNING)]
        unknown = set(page.loaded) - {"site.css", "site.js", "menu.js"}
        found += [f"{path}: loads {address}" for address in unknown]
        strange = {"img", "iframe", "object", "embed", "form", "base", "foreignobject"} & set(page.tags)
        found += [f"{path}: <{tag}>" for tag in strange]
        if page.tags["script"] != 2 or page.styles:
            found.append(f"{path}: {page.tags['script']} scripts, {page.styles} styles")
    return found
