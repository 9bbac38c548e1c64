"""The marks around hand-editable parts of generated files: begin with id and checksum, end.

# <vicode LookForBall.enter 3f2a9c1b>
self.tries = 0
# </vicode>
"""

import hashlib
import io
import re
import tokenize
from dataclasses import dataclass

from vicode.findings import Finding, Place, rule

_BEGIN = re.compile(r"<vicode (?P<id>[^\s<>]+) (?P<checksum>[0-9a-f]{8})>\Z")
_END = "</vicode>"
_INSIDE_STRING_BEGINS = frozenset(getattr(tokenize, name, -1) for name in ("FSTRING_START", "TSTRING_START"))
_INSIDE_STRING_ENDS = frozenset(getattr(tokenize, name, -1) for name in ("FSTRING_END", "TSTRING_END"))


@dataclass(frozen=True, slots=True, kw_only=True)
class Region:
    """A marked part of a file: `body` without its indentation, `checksum` as its mark says, `line` of that mark."""

    id: str
    checksum: str
    body: str
    line: int
    end_line: int
    indent: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Found:
    """The regions of a text in order, and what is wrong with its marks."""

    regions: tuple[Region, ...] = ()
    findings: tuple[Finding, ...] = ()


def wrap(id: str, body: str, *, comment: str = "#", indent: str = "") -> str:  # noqa: A002 - what it is
    """The body between its marks, indented; ends with a line break."""
    trimmed = _trim(_dedented(body))
    lines = _indented(trimmed, indent)
    # The checksum is that of the body as it will be read again.
    begin = f"{indent}{comment} <vicode {id} {checksum_of(_unindented(lines, indent))}>"
    # Formatters want blank lines after a definition, and those stand before the mark.
    blank = [""] * _count_blank_lines_after(trimmed, indent) if comment == "#" else []
    return "".join(line + "\n" for line in (begin, *lines, *blank, f"{indent}{comment} {_END}"))


def find(text: str, comment: str = "#", *, file: str = "") -> Found:
    """All regions of a text; marks that do not match are findings, and the regions around them are still given."""
    lines = text.replace("\r\n", "\n").split("\n")
    regions: list[Region] = []
    findings: list[Finding] = []
    at = 0
    while at < len(lines):
        content = _mark_content(lines[at], comment)
        begin = _BEGIN.match(content)
        if begin is None:
            findings += _stray(content, Place(file=file, line=at + 1, column=1, length=len(lines[at])))
            at += 1
            continue
        region = _region_at(lines, at, comment, begin)
        if region is None:
            place = Place(file=file, line=at + 1, column=1, length=len(lines[at]))
            findings.append(_broken(f"the region '{begin['id']}' has no end mark", place, comment))
        else:
            regions.append(region)
            at = region.end_line - 1
        at += 1
    return Found(regions=tuple(regions), findings=(*findings, *_find_duplicates(regions, file)))


def is_edited(region: Region) -> bool:
    """Whether its body is no longer the one that was generated."""
    return checksum_of(region.body) != region.checksum


def checksum_of(body: str) -> str:
    """Eight hexadecimal digits; blanks at line ends and blank lines around do not count."""
    lines = [line.rstrip() for line in _trim(body).split("\n")]
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()[:8]


def without_bodies(text: str, comment: str = "#") -> str:
    """The text with its regions emptied and their checksums left out: what nobody is meant to edit."""
    lines = text.replace("\r\n", "\n").split("\n")
    for region in reversed(find(text, comment).regions):
        lines[region.line - 1 : region.end_line] = [f"{region.indent}{comment} <vicode {region.id}>"]
    return "\n".join(lines)


def defuse(text: str) -> str:
    """A user's text with nothing in it that could pass for a mark."""
    return text.replace("<vicode", "< vicode").replace("</vicode", "< /vicode")


def _region_at(lines: list[str], begin_at: int, comment: str, begin: re.Match[str]) -> Region | None:
    """The region that begins at a line, up to the end mark that fits its checksum (code may hold marks), or the first."""
    indent = lines[begin_at][: len(lines[begin_at]) - len(lines[begin_at].lstrip())]
    first: Region | None = None
    is_overrun = False
    for at in range(begin_at + 1, len(lines)):
        content = _mark_content(lines[at], comment)
        is_overrun = is_overrun or (first is None and bool(_BEGIN.match(content)))
        if content != _END:
            continue
        body = _trim(_unindented(lines[begin_at + 1 : at], indent))
        region = Region(
            id=begin["id"], checksum=begin["checksum"], body=body, line=begin_at + 1, end_line=at + 1, indent=indent
        )
        if not is_edited(region):
            return region
        first = first or region
    return None if is_overrun else first


def _mark_content(line: str, comment: str) -> str:
    stripped = line.strip()
    return stripped[len(comment) :].strip() if stripped.startswith(comment) else ""


def _stray(content: str, place: Place) -> list[Finding]:
    if content == _END:
        return [_broken("an end mark without its begin", place, "#")]
    if content.startswith("<vicode "):
        return [_broken("a mark that cannot be read", place, "#")]
    return []


def _find_duplicates(regions: list[Region], file: str) -> list[Finding]:
    seen: set[str] = set()
    findings = []
    for region in regions:
        if region.id in seen:
            place = Place(file=file, line=region.line, column=1)
            findings.append(_broken(f"two regions with the id '{region.id}'", place, "#"))
        seen.add(region.id)
    return findings


def _broken(message: str, place: Place, comment: str) -> Finding:
    mend = f"restore the marks '{comment} <vicode …>' and '{comment} {_END}', or move the file away and generate it"
    return Finding(rule=rule("G503"), message=message, mend=mend, place=place)


def _trim(body: str) -> str:
    lines = body.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    while lines and not lines[-1].strip():
        lines.pop()
    while lines and not lines[0].strip():
        lines.pop(0)
    return "\n".join(lines)


def _dedented(body: str) -> str:
    lines = body.expandtabs(4).split("\n") if body[:1] == "\t" else body.split("\n")
    fixed = _lines_inside_strings(body)
    margins = [
        len(line) - len(line.lstrip())
        for number, line in enumerate(lines, start=1)
        if line.strip() and number not in fixed
    ]
    return _unindented(lines, " " * min(margins, default=0))


def _indented(body: str, indent: str) -> list[str]:
    fixed = _lines_inside_strings(body)
    return [
        line if number in fixed or not line.strip() else indent + line
        for number, line in enumerate(body.split("\n"), start=1)
    ]


def _unindented(lines: list[str], indent: str) -> str:
    """The lines with the indentation of their marks taken away, where they have it."""
    fixed = _lines_inside_strings("\n".join(lines))
    return "\n".join(
        line if number in fixed else line.removeprefix(indent) for number, line in enumerate(lines, start=1)
    )


def _lines_inside_strings(body: str) -> set[int]:
    """Numbers of the lines that begin inside a string of Python: blanks there would change its value."""
    fixed: set[int] = set()
    begins: list[int] = []
    try:
        for token in tokenize.generate_tokens(io.StringIO(body).readline):
            if token.type == tokenize.STRING:
                fixed.update(range(token.start[0] + 1, token.end[0] + 1))
            elif token.type in _INSIDE_STRING_BEGINS:
                begins.append(token.start[0])
            elif token.type in _INSIDE_STRING_ENDS and begins:
                fixed.update(range(begins.pop() + 1, token.end[0] + 1))
    except (tokenize.TokenError, SyntaxError):
        # Text that is no Python, or another language's code, is indented as it stands.
        return fixed
    return fixed


def _count_blank_lines_after(body: str, indent: str) -> int:
    """How many blank lines a formatter puts between the last definition of a body and a comment behind it."""
    last = [line for line in body.split("\n") if line and not line[0].isspace() and line[0] not in ")]}#\"'"]
    if not last or not last[-1].startswith(("def ", "class ", "async def ")):
        return 0
    return 1 if indent else 2
