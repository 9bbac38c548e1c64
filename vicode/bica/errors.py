"""Errors of the runtime, and the location of errors in the code of components.

Exception
├── ComponentError    a component raised an exception and the root stops on errors
├── CyclicUseError    components use each other in a cycle
└── OSError
    └── NetworkError  there is no connection to other robots
"""

from __future__ import annotations

import linecache
import re
import sys
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from types import FrameType

    from .component import Component

USER_ERRORS = (Exception, SystemExit)
"""What code of users raises; `sys.exit` in one component must not end the robot. Ctrl-C does."""

# Marks enclose the editable regions of generated files; the first mark contains the id of the region.
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
    """An exception in the code of a component, with its location.

    Attributes:
        component: The name of its class.
        design_file: The file of the design; "" for a hand-written component.
        state: The active state.
        method: The method that failed.
        file: The file of the code.
        message: The type and text of the exception.
        iteration: The number of the iteration.
        time_ns: The time of the iteration.
        body: The part of the design that failed: `state` (guards and actions in the method of the state), `enter`,
            `leave`, `guard`, `action`, `common transitions`, `common actions`, or the name of a method.
        region: The id of the region that contains the line, if any.
        line: Line in the region, or else in the body of the method, from 1.
        file_line: Line in the file, from 1.
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
        """Identifies the error: records with the same place are counted as one error."""
        return (self.component, self.method, self.line)

    def __str__(self) -> str:
        design = f" ({self.design_file})" if self.design_file else ""
        state = f", state {self.state}" if self.state else ""
        body = self.body if self.body == self.method else f"{self.body} {self.region or self.method}"
        return (
            f"{self.component}{design}{state}, {body}, line {self.line}: {self.message} [{self.file}:{self.file_line}]"
        )


class ComponentError(Exception):
    """A component raised an exception, and its root stops on errors; `record` is its `ErrorRecord`."""

    def __init__(self, record: ErrorRecord) -> None:
        super().__init__(str(record))
        self.record = record


class CyclicUseError(Exception):
    """Components use each other in a cycle, so no order of creation exists."""

    def __init__(self, names: tuple[str, ...]) -> None:
        super().__init__(f"components use each other in a cycle: {' -> '.join(names)}; remove one of these uses")
        self.names = names


class NetworkError(OSError):
    """There is no connection to other robots; the message says why."""


def make_error_record(component: Component, error: BaseException) -> ErrorRecord:
    """Create the record of an exception in `component`; it refers to the innermost frame in methods of `component`."""
    try:
        return _make_located_record(component, error)
    except USER_ERRORS:
        # The component continues even if its exception, its attributes or its source file cannot be read.
        return ErrorRecord(
            component=type(component).__name__,
            design_file="",
            state="",
            body="",
            method="",
            region="",
            line=0,
            file="",
            file_line=0,
            message=type(error).__name__,
            iteration=component.root.iteration,
            time_ns=component.root.now_ns,
        )


def describe_exception(error: BaseException) -> str:
    try:
        text = str(error)
    except USER_ERRORS as failure:
        text = f"its text cannot be read, {type(failure).__name__}"
    return f"{type(error).__name__}: {text}" if text else type(error).__name__


class OutputError(Exception):
    """An output of a run cannot be written: its trace, its record or the standard output."""


def escape_text(text: str) -> str:
    """Write control characters as `repr` does: a text from elsewhere cannot command a terminal or begin a line."""
    return text if text.isprintable() else "".join(each if each.isprintable() else repr(each)[1:-1] for each in text)


def print_error(message: str, *, kind: str = "error") -> None:
    """Write a message to standard error in one line; it is lost if standard error is missing, closed or broken."""
    with suppress(Exception):
        sys.stderr.write(f"{kind}: {escape_text(message)}\n")


def _make_located_record(component: Component, error: BaseException) -> ErrorRecord:
    frame, file_line = _find_component_frame(component, error)
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


def find_region(file: str, file_line: int, first_line: int = 0) -> tuple[str, int]:
    """Return the id of the region around a line and the line of its mark, or "" and `first_line` if there is none.

    The search starts after `first_line`, the `def` of the method.
    """
    for number in range(file_line - 1, first_line, -1):
        mark = _MARK.match(linecache.getline(file, number))
        if mark is not None:
            return mark["id"], number
    return "", first_line


def _find_component_frame(component: Component, error: BaseException) -> tuple[FrameType, int]:
    """Return the innermost frame of a method of `component` outside the runtime, or else the innermost frame.

    The generated class of a component of the world only calls the world, so without a design its methods count, too.
    """
    owners = (component,) if component.design_file or component.world is None else (component, component.world)
    traceback = error.__traceback__
    assert traceback is not None
    innermost = (traceback.tb_frame, traceback.tb_lineno)
    component_frame = None
    while traceback is not None:
        innermost = (traceback.tb_frame, traceback.tb_lineno)
        owner = traceback.tb_frame.f_locals.get("self")
        is_method = any(owner is each for each in owners)
        if is_method and traceback.tb_frame.f_globals.get("__package__") != __package__:
            component_frame = innermost
        traceback = traceback.tb_next
    return component_frame or innermost
