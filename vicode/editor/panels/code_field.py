"""Fields for code and expressions, with highlighting, completion and marks at errors."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

from nicegui import ui
from nicegui.events import CodeMirrorFocusChangeEventArguments

from vicode.editor.code import CodeAssist
from vicode.editor.panels import texts
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.fields import Field, FieldBinding, add_field
from vicode.editor.panels.finding_navigation import fix_button
from vicode.editor.panels.form import Form
from vicode.editor.panels.open_in_editor import open_in_editor
from vicode.editor.panels.widgets import icon_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.code_marks import CodeMark, mark_text
from vicode.editor.session.completion import (
    CompletionResult,
    complete_expression,
    complete_python,
)
from vicode.editor.session.fixes import is_fixable
from vicode.languages import LANGUAGES

_SHOWN_MESSAGES = 6


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeFieldSpec:
    """The content type of a code field: completion and marks."""

    complete: Callable[[str, int], CompletionResult]
    find_marks: Callable[[str], Sequence[CodeMark]]
    mode: Literal["Python", "C++", "C"] = "Python"
    open_in_editor: Callable[[], None] | None = None


def code_field(form: Form, binding: FieldBinding, language: str = "python") -> Field:
    """Build a field for code in a language; the path of the binding leads to the texts by language."""
    context = form.context
    complete = complete_python if language == "python" else complete_expression

    def find_marks(text: str) -> Sequence[CodeMark]:
        path = binding.get_path()
        text_path = (*path, language)
        if language == "python":
            lints = context.linter.lints_for(text_path, text)
            return mark_text(text, text_path if path[-1:] == ("code",) else path, context.document.findings, lints)
        # A missing version is a finding about the code in all languages.
        missing = [
            replace(each, subject=replace(each.subject, path=text_path))
            for each in context.document.findings
            if each.rule.code == "D414" and language in each.languages and each.subject and each.subject.path == path
        ]
        return mark_text(text, text_path, (*context.document.findings, *missing))

    spec = CodeFieldSpec(
        complete=lambda text, at: complete(context.workspace.project, context.design, text, at),
        find_marks=find_marks,
        mode=LANGUAGES[language].editor_mode,
        open_in_editor=lambda: open_in_editor(context, binding.get_path(), language),
    )
    return add_field(form, _build(context, binding, spec))


def _build(
    context: WindowContext, binding: FieldBinding, spec: CodeFieldSpec, *, is_large: bool = False
) -> "CodeField":
    fields: list[CodeField] = []

    def focus(event: CodeMirrorFocusChangeEventArguments) -> None:
        for code in fields:
            code.focus(has_focus=event.focused)

    with ui.column().classes("field"):
        with ui.row().classes("field-head"):
            if not is_large:
                ui.label(binding.label).classes("field-label")
                ui.element("div").classes("spacer")
                if spec.open_in_editor is not None:
                    icon_button("open_in_new", f"Open in editor: {binding.label}", spec.open_in_editor)
                icon_button("open_in_full", f"Enlarge: {binding.label}", lambda: _enlarge(fields[0], spec))
        editor = context.code_editors.create(on_focus=focus, language=spec.mode)
        editor.classes("code-field" + (" is-large" if is_large else ""))
        code_assist = CodeAssist(
            editor,
            label=binding.label,
            complete=spec.complete,
            hint=binding.hint,
        )
        messages = ui.column().classes("field-messages").props('role="status"')
    fields.append(CodeField(context, binding, editor, spec=spec, code_assist=code_assist, messages=messages))
    return fields[0]


def _enlarge(small: Field, spec: CodeFieldSpec) -> None:
    """Open the text in a large editor. Both editors stay in sync until the path is removed."""
    context, binding = small.context, small.binding
    with titled_dialog(binding.label, "code-dialog") as dialog:
        large = _build(context, binding, spec, is_large=True)
        with ui.row().classes("dialog-buttons"):
            ui.button("Close", on_click=dialog.close).props("flat no-caps")

    path = large.path

    def unsubscribe() -> None:
        for stop in stops:
            stop()

    def follow() -> None:
        if large.is_path_valid() and large.path == path:
            large.refresh()
            return
        unsubscribe()
        context.show_toast(texts.CODE_OWNER_CHANGED, "warning")
        dialog.close()

    def close() -> None:
        unsubscribe()
        dialog.delete()

    stops = (context.changes.subscribe(follow), context.linter.changes.subscribe(large.refresh))
    dialog.on("hide", close)


@dataclass(eq=False)
class CodeField(Field):
    """A code editor with messages below it that can be read and followed with the keyboard.

    While the user types, the server must not change the editor element, not even a class: NiceGUI would send its
    value as well, which is older than the text in the browser. `CodeAssist` sends marks only.
    """

    spec: CodeFieldSpec = field(kw_only=True)
    code_assist: CodeAssist = field(kw_only=True)
    messages: ui.column = field(kw_only=True)
    _shown: object = None

    def __post_init__(self) -> None:
        """Subscribe to changes; the editor reports its focus through its own event."""
        self.element.on_value_change(lambda event: self.on_typed(event.value))
        self.refresh()

    def refresh(self) -> None:
        super().refresh()
        if self.messages.is_deleted:
            return
        text = str(self.element.value or "")
        marks = tuple(self.spec.find_marks(text))
        self.code_assist.show_marks(text, marks)
        if (marks, self.error) != self._shown:
            self._shown = (marks, self.error)
            self._show_messages(marks, is_long="\n" in text.rstrip("\n"))

    def _show_messages(self, marks: tuple[CodeMark, ...], *, is_long: bool) -> None:
        self.messages.clear()
        with self.messages:
            if self.error:
                ui.label(self.error).classes("field-finding")
            for mark in marks[:_SHOWN_MESSAGES]:
                self._message(mark, f"Line {mark.line}: " if is_long else "")
            if len(marks) > _SHOWN_MESSAGES:
                ui.label(texts.more(len(marks) - _SHOWN_MESSAGES)).classes("empty")

    def _message(self, mark: CodeMark, line: str) -> None:
        with ui.row().classes("field-message-row"):
            button = ui.element("button").classes(f"field-message {mark.severity}").props('type="button"')
            with button:
                ui.label(f"{line}{mark.message}")
            if mark.finding is not None and is_fixable(mark.finding):
                fix_button(self.context, mark.finding, "Quick fixes")
        button.on("click", lambda: self.code_assist.go_to(mark.start))
