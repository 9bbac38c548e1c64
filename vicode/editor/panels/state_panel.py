"""The form of a state."""

from dataclasses import replace

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.actions_panel import (
    actions_panel,
    component_parameters,
    format_assignments,
    parse_assignments,
)
from vicode.editor.panels.code_field import pairs_field
from vicode.editor.panels.collapsible import collapsible_section
from vicode.editor.panels.color_choice import color_choice
from vicode.editor.panels.decisions_list import decisions_list
from vicode.editor.panels.fields import (
    DOC,
    XABSL_NAME,
    Attribute,
    FieldBinding,
    FieldKind,
    attribute_binding,
    attribute_field,
    checkbox_field,
    choice_field,
)
from vicode.editor.panels.form import Form, ItemRows
from vicode.editor.panels.name_field import name_field, node_renamer
from vicode.editor.panels.widgets import heading, panel_title
from vicode.editor.session import number_text
from vicode.editor.session.item_paths import TrackedItem
from vicode.editor.view import ItemRef
from vicode.model.design import Call, Design, State

_NAME = Attribute(label="State", name="name")
_FLAGS = (
    Attribute(label="Final", name="final", kind=FieldKind.CHECKBOX, hint="The component is done in this state"),
    Attribute(label="Disabled", name="disabled", kind=FieldKind.CHECKBOX, hint="Not generated"),
)


def _count(label: str, name: str, hint: str, help_text: str) -> Attribute:
    return Attribute(
        label=label,
        name=name,
        hint=hint,
        help=help_text,
        format=number_text.format_number,
        parse=number_text.parse_count,
        validate=number_text.validate_count,
    )


_TEAM = (
    _count("Capacity (robots at once)", "capacity", "no limit", texts.CAPACITY_HELP),
    _count("Synchronized (robots)", "synchronized", "not synchronized", texts.SYNCHRONIZED_HELP),
    XABSL_NAME,
)
_REQUIRES = Attribute(label="Components", name="requires", format=list, parse=tuple)
_PHASES = (
    ("actions", "Actions", "run in order in each iteration"),
    ("enter", "Enter", "run once on entry"),
    ("leave", "Leave", "run once on exit"),
)


def state_panel(form: Form, name: str) -> None:
    item = form.item("states", name)
    # Sighted users read the name in the field.
    panel_title("State", name, is_visually_hidden=True)
    name_field(form, attribute_binding(item, _NAME), node_renamer(form.context, "states"))
    changed_outside_note(form, item)
    attribute_field(form, item, DOC)
    with ui.element("div").classes("field-row"):
        _initial(form, item)
        for attribute in _FLAGS:
            attribute_field(form, item, attribute)
    form.on_refresh(
        color_choice(form.context, lambda: [ItemRef(kind="states", id=state.name)] if (state := item.get()) else [])
    )

    def build_team() -> None:
        with ui.element("div").classes("field-row"):
            for attribute in _TEAM:
                attribute_field(form, item, attribute)

    collapsible_section(
        form, "team", lambda: "Team and XABSL", lambda: _team_caption(item.get()), build_team, is_shared=True
    )
    heading("Requires", hint="updated before this state runs")
    choice_field(form, attribute_binding(item, _REQUIRES), _aliases, multiple=True)
    heading("Modulates", hint="controlled by this state")
    choice_field(form, attribute_binding(item, _modulates(item)), _aliases, multiple=True)
    ItemRows(
        form, item, "modulates", _parameters, lambda call: (call.alias, component_parameters(form.context, call.alias))
    )
    heading("Transitions", hint="the first whose guard holds is taken")
    decisions_list(form, item, "transitions")
    for section, title, hint in _PHASES:
        heading(title, hint=hint)
        actions_panel(form, item, section, calls=section == "actions")


def changed_outside_note(form: Form, item: TrackedItem) -> None:
    """Say that other programs changed code of the state, until another item is selected."""
    document = form.context.document

    def is_marked() -> bool:
        path = item.path
        marked = document.shared.outside.marked_items(document.history)
        return path is not None and any(each.kind == "states" and each.id == path[1] for each in marked)

    with ui.row().classes("outside-note").props('role="status"') as note:
        ui.icon("input").props('aria-hidden="true"')
        ui.label(texts.CHANGED_OUTSIDE)
    form.watch(is_marked, note.set_visibility)


def _aliases(design: Design) -> list[str]:
    return [use.alias for use in design.uses]


def _team_caption(state: State | None) -> str:
    if state is None:
        return ""
    parts = [
        f"{name} {number_text.format_number(count)}"
        for name, count in (("capacity", state.capacity), ("synchronized", state.synchronized))
        if count is not None
    ]
    parts += [f"{state.xabsl_name} in XABSL"] if state.xabsl_name else []
    return "; ".join(parts) or "capacity, synchronized, name"


def _initial(form: Form, item: TrackedItem) -> None:
    def is_initial(design: Design) -> bool:
        state = item.get(design)
        return state is not None and design.initial == state.name

    binding = FieldBinding(
        label="Initial",
        get_path=lambda: ("initial",),
        read=is_initial,
        write=lambda design, value: replace(design, initial=item.get(design).name) if value else design,
        item=item,
    )
    checkbox_field(form, binding)


def _modulates(item: TrackedItem) -> Attribute:
    """The aliases of the calls; calls that stay keep their arguments."""

    def parse(aliases: list[str]) -> tuple[Call, ...]:
        known = {call.alias: call for call in item.get().modulates}
        return tuple(known.get(alias, Call(alias=alias)) for alias in aliases)

    return Attribute(
        label="Components", name="modulates", format=lambda calls: [call.alias for call in calls], parse=parse
    )


def _parameters(form: Form, item: TrackedItem) -> None:
    alias = item.get().alias
    parameters = component_parameters(form.context, alias)
    attribute = Attribute(
        label=f"{alias}: parameter = expression",
        name="arguments",
        format=format_assignments,
        parse=parse_assignments,
        hint=", ".join(f"{each.name}{f' [{each.unit}]' if each.unit else ''}" for each in parameters)
        or "no parameters",
    )
    # The path of a call has its alias instead of its index.
    binding = replace(attribute_binding(item, attribute), get_path=lambda: (*(item.path or ())[:-1], alias))
    pairs_field(form, binding, lambda: component_parameters(form.context, alias))
