"""Adds, changes and removes comments of one file."""

from collections.abc import Mapping, Sequence
from difflib import SequenceMatcher

from vicode.xabsl.patching.doc_edits import Span
from vicode.xabsl.patching.source_edits import SourceEdits
from vicode.xabsl.tokens import DOC

Lines = tuple[str, ...]


def remove_comment(file: SourceEdits, span: Span) -> None:
    """Remove a comment, with its lines if nothing else is in them."""
    text, (start, end) = file.text, span
    line, newline = text.rfind("\n", 0, start) + 1, text.find("\n", end)
    after = len(text) if newline < 0 else newline
    if text[end:after].strip():
        file.delete(start, end + len(text[end:after]) - len(text[end:after].lstrip(" \t")))
    elif text[line:start].strip():
        file.delete(len(text[:start].rstrip(" \t")), end)
    else:
        file.delete(line, after if newline < 0 else newline + 1)


def rewrite_comment(file: SourceEdits, span: Span, old: Sequence[str], new: Sequence[str]) -> None:
    """Change the lines of a comment; its markers and the lines that stay keep their form."""
    raw = file.text[slice(*span)]
    if raw.startswith("//"):
        mark = raw[: len(raw) - len(raw.lstrip("/"))]
        first = raw.replace(old[0], new[0]) if old[0] in raw else f"{mark} {new[0]}"
        indent = file.indent_at(span[0])
        file.replace(*span, f"\n{indent}".join([first, *(f"// {line}" for line in new[1:])]))
        return
    safe = [line.replace("*/", "* /") for line in new]
    lines = _edited_block(raw.replace("\r\n", "\n").split("\n"), old, safe)
    if lines is not None:
        file.replace(*span, "\n".join(lines))
    elif raw.startswith("/***"):
        file.replace(*span, header_text(new))
    else:
        indent = file.indent_at(span[0])
        file.replace(*span, f"\n{indent}".join(["/*", *(f"   {line}" for line in safe), "*/"]))


def _edited_block(raw: Sequence[str], old: Sequence[str], new: Sequence[str]) -> list[str] | None:
    """The lines of a block comment with the new text; None if its lines cannot be mapped to the old text."""
    places = [index for index, line in enumerate(raw) if line.strip().strip("*/").strip()]
    if len(places) != len(old) or any(text.strip() not in raw[at] for at, text in zip(places, old, strict=True)):
        return None
    lines: list[str | None] = list(raw)
    behind: dict[int, list[str]] = {}
    for tag, first, last, new_first, new_last in SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
        if tag == "equal":
            continue
        pairs = min(last - first, new_last - new_first)
        for number in range(pairs):
            at, text = places[first + number], old[first + number].strip()
            head, _text, tail = raw[at].partition(text)
            lines[at] = head + new[new_first + number].strip() + tail
        for number in range(first + pairs, last):
            if places[number] in (0, len(raw) - 1):
                return None
            lines[places[number]] = None
        if new_last > new_first + pairs:
            above = first + pairs - 1
            if above < 0 or places[above] in (0, len(raw) - 1):
                return None
            margin = _margin(raw[places[above]], old[above])
            behind[places[above]] = [margin + line for line in new[new_first + pairs : new_last]]
    return [each for at, line in enumerate(lines) for each in ([line] if line is not None else []) + behind.get(at, [])]


def _margin(raw: str, text: str) -> str:
    """What precedes a line of a comment in the file."""
    margin = raw.partition(text.strip())[0].expandtabs(4)
    return margin[: len(margin) - (len(text) - len(text.lstrip()))]


def insert_above(file: SourceEdits, token: int, comments: Sequence[str]) -> None:
    """Write comments above a token, or above the `else` before it."""
    start = file.start(comment_token(file, token))
    indent = file.indent_at(start)
    if file.is_first_in_line(start):
        file.insert(start - len(indent), "".join(f"{indent}{comment}\n" for comment in comments))
        return
    indent += "\t" if "\t" in indent else "  "
    file.replace(
        len(file.text[:start].rstrip(" \t")),
        start,
        "".join(f"\n{indent}{comment}" for comment in comments) + f"\n{indent}",
    )


def comment_token(file: SourceEdits, token: int) -> int:
    """The token that comments above a token precede: the `else` before a decision, and its description."""
    kinds = file.tokens.kinds
    if token and kinds[token - 1] == "else":
        token -= 1
        if kinds[token - 1] == DOC:
            token -= 1
    return token


def insert_beside(file: SourceEdits, span: Span, comments: Sequence[str], *, is_after: bool) -> None:
    """Write comments in the lines before or after a comment that is the first text in its line."""
    indent = file.indent_at(span[0])
    if is_after:
        rest = file.text[span[1] :].split("\n", 1)[0]
        code = len(rest) - len(rest.lstrip(" \t"))
        lines = "".join(f"\n{indent}{comment}" for comment in comments)
        if rest.strip():
            file.replace(span[1], span[1] + code, f"{lines}\n{indent}")
        else:
            file.insert(span[1], lines)
    else:
        file.insert(span[0], "".join(f"{comment}\n{indent}" for comment in comments))


def insert_header(file: SourceEdits, lines: Sequence[str]) -> None:
    """Write a comment at the start of the file."""
    file.insert(len(file.text) - len(file.text.lstrip("\ufeff")), f"{header_text(lines)}\n")


def header_text(lines: Sequence[str]) -> str:
    return "\n".join(["/***", *(line.replace("*/", "* /") for line in lines), "*/"])


def formatted_comments(lines: Sequence[str], originals: Mapping[Lines, str]) -> list[str]:
    """The comments with these lines; those that the file had before keep their form."""
    comments, position = [], 0
    while position < len(lines):
        ends = range(len(lines), position, -1)
        known = next((end for end in ends if tuple(lines[position:end]) in originals), None)
        end = known or position + 1
        comments.append(originals[tuple(lines[position:end])] if known else f"// {lines[position]}".rstrip())
        position = end
    return comments
