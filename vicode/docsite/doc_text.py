"""Renders descriptions as HTML. They are untrusted Markdown: HTML, images and unusual URL schemes are disabled."""

import re
from collections.abc import Iterable
from functools import lru_cache
from html import escape

from markdown_it import MarkdownIt

_ALLOWED = re.compile(r"(?i)(https?://|mailto:)")
# Text without these characters contains no markup.
_MARKUP = re.compile(r"[*_`\[\\&<]")


def render_doc(text: str, parent_level: int = 1) -> str:
    """Render a block of Markdown; its top headings are one level below `parent_level`."""
    tokens = _markdown().parse(text)
    headings = [token for token in tokens if token.type in ("heading_open", "heading_close")]
    highest = min((int(token.tag[1]) for token in headings), default=1)
    for token in headings:
        token.tag = f"h{min(6, int(token.tag[1]) - highest + parent_level + 1)}"
    rendered: str = _markdown().renderer.render(tokens, _markdown().options, {})
    return rendered


def render_inline_doc(text: str) -> str:
    """Render Markdown for a line or a table cell."""
    return str(_markdown().renderInline(text))


def render_facts(text: str, facts: Iterable[str]) -> str:
    """Render Markdown for a table cell, followed by facts as badges."""
    badges = (f'<span class="badge">{escape(fact)}</span>' for fact in facts)
    return " ".join(part for part in (render_inline_doc(text), *badges) if part)


def summarize(text: str) -> str:
    """Return the first sentence as plain text."""
    paragraph = " ".join(text.strip().split("\n\n")[0].split())
    if _MARKUP.search(paragraph):
        (line,) = _markdown().parseInline(paragraph)
        paragraph = "".join(token.content for token in line.children or ())
    end = re.search(r"[.:!?](?= [A-Z])", paragraph)
    return paragraph[: end.end()] if end else paragraph


@lru_cache(maxsize=1)
def _markdown() -> MarkdownIt:
    markdown = MarkdownIt("commonmark", {"html": False, "linkify": False}).enable("table").disable("image")
    markdown.validateLink = _is_allowed  # type: ignore[method-assign]
    return markdown


def _is_allowed(url: str) -> bool:
    return _ALLOWED.match(url.strip()) is not None
