"""Patches with edits of generated files that no design can express: their names, paths, and which are still open."""

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from itertools import count
from pathlib import Path

from vicode.findings import Finding, SourceLocation, get_rule
from vicode.generators import GENERATORS

_SIGNATURE = "Written by vicode sync"
_HUNK = re.compile(r"^@@ .*@@.*\n", re.MULTILINE)
_FILE = re.compile(r"^\+\+\+ b/(.*)$", re.MULTILINE)


def patch_root(folder: Path, project_folder: Path | None) -> Path:
    """The folder from which `git apply` accepts the patches of a folder of generated files.

    It is the folder of the project, or the first one above that contains both.
    """
    if project_folder is None:
        return folder
    root = Path(os.path.commonpath([folder.resolve(), project_folder.resolve()]))
    return folder if root == root.parent else root


def format_patch(patch: str, path: str, design: str) -> str:
    """A patch after lines that say what it is, which programs that apply patches skip."""
    return (
        f"{_SIGNATURE}: edits of {path} that {design} cannot express.\n"
        "Write them into the design by hand, then delete this file.\n\n" + patch
    )


def name_patches(folder: Path, patches: Mapping[str, str]) -> dict[str, str]:
    """The patches by the paths of free files next to the generated ones; a file with the same patch is used again."""
    return {_free_name(folder, path, text): text for path, text in patches.items()}


def _free_name(folder: Path, path: str, text: str) -> str:
    names = (f"{path}.{number}.patch" if number > 1 else f"{path}.patch" for number in count(1))
    return next(name for name in names if not (folder / name).exists() or _read(folder / name) == text)


def find_patches(folder: Path, shown: str = "") -> Iterator[Finding]:
    """Yield a finding for each patch in a folder of generated files whose edits the file does not contain."""
    for file in sorted(file for language in GENERATORS for file in (folder / language).rglob("*.patch")):
        text = _read(file)
        if text.startswith(_SIGNATURE) and not _is_applied(text, file):
            name = file.relative_to(folder).as_posix()
            yield describe_patch(f"{shown}/{name}" if shown else name)


def describe_patch(file: str) -> Finding:
    return Finding(
        rule=get_rule("G506"),
        message="the program does not contain the edits in this patch",
        fix="write them into the design by hand, then delete the patch",
        location=SourceLocation(file=file, line=1, column=1),
    )


def _is_applied(patch: str, file: Path) -> bool:
    """Whether the generated file contains the result of each part of its patch."""
    target = _FILE.search(patch)
    if target is None:
        return False
    lines = _read(file.with_name(target[1].rpartition("/")[2])).split("\n")
    return all(_contains(lines, _new_lines(hunk)) for hunk in _HUNK.split(patch)[1:])


def _new_lines(hunk: str) -> list[str]:
    return [line[1:] for line in hunk.split("\n") if line[:1] in (" ", "+")]


def _contains(lines: list[str], part: Iterable[str]) -> bool:
    wanted = list(part)
    return any(lines[at : at + len(wanted)] == wanted for at in range(len(lines) - len(wanted) + 1))


def _read(path: Path) -> str:
    try:
        return path.read_text("utf-8", errors="backslashreplace")
    except OSError:
        return ""
