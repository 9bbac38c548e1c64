"""Joins all C++ files of a project into one header, for targets with one source file such as an Arduino sketch."""

import re
from collections.abc import Mapping, Sequence

from vicode.output import OutputFile

_INCLUDE = re.compile(r'#include "(?P<path>[^"]+)"')


def join_headers(files: Sequence[OutputFile]) -> str:
    """Return one header with the runtime, all headers and all sources of a project.

    Args:
        files: The C++ files of one project.
    """
    paths = ((file.path.partition("/")[2], file.text) for file in files if file.path.endswith((".hpp", ".cpp")))
    # A controller has no live view.
    texts = {path: text for path, text in paths if path.rpartition("/")[2] not in ("bica_live.hpp", "live.hpp")}
    (start,) = (path for path in texts if path.endswith("/components.hpp"))
    lines = ["#pragma once", ""]
    written: set[str] = set()
    _append(start, texts, written, lines)
    for path in texts:
        _append(path, texts, written, lines)
    header = texts[start].partition("\n")[0]
    return "\n".join([header, *lines]) + "\n"


def _append(path: str, texts: Mapping[str, str], written: set[str], lines: list[str]) -> None:
    """Append a file after those that it includes."""
    if path in written:
        return
    written.add(path)
    own = texts[path].rstrip("\n").split("\n")[1:]
    for line in own:
        match = _INCLUDE.fullmatch(line)
        if match and match["path"] in texts:
            _append(match["path"], texts, written, lines)
    kept = [line for line in own if line != "#pragma once" and not _is_local(line, texts)]
    lines += [f"// {path}", *kept, ""]


def _is_local(line: str, texts: Mapping[str, str]) -> bool:
    match = _INCLUDE.fullmatch(line)
    return match is not None and match["path"] in texts
