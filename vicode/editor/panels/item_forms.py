"""Forms that the browser draws: sends what they show, applies their edits, and answers their requests."""

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from vicode.editor.inspector import FormView
from vicode.editor.inspector.protocol import (
    ApplyFix,
    CompleteText,
    FocusField,
    FormEvent,
    ListFixes,
    OpenCode,
    SelectItem,
    ShowLanguage,
)
from vicode.editor.panels import texts
from vicode.editor.panels.finding_navigation import apply_fix
from vicode.editor.panels.open_in_editor import open_in_editor
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.completion import CompletionResult, complete_expression, complete_python
from vicode.editor.session.fixes import find_fixes
from vicode.editor.session.forms.edits import FormEdit, TextEdit, item_path
from vicode.editor.session.forms.form_data import Forms, item_form, option_lists
from vicode.editor.session.forms.marks import field_path, finding_path, marks_of, note_at
from vicode.editor.session.rebase import rebase_selection
from vicode.editor.view import ItemRef, item_at_path
from vicode.findings import DesignPath
from vicode.model.design import Design

_MAX_TEXT_LENGTH = 200_000


class ItemForms:
    """The forms of one window."""

    def __init__(self, context: WindowContext) -> None:
        self.context = context
        self._shown: tuple[Design, Forms] = (context.design, {})
        self.view = FormView(self._edit, self._handle, self._on_malformed)
        context.linter.changes.subscribe(lambda: None if self.view.is_deleted else self.refresh())

    def _on_malformed(self, reason: str) -> None:
        self.context.show_toast(texts.invalid_event(reason), "warning")

    def refresh(self) -> None:
        """Send what has changed, and the selection."""
        context = self.context
        forms = context.document.shared.forms(context.workspace.project)
        data = {
            "rev": context.document.rev,
            "forms": forms,
            "marks": self._marks(),
            "lists": option_lists(context.design),
            "language": context.code_language,
        }
        self.view.show(data, self._find_moved(forms))
        self._shown = (context.design, forms)
        self.view.select(context.selected, context.selection_seq)
        if context.is_opening and context.single_selection is not None:
            context.is_opening = False
            self.view.open(context.single_selection)

    def _find_moved(self, forms: Forms) -> dict[str, str]:
        """The new keys of items whose forms changed their places."""
        design, before = self._shown
        if design is self.context.design:
            return {}
        moved = {}
        for key, text in before.items():
            if forms.get(key) == text:
                continue
            kind, _slash, id_ = key.partition("/")
            item = ItemRef(kind="transitions" if kind == "transitions" else "states", id=id_)
            now = rebase_selection(item, design, self.context.design)
            if now is not None and now != item:
                moved[key] = f"{now.kind}/{now.id}"
        return moved

    def _marks(self) -> dict[str, list[dict[str, Any]]]:
        """The messages of the items with findings, and of the selected one."""
        context, project = self.context, self.context.workspace.project
        findings = context.document.findings
        items = {
            item_at_path(finding.subject.path)
            for finding in findings
            if finding.subject is not None and finding.subject.component == context.design.component
        }
        selected = context.single_selection
        marks = {
            f"{item.kind}/{item.id}": marks_of(item_form(project, context.design, item), item_path(item), findings)
            for item in items
            if item != selected
        }
        if selected is not None:
            nodes, path = item_form(project, context.design, selected), item_path(selected)
            own = marks_of(nodes, path, findings, context.linter.lints_for)
            marks[f"{selected.kind}/{selected.id}"] = [*own, *self._others_typing(path)]
        return {key: found for key, found in marks.items() if found}

    def _others_typing(self, item: DesignPath) -> list[dict[str, Any]]:
        presence, window = self.context.presence, self.context.window
        paths = {other.editing_path for other in presence.others(window)}
        return [
            note_at(field_path(item, path), texts.others_typing(presence.names_editing(path, window)))
            for path in paths
            if item and path[: len(item)] == item != path
        ]

    def _edit(self, edit: FormEdit) -> Mapping[str, object]:
        result = edit.apply(self.context.document)
        if result.new_selection is not None:
            self.context.select(*result.new_selection)
        if result.error and not isinstance(edit, TextEdit):
            # Text fields show their errors themselves.
            self.context.show_toast(texts.sentence(result.error), "warning")
        return {"own": result.own, "error": result.error}

    def _handle(self, event: FormEvent) -> None:
        context = self.context
        match event:
            case FocusField(item=item, path=path):
                editing = () if path is None else finding_path(item_path(item), _steps(path))
                context.presence.update(context.window, editing_path=editing)
            case SelectItem(item=item):
                context.select(item)
                context.page.reveal(item)
            case CompleteText():
                self._complete(event)
            case OpenCode(item=item, path=path):
                open_in_editor(context, finding_path(item_path(item), _steps(path))[:-1], _steps(path)[-1])
            case ListFixes(finding=number):
                self.view.show_fixes(fix.label for fix in self._fixes(number))
            case ApplyFix(finding=number, index=index, label=label):
                fixes = self._fixes(number)
                if index < len(fixes) and fixes[index].label == label:
                    apply_fix(context, fixes[index])
            case ShowLanguage(language=language):
                context.code_language = language

    def _fixes(self, number: int) -> list[Any]:
        context, findings = self.context, self.context.document.findings
        known = 0 <= number < len(findings)
        return list(find_fixes(context.workspace.project, context.design, findings[number])) if known else []

    def _complete(self, request: CompleteText) -> None:
        project, design = self.context.workspace.project, self.context.design
        result = CompletionResult(start=request.offset, options=())
        if len(request.text) <= _MAX_TEXT_LENGTH and 0 <= request.offset <= len(request.text):
            complete = complete_python if _steps(request.path)[-1] == "python" else complete_expression
            result = complete(project, design, request.text, request.offset)
        answer = {"start": result.start, "options": [asdict(option) for option in result.options]}
        self.view.answer_completion(request.number, answer)


def _steps(path: str) -> tuple[str, ...]:
    return tuple(path.split("/"))
