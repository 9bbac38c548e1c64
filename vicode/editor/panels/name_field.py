"""Fields for names: taken over when Enter is pressed or the field is left, as everything that says it follows."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from nicegui import ui

from vicode.editor.panels.desk import Desk
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.fields import Bound, Field
from vicode.editor.panels.rows import primary_button
from vicode.editor.panels.text_input import TextInput
from vicode.editor.session import apply_gesture
from vicode.editor.session.declared_names import NamePlan, NewName, plan_name, rename_in_files, words_of_declared
from vicode.editor.session.wording import reason_of
from vicode.editor.view import Selected
from vicode.model.renaming import Declared

Take = Callable[[str, str], str]
"""Takes a new name over, given the old one and the new one; why not, in words."""


def name_field(
    desk: Desk, bound: Bound, take: Take, on_shown: Callable[[str], None] = lambda _name: None
) -> "NameField":
    """A name in a line; `take` takes another one over, `on_shown` hears the design's name when it is another."""
    with ui.column().classes("field"):
        element = TextInput(bound.label, monospace=True).props("maxlength=80")
        message = ui.label().classes("field-finding").props('role="status"')
        message.set_visibility(False)
    return NameField(desk, bound, element, message, take=take, on_shown=on_shown)


def take_declared(desk: Desk, thing: Declared, new: str) -> str:
    """Give a declared thing another name; returns why not.

    What only the open design says is an edit of it; what nothing says but its own line is written at once. Else all
    that changes, and what a person must look at, is listed first, and the name stays until that was agreed to.
    """
    plan = plan_name(desk.workspace, thing, new)
    if plan.refused:
        return plan.refused
    design = plan.design
    if design is not None and not plan.by_hand:
        desk.edit(f"rename {thing.name} to {new}", lambda _design: design)
    elif plan.is_alone:
        _rename_in_files(desk, plan)
    else:
        _ask(desk, plan)
    return ""


def rename_by_gesture(desk: Desk, thing: Selected, new: str) -> str:
    """Give a state, or a used component, another name as the drawing does; returns why not."""
    is_shown = thing in desk.selected
    outcome = apply_gesture(desk.document, {"kind": "rename", "of": thing.of, "id": thing.id, "name": new})
    if outcome.select and is_shown:
        desk.select(*outcome.select)
    return outcome.refused


@dataclass(eq=False)
class NameField(Field):
    """A name that is being typed is nobody's: it counts when it is done, and what cannot be taken over stays."""

    take: Take = field(default=lambda _old, _new: "")
    on_shown: Callable[[str], None] = field(default=lambda _name: None)
    may_be_empty: bool = False
    """Whether it is a text that may be missing, and no name."""
    is_long: bool = False
    """Whether it is a text of several lines: Enter is part of it."""
    _shown_name: str = ""

    def __post_init__(self) -> None:
        """Take the name over when it is typed."""
        super().__post_init__()
        # A key that saves, or leads elsewhere, tells of a change without leaving the field.
        for event in ("change",) if self.is_long else ("keydown.enter", "change"):
            self.element.on(event, self.finish)

    def refresh(self) -> None:
        """Show the design's name unless another one is being typed here; who types is told of a new one."""
        now = str(self.bound.read(self.desk.design) or "")
        is_own = str(self.element.value or "").strip() not in (self._shown_name, now)
        if self.has_focus and is_own and now not in ("", self._shown_name) and self._shown_name:
            self.refused = f"somebody named it {now} just now; Enter gives it your name"
            self._refused_beside = now
        if now != self._shown_name:
            self.on_shown(now)
            if self.has_focus and not is_own:
                # Nothing is typed that could be lost.
                self.element.set_value(now)
        self._shown_name = now
        super().refresh()

    def focus(self, *, has_focus: bool) -> None:
        """Take over what was typed before the field shows the design's name again."""
        if not has_focus:
            self.finish()
        super().focus(has_focus=has_focus)

    def hear_late(self, text: str) -> None:
        """Take over a name that was typed and done before the form was built anew."""
        super().hear_late(text)
        self.finish()

    def write_late(self, text: str) -> None:
        """Give the thing its name, though another one is shown by now."""
        if not self.bound.refuse(text) and text.strip() not in ("", self._shown_name):
            self.take(self._shown_name, text.strip())

    def finish(self) -> None:
        """Take over what stands in the field."""
        old, new = str(self.bound.read(self.desk.design) or ""), str(self.element.value or "").strip()
        # What the field showed is nobody's wish, though the design may have another name since.
        if (not old and not self.may_be_empty) or new in (old, self._shown_name):
            self.refused = ""
        else:
            self.refused, self._refused_beside = self.take(old, new), self.bound.read(self.desk.design)
            if self.element.is_deleted:
                # The form was built anew for the thing under its new name.
                return
            if not self.refused:
                # It is the design's name by now, or nobody's before somebody agreed to it.
                self.element.set_value(str(self.bound.read(self.desk.design) or ""))
        self.refresh()

    def _typed(self, value: Any) -> None:
        """A name on its way: what can be none at all is told at once, the rest when it is done."""
        now = self.bound.read(self.desk.design)
        self.refused, self._refused_beside = ("" if value == now else self.bound.refuse(value)), now
        self.refresh()


def _ask(desk: Desk, plan: NamePlan) -> None:
    """List what a name changes in the project's files, and change it."""
    what = words_of_declared(plan.thing)
    with titled_dialog(f"Rename {what} to {plan.new}") as dialog:
        if plan.changes:
            ui.label("What changes, and is written at once").classes("field-label")
            with ui.column().classes("change-list"):
                for change in plan.changes:
                    ui.label(change.file.name).classes("mono")
                    ui.label(change.words)
        if plan.by_hand:
            ui.label("Look here by hand: code that says the name, and may mean something else").classes("field-label")
            with ui.column().classes("by-hand-list").props("role=list"):
                for words in plan.by_hand:
                    ui.label(words).props("role=listitem")
        if desk.workspace.broken:
            ui.label(f"Not looked into, as it cannot be read: {', '.join(desk.workspace.broken)}").classes("empty")
        if plan.note:
            ui.label(plan.note).classes("field-finding")

        def rename() -> None:
            if plan.design is not None:
                _edit_as_planned(desk, plan)
            else:
                _rename_in_files(desk, plan)
            dialog.close()

        with ui.row().classes("dialog-buttons"):
            ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
            primary_button("Rename everywhere" if plan.changes else "Rename", rename).props("autofocus")
    dialog.on("hide", dialog.delete)


def _rename_in_files(desk: Desk, plan: NamePlan) -> None:
    """Write it, and offer to take it back."""
    if carry_out(desk, plan):
        whole = NewName(workspace=desk.workspace, thing=plan.thing, new=plan.new)
        desk.document.note(whole)
        desk.offer_undo(f"{plan.thing.name} is {plan.new} now", lambda: _take_back(desk, whole))


def _edit_as_planned(desk: Desk, plan: NamePlan) -> None:
    """Rename in the one design that says it, as it is by now."""
    again = plan_name(desk.workspace, plan.thing, plan.new)
    design = again.design
    if design is None:
        desk.say(again.refused or "A design has changed meanwhile: rename it once more", "warning")
        return
    desk.edit(f"rename {plan.thing.name} to {plan.new}", lambda _design: design)


def carry_out(desk: Desk, plan: NamePlan) -> bool:
    """Write what a plan says; what stands in the way is told."""
    try:
        refused = rename_in_files(desk.workspace, plan, desk.document.person)
    except (OSError, ValueError) as error:
        refused = f"not done: {reason_of(error)}"
    if refused:
        desk.say(f"{refused[:1].upper()}{refused[1:]}", "warning")
    desk.tell()
    return not refused


def _take_back(desk: Desk, whole: NewName) -> None:
    refused = desk.document.take_back(whole)
    if refused:
        desk.say(refused, "warning")
        return
    desk.tell()
    desk.say(f"It is {whole.thing.name} again", "positive")
