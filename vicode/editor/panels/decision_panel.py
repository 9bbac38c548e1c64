"""The selected transition, stay or group: where it leads and its guard."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from nicegui import ui

from vicode.editor.panels.actions_panel import python, with_python
from vicode.editor.panels.code_field import code_field, expression_field
from vicode.editor.panels.decisions_list import decisions_list
from vicode.editor.panels.desk import Desk
from vicode.editor.panels.fields import Bound, Field, choice_field, flag_field, state_names, text_field
from vicode.editor.panels.rows import heading, panel_title
from vicode.editor.view import Selected, path_of_key
from vicode.findings import Path
from vicode.model.design import COMMON, Decision, Design, Group, Guard, Transition
from vicode.model.edits import give_id, remove_decisions, replace_decision
from vicode.model.walks import decision_at

_CODE_HINT = "return self.perception.ball_seen\n"


def decision_panel(desk: Desk, key: str) -> list[Field]:
    """Build the form of a decision; empty if it is gone."""
    located = decision_at(desk.design, path_of_key(key))
    if located is None:
        return []
    path, decision = located.path, located.decision
    source = "every state" if located.source == COMMON else located.source
    panel_title(_kind(decision), source, _select_source(desk, located.source))
    fields = _target_field(desk, path, decision)
    fields.append(expression_field(desk, _guard_bound(path, "When", "when")))
    fields.append(text_field(desk, _guard_bound(path, "After, seconds in this state", "after"), monospace=True))
    fields += _code(desk, path, decision.guard)
    fields.append(text_field(desk, _decision_bound(path, "Doc", "doc"), lines=True))
    fields.append(flag_field(desk, _decision_bound(path, "Disabled: kept, but never tested", "disabled")))
    if isinstance(decision, Group):
        heading("Then")
        decisions_list(desk, located.source, (*path, "then"), decision.then)
        heading("Else")
        decisions_list(desk, located.source, (*path, "else"), decision.otherwise)
    _remove_button(desk, path)
    return fields


def _kind(decision: Decision) -> str:
    if isinstance(decision, Group):
        return "Group of"
    return "Transition from" if isinstance(decision, Transition) else "Stay in"


def _target_field(desk: Desk, path: Path, decision: Decision) -> list[Field]:
    if not isinstance(decision, Transition):
        return []
    return [choice_field(desk, _decision_bound(path, "To", "to"), state_names)]


def _decision_bound(path: Path, label: str, attribute: str) -> Bound:
    def read(design: Design) -> Any:
        located = decision_at(design, path)
        return getattr(located.decision, attribute, "") if located else ""

    return Bound(
        label=label,
        path=(*path, attribute),
        read=read,
        write=lambda design, value: _change(design, path, lambda old: replace(old, **{attribute: value})),
    )


def _guard_bound(path: Path, label: str, attribute: str) -> Bound:
    def read(design: Design) -> str:
        located = decision_at(design, path)
        return str(getattr(located.decision.guard, attribute)) if located else ""

    return Bound(
        label=label,
        path=(*path, attribute),
        read=read,
        write=lambda design, value: _change_guard(design, path, lambda guard: replace(guard, **{attribute: value})),
        hint="always" if attribute == "when" else "",
    )


def _code(desk: Desk, path: Path, guard: Guard) -> list[Field]:
    """The predicate in code, or a button that adds one."""

    def set_code(text: str) -> Callable[[Design], Design]:
        return lambda design: _change_guard(design, path, lambda old: replace(old, code=python(text) if text else None))

    if guard.code is None:
        add = set_code(_CODE_HINT)
        ui.button(
            "Predicate in code",
            icon="add",
            on_click=lambda: desk.edit("add code", lambda design: give_id(add(design), path)),
        ).props("flat dense no-caps size=sm")
        return []

    def read(design: Design) -> str:
        located = decision_at(design, path)
        code = located.decision.guard.code if located else None
        return (code.in_language("python") or "") if code else ""

    bound = Bound(
        label="Predicate: the body of a function that returns a bool",
        path=(*path, "code"),
        read=read,
        write=lambda design, value: _change_guard(
            design, path, lambda old: replace(old, code=with_python(old.code, value))
        ),
    )
    field = code_field(desk, bound)
    ui.button("Remove the code", on_click=lambda: desk.edit("remove code", set_code(""))).props(
        "flat dense no-caps size=sm"
    )
    return [field]


def _change(design: Design, path: Path, change: Callable[[Decision], Decision]) -> Design:
    located = decision_at(design, path)
    return replace_decision(design, path, change(located.decision)) if located else design


def _change_guard(design: Design, path: Path, change: Callable[[Guard], Guard]) -> Design:
    return _change(design, path, lambda decision: replace(decision, guard=change(decision.guard)))


def _select_source(desk: Desk, source: str) -> Callable[[], None]:
    thing = Selected(of="common", id=COMMON) if source == COMMON else Selected(of="states", id=source)
    return lambda: desk.select(thing)


def _remove_button(desk: Desk, path: Path) -> None:
    def remove() -> None:
        desk.edit("remove transition", lambda design: remove_decisions(design, [path]))
        desk.select()

    ui.button("Remove", icon="delete", on_click=remove).props("flat dense no-caps color=negative").classes("remove")
