"""Renames declarations, with a dialog that lists the changes if they are not in the open design alone."""

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.descriptions import error_reason
from vicode.editor.session.project.renames import RenameEdit, apply_symbol_rename
from vicode.model.rename import SymbolRef
from vicode.services.rename.symbol import SymbolRenamePlan, describe_symbol, plan_symbol_rename


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
