"""The Python side of a code editor's aid: answers what may be written, and sends the marks to show."""

from collections.abc import Callable, Iterable
from dataclasses import asdict
from typing import Any

from nicegui import ui
from nicegui.events import GenericEventArguments

from vicode.editor.scripts import CODE
from vicode.editor.session.completing import Completion
from vicode.editor.session.marking import Mark

_LONGEST = 200_000


Complete = Callable[[str, int], Completion]
"""What may be written in a text at a character."""


class CodeAid(ui.element, component=CODE / "vicode_code.js"):
    """Stands beside a code editor and helps who writes in it; it shows nothing itself.

    Args:
        editor: the code editor.
        label: its name for screen readers.
        complete: answers what may be written; None for an editor that asks nobody.
        is_expression: coloured as an expression, and left by Tab like any field.
        hint: shown while it is empty.
        on_line: called with the line that was clicked or reached by keyboard in it; None if nobody wants to know.
    """

    def __init__(
        self,
        editor: ui.codemirror,
        *,
        label: str,
        complete: Complete | None = None,
        is_expression: bool = False,
        hint: str = "",
        on_line: Callable[[int], None] | None = None,
    ) -> None:
        super().__init__()
        self._complete, self._on_line = complete, on_line
        self._sent: object = None
        self._is_mounted = False
        self._waiting: dict[str, tuple[object, ...]] = {}
        self.props["editor"] = editor.id
        self.props["wishes"] = {
            "label": label,
            "asks": complete is not None,
            "isExpression": is_expression,
            "hint": hint,
            "tellsLines": on_line is not None,
        }
        # Handlers added after the first rendering would make NiceGUI mount the element anew.
        self.on("ready", self._hear_ready)
        self.on("complete", self._hear_complete)
        self.on("line", self._hear_line)

    def show_marks(self, text: str, marks: Iterable[Mark]) -> None:
        """Underline characters of a text; nothing is shown if something else stands in the editor by then."""
        rows = [asdict(mark) for mark in marks]
        if (text, rows) != self._sent:
            self._sent = (text, rows)
            self._call("showMarks", text, rows)

    def show_lines(self, first: int, last: int, *, reveal: bool = True) -> None:
        """Bring lines forward, counted from 1, and scroll to them; none for 0."""
        self._call("showLines", first, last, reveal)

    def show_regions(self, lines: Iterable[tuple[int, str]]) -> None:
        """Give lines a style class and take it from all others: pairs of a line and a class."""
        self._call("showStyles", [list(each) for each in lines])

    def go_to(self, start: int) -> None:
        """Put the cursor to a character, and the focus into the editor."""
        self._call("goTo", start)

    def _call(self, method: str, *arguments: object) -> None:
        # Before it is mounted a call would be lost; only the newest of its kind counts.
        if self._is_mounted:
            self.run_method(method, *arguments)
        else:
            self._waiting[method] = arguments

    def _hear_ready(self) -> None:
        self._is_mounted = True
        for method, arguments in self._waiting.items():
            self.run_method(method, *arguments)

    def _hear_complete(self, event: GenericEventArguments) -> None:
        number, text, offset = _question(event.args)
        answer: dict[str, Any] = {"start": offset, "options": []}
        if self._complete is not None and len(text) <= _LONGEST:
            found = self._complete(text, offset)
            answer = {"start": found.start, "options": [asdict(option) for option in found.options]}
        self.run_method("answer", number, answer)

    def _hear_line(self, event: GenericEventArguments) -> None:
        if self._on_line is not None and isinstance(event.args, int):
            self._on_line(event.args)


def _question(payload: Any) -> tuple[int, str, int]:
    """A question of a browser, in which nothing is trusted."""
    wanted = payload if isinstance(payload, dict) else {}
    number, text, offset = wanted.get("number"), wanted.get("text"), wanted.get("offset")
    whole = text if isinstance(text, str) else ""
    at = offset if isinstance(offset, int) else 0
    return (number if isinstance(number, int) else 0, whole, max(0, min(at, len(whole))))
