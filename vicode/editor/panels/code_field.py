"""Fields for what is written in Python or as expressions: coloured, completed, with every mistake at its characters."""

from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from nicegui import ui
from nicegui.events import CodeMirrorFocusChangeEventArguments

from vicode.editor.code import CodeAid
from vicode.editor.panels.desk import Desk
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.fields import Bound, Field
from vicode.editor.panels.rows import icon_button
from vicode.editor.session.completing import (
    Completion,
    complete_expression,
    complete_pairs,
    complete_python,
)
from vicode.editor.session.marking import Mark, marks_of_pairs, marks_of_text
from vicode.findings import Path
from vicode.model.design import Declaration

_SHOWN_MESSAGES = 6
_TELL_LAST = """
const text = getElement({large})?.editor?.state.doc.toString();
if (text !== undefined) emitEvent("typed-and-left", {{ number: {small}, text }});
return true;
"""
_LONGEST_S = 5


@dataclass(frozen=True, slots=True, kw_only=True)
class Writing:
    """What is written in a field: what completes it, where its mistakes are, how it looks."""

    complete: Callable[[str, int], Completion]
    mark: Callable[[str], Sequence[Mark]]
    style: str
    is_expression: bool = True
    lint_path: Path = ()


def code_field(desk: Desk, bound: Bound) -> Field:
    """Python code; `bound.path` leads to its texts by language."""
    path = (*bound.path, "python") if bound.path[-1:] == ("code",) else bound.path
    lint_path = (*bound.path, "python")
    writing = Writing(
        complete=lambda text, at: complete_python(desk.workspace.project, desk.design, text, at),
        mark=lambda text: marks_of_text(text, path, desk.document.findings, desk.lints.of(lint_path, text)),
        style="code-field",
        is_expression=False,
        lint_path=lint_path,
    )
    return _build(desk, bound, writing)


def expression_field(desk: Desk, bound: Bound) -> Field:
    """One expression, in as many lines as it needs."""
    writing = Writing(
        complete=lambda text, at: complete_expression(desk.workspace.project, desk.design, text, at),
        mark=lambda text: marks_of_text(text, bound.path, desk.document.findings),
        style="code-field expression-field",
    )
    return _build(desk, bound, writing)


def pairs_field(desk: Desk, bound: Bound, settable: Callable[[], Iterable[Declaration]]) -> Field:
    """Lines `name = expression`; `settable` are what the names may be."""
    writing = Writing(
        complete=lambda text, at: complete_pairs(desk.workspace.project, desk.design, settable(), text, at),
        mark=lambda text: marks_of_pairs(text, bound.path, desk.document.findings),
        style="code-field expression-field",
    )
    return _build(desk, bound, writing)


def _build(desk: Desk, bound: Bound, writing: Writing, *, is_large: bool = False) -> "CodeField":
    made: list[CodeField] = []

    def focus(event: CodeMirrorFocusChangeEventArguments) -> None:
        for code in made:
            code.focus(has_focus=event.focused)

    with ui.column().classes("field"):
        with ui.row().classes("field-head"):
            if not is_large:
                ui.label(bound.label).classes("field-label")
                icon_button("open_in_full", f"Enlarge: {bound.label}", lambda: _enlarge(made[0], writing))
        editor = desk.code_editors.make(on_focus=focus, language=None if writing.is_expression else "Python")
        editor.classes(writing.style + (" is-large" if is_large else ""))
        aid = CodeAid(
            editor,
            label=bound.label,
            complete=writing.complete,
            is_expression=writing.is_expression,
            hint=bound.hint,
        )
        messages = ui.column().classes("field-messages").props('role="status"')
    made.append(CodeField(desk, bound, editor, writing=writing, aid=aid, messages=messages))
    return made[0]


def _enlarge(small: Field, writing: Writing) -> None:
    """The same text in a wide editor; both follow each other, as long as there is a place for it."""
    desk, bound = small.desk, small.bound
    with titled_dialog(bound.label, "code-dialog") as dialog:
        large = _build(desk, bound, writing, is_large=True)
        with ui.row().classes("dialog-buttons"):
            ui.button("Close", on_click=dialog.close).props("flat no-caps")

    def follow() -> None:
        if large.leads_there():
            large.refresh()
            return
        stop()
        desk.say("Somebody else removed, renamed or moved what this code belongs to", "warning")
        large.is_closing = True
        # What was typed till now belongs to where the code is by now, if it is anywhere.
        small.go_on_from(large)
        desk.begin(tell_last(), "last words")

    async def tell_last() -> None:
        with suppress(TimeoutError):
            script = _TELL_LAST.format(small=small.element.id, large=large.element.id)
            await dialog.client.run_javascript(script, timeout=_LONGEST_S)
        dialog.close()

    def close() -> None:
        stop()
        dialog.delete()

    stop = desk.listen(follow)
    dialog.on("hide", close)


@dataclass(eq=False)
class CodeField(Field):
    """A code editor with its aid; the messages below it can be read, and followed, without a mouse.

    While somebody types nothing of the editor element itself may be changed from here, not even a class: NiceGUI
    sends its value along, which is older than what stands in the browser. The aid sends marks, and nothing else.
    """

    writing: Writing = field(kw_only=True)
    aid: CodeAid = field(kw_only=True)
    messages: ui.column = field(kw_only=True)
    is_closing: bool = False
    """Whether its dialog is about to close: what is typed here is taken over another way."""
    _shown: object = None

    def __post_init__(self) -> None:
        """Watch for typing; the editor tells its focus in a way of its own."""
        self.element.on_value_change(lambda event: self._typed(event.value))
        if self.writing.lint_path:
            self.desk.lints.follow(self)
        self.refresh()

    @property
    def is_gone(self) -> bool:
        """Whether the form it stood in was built anew."""
        return self.element.is_deleted

    def refresh(self) -> None:
        """Show what the design holds, and what is wrong with it."""
        super().refresh()
        if self.is_gone:
            return
        text = str(self.element.value or "")
        marks = tuple(self.writing.mark(text))
        self.aid.show_marks(text, marks)
        if (marks, self.refused) != self._shown:
            self._shown = (marks, self.refused)
            self._tell(marks, is_long="\n" in text.rstrip("\n"))

    def _typed(self, value: Any) -> None:
        if not self.is_closing:
            super()._typed(value)

    def _tell(self, marks: tuple[Mark, ...], *, is_long: bool) -> None:
        self.messages.clear()
        with self.messages:
            if self.refused:
                ui.label(self.refused).classes("field-finding")
            for mark in marks[:_SHOWN_MESSAGES]:
                self._message(mark, f"Line {mark.line}: " if is_long else "")
            if len(marks) > _SHOWN_MESSAGES:
                ui.label(f"and {len(marks) - _SHOWN_MESSAGES} more").classes("empty")

    def _message(self, mark: Mark, line: str) -> None:
        button = ui.element("button").classes(f"field-message {mark.severity}").props('type="button"')
        with button:
            ui.label(f"{line}{mark.message}")
        button.on("click", lambda: self.aid.go_to(mark.start))
