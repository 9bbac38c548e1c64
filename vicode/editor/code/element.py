"""Python side of the code editor extensions: answers completion requests and sends marks."""

from collections.abc import Callable, Iterable
from dataclasses import asdict, replace
from typing import Any

from nicegui import ui
from nicegui.events import GenericEventArguments

from vicode.editor.js_modules import CODE_JS
from vicode.editor.session.code_marks import CodeMark
from vicode.editor.session.completion import CompletionResult

_MAX_TEXT_LENGTH = 200_000


Complete = Callable[[str, int], CompletionResult]
"""Computes the completions of a text at a character offset."""


class CodeAssist(ui.element, component=CODE_JS / "vicode_code.js"):
    """Invisible element that extends a code editor with completion, marks and line styles.

    Args:
        editor: the code editor.
        label: its accessible name.
        complete: computes completions; None for an editor without completion.
        hint: placeholder of the empty editor.
        on_line_selected: called with the line number when the user moves the cursor.
    """

    def __init__(
        self,
        editor: ui.codemirror,
        *,
        label: str,
        complete: Complete | None = None,
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
            "hint": hint,
            "reportsLine": on_line_selected is not None,
        }
        # NiceGUI remounts an element when handlers are added after its first rendering.
        self.on("ready", self._on_ready)
        self.on("complete", self._on_complete)
        self.on("line", self._on_line_event)

    def show_marks(self, text: str, marks: Iterable[CodeMark]) -> None:
        """Underline characters of a text; ignored if the editor's text differs from `text`."""
        rows = [asdict(replace(mark, finding=None)) for mark in marks]
        if (text, rows) != self._sent_marks:
            self._sent_marks = (text, rows)
            self._call("showMarks", text, rows)

    def highlight_lines(self, first: int, last: int, *, reveal: bool = True) -> None:
        """Highlight lines, counted from 1, and scroll to them; `first=0` removes the highlight."""
        self._call("highlightLines", first, last, reveal)

    def set_line_styles(self, lines: Iterable[tuple[int, str]]) -> None:
        """Replace all line styles; `lines` are pairs of a line number and a CSS class."""
        self._call("setLineStyles", [list(line) for line in lines])

    def go_to(self, start: int) -> None:
        """Move the cursor to a character offset and focus the editor."""
        self._call("goTo", start)

    def _call(self, method: str, *arguments: object) -> None:
        # A call before mounting would be lost; only the latest call of each method counts.
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
            result = self._complete(text, offset)
            answer = {"start": result.start, "options": [asdict(option) for option in result.options]}
        self.run_method("answer", number, answer)

    def _on_line_event(self, event: GenericEventArguments) -> None:
        if self._on_line_selected is not None and isinstance(event.args, int):
            self._on_line_selected(event.args)


def _parse_request(payload: Any) -> tuple[int, str, int]:
    """Decode a completion request; every field is validated, since it comes from a browser."""
    request = payload if isinstance(payload, dict) else {}
    number, text, offset = request.get("number"), request.get("text"), request.get("offset")
    number = number if isinstance(number, int) else 0
    text = text if isinstance(text, str) else ""
    offset = offset if isinstance(offset, int) else 0
    return (number, text, max(0, min(offset, len(text))))
