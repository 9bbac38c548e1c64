"""The design itself: what it is for, how often it works, what it declares, uses and does in every state."""

from collections.abc import Callable
from dataclasses import replace

from nicegui import ui

from vicode.editor.panels.actions_panel import actions_panel, replace_python
from vicode.editor.panels.code_field import code_field
from vicode.editor.panels.collapsible import collapsible_section
from vicode.editor.panels.decisions_list import decisions_list
from vicode.editor.panels.declarations import SECTIONS, declarations_form
from vicode.editor.panels.fields import Field, FieldBinding, checkbox_field, choice_field, state_names, text_field
from vicode.editor.panels.project.project_form import project_form
from vicode.editor.panels.widgets import add_button, heading, icon_button, panel_title
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import number_text
from vicode.model.design import COMMON
from vicode.model.edits import add_use, remove_uses


def design_panel(context: WindowContext) -> list[Field]:
    """Build the form of the design."""
    panel_title("Component", context.design.component)
    fields = [
        text_field(context, _attribute_binding("Doc", "doc"), multiline=True),
        text_field(context, _frequency(), monospace=True),
        choice_field(context, _attribute_binding("Initial state", "initial"), state_names),
        checkbox_field(context, _attribute_binding("Resume: go on where it was left", "resume")),
    ]
    _xabsl(context, fields)
    heading("Uses", hint="components it requires or modulates")
    _uses(context)
    for section, title, hint in SECTIONS:
        heading(title, hint=hint)
        declarations_form(context, section, fields)
    fields += common_panel(context)
    _code(context, fields)
    project_form(context, fields)
    return fields


def _xabsl(context: WindowContext, fields: list[Field]) -> None:
    """How it is called in XABSL, and what it takes over from there: few need it."""
    design = context.design
    said = [f"{design.xabsl_name} in XABSL"] if design.xabsl_name else []
    said += ["calculates as XABSL"] if design.arithmetic else []
    said += [f"times in {design.time_unit}"] if design.time_unit else []

    def build() -> None:
        fields.append(text_field(context, _attribute_binding("Name in XABSL", "xabsl_name"), monospace=True))
        fields.append(choice_field(context, _attribute_binding("Arithmetic", "arithmetic"), lambda _design: ["xabsl"]))
        fields[-1].element.props("clearable")
        ui.label("xabsl: calculates and restarts as XABSL does; empty: as every design.").classes("empty")
        fields.append(
            choice_field(context, _attribute_binding("Unit of times", "time_unit"), lambda _design: ["s", "ms"])
        )
        fields[-1].element.props("clearable")
        ui.label("Of state_time and component_time in expressions; empty: seconds.").classes("empty")

    collapsible_section(context, "xabsl", "XABSL", "; ".join(said) or "name, arithmetic, unit of times", build)


def _common_doc() -> FieldBinding:
    return FieldBinding(
        label="Doc of what is common",
        path=("common", "doc"),
        read=lambda design: design.common.doc,
        write=lambda design, value: replace(design, common=replace(design.common, doc=value)),
    )


def _code(context: WindowContext, fields: list[Field]) -> None:
    """The code for module and class, built when it is opened: code editors are a large script to load."""
    written = [
        name for name, code in (("module", context.design.module), ("members", context.design.members)) if code.texts
    ]
    hint = f"written: {', '.join(written)}" if written else "for the top of the module, and for the class"

    def build() -> None:
        fields.extend([code_field(context, _module_code()), code_field(context, _member_code())])

    collapsible_section(context, "code", "Code", hint, build)


def common_panel(context: WindowContext) -> list[Field]:
    """Build the form of what is common to all states."""
    heading("Common transitions", hint="tested before those of every state")
    decisions_list(context, COMMON, ("common", "transitions"), context.design.common.transitions)
    heading("Common actions", hint="done before those of every state")
    fields = actions_panel(context, ("common", "actions"), context.design.common.actions)
    return [*fields, text_field(context, _common_doc(), multiline=True)]


def _attribute_binding(label: str, attribute: str) -> FieldBinding:
    return FieldBinding(
        label=label,
        path=(attribute,),
        read=lambda design: getattr(design, attribute),
        write=lambda design, value: replace(design, **{attribute: value}),
    )


def _frequency() -> FieldBinding:
    return FieldBinding(
        label="Frequency, Hz",
        path=("frequency",),
        read=lambda design: number_text.format_number(design.frequency_hz),
        write=lambda design, text: replace(design, frequency_hz=number_text.parse_frequency(text)),
        hint="at every step",
        validate=number_text.validate_frequency,
    )


def _module_code() -> FieldBinding:
    return FieldBinding(
        label="Module",
        path=("module",),
        read=lambda design: design.module.in_language("python") or "",
        write=lambda design, value: replace(design, module=replace_python(design.module, value)),
    )


def _member_code() -> FieldBinding:
    return FieldBinding(
        label="Members",
        path=("members",),
        read=lambda design: design.members.in_language("python") or "",
        write=lambda design, value: replace(design, members=replace_python(design.members, value)),
    )


def _uses(context: WindowContext) -> None:
    for use in context.design.uses:
        with ui.row().classes("use-row"):
            ui.label(use.alias).classes("mono alias")
            ui.label(use.component).classes("component-name")
            icon_button("close", f"Stop using {use.alias}", _use_remover(context, use.alias))
    used = {use.component for use in context.design.uses} | {context.design.component}
    free = sorted(name for name in context.workspace.project.interfaces() if name not in used)
    with ui.row().classes("adders"), add_button("Component", "Use one more component") as button:
        if not free:
            button.disable()
        with ui.menu().props("auto-close"):
            for name in free:
                ui.menu_item(name, on_click=_use_adder(context, name)).classes("mono")


def _use_adder(context: WindowContext, component: str) -> Callable[[], None]:
    return lambda: context.edit(f"use {component}", lambda design: add_use(design, component))


def _use_remover(context: WindowContext, alias: str) -> Callable[[], None]:
    return lambda: context.edit(f"stop using {alias}", lambda design: remove_uses(design, [alias]))
