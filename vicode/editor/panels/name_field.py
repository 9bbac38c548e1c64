"""Fields for names: taken over when Enter is pressed or the field is left, as everything that says it follows."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from nicegui import ui

from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.fields import Field, FieldBinding
from vicode.editor.panels.text_input import TextInput
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import apply_gesture
from vicode.editor.session.descriptions import error_reason
from vicode.editor.session.rename_symbol import (
    RenameEdit,
    SymbolRenamePlan,
    apply_symbol_rename,
    describe_symbol,
    plan_symbol_rename,
)
from vicode.editor.view import ItemRef
from vicode.model.rename import SymbolRef

RenameCallback = Callable[[str, str], str]
"""Takes a new name over, given the old one and the new one; why not, in words."""


def name_field(
    context: WindowContext,
    binding: FieldBinding,
    rename: RenameCallback,
    on_name_changed: Callable[[str], None] = lambda _name: None,
) -> "NameField":
    """A name in a line; `rename` takes another one over, `on_name_changed` hears the design's name when it is another."""
    with ui.column().classes("field"):
        element = TextInput(binding.label, monospace=True).props("maxlength=80")
        message = ui.label().classes("field-finding").props('role="status"')
        message.set_visibility(False)
    return NameField(context, binding, element, message, rename=rename, on_name_changed=on_name_changed)


def rename_declaration(context: WindowContext, thing: SymbolRef, new: str) -> str:
    """Give a declared thing another name; returns why not.

    What only the open design says is an edit of it; what nothing says but its own line is written at once. Else all
    that changes, and what a person must look at, is listed first, and the name stays until that was agreed to.
    """
    plan = plan_symbol_rename(context.workspace, thing, new)
    if plan.error:
        return plan.error
    design = plan.design
    if design is not None and not plan.ambiguous_places:
        context.edit(f"rename {thing.name} to {new}", lambda _design: design)
    elif plan.is_declaration_only:
        _rename_in_files(context, plan)
    else:
        _ask(context, plan)
    return ""


def rename_node(context: WindowContext, thing: ItemRef, new: str) -> str:
    """Give a state, or a used component, another name as the drawing does; returns why not."""
    is_shown = thing in context.selected
    outcome = apply_gesture(context.document, {"kind": "rename", "of": thing.kind, "id": thing.id, "name": new})
    if outcome.new_selection and is_shown:
        context.select(*outcome.new_selection)
    return outcome.error


@dataclass(eq=False)
class NameField(Field):
    """A name that is being typed is nobody's: it counts when it is done, and what cannot be taken over stays."""

    rename: RenameCallback = field(default=lambda _old, _new: "")
    on_name_changed: Callable[[str], None] = field(default=lambda _name: None)
    is_optional: bool = False
    """Whether it is a text that may be missing, and no name."""
    is_multiline: bool = False
    """Whether it is a text of several lines: Enter is part of it."""
    _shown_name: str = ""

    def __post_init__(self) -> None:
        """Take the name over when it is typed."""
        super().__post_init__()
        # A key that saves, or leads elsewhere, tells of a change without leaving the field.
        for event in ("change",) if self.is_multiline else ("keydown.enter", "change"):
            self.element.on(event, self.commit)

    def refresh(self) -> None:
        """Show the design's name unless another one is being typed here; who types is told of a new one."""
        now = str(self.binding.read(self.context.design) or "")
        is_own = str(self.element.value or "").strip() not in (self._shown_name, now)
        if self.has_focus and is_own and now not in ("", self._shown_name) and self._shown_name:
            self.error = f"somebody named it {now} just now; Enter gives it your name"
            self._value_at_error = now
        if now != self._shown_name:
            self.on_name_changed(now)
            if self.has_focus and not is_own:
                # Nothing is typed that could be lost.
                self.element.set_value(now)
        self._shown_name = now
        super().refresh()

    def focus(self, *, has_focus: bool) -> None:
        """Take over what was typed before the field shows the design's name again."""
        if not has_focus:
            self.commit()
        super().focus(has_focus=has_focus)

    def apply_delayed_input(self, text: str) -> None:
        """Take over a name that was typed and done before the form was built anew."""
        super().apply_delayed_input(text)
        self.commit()

    def commit_delayed_input(self, text: str) -> None:
        """Give the thing its name, though another one is shown by now."""
        if not self.binding.validate(text) and text.strip() not in ("", self._shown_name):
            self.rename(self._shown_name, text.strip())

    def commit(self) -> None:
        """Take over what stands in the field."""
        old, new = str(self.binding.read(self.context.design) or ""), str(self.element.value or "").strip()
        # What the field showed is nobody's wish, though the design may have another name since.
        if (not old and not self.is_optional) or new in (old, self._shown_name):
            self.error = ""
        else:
            self.error, self._value_at_error = self.rename(old, new), self.binding.read(self.context.design)
            if self.element.is_deleted:
                # The form was built anew for the thing under its new name.
                return
            if not self.error:
                # It is the design's name by now, or nobody's before somebody agreed to it.
                self.element.set_value(str(self.binding.read(self.context.design) or ""))
        self.refresh()

    def _on_typed(self, value: Any) -> None:
        """A name on its way: what can be none at all is told at once, the rest when it is done."""
        now = self.binding.read(self.context.design)
        self.error, self._value_at_error = ("" if value == now else self.binding.validate(value)), now
        self.refresh()


def _ask(context: WindowContext, plan: SymbolRenamePlan) -> None:
    """List what a name changes in the project's files, and change it."""
    what = describe_symbol(plan.symbol)
    with titled_dialog(f"Rename {what} to {plan.new}") as dialog:
        if plan.changes:
            ui.label("What changes, and is written at once").classes("field-label")
            with ui.column().classes("change-list"):
                for change in plan.changes:
                    ui.label(change.file.name).classes("mono")
                    ui.label(change.summary)
        if plan.ambiguous_places:
            ui.label("Look here by hand: code that says the name, and may mean something else").classes("field-label")
            with ui.column().classes("manual-list").props("role=list"):
                for words in plan.ambiguous_places:
                    ui.label(words).props("role=listitem")
        if context.workspace.broken_file_names:
            ui.label(
                f"Not looked into, as it cannot be read: {', '.join(context.workspace.broken_file_names)}"
            ).classes("empty")
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
    """Write it, and offer to take it back."""
    if apply_rename_plan(context, plan):
        whole = RenameEdit(workspace=context.workspace, symbol=plan.symbol, new=plan.new)
        context.document.record_compound(whole)
        context.offer_undo(f"{plan.symbol.name} is {plan.new} now", lambda: _undo_rename(context, whole))


def _apply_in_design(context: WindowContext, plan: SymbolRenamePlan) -> None:
    """Rename in the one design that says it, as it is by now."""
    again = plan_symbol_rename(context.workspace, plan.symbol, plan.new)
    design = again.design
    if design is None:
        context.show_toast(again.error or "A design has changed meanwhile: rename it once more", "warning")
        return
    context.edit(f"rename {plan.symbol.name} to {plan.new}", lambda _design: design)


def apply_rename_plan(context: WindowContext, plan: SymbolRenamePlan) -> bool:
    """Write what a plan says; what stands in the way is told."""
    try:
        refused = apply_symbol_rename(context.workspace, plan, context.document.user_id)
    except (OSError, ValueError) as error:
        refused = f"not done: {error_reason(error)}"
    if refused:
        context.show_toast(f"{refused[:1].upper()}{refused[1:]}", "warning")
    context.notify_listeners()
    return not refused


def _undo_rename(context: WindowContext, whole: RenameEdit) -> None:
    refused = context.document.undo_compound(whole)
    if refused:
        context.show_toast(refused, "warning")
        return
    context.notify_listeners()
    context.show_toast(f"It is {whole.symbol.name} again", "positive")
