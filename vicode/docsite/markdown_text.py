"""Escapes untrusted text for Markdown dialects, and converts the HTML of this package back to Markdown."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from html import unescape
from html.parser import HTMLParser

from vicode.docsite.views import RichText, TextSpan

# Escapable with a backslash in CommonMark and in Python-Markdown.
_ESCAPED = re.compile(r"([\\`*_{}\[\]#])")
# Only entities are safe in all dialects: tags, tables, strikethrough, formulas, roles and comments.
_ENTITIES = {
    "&": "&amp;",
    "<": "&lt;",
    ">": "&gt;",
    "|": "&#124;",
    "~": "&#126;",
    "$": "&#36;",
    "^": "&#94;",
    "@": "&#64;",
}
_ENTITY = re.compile("[" + re.escape("".join(_ENTITIES)) + "]")
# At the start of a line: lists, rules, definitions, comments.
_LEADING = re.compile(r"^(\s*)(?:([-+=:%!])|(\d+)([.)]))")
_CODE_UNSAFE = re.compile(r"[`|\n]")
_ADDRESS_UNSAFE = re.compile(r"[\s()<>\\\"'{}|`]")


def escape_text(text: str) -> str:
    """Escape text as one line."""
    line = " ".join(text.split())
    line = _ENTITY.sub(lambda found: _ENTITIES[found[0]], _ESCAPED.sub(r"\\\1", line))
    return _LEADING.sub(_leading, line)


def inline_code(text: str) -> str:
    """Format code as one line."""
    line = " ".join(text.split())
    if not line:
        return ""
    if not _CODE_UNSAFE.search(line):
        return f"`{line}`"
    return f"<code>{''.join(_as_entity(letter) for letter in line)}</code>"


def fence(text: str, language: str = "") -> str:
    """Format a code block with a fence longer than any in the text."""
    longest = max((len(found) for found in re.findall("`+", text)), default=0)
    mark = "`" * max(3, longest + 1)
    return f"{mark}{language}\n{text.strip(chr(10))}\n{mark}"


def link(text: str, href: str) -> str:
    """A link whose text is Markdown already."""
    return f"[{text}]({markdown_href(href)})" if href else text


def markdown_href(href: str) -> str:
    """Convert a URL of the site to its Markdown file; Markdown has no anchors for lines of code."""
    safe = _ADDRESS_UNSAFE.sub(lambda found: "".join(f"%{byte:02X}" for byte in found[0].encode()), href)
    if re.match(r"[a-z]+:", safe):
        return safe
    return re.sub(r"#L\d+$", "", re.sub(r"\.html(?=#|$)", ".md", safe))


def rich_text(parts: RichText) -> str:
    return "".join(_part(part) for part in parts)


def inline_expression(parts: RichText) -> str:
    """Format code with links; spans without links are joined."""
    groups: list[list[TextSpan]] = []
    for part in parts:
        if groups and not part.href and not groups[-1][-1].href:
            groups[-1].append(part)
        else:
            groups.append([part])
    return "".join(_code_group(group) for group in groups)


def markdown_from_html(html: str) -> str:
    reader = _MarkdownConverter()
    reader.feed(html)
    reader.close()
    return reader.markdown()


def strip_tags(html: str) -> str:
    """The text of highlighted code."""
    return unescape(re.sub(r"<[^>]*>", "", html))


def _leading(found: re.Match[str]) -> str:
    space, sign, number, point = found.groups()
    return f"{space}&#{ord(sign)};" if sign else f"{space}{number}&#{ord(point)};"


def _as_entity(letter: str) -> str:
    return letter if letter.isalnum() or letter in " .,=+-/%:;?'" else f"&#{ord(letter)};"


def _part(part: TextSpan) -> str:
    text = part.text
    inner = inline_code(text) if part.css_class == "code" else escape_text(text)
    before, after = " " * text[:1].isspace(), " " * (len(text) > 1 and text[-1:].isspace())
    return before + link(inner, part.href) + after


def _code_group(group: list[TextSpan]) -> str:
    text = "".join(part.text for part in group)
    before, after = " " * text[:1].isspace(), " " * (bool(text.strip()) and text[-1:].isspace())
    return before + link(inline_code(text), group[0].href) + after


@dataclass
class _Block:
    """An open block: its tag and content."""

    tag: str
    lines: list[str] = field(default_factory=list)
    inline: str = ""


class _MarkdownConverter(HTMLParser):
    """Parses HTML that was rendered from Markdown."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.blocks: list[_Block] = [_Block("")]
        self.hrefs: list[str] = []
        self.raw: str | None = None
        self.is_code = False
        self.rows: list[list[str]] = []

    def markdown(self) -> str:
        self._end_line()
        return "\n\n".join(self.blocks[0].lines)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        match tag:
            case "pre":
                self.raw = ""
            case "code" if self.raw is None:
                self.raw, self.is_code = "", True
            case "em" | "strong" | "s":
                self._add({"em": "*", "strong": "**", "s": ""}[tag])
            case "a":
                self.hrefs.append(dict(attrs).get("href") or "")
                self._add("[")
            case "br":
                self._add(" ")
            case "hr":
                self._end_line()
                self.blocks[-1].lines.append("* * *")
            case "tr":
                self.rows.append([])
            case "ul" | "ol" | "li" | "blockquote" | "td" | "th":
                self._end_line()
                self.blocks.append(_Block(tag))

    def handle_endtag(self, tag: str) -> None:
        match tag:
            case "pre":
                self._end_line()
                self.blocks[-1].lines.append(fence(self.raw or ""))
                self.raw = None
            case "code" if self.is_code:
                written, self.raw, self.is_code = inline_code(self.raw or ""), None, False
                self._add(written)
            case "em" | "strong" | "s":
                self._add({"em": "*", "strong": "**", "s": ""}[tag])
            case "a":
                self._add(f"]({markdown_href(self.hrefs.pop())})")
            case "p":
                self._end_line()
            case "h1" | "h2" | "h3" | "h4" | "h5" | "h6":
                self.blocks[-1].inline = f"**{self.blocks[-1].inline.strip()}**"
                self._end_line()
            case "ul" | "ol" | "li" | "blockquote" | "td" | "th":
                self._end_block()
            case "table":
                self.blocks[-1].lines.append("\n".join(_table(self.rows)))
                self.rows = []

    def handle_data(self, data: str) -> None:
        if self.raw is not None:
            self.raw += data
        elif data.strip() or self.blocks[-1].inline:
            before, after = " " * data[:1].isspace(), " " * data[-1:].isspace()
            words = escape_text(data) if not self.blocks[-1].inline else escape_text(f"x{data}")[1:].strip()
            self._add(f"{before}{words}{after}" if data.strip() else " ")

    def _add(self, text: str) -> None:
        self.blocks[-1].inline += text

    def _end_line(self) -> None:
        block = self.blocks[-1]
        if block.inline.strip():
            block.lines.append(block.inline.strip())
        block.inline = ""

    def _end_block(self) -> None:
        self._end_line()
        block = self.blocks.pop()
        text = "\n\n".join(block.lines)
        match block.tag:
            case "li":
                self.blocks[-1].lines.append(text)
            case "ul" | "ol":
                marks = ("-" if block.tag == "ul" else f"{number}." for number in range(1, len(block.lines) + 1))
                items = (f"{mark:<4}{_indented(item)}" for mark, item in zip(marks, block.lines, strict=True))
                self.blocks[-1].lines.append("\n".join(items))
            case "blockquote":
                self.blocks[-1].lines.append("\n".join(f"> {each}".rstrip() for each in text.split("\n")))
            case _:
                self.rows[-1].append(" ".join(text.split()))


def _indented(text: str) -> str:
    """A list item; all dialects agree on an indent of four spaces."""
    return re.sub(r"\n(?=.)", "\n    ", text)


def _table(rows: list[list[str]]) -> Iterator[str]:
    for number, row in enumerate(rows):
        yield f"| {' | '.join(row)} |"
        if not number:
            yield f"|{' --- |' * len(row)}"
