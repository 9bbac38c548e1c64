"""Writes target trees as YAML, with as few quotes as possible and in flow style where a collection fits on a line."""

import re
from dataclasses import dataclass

from vicode.store.target_tree import (
    TargetCollection,
    TargetMember,
    TargetMoved,
    TargetNode,
    TargetScalar,
    has_multiline_text,
)
from vicode.store.yaml_tree import YamlMapping, YamlNode, YamlScalar, YamlSequence

_PLAIN = re.compile(r"[^\s\-?:,\[\]{}#&*!|>'\"%@`=~]|[-?:][^\s,\[\]{}:#]")
_UNPRINTABLE = re.compile("[^ -~\xa0-\ud7ff\ue000-\ufefe\uff00-\ufffd\U00010000-\U0010ffff]|[\u2028\u2029]")
_NOT_IN_BLOCK = re.compile("[^\t\n -~\xa0-\ud7ff\ue000-\ufefe\uff00-\ufffd\U00010000-\U0010ffff]|[\u2028\u2029]")
_ESCAPES = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\t": "\\t", "\r": "\\r", "\0": "\\0"}
_FOLD_WIDTH = 100


@dataclass(frozen=True, slots=True, kw_only=True)
class YamlStyle:
    """The indentation of a file in columns; `dash_indent` is that of list items below their key."""

    indent_width: int = 2
    dash_indent: int = 2


def detect_style(root: YamlNode | None, text: str) -> YamlStyle:
    """Detect the style from the first nested mapping and the first list."""
    step, dash = 0, -1
    stack: list[tuple[YamlNode, int]] = [(root, 0)] if isinstance(root, YamlMapping) else []
    while stack and (not step or dash < 0):
        node, column = stack.pop()
        inner = (
            [value for _key, value in node.pairs] if isinstance(node, YamlMapping) else list(getattr(node, "items", ()))
        )
        for child in inner:
            if isinstance(child, YamlScalar) or child.is_flow:
                continue
            offset = child.start - text.rfind("\n", 0, child.start) - 1
            if isinstance(node, YamlMapping) and isinstance(child, YamlMapping) and not step:
                step = offset - column
            if isinstance(node, YamlMapping) and isinstance(child, YamlSequence) and dash < 0:
                dash = offset - column
            stack.append((child, offset))
    return YamlStyle(indent_width=step if 0 < step <= 8 else 2, dash_indent=dash if 0 <= dash <= 8 else 2)


def format_inline_text(text: str, *, in_flow: bool = False, quote: str = "") -> str:
    """Format a text on one line; `quote` is the preferred quote, empty for a plain scalar if possible."""
    if not quote and _is_plain(text, in_flow=in_flow):
        return text
    if _UNPRINTABLE.search(text):
        return _in_double_quotes(text)
    if quote == '"' or (not quote and "'" in text and '"' not in text and "\\" not in text):
        return _in_double_quotes(text)
    return "'" + text.replace("'", "''") + "'"


def format_block_text(text: str, indent: int, *, folded: bool = False) -> str | None:
    """Format a text as a block scalar, `folded` if possible; None if a block scalar cannot represent it."""
    body = text.rstrip("\n")
    ends = len(text) - len(body)
    if not body.strip() or _NOT_IN_BLOCK.search(text) or not body.split("\n")[-1].strip():
        return None
    if text[0] in "\n\t" or body.split("\n")[0].strip() == "":
        return None
    chomping = "-" if ends == 0 else "" if ends == 1 else "+"
    lines = _folded_lines(body, indent) if folded and ends < 2 else None
    style = "|" if lines is None else ">"
    # The parser detects the indentation from the first line; if that starts with spaces, an indicator is needed.
    number = str(indent) if text[0] == " " else ""
    lines = body.split("\n") if lines is None else lines
    written = [" " * indent + line if line else "" for line in lines]
    return "\n".join([f"{style}{number}{chomping}", *written, *[""] * max(0, ends - 1)])


def format_value(target: TargetNode, column: int, used: int, style: YamlStyle, *, after_dash: bool = False) -> str:
    """Format a value after 'key:' or '-', without the final line break.

    Args:
        target: The value, without `TargetKeep`.
        column: Column of the key or dash.
        used: Number of used columns in the line.
        style: The indentation of the file.
        after_dash: Whether the value follows a dash.
    """
    if isinstance(target, TargetScalar):
        return " " + _format_scalar(target, column, style)
    assert isinstance(target, TargetCollection), "TargetKeep cannot be formatted"
    if _fits_line(target, used):
        return " " + format_flow(target)
    if target.is_mapping and after_dash:
        return " " + "\n".join(_pair_lines(target, column + 2, style)).lstrip()
    if target.is_mapping:
        return "\n" + "\n".join(_pair_lines(target, column + style.indent_width, style))
    dash = column + (2 if after_dash else style.dash_indent)
    return "\n" + "\n".join(format_member(member, dash, style) for member in target.members)


def format_member(member: TargetMember, column: int, style: YamlStyle) -> str:
    """Format a pair or item including its indentation, without the final line break."""
    lead = " " * column
    if member.key is None and isinstance(member.value, TargetMoved):
        return "\n".join(_shift_line(line, column - member.value.column) for line in member.value.lines)
    if member.key is None:
        return lead + "-" + format_value(member.value, column, column + 2, style, after_dash=True)
    key = format_inline_text(member.key)
    return f"{lead}{key}:" + format_value(member.value, column, column + len(key) + 2, style)


def format_document(target: TargetNode, style: YamlStyle) -> str:
    assert isinstance(target, TargetCollection)
    return "\n".join(_pair_lines(target, 0, style)) + "\n"


def _shift_line(line: str, columns: int) -> str:
    """Change the indentation of a line; blank lines have none."""
    indent = len(line) - len(line.lstrip(" "))
    return " " * max(0, indent + columns) + line[indent:] if line.strip() else ""


def format_flow(target: TargetNode) -> str:
    if isinstance(target, TargetMoved):
        return format_flow(target.target)
    if isinstance(target, TargetScalar):
        return target.text if target.is_plain else format_inline_text(target.text, in_flow=True)
    assert isinstance(target, TargetCollection), "TargetKeep cannot be formatted"
    parts = [format_flow_member(member) for member in target.members]
    return "{" + ", ".join(parts) + "}" if target.is_mapping else "[" + ", ".join(parts) + "]"


def format_flow_member(member: TargetMember) -> str:
    """Format a pair or item of a flow collection."""
    value = format_flow(member.value)
    return value if member.key is None else f"{format_inline_text(member.key, in_flow=True)}: {value}"


def _pair_lines(target: TargetCollection, column: int, style: YamlStyle) -> list[str]:
    return [format_member(member, column, style) for member in target.members]


def _fits_line(target: TargetCollection, used: int) -> bool:
    if not target.members:
        return True
    return (
        _may_be_flow(target) and not has_multiline_text(target) and used + len(format_flow(target)) <= target.flow_width
    )


def _may_be_flow(target: TargetCollection) -> bool:
    inner = (
        member.value for member in target.members if isinstance(member.value, TargetCollection) and member.value.members
    )
    return target.flow_width > 0 and all(_may_be_flow(child) for child in inner)


def _format_scalar(scalar: TargetScalar, column: int, style: YamlStyle) -> str:
    if scalar.is_plain:
        return scalar.text
    block = format_block_text(scalar.text, style.indent_width, folded=False) if "\n" in scalar.text else None
    if block is None:
        return format_inline_text(scalar.text)
    head, *lines = block.split("\n")
    return "\n".join([head, *(" " * column + line if line else "" for line in lines)])


def _is_plain(text: str, *, in_flow: bool) -> bool:
    if not _PLAIN.match(text) or text != text.strip() or _UNPRINTABLE.search(text):
        return False
    if ": " in text or " #" in text or text.endswith(":") or text.startswith(("---", "...")):
        return False
    return not in_flow or not re.search(r"[,\[\]{}:?]", text)


def _in_double_quotes(text: str) -> str:
    return '"' + "".join(_escaped(char) for char in text) + '"'


def _escaped(char: str) -> str:
    if char in _ESCAPES:
        return _ESCAPES[char]
    if not _UNPRINTABLE.match(char):
        return char
    code = ord(char)
    return f"\\x{code:02X}" if code < 0x100 else f"\\u{code:04X}" if code < 0x10000 else f"\\U{code:08X}"


def _folded_lines(body: str, indent: int) -> list[str] | None:
    """Fold a text into lines; None if reading them back would not give the same text."""
    words = body.split(" ")
    if "\n" in body or "\t" in body or not all(words) or len(words) < 2:
        return None
    lines = [words[0]]
    for word in words[1:]:
        if len(lines[-1]) + len(word) + indent < _FOLD_WIDTH:
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    return lines
