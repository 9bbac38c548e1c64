"""Lints the Python code in a design.

All code blocks are placed in one module, as in generated code. The linter reads the module from standard input without
running it; its warnings are mapped back to the blocks by line.
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
_MAX_LENGTH = 400_000
_RULES = "F,E7,E9,B,PLE,W605"
# A block may import a name for other blocks, and may be an unfinished expression.
_IGNORED = "F401,F811,B018"


@dataclass(frozen=True, slots=True, kw_only=True)
class LintWarning:
    """A warning about a range of characters in a code block."""

    start: int
    end: int
    code: str
    message: str


@dataclass(frozen=True, slots=True, kw_only=True)
class _CodeBlock:
    """A code block in the module: the index of its first line there, and the added indentation of each line."""

    path: DesignPath
    text: str
    first: int
    shifts: tuple[int, ...]


@dataclass(slots=True)
class _Module:
    """The lines of the module and the code blocks in it, both extended by `add`."""

    lines: list[str] = field(default_factory=list)
    blocks: list[_CodeBlock] = field(default_factory=list)

    def add(self, located: LocatedCode, text: str, indent: str) -> None:
        """Add a block with its indentation replaced by `indent`."""
        lines = text.replace("\r\n", "\n").split("\n")
        dedented = textwrap.dedent("\n".join(lines)).split("\n")
        shifts = tuple(len(indent) - (len(old) - len(new)) for old, new in zip(lines, dedented, strict=True))
        path = (*located.path, "python")
        self.blocks.append(_CodeBlock(path=path, text=text, first=len(self.lines), shifts=shifts))
        self.lines += [indent + line if line.strip() else "" for line in dedented]


LintWarnings = Mapping[DesignPath, tuple[LintWarning, ...]]
Linter = Callable[[str, tuple[str, ...]], str]
"""Lints a module with additional builtin names; returns the linter's JSON, empty if no linter is available."""


def lint_design(project: Project, design: Design, run: Linter | None = None) -> LintWarnings:
    """The warnings about each Python block of a design, by path; empty if no linter is available."""
    module = _module_of(design)
    source = "\n".join(module.lines) + "\n"
    if not module.blocks or len(source) > _MAX_LENGTH:
        return {}
    known = [enumeration.name for enumeration in project.enumerations] + [
        constant.name for constant in project.constants
    ]
    known += [use.component for use in design.uses] + ["arithmetic", "Component", "State", "Root"]
    found: dict[DesignPath, list[LintWarning]] = {}
    for row in _rows((run or run_ruff)(source, tuple(known))):
        for path, lint in _map_to_code(row, module):
            found.setdefault(path, []).append(lint)
    return {path: tuple(lints) for path, lints in found.items()}


def run_ruff(source: str, known: tuple[str, ...]) -> str:
    """Lint a text with ruff, isolated from files and configuration."""
    try:
        from ruff import find_ruff_bin  # noqa: PLC0415 - optional: the editor works without it

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
    """The code of a design as a module, without blocks that do not parse: those are findings."""
    module = _Module()
    blocks = [(located, located.code.in_language("python")) for located in iter_code(design)]
    sound = [(code, text) for code, text in blocks if text is not None and validate_python(text, code.role) is None]
    for code, text in sound:
        if code.role == "module":
            module.add(code, text, "")
    module.lines += ["", "", f"class {_class_name(design)}:", "    pass", ""]
    for code, text in sound:
        if code.role == "members":
            module.add(code, text, "    ")
    for number, (code, text) in enumerate(sound):
        if code.role in ("action", "predicate"):
            module.lines += ["", f"    def _block_{number}(self):", "        pass"]
            module.add(code, text, "        ")
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
    """The warning at its range in a block; warnings about lines between blocks are dropped."""
    begin, end = _position(row.get("location")), _position(row.get("end_location"))
    for block in module.blocks:
        if begin is not None and block.first <= begin[0] - 1 < block.first + len(block.shifts):
            start = _offset(block, *begin)
            stop = _offset(block, *end) if end is not None else start + 1
            code, message = str(row.get("code") or "E999"), str(row.get("message", ""))
            yield block.path, LintWarning(start=start, end=max(start + 1, stop), code=code, message=message)
            return


def _position(location: object) -> tuple[int, int] | None:
    if not isinstance(location, dict):
        return None
    row, column = location.get("row"), location.get("column")
    return (row, column) if isinstance(row, int) and isinstance(column, int) else None


def _offset(block: _CodeBlock, row: int, column: int) -> int:
    """The offset in a block of a row and column of the module, both from 1."""
    lines = block.text.split("\n")
    index = min(row - 1 - block.first, len(lines) - 1)
    offset = max(0, min(column - 1 - block.shifts[index], len(lines[index])))
    return sum(len(line) + 1 for line in lines[:index]) + offset
