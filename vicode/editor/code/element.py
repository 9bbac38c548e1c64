"""Python side of the code editor extensions: sends marks and line styles."""

from collections.abc import Callable, Iterable
from dataclasses import asdict, replace

from nicegui import ui
from nicegui.events import GenericEventArguments

from vicode.editor.js_modules import CODE_JS
from vicode.editor.session.code.code_marks import CodeMark


class CodeAssist(ui.element, component=CODE_JS / "vicode_code.js"):
    """Invisible element that extends a code editor with marks and line styles.

    Args:
        editor: the code editor.
        label: its accessible name.
        on_line_selected: called with the line number when the user moves the cursor.
    """

    def __init__(
        self,
        editor: ui.codemirror,
        *,
        label: str,
        on_line_selected: Callable[[int], None] | None = None,
    ) -> None:
        super().__init__()
        self._on_line_selected = on_line_selected
        self._sent_marks: object = None
        self._is_mounted = False
        self._pending_calls: dict[str, tuple[object, ...]] = {}
        self.props["editor"] = editor.id
        self.props["options"] = {
            "label": label,
            "completes": False,
            "reportsLine": on_line_selected is not None,
        }
        # NiceGUI remounts an element when handlers are added after its first rendering.
        self.on("ready", self._on_ready)
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

    def _on_line_event(self, event: GenericEventArguments) -> None:
        if self._on_line_selected is not None and isinstance(event.args, int):
            self._on_line_selected(event.args)
