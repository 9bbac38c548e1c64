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
    LostText,
    OpenCode,
    SelectItem,
    ShowLanguage,
    ToggleSection,
)
from vicode.editor.panels import texts
from vicode.editor.panels.code.open_in_editor import open_in_editor
from vicode.editor.panels.findings.finding_navigation import apply_fix
from vicode.editor.panels.inspector.rename_dialog import rename_declaration
from vicode.editor.panels.project.edits import ProjectFormEdits
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.fixes import find_fixes
from vicode.editor.session.forms.action_form import component_parameters, settable_declarations
from vicode.editor.session.forms.declaration_form import declared_symbol
from vicode.editor.session.forms.edits import ButtonEdit, FormEdit, NameEdit, TextEdit, rename_item
from vicode.editor.session.forms.form_data import Forms, has_form
from vicode.editor.session.forms.form_paths import file_path, item_path, parse_path, resolve
from vicode.editor.session.forms.form_places import FormResult
from vicode.editor.session.forms.marks import ItemFields, marks_of, note_at, project_marks
from vicode.editor.session.forms.project_places import resolve_in_project
from vicode.editor.session.forms.state_form import OUTSIDE
from vicode.editor.session.gestures.item_paths import item_at
from vicode.editor.session.gestures.rebase import rebase_selection
from vicode.editor.session.texts import ITEM_MISSING
from vicode.editor.view import ItemKind, ItemRef, item_at_path
from vicode.findings import DesignPath
from vicode.model.completion import (
    CompletionResult,
    complete_assignments,
    complete_expression,
    complete_python,
)
from vicode.model.design import Call, Design
from vicode.model.lowering import is_lowered

_MOVING_KINDS: Mapping[str, ItemKind] = {
    "states": "states",
    "transitions": "transitions",
    "frames": "frames",
    "components": "components",
}
"""The kinds of items whose names or places can change."""
_MAX_TEXT_LENGTH = 200_000


class ItemForms:
    """The forms of one window."""

    def __init__(self, context: WindowContext) -> None:
        self.context = context
        self._shown: tuple[Design, Forms] = (context.design, {})
        self._edited: tuple[ItemRef, str] | None = None
        """The item and the path of the field with the focus."""
        self._project = ProjectFormEdits(context)
        self.view = FormView(self._edit, self._handle, self._on_malformed, self._prepare, context.inbox)
        context.linter.changes.subscribe(lambda: None if self.view.is_deleted else self.refresh())

    def _on_malformed(self, reason: str) -> None:
        self.context.show_toast(texts.invalid_event(reason), "warning")

    def _prepare(self, is_continued: bool) -> None:
        """Recover or offer what a killed server has left."""
        self.context.page.recover_work(is_continued)
        self.refresh()

    def refresh(self) -> None:
        """Send what has changed, and the selection."""
        context = self.context
        project, shared = context.workspace.project, context.document.shared
        forms = shared.forms(project)
        data = {
            "rev": context.document.rev,
            "forms": forms,
            "marks": self._marks(),
            "lists": shared.form_lists(project),
            "language": context.code_language,
            "open_sections": sorted(context.open_sections),
        }
        self.view.show(data, self._find_moved(forms))
        self._follow_edited()
        self._shown = (context.design, forms)
        self.view.select(context.selected, context.selection_seq)
        if context.is_opening and context.single_selection is not None:
            context.is_opening = False
            self.view.open(context.single_selection)

    def _follow_edited(self) -> None:
        """Say so if another user has removed what the user is typing into."""
        if self._edited is None or self._shown[0] is self.context.design:
            return
        item, path = self._edited
        now = rebase_selection(item, self._shown[0], self.context.design)
        is_there = now is not None and has_form(self.context.design, now) and self._path_in_file(now, path)
        self._edited = (now, path) if now is not None and is_there else None
        if not is_there:
            self.context.show_toast(texts.EDITED_ITEM_REMOVED, "warning")

    def _find_moved(self, forms: Forms) -> dict[str, str]:
        """The new keys of items whose forms changed their places."""
        design, before = self._shown
        if design is self.context.design:
            return {}
        moved = {}
        for key, text in before.items():
            kind, _slash, id_ = key.partition("/")
            if forms.get(key) == text or kind not in _MOVING_KINDS:
                continue
            item = ItemRef(kind=_MOVING_KINDS[kind], id=id_)
            now = rebase_selection(item, design, self.context.design)
            if now is not None and now != item:
                moved[key] = f"{now.kind}/{now.id}"
        return moved

    def _fields(self, item: ItemRef) -> ItemFields:
        context = self.context
        return ItemFields.of(context.workspace.project, context.design, item, context.document.shared.list_ids)

    def _marks(self) -> dict[str, list[dict[str, Any]]]:
        """The messages of the items with findings, and of the selected one."""
        context = self.context
        findings = context.document.findings
        items = {
            item_at_path(finding.subject.path)
            for finding in findings
            if finding.subject is not None and finding.subject.component == context.design.component
        }
        if is_lowered(context.design):
            # Other forms show the fields of its constructs.
            items.add(ItemRef(kind="design"))
        selected = self._shown_item()
        marks = {
            f"{item.kind}/{item.id}": marks_of(self._fields(item), findings)
            for item in items
            if item != selected and has_form(context.design, item)
        }
        if selected is not None and has_form(context.design, selected):
            fields = self._fields(selected)
            own = marks_of(fields, findings, context.linter.lints_for)
            marks[f"{selected.kind}/{selected.id}"] = [*own, *self._notices(selected), *self._others_typing(fields)]
        project = context.workspace.project
        marks["project/"] = project_marks(project, context.document.shared.list_ids, context.workspace.project_findings)
        return {key: found for key, found in marks.items() if found}

    def _shown_item(self) -> ItemRef | None:
        """The item whose form is shown: the design if nothing is selected."""
        return self.context.single_selection if self.context.selected else ItemRef(kind="design")

    def _notices(self, item: ItemRef) -> list[dict[str, Any]]:
        document = self.context.document
        is_marked = item in document.shared.outside.marked_items(document.history)
        return [note_at(OUTSIDE, texts.CHANGED_OUTSIDE)] if is_marked else []

    def _others_typing(self, fields: ItemFields) -> list[dict[str, Any]]:
        presence, window = self.context.presence, self.context.window
        edited = {other.editing_path for other in presence.others(window)}
        return [
            note_at(path, texts.others_typing(presence.names_editing(in_file, window)))
            for path, in_file in fields.paths.items()
            if in_file in edited
        ]

    def _edit(self, edit: FormEdit) -> Mapping[str, object]:
        context = self.context
        result = self._apply(edit)
        if result.new_selection is not None:
            context.select(*result.new_selection)
        if result.renamed is not None and result.renamed[0] in context.selected:
            context.select(*(result.renamed[1] if item == result.renamed[0] else item for item in context.selected))
        if result.error == ITEM_MISSING:
            context.show_toast(texts.EDITED_ITEM_REMOVED, "warning")
        elif result.error and not isinstance(edit, TextEdit | NameEdit) and edit.path != "project":
            # Fields for texts show their errors themselves.
            context.show_toast(texts.sentence(result.error), "warning")
        return {"own": result.own, "error": result.error}

    def _apply(self, edit: FormEdit) -> FormResult:
        if edit.path.partition("/")[0] == "project":
            return self._project.apply(edit)
        match edit:
            case NameEdit(item=ItemRef(kind="design")):
                return self._rename(edit.path, edit.text.strip())
            case ButtonEdit(action="open-design", item=ItemRef(kind="components", id=alias)):
                use = self.context.design.use(alias)
                if use is not None:
                    self.context.page.open_component(use.component)
                return FormResult()
            case _:
                return edit.apply(self.context.document)

    def _rename(self, path: str, new: str) -> FormResult:
        """Rename a declaration or construct; a dialog may ask first, and the name stays until then."""
        document = self.context.document
        ids = document.shared.list_ids
        match resolve(document.design, ids, (), parse_path(path)):
            case (*place, int(index), "name") if place[-1] in ("steps", "layers"):
                state = item_at(document.design, (*place, index)).name
                return rename_item(document, ItemRef(kind="states", id=state), new)
        symbol = declared_symbol(document.design, ids, path)
        if symbol is None:
            return FormResult(error=ITEM_MISSING)
        error = "" if new == symbol.name else rename_declaration(self.context, symbol, new)
        now = declared_symbol(document.design, ids, path)
        return FormResult(own=now.name if now else "", error=error)

    def _handle(self, event: FormEvent) -> None:
        context = self.context
        match event:
            case FocusField(item=item, path=path):
                self._edited = None if path is None else (item, path)
                editing = () if path is None else self._path_in_file(item, path)
                context.presence.update(context.window, editing_path=editing)
            case SelectItem(item=item):
                context.select(item)
                context.page.reveal(item)
            case CompleteText():
                self._complete(event)
            case OpenCode(item=item, path=path):
                in_file = self._path_in_file(item, path)
                if in_file:
                    open_in_editor(context, in_file[:-1], str(in_file[-1]))
            case ShowLanguage(language=language):
                context.code_language = language
            case ToggleSection(key=key, is_open=is_open):
                (context.open_sections.add if is_open else context.open_sections.discard)(key)
            case LostText(item=item, text=text):
                context.show_toast(texts.typed_text_lost(item.id, text), "warning")
            case _:
                self._handle_fixes(event)

    def _handle_fixes(self, event: ListFixes | ApplyFix) -> None:
        match event:
            case ListFixes(finding=number):
                self.view.show_fixes(fix.label for fix in self._fixes(number))
            case ApplyFix(finding=number, index=index, label=label):
                fixes = self._fixes(number)
                if index < len(fixes) and fixes[index].label == label:
                    apply_fix(self.context, fixes[index])
                else:
                    # The text has changed since the menu was filled.
                    self.context.show_toast(texts.FIX_OUTDATED, "info")

    def _path_in_file(self, item: ItemRef, path: str) -> DesignPath:
        """The path in the file of a field; empty if it no longer exists."""
        design, ids, owner = self.context.design, self.context.document.shared.list_ids, item_path(item)
        if path.partition("/")[0] == "project":
            shared = resolve_in_project(self.context.workspace.project, ids, parse_path(path))
            return () if shared is None else ("project", *shared)
        steps = None if owner is None else resolve(design, ids, owner, parse_path(path))
        return () if owner is None or steps is None else file_path(design, owner, steps)

    def _fixes(self, number: int) -> list[Any]:
        context, findings = self.context, self.context.document.findings
        known = 0 <= number < len(findings)
        return list(find_fixes(context.workspace.project, context.design, findings[number])) if known else []

    def _complete(self, request: CompleteText) -> None:
        result = CompletionResult(start=request.offset, options=())
        if len(request.text) <= _MAX_TEXT_LENGTH and 0 <= request.offset <= len(request.text):
            result = self._completions(request)
        answer = {"start": result.start, "options": [asdict(option) for option in result.options]}
        self.view.answer_completion(request.number, answer)

    def _completions(self, request: CompleteText) -> CompletionResult:
        project, design, ids = (
            self.context.workspace.project,
            self.context.design,
            self.context.document.shared.list_ids,
        )
        owner = item_path(request.item) or ()
        steps = resolve(design, ids, owner, parse_path(request.path)) or ()
        match steps[-1:]:
            case ("python",):
                return complete_python(project, design, request.text, request.offset)
            case ("values",):
                settable = settable_declarations(project, design)
            case ("arguments",):
                call = item_at(design, (*owner, *steps[:-1]))
                settable = component_parameters(project, design, call.alias) if isinstance(call, Call) else ()
            case _:
                return complete_expression(project, design, request.text, request.offset)
        return complete_assignments(project, design, settable, request.text, request.offset)
