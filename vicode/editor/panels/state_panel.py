"""The form of a state."""

from dataclasses import replace
from typing import Any

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
from vicode.editor.panels.decisions_list import decisions_list
from vicode.editor.panels.fields import Field, FieldBinding, checkbox_field, choice_field, text_field
from vicode.editor.panels.name_field import name_field, rename_node
from vicode.editor.panels.widgets import heading, panel_title
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import number_text
from vicode.editor.view import ItemRef
from vicode.model.design import Call, Design, State
from vicode.model.edits import update_state


def state_panel(context: WindowContext, name: str) -> list[Field]:
    """Build the form of a state; return no fields if it does not exist."""
    state = context.design.state(name)
    if state is None:
        return []
    path = ("states", name)
    # Sighted users read the name in the field.
    panel_title("State", name, is_visually_hidden=True)
    fields = [
        _title(context, name),
        text_field(context, _attribute_binding(name, "Description", "doc"), multiline=True),
        checkbox_field(context, _initial(name)),
        checkbox_field(context, _attribute_binding(name, "Final (the component is done)", "final")),
        checkbox_field(context, _attribute_binding(name, "Disabled (not generated)", "disabled")),
    ]
    _team(context, state, fields)
    heading("Requires", hint="updated before this state runs")
    fields.append(_requires(context, name))
    heading("Modulates", hint="controlled by this state")
    fields += _modulates(context, state)
    heading("Transitions", hint="the first whose guard holds is taken")
    decisions_list(context, name, (*path, "transitions"), state.transitions)
    heading("Actions", hint="run in order in each iteration")
    fields += actions_panel(context, (*path, "actions"), state.actions)
    heading("Enter", hint="run once on entry")
    fields += actions_panel(context, (*path, "enter"), state.enter, calls=False)
    heading("Leave", hint="run once on exit")
    fields += actions_panel(context, (*path, "leave"), state.leave, calls=False)
    return fields


def _aliases(design: Design) -> list[str]:
    return [use.alias for use in design.uses]


def _title(context: WindowContext, name: str) -> Field:
    """Build the name field, committed by Enter or when it loses focus, as a rename updates the design."""

    def rename(old: str, new: str) -> str:
        return rename_node(context, ItemRef(kind="states", id=old), new)

    binding = FieldBinding(
        label="State",
        read=lambda design: name if design.state(name) else "",
        write=lambda design, _value: design,
        path=("states", name, "name"),
    )
    return name_field(context, binding, rename)


def _attribute_binding(name: str, label: str, attribute: str) -> FieldBinding:
    def read(design: Design) -> Any:
        state = design.state(name)
        return getattr(state, attribute) if state else ("" if attribute in ("doc", "xabsl_name") else False)

    return FieldBinding(
        label=label,
        path=("states", name, attribute),
        read=read,
        write=lambda design, value: update_state(design, name, lambda state: replace(state, **{attribute: value})),
    )


def _team(context: WindowContext, state: State, fields: list[Field]) -> None:
    parts = []
    if state.capacity is not None:
        parts.append(f"capacity {number_text.format_number(state.capacity)}")
    if state.synchronized is not None:
        parts.append(f"synchronized {number_text.format_number(state.synchronized)}")
    if state.xabsl_name:
        parts.append(f"{state.xabsl_name} in XABSL")

    def build() -> None:
        fields.append(
            text_field(
                context, _count(state.name, "Capacity (robots in this state at once)", "capacity"), monospace=True
            )
        )
        ui.label(texts.CAPACITY_HELP).classes("empty")
        label = "Synchronized (robots that enter together)"
        fields.append(text_field(context, _count(state.name, label, "synchronized"), monospace=True))
        ui.label(texts.SYNCHRONIZED_HELP).classes("empty")
        fields.append(
            text_field(context, _attribute_binding(state.name, "Name in XABSL", "xabsl_name"), monospace=True)
        )

    collapsible_section(
        context, f"team {state.name}", "Team and XABSL", "; ".join(parts) or "capacity, synchronized, name", build
    )


def _count(name: str, label: str, attribute: str) -> FieldBinding:
    def read(design: Design) -> str:
        state = design.state(name)
        return number_text.format_number(getattr(state, attribute)) if state else ""

    def write(design: Design, text: str) -> Design:
        changes: dict[str, Any] = {attribute: number_text.parse_count(text)}
        return update_state(design, name, lambda state: replace(state, **changes))

    return FieldBinding(
        label=label,
        path=("states", name, attribute),
        read=read,
        write=write,
        hint="no limit" if attribute == "capacity" else "not synchronized",
        validate=number_text.validate_count,
    )


def _initial(name: str) -> FieldBinding:
    return FieldBinding(
        label="Initial",
        path=("initial",),
        read=lambda design: design.initial == name,
        write=lambda design, value: replace(design, initial=name) if value else design,
    )


def _requires(context: WindowContext, name: str) -> Field:
    def read(design: Design) -> list[str]:
        state = design.state(name)
        return list(state.requires) if state else []

    binding = FieldBinding(
        label="Components",
        path=("states", name, "requires"),
        read=read,
        write=lambda design, value: update_state(design, name, lambda state: replace(state, requires=tuple(value))),
    )
    return choice_field(context, binding, _aliases, multiple=True)


def _modulates(context: WindowContext, state: State) -> list[Field]:
    """Build a select that adds or removes calls, and a field for the parameters of each call."""
    name = state.name

    def write(design: Design, value: list[str]) -> Design:
        def changed(old: State) -> State:
            known = {call.alias: call for call in old.modulates}
            return replace(old, modulates=tuple(known.get(alias, Call(alias=alias)) for alias in value))

        return update_state(design, name, changed)

    def read(design: Design) -> list[str]:
        now = design.state(name)
        return [call.alias for call in now.modulates] if now else []

    binding = FieldBinding(label="Components", path=("states", name, "modulates"), read=read, write=write)
    fields = [choice_field(context, binding, _aliases, multiple=True)]
    fields += [_parameters(context, name, call.alias) for call in state.modulates]
    return fields


def _parameters(context: WindowContext, name: str, alias: str) -> Field:
    def call_in(design: Design) -> Call | None:
        state = design.state(name)
        return next((call for call in state.modulates if call.alias == alias), None) if state else None

    def write(design: Design, value: str) -> Design:
        def changed(old: State) -> State:
            pairs = parse_assignments(value)
            calls = (replace(call, arguments=pairs) if call.alias == alias else call for call in old.modulates)
            return replace(old, modulates=tuple(calls))

        return update_state(design, name, changed)

    def read(design: Design) -> str:
        call = call_in(design)
        return format_assignments(call.arguments) if call else ""

    binding = FieldBinding(
        label=f"{alias}: parameter = expression",
        path=("states", name, "modulates", alias),
        read=read,
        write=write,
        hint=describe_parameters(context, alias),
    )
    return pairs_field(context, binding, lambda: component_parameters(context, alias))


def describe_parameters(context: WindowContext, alias: str) -> str:
    """Describe the parameters of a used component, with units, as a placeholder."""
    parameters = component_parameters(context, alias)
    if not parameters:
        return "no parameters"
    return ", ".join(f"{each.name}{f' [{each.unit}]' if each.unit else ''}" for each in parameters)
