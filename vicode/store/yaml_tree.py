"""Parses YAML into a tree of nodes with offsets, in which scalars are untyped texts.

The tree is built from parser events without recursion. Aliases, tags, deep nesting and large files are rejected.
"""

import contextlib
import re
from dataclasses import dataclass

import yaml

from vicode.store.line_index import ReadReport
from vicode.store.yaml_errors import explain_yaml_error

MAX_BYTES = 2_000_000
MAX_NODES = 250_000
MAX_DEPTH = 40

_LOADER = yaml.CSafeLoader if yaml.__with_libyaml__ else yaml.SafeLoader
_LINE_END = re.compile(r"[\r\n]")
_INVALID_CHARACTER = re.compile("[^\t\n\r -~\x85\xa0-\ud7ff\ue000-\ufefe\uff00-\ufffd\U00010000-\U0010ffff]")


@dataclass(frozen=True, slots=True)
class YamlScalar:
    """A scalar; `style` is empty (plain) or the indicator ' " | >. An alias becomes a scalar with `is_rejected`."""

    text: str
    style: str
    start: int
    end: int
    is_rejected: bool = False

    @property
    def is_empty(self) -> bool:
        return not self.text and not self.style


@dataclass(frozen=True, slots=True)
class YamlMapping:
    """A mapping; the pairs are in file order."""

    pairs: "tuple[tuple[YamlNode, YamlNode], ...]"
    is_flow: bool
    start: int
    end: int


@dataclass(frozen=True, slots=True)
class YamlSequence:
    """A list."""

    items: "tuple[YamlNode, ...]"
    is_flow: bool
    start: int
    end: int


YamlNode = YamlScalar | YamlMapping | YamlSequence
_NodeEvent = yaml.ScalarEvent | yaml.MappingStartEvent | yaml.SequenceStartEvent


@dataclass(frozen=True, slots=True, kw_only=True)
class YamlTree:
    """The result of parsing.

    Attributes:
        root: None if the text is empty or was rejected.
        is_complete: Whether the whole text was parsed.
        unclosed: Start offsets of the collections that were open at a syntax error.
    """

    root: YamlNode | None
    is_complete: bool
    unclosed: tuple[int, ...] = ()


@dataclass(slots=True)
class _OpenCollection:
    """A collection whose end was not parsed yet."""

    is_mapping: bool
    is_flow: bool
    start: int
    children: list[YamlNode]


class _ParseAborted(Exception):  # noqa: N818 - control flow, not an error
    """Stops parsing after a finding that makes the rest useless."""


def parse_yaml(text: str, report: ReadReport) -> YamlTree:
    """Parse a text and add syntax errors to the report."""
    # The byte order mark is removed here because builds of libyaml count it differently in offsets.
    skipped = 1 if text.startswith("\ufeff") else 0
    if not _has_valid_characters(text, skipped, report):
        return YamlTree(root=None, is_complete=False)
    builder = _TreeBuilder(text, skipped, report)
    try:
        for event in yaml.parse(text[skipped:], Loader=_LOADER):
            builder.handle_event(event)
    except yaml.YAMLError as error:
        _report_syntax(error, skipped, report)
        unclosed = tuple(collection.start for collection in builder.open)
        return YamlTree(root=builder.close_all(), is_complete=False, unclosed=unclosed)
    except _ParseAborted:
        return YamlTree(root=None, is_complete=False)
    return YamlTree(root=builder.root, is_complete=True)


def find_undefined_aliases(text: str) -> set[str | None]:
    """The names of aliases without an anchor above them; of a text with syntax errors, those before the first one."""
    anchors, undefined = set[str | None](), set[str | None]()
    with contextlib.suppress(yaml.YAMLError):
        for event in yaml.parse(text.removeprefix("\ufeff"), Loader=_LOADER):
            if isinstance(event, yaml.AliasEvent):
                undefined |= {event.anchor} - anchors
            elif isinstance(event, yaml.NodeEvent):
                anchors.add(event.anchor)
    return undefined


def _has_valid_characters(text: str, skipped: int, report: ReadReport) -> bool:
    match = _INVALID_CHARACTER.search(text, skipped)
    if match:
        message = f"invalid character U+{ord(match.group()):04X}"
        fix = f'remove it, or write "\\u{ord(match.group()):04X}" in double quotes'
        report.add("Y110", message, match.span(), fix=fix)
    return match is None


def _report_syntax(error: yaml.YAMLError, skipped: int, report: ReadReport) -> None:
    text = report.line_index.text
    problem = getattr(error, "problem_mark", None)
    offset = min(skipped + problem.index, max(0, len(text) - 1)) if problem else 0
    message, fix, tells_opening = explain_yaml_error(error, text[offset : offset + 1])
    opening = getattr(error, "context_mark", None)
    if opening and tells_opening and not text[offset:].strip():
        # At the end of the file, there is no text to show.
        offset = skipped + opening.index
    is_elsewhere = opening and tells_opening and skipped + opening.index != offset
    note = ("starts here", skipped + opening.index) if opening and is_elsewhere else None
    report.add("Y101", message, (offset, offset + 1), fix=fix, note=note)


class _TreeBuilder:
    def __init__(self, text: str, skipped: int, report: ReadReport) -> None:
        self.text = text
        self.skipped = skipped
        self.report = report
        self.root: YamlNode | None = None
        self.documents = 0
        self.nodes = 0
        self.open: list[_OpenCollection] = []

    def handle_event(self, event: yaml.Event) -> None:
        match event:
            case yaml.ScalarEvent():
                self._reject_anchor_and_tag(event)
                self._add(self._scalar(event))
            case yaml.MappingStartEvent() | yaml.SequenceStartEvent():
                self._reject_anchor_and_tag(event)
                self._open_collection(event)
            case yaml.MappingEndEvent() | yaml.SequenceEndEvent():
                self._close_collection(self._span(event)[1])
            case yaml.AliasEvent():
                span = self._span(event)
                self._report("Y107", "YAML aliases are not supported", span, "repeat the value instead")
                self._add(YamlScalar("", "", *span, is_rejected=True))
            case yaml.DocumentStartEvent():
                self._check_single_document(event)

    def close_all(self) -> YamlNode | None:
        """Close all open collections after a syntax error and return the root."""
        while self.open:
            self._close_collection(len(self.text))
        return self.root

    def _check_single_document(self, event: yaml.Event) -> None:
        self.documents += 1
        if self.documents > 1:
            start = self._span(event)[0]
            message = "a second YAML document starts here"
            self.report.add("Y112", message, (start, start + 3), fix="remove '---': a file contains one design")
            raise _ParseAborted

    def _span(self, event: yaml.Event) -> tuple[int, int]:
        assert event.start_mark is not None
        assert event.end_mark is not None
        return event.start_mark.index + self.skipped, event.end_mark.index + self.skipped

    def _reject_anchor_and_tag(self, event: _NodeEvent) -> None:
        start, end = self._span(event)
        if event.anchor is not None:
            end = min(end, start + len(event.anchor) + 1)
            self._report("Y107", f"YAML anchors such as '&{event.anchor}' are not supported", (start, end), "remove it")
        if event.tag is not None:
            tag_start = self.text.find("!", start)
            start = tag_start if tag_start >= 0 else start
            tag = self.text[start : start + 60].split(maxsplit=1)[0]
            message = f"YAML tags such as '{tag}' are not supported"
            self._report("Y106", message, (start, start + len(tag)), "remove the tag")

    def _report(self, code: str, message: str, span: tuple[int, int], fix: str) -> None:
        self.report.add(code, message, span, fix=fix)
        if self.report.is_full:
            raise _ParseAborted

    def _open_collection(self, event: yaml.MappingStartEvent | yaml.SequenceStartEvent) -> None:
        start = self._span(event)[0]
        if len(self.open) >= MAX_DEPTH:
            message = f"more than {MAX_DEPTH} nested levels"
            self.report.add("Y108", message, (start, start + 1), fix="split the design")
            raise _ParseAborted
        is_mapping = isinstance(event, yaml.MappingStartEvent)
        self.open.append(_OpenCollection(is_mapping, bool(event.flow_style), start, []))

    def _close_collection(self, end: int) -> None:
        closed = self.open.pop()
        children = tuple(closed.children)
        if not closed.is_flow:
            # The parser reports the start of the next token as the end of a block.
            end = children[-1].end if children else closed.start
        if closed.is_mapping:
            pairs = tuple(zip(children[::2], children[1::2], strict=False))
            self._add(YamlMapping(pairs, closed.is_flow, closed.start, end))
        else:
            self._add(YamlSequence(children, closed.is_flow, closed.start, end))

    def _add(self, node: YamlNode) -> None:
        self.nodes += 1
        if self.nodes > MAX_NODES:
            self.report.add("Y108", f"more than {MAX_NODES} values", (node.start, node.end), fix="split the design")
            raise _ParseAborted
        if self.open:
            self.open[-1].children.append(node)
        else:
            self.root = node

    def _scalar(self, event: yaml.ScalarEvent) -> YamlScalar:
        start, end = self._span(event)
        style = event.style or ""
        if style in ("|", ">"):
            end = self._block_end(start, end)
        elif event.anchor is not None or event.tag is not None:
            start = max(start, end - len(event.value)) if not style else start
        return YamlScalar(event.value, style, start, end)

    def _block_end(self, start: int, end: int) -> int:
        """The end of the last line of a block scalar, without its line break."""
        raw = self.text[start:end]
        header = raw.splitlines()[0].split("#")[0] if raw else ""
        if "+" in header:
            return start + len(raw.removesuffix("\n").removesuffix("\r"))
        last = start + len(raw.rstrip())
        following = _LINE_END.search(self.text, last)
        return min(following.start(), end) if following else end
