"""The design itself: what it is for, how often it works, what it declares, uses and does in every state."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from nicegui import ui

from vicode.editor.panels.actions_panel import actions_panel, with_python
from vicode.editor.panels.code_field import code_field
from vicode.editor.panels.decisions_list import decisions_list
from vicode.editor.panels.desk import Desk
from vicode.editor.panels.fields import Bound, Field, choice_field, flag_field, state_names, text_field
from vicode.editor.panels.rows import add_button, heading, icon_button, panel_title
from vicode.editor.session import numbers
from vicode.model.design import COMMON, Declaration, Design
from vicode.model.edits import add_use, free_name, remove_uses, set_declarations

_SECTIONS = (
    ("parameters", "Parameters", "what others may modulate in it"),
    ("outputs", "Outputs", "what others may read from it"),
    ("variables", "Variables", "its own memory"),
)


def design_panel(desk: Desk) -> list[Field]:
    """Build the form of the design."""
    panel_title("Component", desk.design.component)
    fields = [
        text_field(desk, _bound("Doc", "doc"), lines=True),
        text_field(desk, _frequency(), monospace=True),
        choice_field(desk, _bound("Initial state", "initial"), state_names),
        flag_field(desk, _bound("Resume: go on where it was left", "resume")),
    ]
    heading("Uses", hint="components it requires or modulates")
    _uses(desk)
    for section, title, hint in _SECTIONS:
        heading(title, hint=hint)
        fields += _declarations(desk, section)
    fields += common_panel(desk)
    _code(desk, fields)
    return fields


def _code(desk: Desk, fields: list[Field]) -> None:
    """The code for module and class, built when it is opened: code editors are a large script to load."""
    written = [name for name, code in (("module", desk.design.module), ("members", desk.design.members)) if code.texts]
    hint = f"written: {', '.join(written)}" if written else "for the top of the module, and for the class"
    opened: list[bool] = []

    def build() -> None:
        if not opened:
            opened.append(True)
            with section:
                fields.extend([code_field(desk, _module_code()), code_field(desk, _member_code())])

    section = ui.expansion("Code", caption=hint, on_value_change=build).classes("section").props("dense")


def common_panel(desk: Desk) -> list[Field]:
    """Build the form of what is common to all states."""
    heading("Common transitions", hint="tested before those of every state")
    decisions_list(desk, COMMON, ("common", "transitions"), desk.design.common.transitions)
    heading("Common actions", hint="done before those of every state")
    return actions_panel(desk, ("common", "actions"), desk.design.common.actions)


def _bound(label: str, attribute: str) -> Bound:
    return Bound(
        label=label,
        path=(attribute,),
        read=lambda design: getattr(design, attribute),
        write=lambda design, value: replace(design, **{attribute: value}),
    )


def _frequency() -> Bound:
    return Bound(
        label="Frequency, Hz",
        path=("frequency",),
        read=lambda design: numbers.text_of(design.frequency_hz),
        write=lambda design, text: replace(design, frequency_hz=numbers.frequency_of(text)),
        hint="at every step",
        refuse=numbers.refuse_frequency,
    )


def _module_code() -> Bound:
    return Bound(
        label="Module",
        path=("module",),
        read=lambda design: design.module.in_language("python") or "",
        write=lambda design, value: replace(design, module=with_python(design.module, value)),
    )


def _member_code() -> Bound:
    return Bound(
        label="Members",
        path=("members",),
        read=lambda design: design.members.in_language("python") or "",
        write=lambda design, value: replace(design, members=with_python(design.members, value)),
    )


def _uses(desk: Desk) -> None:
    for use in desk.design.uses:
        with ui.row().classes("use-row"):
            ui.label(use.alias).classes("mono alias")
            ui.label(use.component).classes("component-name")
            icon_button("close", f"Stop using {use.alias}", _use_remover(desk, use.alias))
    used = {use.component for use in desk.design.uses} | {desk.design.component}
    free = sorted(name for name in desk.workspace.project.interfaces() if name not in used)
    with ui.row().classes("adders"), add_button("Component", "Use one more component") as button:
        if not free:
            button.disable()
        with ui.menu().props("auto-close"):
            for name in free:
                ui.menu_item(name, on_click=_use_adder(desk, name)).classes("mono")


def _use_adder(desk: Desk, component: str) -> Callable[[], None]:
    return lambda: desk.edit(f"use {component}", lambda design: add_use(design, component))


def _use_remover(desk: Desk, alias: str) -> Callable[[], None]:
    return lambda: desk.edit(f"stop using {alias}", lambda design: remove_uses(design, [alias]))


def _declarations(desk: Desk, section: str) -> list[Field]:
    fields: list[Field] = []
    declarations: tuple[Declaration, ...] = getattr(desk.design, section)
    for index, declaration in enumerate(declarations):
        with ui.element("div").classes("declaration").props("role=group") as whole:
            whole.props["aria-label"] = f"{section.removesuffix('s')} {declaration.name}"
            for label, attribute in (("Name", "name"), ("Type", "type"), ("Initial", "initial"), ("Unit", "unit")):
                bound = _declaration_bound(section, index, declaration.name, (label, attribute))
                fields.append(text_field(desk, bound, monospace=True))
            fields.append(text_field(desk, _declaration_bound(section, index, declaration.name, ("Doc", "doc"))))
            icon_button("close", f"Remove {declaration.name}", _declaration_remover(desk, section, index))
    with ui.row().classes("adders"):
        add_button("Declare", f"Declare: one more of the {section}", _declaration_adder(desk, section))
    return fields


def _declaration_bound(section: str, index: int, name: str, what: tuple[str, str]) -> Bound:
    label, attribute = what

    def read(design: Design) -> str:
        declarations = getattr(design, section)
        return str(getattr(declarations[index], attribute)) if index < len(declarations) else ""

    def write(design: Design, value: str) -> Design:
        return _updated(design, section, index, {attribute: value.strip() if attribute != "doc" else value})

    key = {"initial": "default" if section == "parameters" else "initial"}.get(attribute, attribute)
    path = (section, name) if attribute == "name" else (section, name, key)
    refuse = _refuse_nameless if attribute == "name" else (lambda _value: "")
    return Bound(label=label, path=path, read=read, write=write, refuse=refuse)


def _refuse_nameless(value: Any) -> str:
    return "" if str(value or "").strip() else "it needs a name"


def _updated(design: Design, section: str, index: int, changes: dict[str, Any]) -> Design:
    declarations = list(getattr(design, section))
    if index < len(declarations):
        declarations[index] = replace(declarations[index], **changes)
    return set_declarations(design, section, tuple(declarations))


def _declaration_adder(desk: Desk, section: str) -> Callable[[], None]:
    def change(design: Design) -> Design:
        name = free_name(section.removesuffix("s"), {each.name for _section, each in design.declarations()})
        return set_declarations(design, section, (*getattr(design, section), Declaration(name=name, initial="0")))

    return lambda: desk.edit("declare", change)


def _declaration_remover(desk: Desk, section: str, index: int) -> Callable[[], None]:
    def change(design: Design) -> Design:
        rest = tuple(each for at, each in enumerate(getattr(design, section)) if at != index)
        return set_declarations(design, section, rest)

    return lambda: desk.edit("remove declaration", change)
