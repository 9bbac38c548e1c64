"""The form of a transition, stay or group: target and guard."""

from dataclasses import replace

from nicegui import ui

from vicode.editor.panels.code_field import expression_field
from vicode.editor.panels.code_language_tabs import code_fields, replace_text
from vicode.editor.panels.decisions_list import decision_source, decisions_list
from vicode.editor.panels.fields import (
    DOC,
    Attribute,
    FieldBinding,
    FieldKind,
    attribute_binding,
    attribute_field,
    choice_field,
    state_names,
    text_field,
)
from vicode.editor.panels.form import Form, Rows
from vicode.editor.panels.widgets import heading, panel_title
from vicode.editor.session.item_paths import TrackedItem
from vicode.editor.view import ItemRef, parse_transition_key
from vicode.model.design import COMMON, DecisionGroup, Design, Transition
from vicode.model.edits import assign_id, remove_decisions

_INITIAL_CODE = "return self.state_time > 2\n"
_TO = Attribute(label="To", name="to", format=str)
_WHEN = Attribute(label="When", name="when", hint="always")
_DISABLED = Attribute(label="Disabled (never tested)", name="disabled", kind=FieldKind.CHECKBOX)
_PREDICATE = "Predicate (body of a function that returns a bool)"


def decision_panel(form: Form, key: str) -> None:
    item = form.item(*parse_transition_key(key))
    guard, decision = item.child("guard"), item.get()
    _title(form, item)
    if isinstance(decision, Transition):
        choice_field(form, attribute_binding(item, _TO), state_names)
    expression_field(form, _guard_binding(item, attribute_binding(guard, _WHEN)))
    unit = "milliseconds" if form.context.design.time_unit == "ms" else "seconds"
    after = Attribute(label=f"After ({unit} in this state)", name="after")
    text_field(form, _guard_binding(item, attribute_binding(guard, after)), monospace=True)
    Rows(form, lambda: [item.path is not None and guard.get().code is not None], lambda row, has: _code(row, item, has))
    attribute_field(form, item, DOC)
    attribute_field(form, item, _DISABLED)
    if isinstance(decision, DecisionGroup):
        for section, title in (("then", "Then"), ("else", "Else")):
            heading(title)
            decisions_list(form, item, section)
    _remove_button(form, item)


def _title(form: Form, item: TrackedItem) -> None:
    noun = {Transition: "Transition from", DecisionGroup: "Group of"}.get(type(item.get()), "Stay in")

    def build(_row: Form, source: str) -> None:
        shown = ItemRef(kind="common", id=COMMON) if source == COMMON else ItemRef(kind="states", id=source)
        name = "every state" if source == COMMON else source
        panel_title(noun, name, lambda: form.context.select(shown))

    Rows(form, lambda: [decision_source(item)], build)


def _guard_binding(item: TrackedItem, binding: FieldBinding) -> FieldBinding:
    """Bind an attribute of the guard, which stands among those of the decision in the file."""
    return replace(binding, get_path=lambda: (*(item.path or ()), binding.get_path()[-1]))


def _code(form: Form, item: TrackedItem, has_code: bool) -> None:
    """Build the field of the code predicate, or a button that adds it."""
    context, guard = form.context, item.child("guard")

    def set_code(design: Design, text: str) -> Design:
        code = replace_text(None, "python", text) if text else None
        changed: Design = guard.update(design, lambda old: replace(old, code=code))
        return assign_id(changed, item.path or ()) if text else changed

    if has_code:
        code_fields(form, guard, "code", _PREDICATE, bind=lambda binding: _guard_binding(item, binding))
        button = ui.button("Remove code", on_click=lambda: context.edit("remove code", lambda old: set_code(old, "")))
    else:
        button = ui.button("Code predicate", icon="add")
        button.on_click(lambda: context.edit("add code", lambda old: set_code(old, _INITIAL_CODE)))
    button.props("flat dense no-caps size=sm")


def _remove_button(form: Form, item: TrackedItem) -> None:
    context = form.context

    def remove() -> None:
        path = item.path
        if path is not None:
            context.edit("remove transition", lambda design: remove_decisions(design, [path]))
        context.select()

    ui.button("Remove", icon="delete", on_click=remove).props("flat dense no-caps color=negative").classes("remove")
