"""Writes wishes as YAML: texts with as few quotes as can be, collections in brackets where they fit into a line."""

import re
from dataclasses import dataclass

from vicode.store.target_tree import TargetCollection, TargetMember, TargetNode, TargetScalar, has_multiline_text
from vicode.store.yaml_tree import YamlMapping, YamlNode, YamlScalar, YamlSequence

_PLAIN = re.compile(r"[^\s\-?:,\[\]{}#&*!|>'\"%@`=~]|[-?:][^\s,\[\]{}:#]")
_UNPRINTABLE = re.compile("[^ -~\xa0-\ud7ff\ue000-\ufefe\uff00-\ufffd\U00010000-\U0010ffff]|[\u2028\u2029]")
_NOT_IN_BLOCK = re.compile("[^\t\n -~\xa0-\ud7ff\ue000-\ufefe\uff00-\ufffd\U00010000-\U0010ffff]|[\u2028\u2029]")
_ESCAPES = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\t": "\\t", "\r": "\\r", "\0": "\\0"}
_FOLD_WIDTH = 100


@dataclass(frozen=True, slots=True, kw_only=True)
class YamlStyle:
    """How a file is indented: `indent_width` columns a mapping, `dash_indent` columns the dashes under a key."""

    indent_width: int = 2
    dash_indent: int = 2


def detect_style(root: YamlNode | None, text: str) -> YamlStyle:
    """The layout of an old text, from its first mapping in a mapping and its first list."""
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
    """A text in one line; `quote` is the one to use if it must or should have quotes."""
    if not quote and _is_plain(text, in_flow=in_flow):
        return text
    if _UNPRINTABLE.search(text):
        return _in_double_quotes(text)
    if quote == '"' or (not quote and "'" in text and '"' not in text and "\\" not in text):
        return _in_double_quotes(text)
    return "'" + text.replace("'", "''") + "'"


def format_block_text(text: str, indent: int, *, folded: bool = False) -> str | None:
    """A text as a block: '|' and its lines, or '>' if it can be folded; None when no block can hold it."""
    body = text.rstrip("\n")
    ends = len(text) - len(body)
    if not body.strip() or _NOT_IN_BLOCK.search(text) or not body.split("\n")[-1].strip():
        return None
    if text[0] in "\n\t" or body.split("\n")[0].strip() == "":
        return None
    chomping = "-" if ends == 0 else "" if ends == 1 else "+"
    lines = _folded_lines(body, indent) if folded and ends < 2 else None
    style = "|" if lines is None else ">"
    # The first line would say how far the block is indented; when it begins with blanks, a number must.
    number = str(indent) if text[0] == " " else ""
    lines = body.split("\n") if lines is None else lines
    written = [" " * indent + line if line else "" for line in lines]
    return "\n".join([f"{style}{number}{chomping}", *written, *[""] * max(0, ends - 1)])


def format_value(wish: TargetNode, column: int, used: int, layout: YamlStyle, *, after_dash: bool = False) -> str:
    """What follows 'key:' or '-', without the last line break.

    Args:
        wish: A value without anything kept.
        column: Where the key or dash begins.
        used: Columns of the line that are taken.
        layout: How the file is indented.
        after_dash: It follows a dash, not a key.
    """
    if isinstance(wish, TargetScalar):
        return " " + _format_scalar(wish, column, layout)
    assert isinstance(wish, TargetCollection), "what is kept is not written"
    if _fits_line(wish, used):
        return " " + format_flow(wish)
    if wish.is_mapping and after_dash:
        return " " + "\n".join(_pair_lines(wish, column + 2, layout)).lstrip()
    if wish.is_mapping:
        return "\n" + "\n".join(_pair_lines(wish, column + layout.indent_width, layout))
    dash = column + (2 if after_dash else layout.dash_indent)
    return "\n" + "\n".join(format_member(member, dash, layout) for member in wish.members)


def format_member(member: TargetMember, column: int, layout: YamlStyle) -> str:
    """A whole pair or item from its first column, without the last line break."""
    lead = " " * column
    if member.key is None:
        return lead + "-" + format_value(member.value, column, column + 2, layout, after_dash=True)
    key = format_inline_text(member.key)
    return f"{lead}{key}:" + format_value(member.value, column, column + len(key) + 2, layout)


def format_document(wish: TargetNode, layout: YamlStyle) -> str:
    """A whole file."""
    assert isinstance(wish, TargetCollection)
    return "\n".join(_pair_lines(wish, 0, layout)) + "\n"


def format_flow(wish: TargetNode) -> str:
    """A value in one line, collections in brackets."""
    if isinstance(wish, TargetScalar):
        return wish.text if wish.is_plain else format_inline_text(wish.text, in_flow=True)
    assert isinstance(wish, TargetCollection), "what is kept is not written"
    parts = [format_flow_member(member) for member in wish.members]
    return "{" + ", ".join(parts) + "}" if wish.is_mapping else "[" + ", ".join(parts) + "]"


def format_flow_member(member: TargetMember) -> str:
    """A pair or item inside brackets."""
    value = format_flow(member.value)
    return value if member.key is None else f"{format_inline_text(member.key, in_flow=True)}: {value}"


def _pair_lines(wish: TargetCollection, column: int, layout: YamlStyle) -> list[str]:
    return [format_member(member, column, layout) for member in wish.members]


def _fits_line(wish: TargetCollection, used: int) -> bool:
    if not wish.members:
        return True
    return _may_be_flow(wish) and not has_multiline_text(wish) and used + len(format_flow(wish)) <= wish.flow_width


def _may_be_flow(wish: TargetCollection) -> bool:
    inner = (
        member.value for member in wish.members if isinstance(member.value, TargetCollection) and member.value.members
    )
    return wish.flow_width > 0 and all(_may_be_flow(each) for each in inner)


def _format_scalar(word: TargetScalar, column: int, layout: YamlStyle) -> str:
    if word.is_plain:
        return word.text
    block = format_block_text(word.text, layout.indent_width, folded=False) if "\n" in word.text else None
    if block is None:
        return format_inline_text(word.text)
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
    """Words in lines of readable length, None when folding would not give the same text again."""
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
