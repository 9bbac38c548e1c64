"""The Python side of a code editor's aid: answers what may be written, and sends the marks to show."""

from collections.abc import Callable, Iterable
from dataclasses import asdict
from typing import Any

from nicegui import ui
from nicegui.events import GenericEventArguments

from vicode.editor.js_modules import CODE_JS
from vicode.editor.session.code_marks import CodeMark
from vicode.editor.session.completion import CompletionResult

_MAX_TEXT_LENGTH = 200_000


Complete = Callable[[str, int], CompletionResult]
"""What may be written in a text at a character."""


class CodeAssist(ui.element, component=CODE_JS / "vicode_code.js"):
    """Stands beside a code editor and helps who writes in it; it shows nothing itself.

    Args:
        editor: the code editor.
        label: its name for screen readers.
        complete: answers what may be written; None for an editor that asks nobody.
        is_expression: coloured as an expression, and left by Tab like any field.
        hint: shown while it is empty.
        on_line_selected: called with the line that was clicked or reached by keyboard in it; None if nobody wants to know.
    """

    def __init__(
        self,
        editor: ui.codemirror,
        *,
        label: str,
        complete: Complete | None = None,
        is_expression: bool = False,
        hint: str = "",
        on_line_selected: Callable[[int], None] | None = None,
    ) -> None:
        super().__init__()
        self._complete, self._on_line_selected = complete, on_line_selected
        self._sent_marks: object = None
        self._is_mounted = False
        self._pending_calls: dict[str, tuple[object, ...]] = {}
        self.props["editor"] = editor.id
        self.props["options"] = {
            "label": label,
            "completes": complete is not None,
            "isExpression": is_expression,
            "hint": hint,
            "reportsLine": on_line_selected is not None,
        }
        # Handlers added after the first rendering would make NiceGUI mount the element anew.
        self.on("ready", self._on_ready)
        self.on("complete", self._on_complete)
        self.on("line", self._on_line_event)

    def show_marks(self, text: str, marks: Iterable[CodeMark]) -> None:
        """Underline characters of a text; nothing is shown if something else stands in the editor by then."""
        rows = [asdict(mark) for mark in marks]
        if (text, rows) != self._sent_marks:
            self._sent_marks = (text, rows)
            self._call("showMarks", text, rows)

    def highlight_lines(self, first: int, last: int, *, reveal: bool = True) -> None:
        """Bring lines forward, counted from 1, and scroll to them; none for 0."""
        self._call("highlightLines", first, last, reveal)

    def set_line_styles(self, lines: Iterable[tuple[int, str]]) -> None:
        """Give lines a style class and take it from all others: pairs of a line and a class."""
        self._call("setLineStyles", [list(each) for each in lines])

    def go_to(self, start: int) -> None:
        """Put the cursor to a character, and the focus into the editor."""
        self._call("goTo", start)

    def _call(self, method: str, *arguments: object) -> None:
        # Before it is mounted a call would be lost; only the newest of its kind counts.
        if self._is_mounted:
            self.run_method(method, *arguments)
        else:
            self._pending_calls[method] = arguments

    def _on_ready(self) -> None:
        self._is_mounted = True
        for method, arguments in self._pending_calls.items():
            self.run_method(method, *arguments)

    def _on_complete(self, event: GenericEventArguments) -> None:
        number, text, offset = _parse_request(event.args)
        answer: dict[str, Any] = {"start": offset, "options": []}
        if self._complete is not None and len(text) <= _MAX_TEXT_LENGTH:
            found = self._complete(text, offset)
            answer = {"start": found.start, "options": [asdict(option) for option in found.options]}
        self.run_method("answer", number, answer)

    def _on_line_event(self, event: GenericEventArguments) -> None:
        if self._on_line_selected is not None and isinstance(event.args, int):
            self._on_line_selected(event.args)


def _parse_request(payload: Any) -> tuple[int, str, int]:
    """A question of a browser, in which nothing is trusted."""
    wanted = payload if isinstance(payload, dict) else {}
    number, text, offset = wanted.get("number"), wanted.get("text"), wanted.get("offset")
    whole = text if isinstance(text, str) else ""
    at = offset if isinstance(offset, int) else 0
    return (number if isinstance(number, int) else 0, whole, max(0, min(at, len(whole))))
