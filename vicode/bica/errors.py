"""What the runtime says when a component's own code fails.

Exception
├── ComponentError    a component raised and the root was told to stop
└── CyclicUseError    components use each other in a circle
"""

from __future__ import annotations

import linecache
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from types import FrameType

    from .component import Component

# Hand-editable bodies stand between marks in generated files; the first mark names the body.
_MARK = re.compile(r"\s*# <vicode (?P<id>\S+) ")
_BODIES = {
    "_in": "state",
    "_enter": "enter",
    "_leave": "leave",
    "_when": "guard",
    "_do": "action",
    "_decide": "common transitions",
    "_act": "common actions",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class ErrorRecord:
    """One exception in a component's own code, and the place it came from.

    `body` says which piece of the design failed: `state` (guards and actions written in the state's method),
    `enter`, `leave`, `guard`, `action`, `common transitions`, `common actions`, or a method's name.
    `line` counts from 1 within the marked `region` that holds the body, if there is one, else within the method
    from the line after its `def`; `file_line` within the file.
    """

    component: str
    design_file: str
    state: str
    body: str
    method: str
    region: str
    line: int
    file: str
    file_line: int
    message: str
    iteration: int
    time_ns: int

    @property
    def place(self) -> tuple[str, str, int]:
        """What makes two records the same mistake."""
        return (self.component, self.method, self.line)

    def __str__(self) -> str:
        design = f" ({self.design_file})" if self.design_file else ""
        state = f", state {self.state}" if self.state else ""
        body = self.body if self.body == self.method else f"{self.body} {self.region or self.method}"
        return (
            f"{self.component}{design}{state}, {body}, line {self.line}: {self.message} [{self.file}:{self.file_line}]"
        )


class ComponentError(Exception):
    """A component raised while its root stops on errors; `record` tells where."""

    def __init__(self, record: ErrorRecord) -> None:
        super().__init__(str(record))
        self.record = record


class CyclicUseError(Exception):
    """Components use each other in a circle, so none could be made first."""

    def __init__(self, names: tuple[str, ...]) -> None:
        super().__init__(f"components use each other in a circle: {' -> '.join(names)}")
        self.names = names


def make_error_record(component: Component, error: Exception) -> ErrorRecord:
    """Describe `error`, raised by code of `component`, with the innermost place in that component's own methods."""
    frame, file_line = _find_own_frame(component, error)
    code = frame.f_code
    region, line_before = find_region(code.co_filename, file_line, code.co_firstlineno)
    prefix = "_" + code.co_name.split("_")[1] if code.co_name.startswith("_") else ""
    return ErrorRecord(
        component=type(component).__name__,
        design_file=component.design_file,
        state=component.state,
        body=_BODIES.get(prefix, code.co_name),
        method=code.co_name,
        region=region,
        line=file_line - line_before,
        file=code.co_filename,
        file_line=file_line,
        message=describe_exception(error),
        iteration=component.root.iteration,
        time_ns=component.root.now_ns,
    )


def describe_exception(error: BaseException) -> str:
    """Say what was raised, in a line's words."""
    return f"{type(error).__name__}: {error}" if str(error) else type(error).__name__


def find_region(file: str, file_line: int, first_line: int = 0) -> tuple[str, int]:
    """Return the id of the marked region around a line and the line of its mark, else "" and `first_line`.

    Only what follows `first_line`, the `def` of a method, is looked at.
    """
    for number in range(file_line - 1, first_line, -1):
        mark = _MARK.match(linecache.getline(file, number))
        if mark is not None:
            return mark["id"], number
    return "", first_line


def _find_own_frame(component: Component, error: Exception) -> tuple[FrameType, int]:
    """Return the deepest frame of a method of `component` that is not the runtime's, or the deepest of all."""
    traceback = error.__traceback__
    assert traceback is not None
    found = (traceback.tb_frame, traceback.tb_lineno)
    own = None
    while traceback is not None:
        found = (traceback.tb_frame, traceback.tb_lineno)
        is_own = traceback.tb_frame.f_locals.get("self") is component
        if is_own and traceback.tb_frame.f_globals.get("__package__") != __package__:
            own = found
        traceback = traceback.tb_next
    return own or found
