"""Reads files in which git left conflict markers."""

import re

_OURS = re.compile(r"<{7}(?: |$)")
_BASE = re.compile(r"\|{7}(?: |$)")
_MIDDLE = re.compile(r"={7}$")
_THEIRS = re.compile(r">{7}(?: |$)")


def split_sides(text: str) -> tuple[str, str] | None:
    """The texts of both sides of a merge, None if the text has no conflict markers or they do not match."""
    sides: tuple[list[str], list[str]] = ([], [])
    part, conflicts = "both", 0
    for line in text.replace("\r\n", "\n").split("\n"):
        if _OURS.match(line) and part == "both":
            part, conflicts = "ours", conflicts + 1
        elif _BASE.match(line) and part == "ours":
            part = "base"
        elif _MIDDLE.match(line) and part in ("ours", "base"):
            part = "theirs"
        elif _THEIRS.match(line) and part == "theirs":
            part = "both"
        else:
            if part in ("both", "ours"):
                sides[0].append(line)
            if part in ("both", "theirs"):
                sides[1].append(line)
    if not conflicts or part != "both":
        return None
    return "\n".join(sides[0]), "\n".join(sides[1])
