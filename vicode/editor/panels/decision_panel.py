"""The form of a transition, stay or group: target and guard."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from nicegui import ui

from vicode.editor.panels.actions_panel import python_code, replace_python
from vicode.editor.panels.code_field import code_field, expression_field
from vicode.editor.panels.decisions_list import decisions_list
from vicode.editor.panels.fields import Field, FieldBinding, checkbox_field, choice_field, state_names, text_field
from vicode.editor.panels.widgets import heading, panel_title
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.view import ItemRef, parse_transition_key
from vicode.findings import DesignPath
from vicode.model.design import COMMON, Decision, DecisionGroup, Design, Guard, Transition
from vicode.model.edits import assign_id, remove_decisions, replace_decision
from vicode.model.traversal import find_decision

_CODE_HINT = "return self.perception.ball_seen\n"


def decision_panel(context: WindowContext, key: str) -> list[Field]:
    """Build the form of a decision; return no fields if it does not exist."""
    located = find_decision(context.design, parse_transition_key(key))
    if located is None:
        return []
    path, decision = located.path, located.decision
    source = "every state" if located.source == COMMON else located.source
    panel_title(_kind(decision), source, _select_source(context, located.source))
    fields = _target_field(context, path, decision)
    fields.append(expression_field(context, _guard_binding(path, "When", "when")))
    unit = "milliseconds" if context.design.time_unit == "ms" else "seconds"
    fields.append(text_field(context, _guard_binding(path, f"After ({unit} in this state)", "after"), monospace=True))
    fields += _code(context, path, decision.guard)
    fields.append(text_field(context, _decision_binding(path, "Description", "doc"), multiline=True))
    fields.append(checkbox_field(context, _decision_binding(path, "Disabled (never tested)", "disabled")))
    if isinstance(decision, DecisionGroup):
        heading("Then")
        decisions_list(context, located.source, (*path, "then"), decision.then)
        heading("Else")
        decisions_list(context, located.source, (*path, "else"), decision.otherwise)
    _remove_button(context, path)
    return fields


def _kind(decision: Decision) -> str:
    if isinstance(decision, DecisionGroup):
        return "Group of"
    return "Transition from" if isinstance(decision, Transition) else "Stay in"


def _target_field(context: WindowContext, path: DesignPath, decision: Decision) -> list[Field]:
    if not isinstance(decision, Transition):
        return []
    return [choice_field(context, _decision_binding(path, "To", "to"), state_names)]


def _decision_binding(path: DesignPath, label: str, attribute: str) -> FieldBinding:
    def read(design: Design) -> Any:
        located = find_decision(design, path)
        return getattr(located.decision, attribute, "") if located else ""

    return FieldBinding(
        label=label,
        path=(*path, attribute),
        read=read,
        write=lambda design, value: _change(design, path, lambda old: replace(old, **{attribute: value})),
    )


def _guard_binding(path: DesignPath, label: str, attribute: str) -> FieldBinding:
    def read(design: Design) -> str:
        located = find_decision(design, path)
        return str(getattr(located.decision.guard, attribute)) if located else ""

    return FieldBinding(
        label=label,
        path=(*path, attribute),
        read=read,
        write=lambda design, value: _change_guard(design, path, lambda guard: replace(guard, **{attribute: value})),
        hint="always" if attribute == "when" else "",
    )


def _code(context: WindowContext, path: DesignPath, guard: Guard) -> list[Field]:
    """Build the field of the code predicate, or a button that adds it."""

    def set_code(text: str) -> Callable[[Design], Design]:
        return lambda design: _change_guard(
            design, path, lambda old: replace(old, code=python_code(text) if text else None)
        )

    if guard.code is None:
        add = set_code(_CODE_HINT)
        ui.button(
            "Code predicate",
            icon="add",
            on_click=lambda: context.edit("add code", lambda design: assign_id(add(design), path)),
        ).props("flat dense no-caps size=sm")
        return []

    def read(design: Design) -> str:
        located = find_decision(design, path)
        code = located.decision.guard.code if located else None
        return (code.in_language("python") or "") if code else ""

    binding = FieldBinding(
        label="Predicate (body of a function that returns a bool)",
        path=(*path, "code"),
        read=read,
        write=lambda design, value: _change_guard(
            design, path, lambda old: replace(old, code=replace_python(old.code, value))
        ),
    )
    field = code_field(context, binding)
    ui.button("Remove code", on_click=lambda: context.edit("remove code", set_code(""))).props(
        "flat dense no-caps size=sm"
    )
    return [field]


def _change(design: Design, path: DesignPath, change: Callable[[Decision], Decision]) -> Design:
    located = find_decision(design, path)
    return replace_decision(design, path, change(located.decision)) if located else design


def _change_guard(design: Design, path: DesignPath, change: Callable[[Guard], Guard]) -> Design:
    return _change(design, path, lambda decision: replace(decision, guard=change(decision.guard)))


def _select_source(context: WindowContext, source: str) -> Callable[[], None]:
    item = ItemRef(kind="common", id=COMMON) if source == COMMON else ItemRef(kind="states", id=source)
    return lambda: context.select(item)


def _remove_button(context: WindowContext, path: DesignPath) -> None:
    def remove() -> None:
        context.edit("remove transition", lambda design: remove_decisions(design, [path]))
        context.select()

    ui.button("Remove", icon="delete", on_click=remove).props("flat dense no-caps color=negative").classes("remove")
