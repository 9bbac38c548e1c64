"""The pages as Markdown with SVG images, for MkDocs, Sphinx (MyST), and direct reading."""

import json
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from vicode.diagram.palettes import LIGHT
from vicode.docsite import markdown_text
from vicode.docsite.markdown_text import escape_text, fence, link, strip_tags
from vicode.docsite.views import CodeBlock, CodeView, TextSpan
from vicode.docsite.views import PageHead as Head
from vicode.languages import LANGUAGES
from vicode.output import OutputFile
from vicode.templating import render

_COLOR = re.compile(r'(?<= )(fill|stroke)="var\(--drawn-([a-z-]+)\)"')
_LINK = re.compile(r'<a ([^>]*?) href="[^"]*">')
_FENCES = {each.title: each.fence for each in LANGUAGES.values()}
_SECTIONS = {
    "agent": "Agents",
    "component": "State machines",
    "interfaces": "Interfaces",
    "interface": "Interfaces",
    "code": "Code",
}
"""The section of the navigation, by template."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PageContent:
    """A page before rendering: its template and a function that returns the template variables."""

    head: Head
    template: str
    site: str
    views: Callable[[], Mapping[str, object]]


def markdown_files(contents: Iterable[PageContent]) -> tuple[OutputFile, ...]:
    """All pages with their images, and the page order for MkDocs and Sphinx."""
    pages, files = list(contents), []
    for page in pages:
        marker = MarkdownFormatter(stem=page.head.file.removesuffix(".html"))
        text = _page(page.template, marker, {"site": page.site, **page.views()})
        files.append(OutputFile(path=f"{marker.stem}.md", text=text))
        files += [OutputFile(path=name, text=svg) for name, svg in marker.images.items()]
    files.append(OutputFile(path="nav.yml", text="\n".join(_nav(pages)) + "\n"))
    files.append(OutputFile(path="contents.rst", text="\n".join(_contents(pages)) + "\n"))
    return tuple(sorted(files, key=lambda file: file.path))


def render_markdown_page(template: str, **views: object) -> str:
    return _page(template, MarkdownFormatter(stem="index"), views)


@dataclass(frozen=True, slots=True, kw_only=True)
class MarkdownFormatter:
    """Formats values as Markdown in the templates of one page, and collects the images of the page."""

    stem: str
    images: dict[str, str] = field(default_factory=dict)

    text = staticmethod(markdown_text.escape_text)
    code = staticmethod(markdown_text.inline_code)
    rich_text = staticmethod(markdown_text.rich_text)
    expression = staticmethod(markdown_text.inline_expression)
    doc = staticmethod(markdown_text.markdown_from_html)

    def span(self, part: TextSpan) -> str:
        return markdown_text.rich_text((part,))

    def link(self, name: str, href: str) -> str:
        return link(escape_text(name), href)

    def cell(self, html: str) -> str:
        """Format a description for a table cell."""
        return " ".join(markdown_text.markdown_from_html(html).split())

    def code_block(self, block: CodeBlock) -> str:
        return fence(strip_tags(block.html), _FENCES.get(block.language, ""))

    def listing(self, view: CodeView) -> str:
        return fence("\n".join(map(strip_tags, view.lines_html)))

    def image(self, name: str, about: str, svg: str) -> str:
        """Embed a diagram as a separate file that links to itself; "" without a diagram."""
        if not svg:
            return ""
        file = f"{self.stem}-{name}.svg" if name else f"{self.stem}.svg"
        self.images[file] = standalone_svg(svg)
        return f"[![{escape_text(about)}]({file})]({file})"


def standalone_svg(svg: str) -> str:
    """Convert an embedded diagram to an image: fixed colors, no links."""
    colored = _COLOR.sub(lambda found: f'{found[1]}="{getattr(LIGHT, found[2].replace("-", "_"))}"', svg)
    return "<!-- vicode docs -->\n" + _LINK.sub(r"<g \1>", colored).replace("</a>", "</g>")


def _page(template: str, marker: MarkdownFormatter, views: Mapping[str, object]) -> str:
    text = render(f"docsite/markdown/{template}.md.jinja", md=marker, **views)
    return "\n".join(_single_spaced(text))


def _single_spaced(text: str) -> Iterator[str]:
    """Collapse empty lines outside code blocks."""
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


def _nav(pages: Iterable[PageContent]) -> Iterator[str]:
    """The page order for MkDocs; JSON strings are valid YAML."""
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


def _contents(pages: Iterable[PageContent]) -> Iterator[str]:
    """The page order for Sphinx."""
    yield from (".. vicode docs", "", "Contents", "========", "", ".. toctree::", "   :maxdepth: 1", "")
    yield from (f"   {_stem(page)}" for page in _in_order(pages))


def _in_order(pages: Iterable[PageContent]) -> list[PageContent]:
    """Home first, code last, pages of one section together."""
    order = ["home", "agents", "agent", "component", "symbols", "types", "interfaces", "interface", "all", "code"]
    return sorted(pages, key=lambda page: order.index(page.template))


def _stem(page: PageContent) -> str:
    return page.head.file.removesuffix(".html")
