"""Fields for names, committed by Enter or when the field loses focus, as a rename updates all references."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.fields import Field, FieldBinding, add_field
from vicode.editor.panels.form import Form
from vicode.editor.panels.text_input import TextInput
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import apply_edit
from vicode.editor.session.descriptions import error_reason
from vicode.editor.session.gestures import RenameGesture
from vicode.editor.session.rename_symbol import (
    RenameEdit,
    SymbolRenamePlan,
    apply_symbol_rename,
    describe_symbol,
    plan_symbol_rename,
)
from vicode.editor.view import ItemKind, ItemRef
from vicode.model.rename import SymbolRef

RenameCallback = Callable[[str, str], str]
"""Renames from the old to the new name; returns an error message, or "" on success."""


def name_field(form: Form, binding: FieldBinding, rename: RenameCallback) -> "NameField":
    """Build a name field; `rename` applies a new name."""
    with ui.column().classes("field"):
        element = TextInput(binding.label, monospace=True).props("maxlength=80")
        message = ui.label().classes("field-finding").props('role="status"')
        message.set_visibility(False)
    return add_field(form, NameField(form.context, binding, element, message, rename=rename))


def rename_declaration(context: WindowContext, item: SymbolRef, new: str) -> str:
    """Rename a declaration; return an error message, or "" on success.

    A symbol that only the open design uses is renamed by an edit of the design, one without references is written
    immediately. Otherwise a dialog lists the changes and ambiguous places; the name stays until the user confirms.
    """
    plan = plan_symbol_rename(context.workspace, item, new)
    if plan.error:
        return plan.error
    design = plan.design
    if design is not None and not plan.ambiguous_places:
        context.edit(f"rename {item.name} to {new}", lambda _design: design)
    elif plan.is_declaration_only:
        _rename_in_files(context, plan)
    else:
        _ask(context, plan)
    return ""


def node_renamer(context: WindowContext, kind: ItemKind) -> RenameCallback:
    """Return a callback that renames a state or an alias as on the canvas."""

    def rename(old: str, new: str) -> str:
        item = ItemRef(kind=kind, id=old)
        is_shown = item in context.selected
        outcome = apply_edit(context.document, RenameGesture(item=item, name=new))
        if outcome.new_selection and is_shown:
            context.select(*outcome.new_selection)
        return outcome.error

    return rename


@dataclass(eq=False)
class NameField(Field):
    """A field whose text is applied when the user commits it. A rejected text stays in the field."""

    rename: RenameCallback = field(default=lambda _old, _new: "")
    is_optional: bool = False
    """Whether the text may be empty."""
    is_multiline: bool = False
    """Whether the text may have several lines; Enter then inserts a line break."""
    _shown_name: str = ""

    def __post_init__(self) -> None:
        super().__post_init__()
        # Shortcuts that save or navigate send a change event while the field keeps the focus.
        for event in ("change",) if self.is_multiline else ("keydown.enter", "change"):
            self.element.on(event, self.commit)

    def refresh(self) -> None:
        """Show the name of the design unless the user is typing; report a rename by another user."""
        current_name = str(self.binding.read(self.context.design) or "")
        is_own = str(self.element.value or "").strip() not in (self._shown_name, current_name)
        if self.has_focus and is_own and current_name not in ("", self._shown_name) and self._shown_name:
            self.error = texts.renamed_by_another_user(current_name)
            self._value_at_error = current_name
        if current_name != self._shown_name and self.has_focus and not is_own:
            # The user has not typed anything.
            self.element.set_value(current_name)
        self._shown_name = current_name
        super().refresh()

    def focus(self, *, has_focus: bool) -> None:
        """Commit the text before the field shows the name of the design again."""
        if not has_focus:
            self.commit()
        super().focus(has_focus=has_focus)

    def commit(self) -> None:
        old, new = str(self.binding.read(self.context.design) or ""), str(self.element.value or "").strip()
        # The text that the field showed is not input, though the design may have a newer name.
        if (not old and not self.is_optional) or new in (old, self._shown_name):
            self.error = ""
        else:
            self.error, self._value_at_error = self.rename(old, new), self.binding.read(self.context.design)
            if not self.error:
                # The name is applied, or the user must confirm it first.
                self.element.set_value(str(self.binding.read(self.context.design) or ""))
        self.refresh()

    def on_typed(self, value: Any) -> None:
        """Validate while the user types; all other checks run on commit."""
        current_name = self.binding.read(self.context.design)
        self.error, self._value_at_error = ("" if value == current_name else self.binding.validate(value)), current_name
        self.refresh()


def _ask(context: WindowContext, plan: SymbolRenamePlan) -> None:
    """Open a dialog that lists the changes in the files of the project, and applies them."""
    what = describe_symbol(plan.symbol)
    with titled_dialog(f"Rename {what} to {plan.new}") as dialog:
        if plan.changes:
            ui.label(texts.SAVED_IMMEDIATELY).classes("field-label")
            with ui.column().classes("change-list"):
                for change in plan.changes:
                    ui.label(change.file.name).classes("mono")
                    ui.label(change.summary)
        if plan.ambiguous_places:
            ui.label(texts.CHECK_MANUALLY).classes("field-label")
            with ui.column().classes("manual-list").props("role=list"):
                for place in plan.ambiguous_places:
                    ui.label(place).props("role=listitem")
        if context.workspace.broken_file_names:
            ui.label(texts.skipped_files(context.workspace.broken_file_names)).classes("empty")
        if plan.note:
            ui.label(plan.note).classes("field-finding")

        def rename() -> None:
            if plan.design is not None:
                _apply_in_design(context, plan)
            else:
                _rename_in_files(context, plan)
            dialog.close()

        with ui.row().classes("dialog-buttons"):
            ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
            primary_button("Rename everywhere" if plan.changes else "Rename", rename).props("autofocus")
    dialog.on("hide", dialog.delete)


def _rename_in_files(context: WindowContext, plan: SymbolRenamePlan) -> None:
    """Apply the rename, and offer to undo it."""
    if apply_rename_plan(context, plan):
        edit = RenameEdit(workspace=context.workspace, symbol=plan.symbol, new=plan.new)
        context.document.record_compound(edit)
        context.page.offer_undo(texts.renamed(plan.symbol.name, plan.new), lambda: _undo_rename(context, edit))


def _apply_in_design(context: WindowContext, plan: SymbolRenamePlan) -> None:
    """Rename in the only design that uses the symbol, with a plan for its current state."""
    current_plan = plan_symbol_rename(context.workspace, plan.symbol, plan.new)
    design = current_plan.design
    if design is None:
        context.show_toast(texts.sentence(current_plan.error) or texts.DESIGN_CHANGED_RENAME_AGAIN, "warning")
        return
    context.edit(f"rename {plan.symbol.name} to {plan.new}", lambda _design: design)


def apply_rename_plan(context: WindowContext, plan: SymbolRenamePlan) -> bool:
    """Apply a plan; show an error and return False if that is not possible."""
    try:
        error_text = apply_symbol_rename(context.workspace, plan, context.document.user_id)
    except (OSError, ValueError) as error:
        error_text = texts.operation_failed(error_reason(error))
    if error_text:
        context.show_toast(texts.sentence(error_text), "warning")
    context.notify_subscribers()
    return not error_text


def _undo_rename(context: WindowContext, edit: RenameEdit) -> None:
    error_text = context.document.undo_compound(edit)
    if error_text:
        context.show_toast(error_text, "warning")
        return
    context.notify_subscribers()
    context.show_toast(texts.renamed_back(edit.symbol.name), "positive")
