"""Fields for what is written in Python or as expressions: coloured, completed, with every mistake at its characters."""

from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from nicegui import ui
from nicegui.events import CodeMirrorFocusChangeEventArguments

from vicode.editor.code import CodeAssist
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.fields import Field, FieldBinding
from vicode.editor.panels.widgets import icon_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.code_marks import CodeMark, mark_assignments, mark_text
from vicode.editor.session.completion import (
    CompletionResult,
    complete_assignments,
    complete_expression,
    complete_python,
)
from vicode.findings import DesignPath
from vicode.model.design import Declaration

_SHOWN_MESSAGES = 6
_SEND_LAST_INPUT = """
const text = getElement({large})?.editor?.state.doc.toString();
if (text !== undefined) emitEvent("delayed-input", {{ number: {small}, text }});
return true;
"""
_ANSWER_TIMEOUT_S = 5


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeFieldSpec:
    """What is written in a field: what completes it, where its mistakes are, how it looks."""

    complete: Callable[[str, int], CompletionResult]
    find_marks: Callable[[str], Sequence[CodeMark]]
    css_class: str
    is_expression: bool = True
    lint_path: DesignPath = ()


def code_field(context: WindowContext, binding: FieldBinding) -> Field:
    """Python code; `bound.path` leads to its texts by language."""
    path = (*binding.path, "python") if binding.path[-1:] == ("code",) else binding.path
    lint_path = (*binding.path, "python")
    writing = CodeFieldSpec(
        complete=lambda text, at: complete_python(context.workspace.project, context.design, text, at),
        find_marks=lambda text: mark_text(
            text, path, context.document.findings, context.linter.lints_for(lint_path, text)
        ),
        css_class="code-field",
        is_expression=False,
        lint_path=lint_path,
    )
    return _build(context, binding, writing)


def expression_field(context: WindowContext, binding: FieldBinding) -> Field:
    """One expression, in as many lines as it needs."""
    writing = CodeFieldSpec(
        complete=lambda text, at: complete_expression(context.workspace.project, context.design, text, at),
        find_marks=lambda text: mark_text(text, binding.path, context.document.findings),
        css_class="code-field expression-field",
    )
    return _build(context, binding, writing)


def pairs_field(context: WindowContext, binding: FieldBinding, settable: Callable[[], Iterable[Declaration]]) -> Field:
    """Lines `name = expression`; `settable` are what the names may be."""
    writing = CodeFieldSpec(
        complete=lambda text, at: complete_assignments(context.workspace.project, context.design, settable(), text, at),
        find_marks=lambda text: mark_assignments(text, binding.path, context.document.findings),
        css_class="code-field expression-field",
    )
    return _build(context, binding, writing)


def _build(
    context: WindowContext, binding: FieldBinding, writing: CodeFieldSpec, *, is_large: bool = False
) -> "CodeField":
    made: list[CodeField] = []

    def focus(event: CodeMirrorFocusChangeEventArguments) -> None:
        for code in made:
            code.focus(has_focus=event.focused)

    with ui.column().classes("field"):
        with ui.row().classes("field-head"):
            if not is_large:
                ui.label(binding.label).classes("field-label")
                icon_button("open_in_full", f"Enlarge: {binding.label}", lambda: _enlarge(made[0], writing))
        editor = context.code_editors.create(on_focus=focus, language=None if writing.is_expression else "Python")
        editor.classes(writing.css_class + (" is-large" if is_large else ""))
        aid = CodeAssist(
            editor,
            label=binding.label,
            complete=writing.complete,
            is_expression=writing.is_expression,
            hint=binding.hint,
        )
        messages = ui.column().classes("field-messages").props('role="status"')
    made.append(CodeField(context, binding, editor, spec=writing, code_assist=aid, messages=messages))
    return made[0]


def _enlarge(small: Field, writing: CodeFieldSpec) -> None:
    """The same text in a wide editor; both follow each other, as long as there is a place for it."""
    desk, bound = small.context, small.binding
    with titled_dialog(bound.label, "code-dialog") as dialog:
        large = _build(desk, bound, writing, is_large=True)
        with ui.row().classes("dialog-buttons"):
            ui.button("Close", on_click=dialog.close).props("flat no-caps")

    def follow() -> None:
        if large.is_path_valid():
            large.refresh()
            return
        stop()
        desk.show_toast("Somebody else removed, renamed or moved what this code belongs to", "warning")
        large.is_closing = True
        # What was typed till now belongs to where the code is by now, if it is anywhere.
        small.transfer_input_from(large)
        desk.run_in_background(tell_last(), "last words")

    async def tell_last() -> None:
        with suppress(TimeoutError):
            script = _SEND_LAST_INPUT.format(small=small.element.id, large=large.element.id)
            await dialog.client.run_javascript(script, timeout=_ANSWER_TIMEOUT_S)
        dialog.close()

    def close() -> None:
        stop()
        dialog.delete()

    stop = desk.subscribe(follow)
    dialog.on("hide", close)


@dataclass(eq=False)
class CodeField(Field):
    """A code editor with its aid; the messages below it can be read, and followed, without a mouse.

    While somebody types nothing of the editor element itself may be changed from here, not even a class: NiceGUI
    sends its value along, which is older than what stands in the browser. The aid sends marks, and nothing else.
    """

    spec: CodeFieldSpec = field(kw_only=True)
    code_assist: CodeAssist = field(kw_only=True)
    messages: ui.column = field(kw_only=True)
    is_closing: bool = False
    """Whether its dialog is about to close: what is typed here is taken over another way."""
    _shown: object = None

    def __post_init__(self) -> None:
        """Watch for typing; the editor tells its focus in a way of its own."""
        self.element.on_value_change(lambda event: self._on_typed(event.value))
        if self.spec.lint_path:
            self.context.linter.subscribe(self)
        self.refresh()

    @property
    def is_deleted(self) -> bool:
        """Whether the form it stood in was built anew."""
        return self.element.is_deleted

    def refresh(self) -> None:
        """Show what the design holds, and what is wrong with it."""
        super().refresh()
        if self.is_deleted:
            return
        text = str(self.element.value or "")
        marks = tuple(self.spec.find_marks(text))
        self.code_assist.show_marks(text, marks)
        if (marks, self.error) != self._shown:
            self._shown = (marks, self.error)
            self._show_messages(marks, is_long="\n" in text.rstrip("\n"))

    def _on_typed(self, value: Any) -> None:
        if not self.is_closing:
            super()._on_typed(value)

    def _show_messages(self, marks: tuple[CodeMark, ...], *, is_long: bool) -> None:
        self.messages.clear()
        with self.messages:
            if self.error:
                ui.label(self.error).classes("field-finding")
            for mark in marks[:_SHOWN_MESSAGES]:
                self._message(mark, f"Line {mark.line}: " if is_long else "")
            if len(marks) > _SHOWN_MESSAGES:
                ui.label(f"and {len(marks) - _SHOWN_MESSAGES} more").classes("empty")

    def _message(self, mark: CodeMark, line: str) -> None:
        button = ui.element("button").classes(f"field-message {mark.severity}").props('type="button"')
        with button:
            ui.label(f"{line}{mark.message}")
        button.on("click", lambda: self.code_assist.go_to(mark.start))
