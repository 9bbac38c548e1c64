"""What a linter says of the Python in a design: the pieces stand in one module as they will when generated.

The linter reads that module from a pipe and runs no code of it; a map of lines brings its words back to the pieces.
"""

import json
import os
import subprocess
import textwrap
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

from vicode.check.code import validate_python
from vicode.findings import DesignPath
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.model.traversal import LocatedCode, iter_code

TIME_LIMIT_S = 2.0
_MAXIMUM_LENGTH = 400_000
_RULES = "F,E7,E9,B,PLE,W605"
# Code of one piece may use what another one imports, and a piece may be there to be continued.
_IGNORED = "F401,F811,B018"


@dataclass(frozen=True, slots=True, kw_only=True)
class LintWarning:
    """A remark about characters of one piece of code."""

    start: int
    end: int
    code: str
    message: str


@dataclass(frozen=True, slots=True, kw_only=True)
class _CodeBlock:
    """A piece of code in the module: where its lines begin there, and how far each was moved."""

    path: DesignPath
    text: str
    first: int
    shifts: tuple[int, ...]


@dataclass(slots=True)
class _Module:
    """The module as it grows."""

    lines: list[str] = field(default_factory=list)
    blocks: list[_CodeBlock] = field(default_factory=list)

    def add(self, placed: LocatedCode, text: str, indent: str) -> None:
        """Add a piece, indented, without the margin it has by itself."""
        lines = text.replace("\r\n", "\n").split("\n")
        straight = textwrap.dedent("\n".join(lines)).split("\n")
        shifts = tuple(len(indent) - (len(old) - len(new)) for old, new in zip(lines, straight, strict=True))
        path = (*placed.path, "python")
        self.blocks.append(_CodeBlock(path=path, text=text, first=len(self.lines), shifts=shifts))
        self.lines += [indent + line if line.strip() else "" for line in straight]


LintWarnings = Mapping[DesignPath, tuple[LintWarning, ...]]
Linter = Callable[[str, tuple[str, ...]], str]
"""Lints a module with further names that are known in it; the linter's JSON, empty if there is none."""


def lint_design(project: Project, design: Design, run: Linter | None = None) -> LintWarnings:
    """The remarks on every piece of Python in a design, by its path; none where the linter cannot be had."""
    module = _module_of(design)
    source = "\n".join(module.lines) + "\n"
    if not module.blocks or len(source) > _MAXIMUM_LENGTH:
        return {}
    known = [each.name for each in project.enumerations] + [each.name for each in project.constants]
    known += [use.component for use in design.uses] + ["arithmetic", "Component", "State", "Root"]
    found: dict[DesignPath, list[LintWarning]] = {}
    for row in _rows((run or run_ruff)(source, tuple(known))):
        for path, lint in _map_to_code(row, module):
            found.setdefault(path, []).append(lint)
    return {path: tuple(lints) for path, lints in found.items()}


def run_ruff(source: str, known: tuple[str, ...]) -> str:
    """Ask ruff about a text; it reads and writes no file and no configuration."""
    try:
        from ruff import find_ruff_bin  # noqa: PLC0415 - without it there are no remarks, but there is an editor

        command = [find_ruff_bin(), "check", "--isolated", "--no-cache", "--quiet", "--output-format=json"]
    except (ImportError, FileNotFoundError):
        return ""
    command += [f"--select={_RULES}", f"--ignore={_IGNORED}", f"--config=builtins={json.dumps(list(known))}"]
    command += ["--target-version=py311", "--stdin-filename=design.py", "-"]
    try:
        done = subprocess.run(
            command, input=source, capture_output=True, encoding="utf-8", errors="replace", timeout=TIME_LIMIT_S,
            check=False, env={"PATH": os.environ.get("PATH", "")},
        )  # fmt: skip
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return done.stdout


def _module_of(design: Design) -> _Module:
    """The code of a design as a module; what does not parse is left out, as a finding tells of it."""
    module = _Module()
    placed = [(each, each.code.in_language("python")) for each in iter_code(design)]
    sound = [(each, text) for each, text in placed if text is not None and validate_python(text, each.role) is None]
    for each, text in sound:
        if each.role == "module":
            module.add(each, text, "")
    module.lines += ["", "", f"class {_class_name(design)}:", "    pass", ""]
    for each, text in sound:
        if each.role == "members":
            module.add(each, text, "    ")
    for number, (each, text) in enumerate(sound):
        if each.role in ("action", "predicate"):
            module.lines += ["", f"    def _piece_{number}(self):", "        pass"]
            module.add(each, text, "        ")
    return module


def _class_name(design: Design) -> str:
    return design.component if design.component.isidentifier() else "Component"


def _rows(text: str) -> list[Mapping[str, object]]:
    try:
        rows = json.loads(text or "[]")
    except ValueError:
        return []
    return [row for row in rows if isinstance(row, dict)] if isinstance(rows, list) else []


def _map_to_code(row: Mapping[str, object], module: _Module) -> Iterator[tuple[DesignPath, LintWarning]]:
    """The remark at its characters of the piece it is about; what is about our own lines is nobody's."""
    begin, end = _point(row.get("location")), _point(row.get("end_location"))
    for piece in module.blocks:
        if begin is not None and piece.first <= begin[0] - 1 < piece.first + len(piece.shifts):
            start = _offset(piece, *begin)
            stop = _offset(piece, *end) if end is not None else start + 1
            code, message = str(row.get("code") or "E999"), str(row.get("message", ""))
            yield piece.path, LintWarning(start=start, end=max(start + 1, stop), code=code, message=message)
            return


def _point(place: object) -> tuple[int, int] | None:
    if not isinstance(place, dict):
        return None
    row, column = place.get("row"), place.get("column")
    return (row, column) if isinstance(row, int) and isinstance(column, int) else None


def _offset(piece: _CodeBlock, row: int, column: int) -> int:
    """The character of a piece for a row and a column, both from 1, of the module."""
    lines = piece.text.split("\n")
    at = min(row - 1 - piece.first, len(lines) - 1)
    inside = max(0, min(column - 1 - piece.shifts[at], len(lines[at])))
    return sum(len(line) + 1 for line in lines[:at]) + inside
