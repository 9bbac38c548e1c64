"""The same pages as Markdown, with pictures beside them: for mkdocs, for Sphinx (MyST), and to be read as it is."""

import json
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from vicode.diagram.palettes import LIGHT
from vicode.docsite import markdown_text
from vicode.docsite.markdown_text import escaped, fence, link, plain_of
from vicode.docsite.views import CodeBlock, CodeView, Part
from vicode.docsite.views import Page as Head
from vicode.output import OutputFile
from vicode.templating import render

_COLOUR = re.compile(r'(?<= )(fill|stroke)="var\(--drawn-([a-z-]+)\)"')
_LINK = re.compile(r'<a ([^>]*?) href="[^"]*">')
_LANGUAGES = {"Python": "python", "C++": "cpp", "XABSL": "", "YAML": "yaml"}
_SECTIONS = {
    "agent": "Agents",
    "component": "State machines",
    "interfaces": "Interfaces",
    "interface": "Interfaces",
    "code": "Texts",
}
"""Templates whose pages stand below a heading of their own in the order of pages."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Content:
    """A page before it has a form: its template, and what that sees once it is asked for."""

    head: Head
    template: str
    site: str
    views: Callable[[], Mapping[str, object]]


def markdown_files(contents: Iterable[Content]) -> tuple[OutputFile, ...]:
    """All pages with their pictures, and the order of pages for mkdocs and for Sphinx."""
    pages, files = list(contents), []
    for page in pages:
        marker = Marker(stem=page.head.file.removesuffix(".html"))
        text = _page(page.template, marker, {"site": page.site, **page.views()})
        files.append(OutputFile(path=f"{marker.stem}.md", text=text))
        files += [OutputFile(path=name, text=svg) for name, svg in marker.pictures.items()]
    files.append(OutputFile(path="nav.yml", text="\n".join(_nav(pages)) + "\n"))
    files.append(OutputFile(path="contents.rst", text="\n".join(_contents(pages)) + "\n"))
    return tuple(sorted(files, key=lambda file: file.path))


def page_in_markdown(template: str, **views: object) -> str:
    """A page without pictures."""
    return _page(template, Marker(stem="index"), views)


@dataclass(frozen=True, slots=True, kw_only=True)
class Marker:
    """What the templates of one page turn words into Markdown with; it keeps the page's pictures."""

    stem: str
    pictures: dict[str, str] = field(default_factory=dict)

    text = staticmethod(markdown_text.escaped)
    code = staticmethod(markdown_text.code)
    line = staticmethod(markdown_text.line)
    expression = staticmethod(markdown_text.expression)
    doc = staticmethod(markdown_text.of_html)

    def part(self, part: Part) -> str:
        """A piece of a line."""
        return markdown_text.line((part,))

    def link(self, name: str, href: str) -> str:
        """A name that leads somewhere."""
        return link(escaped(name), href)

    def words(self, html: str) -> str:
        """A doc in a cell."""
        return " ".join(markdown_text.of_html(html).split())

    def block(self, block: CodeBlock) -> str:
        """Code of a design."""
        return fence(plain_of(block.html), _LANGUAGES.get(block.language, ""))

    def listing(self, view: CodeView) -> str:
        """A whole text."""
        return fence("\n".join(map(plain_of, view.lines_html)))

    def picture(self, name: str, about: str, svg: str) -> str:
        """A drawing in a file of its own, which a click shows in its full size; nothing for none."""
        if not svg:
            return ""
        file = f"{self.stem}-{name}.svg" if name else f"{self.stem}.svg"
        self.pictures[file] = standing_alone(svg)
        return f"[![{escaped(about)}]({file})]({file})"


def standing_alone(svg: str) -> str:
    """A drawing of a page as a picture: with colours of its own, and without links, which pictures cannot follow."""
    coloured = _COLOUR.sub(lambda found: f'{found[1]}="{getattr(LIGHT, found[2].replace("-", "_"))}"', svg)
    return "<!-- vicode docs -->\n" + _LINK.sub(r"<g \1>", coloured).replace("</a>", "</g>")


def _page(template: str, marker: Marker, views: Mapping[str, object]) -> str:
    text = render(f"docsite/markdown/{template}.md.jinja", md=marker, **views)
    return "\n".join(_single_spaced(text))


def _single_spaced(text: str) -> Iterator[str]:
    """Lines without more than one empty one in a row, but in code."""
    mark, was_empty = "", True
    for line in text.splitlines():
        opened = re.match("`{3,}", line)
        if mark:
            mark = "" if line == mark else mark
        elif opened:
            mark = opened[0]
        elif not line.strip():
            if not was_empty:
                yield ""
            was_empty = True
            continue
        was_empty = False
        yield line if mark else line.rstrip()
    yield ""


def _nav(pages: Iterable[Content]) -> Iterator[str]:
    """The order of pages as mkdocs reads it, which knows a subset of YAML that JSON's strings belong to."""
    yield "# vicode docs: the order of the pages; in mkdocs.yml: INHERIT: <this file>"
    yield "nav:"
    section = ""
    for page in _in_order(pages):
        wanted = _SECTIONS.get(page.template, "")
        if wanted != section:
            section = wanted
            if section:
                yield f"  - {json.dumps(section)}:"
        indent = "      " if section else "  "
        yield f"{indent}- {json.dumps(page.head.title)}: {json.dumps(_stem(page) + '.md')}"


def _contents(pages: Iterable[Content]) -> Iterator[str]:
    """The order of pages as Sphinx reads it."""
    yield from (".. vicode docs", "", "Contents", "========", "", ".. toctree::", "   :maxdepth: 1", "")
    yield from (f"   {_stem(page)}" for page in _in_order(pages))


def _in_order(pages: Iterable[Content]) -> list[Content]:
    """Home first, texts last, what stands below a heading together."""
    order = ["home", "agents", "agent", "component", "symbols", "types", "interfaces", "interface", "all", "code"]
    return sorted(pages, key=lambda page: order.index(page.template))


def _stem(page: Content) -> str:
    return page.head.file.removesuffix(".html")
