"""The selected state: name, marks, what it requires and modulates, code, and its transitions in order."""

from dataclasses import replace
from typing import Any

from nicegui import ui

from vicode.editor.panels.actions_panel import actions_panel, assignments, lines_of, parameters_of
from vicode.editor.panels.code_field import pairs_field
from vicode.editor.panels.decisions_list import decisions_list
from vicode.editor.panels.desk import Desk
from vicode.editor.panels.fields import Bound, Field, choice_field, flag_field, text_field
from vicode.editor.panels.folds import fold
from vicode.editor.panels.name_field import name_field, rename_by_gesture
from vicode.editor.panels.rows import heading, panel_title
from vicode.editor.session import numbers
from vicode.editor.view import Selected
from vicode.model.design import Call, Design, State
from vicode.model.edits import update_state


def state_panel(desk: Desk, name: str) -> list[Field]:
    """Build the form of a state; empty if it is gone."""
    state = desk.design.state(name)
    if state is None:
        return []
    path = ("states", name)
    # The field says it to the eye.
    panel_title("State", name, is_heard_only=True)
    fields = [
        _title(desk, name),
        text_field(desk, _bound(name, "Doc", "doc"), lines=True),
        flag_field(desk, _initial(name)),
        flag_field(desk, _bound(name, "Final: the component is done here", "final")),
        flag_field(desk, _bound(name, "Disabled: kept, but not in the component", "disabled")),
    ]
    _team(desk, state, fields)
    heading("Requires", hint="stepped before, to be read")
    fields.append(_requires(desk, name))
    heading("Modulates", hint="steered after the actions")
    fields += _modulates(desk, state)
    heading("Transitions", hint="the first that holds is taken")
    decisions_list(desk, name, (*path, "transitions"), state.transitions)
    heading("Actions", hint="at each iteration, in order")
    fields += actions_panel(desk, (*path, "actions"), state.actions)
    heading("Enter", hint="once, when it is entered")
    fields += actions_panel(desk, (*path, "enter"), state.enter, calls=False)
    heading("Leave", hint="once, when it is left")
    fields += actions_panel(desk, (*path, "leave"), state.leave, calls=False)
    return fields


def _aliases(design: Design) -> list[str]:
    return [use.alias for use in design.uses]


def _title(desk: Desk, name: str) -> Field:
    """The name changes when Enter is pressed or the field is left, as the whole design follows it."""

    def take(old: str, new: str) -> str:
        return rename_by_gesture(desk, Selected(of="states", id=old), new)

    bound = Bound(
        label="State",
        read=lambda design: name if design.state(name) else "",
        write=lambda design, _value: design,
        path=("states", name, "name"),
    )
    return name_field(desk, bound, take)


def _bound(name: str, label: str, attribute: str) -> Bound:
    def read(design: Design) -> Any:
        state = design.state(name)
        return getattr(state, attribute) if state else ("" if attribute in ("doc", "xabsl_name") else False)

    return Bound(
        label=label,
        path=("states", name, attribute),
        read=read,
        write=lambda design, value: update_state(design, name, lambda state: replace(state, **{attribute: value})),
    )


def _team(desk: Desk, state: State, fields: list[Field]) -> None:
    """What robots of a team agree on, and the name in XABSL: few need them."""
    said = []
    if state.capacity is not None:
        said.append(f"room for {numbers.text_of(state.capacity)}")
    if state.synchronized is not None:
        said.append(f"{numbers.text_of(state.synchronized)} enter together")
    if state.xabsl_name:
        said.append(f"{state.xabsl_name} in XABSL")

    def build() -> None:
        fields.append(
            text_field(desk, _count(state.name, "Capacity: robots in it at once", "capacity"), monospace=True)
        )
        ui.label("One that finds no room stays where it is until others leave.").classes("empty")
        label = "Synchronized: robots that enter at once"
        fields.append(text_field(desk, _count(state.name, label, "synchronized"), monospace=True))
        ui.label("Each waits where it is until so many are ready.").classes("empty")
        fields.append(text_field(desk, _bound(state.name, "Name in XABSL", "xabsl_name"), monospace=True))

    fold(desk, f"team {state.name}", "Team and XABSL", "; ".join(said) or "capacity, synchronized, name", build)


def _count(name: str, label: str, attribute: str) -> Bound:
    def read(design: Design) -> str:
        state = design.state(name)
        return numbers.text_of(getattr(state, attribute)) if state else ""

    def write(design: Design, text: str) -> Design:
        changes: dict[str, Any] = {attribute: numbers.count_of(text)}
        return update_state(design, name, lambda state: replace(state, **changes))

    return Bound(
        label=label,
        path=("states", name, attribute),
        read=read,
        write=write,
        hint="no limit" if attribute == "capacity" else "each by itself",
        refuse=numbers.refuse_count,
    )


def _initial(name: str) -> Bound:
    return Bound(
        label="Initial",
        path=("initial",),
        read=lambda design: design.initial == name,
        write=lambda design, value: replace(design, initial=name) if value else design,
    )


def _requires(desk: Desk, name: str) -> Field:
    def read(design: Design) -> list[str]:
        state = design.state(name)
        return list(state.requires) if state else []

    bound = Bound(
        label="Components",
        path=("states", name, "requires"),
        read=read,
        write=lambda design, value: update_state(design, name, lambda state: replace(state, requires=tuple(value))),
    )
    return choice_field(desk, bound, _aliases, several=True)


def _modulates(desk: Desk, state: State) -> list[Field]:
    """One field a call with its parameters, and a choice that adds or removes calls."""
    name = state.name

    def write(design: Design, value: list[str]) -> Design:
        def changed(old: State) -> State:
            known = {call.alias: call for call in old.modulates}
            return replace(old, modulates=tuple(known.get(alias, Call(alias=alias)) for alias in value))

        return update_state(design, name, changed)

    def read(design: Design) -> list[str]:
        now = design.state(name)
        return [call.alias for call in now.modulates] if now else []

    bound = Bound(label="Components", path=("states", name, "modulates"), read=read, write=write)
    fields = [choice_field(desk, bound, _aliases, several=True)]
    fields += [_parameters(desk, name, call.alias) for call in state.modulates]
    return fields


def _parameters(desk: Desk, name: str, alias: str) -> Field:
    def call_in(design: Design) -> Call | None:
        state = design.state(name)
        return next((call for call in state.modulates if call.alias == alias), None) if state else None

    def write(design: Design, value: str) -> Design:
        def changed(old: State) -> State:
            pairs = assignments(value)
            calls = (replace(call, arguments=pairs) if call.alias == alias else call for call in old.modulates)
            return replace(old, modulates=tuple(calls))

        return update_state(design, name, changed)

    def read(design: Design) -> str:
        call = call_in(design)
        return lines_of(call.arguments) if call else ""

    bound = Bound(
        label=f"{alias}: parameter = expression",
        path=("states", name, "modulates", alias),
        read=read,
        write=write,
        hint=parameter_hint(desk, alias),
    )
    return pairs_field(desk, bound, lambda: parameters_of(desk, alias))


def parameter_hint(desk: Desk, alias: str) -> str:
    """The parameters that a used component takes, with units, for an empty field."""
    parameters = parameters_of(desk, alias)
    if not parameters:
        return "takes no parameters"
    return ", ".join(f"{each.name}{f' [{each.unit}]' if each.unit else ''}" for each in parameters)
