"""The form of the design: description, frequency, declarations, used components, common transitions and actions."""

from collections.abc import Callable
from dataclasses import replace

from nicegui import ui

from vicode.editor.panels import texts
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
    panel_title("Component", context.design.component)
    fields = [
        text_field(context, _attribute_binding("Description", "doc"), multiline=True),
        text_field(context, _frequency(), monospace=True),
        choice_field(context, _attribute_binding("Initial state", "initial"), state_names),
        checkbox_field(context, _attribute_binding("Resume where it left off", "resume")),
    ]
    _xabsl(context, fields)
    heading("Uses", hint="components this design requires or modulates")
    _uses(context)
    for section, title, hint in SECTIONS:
        heading(title, hint=hint)
        declarations_form(context, section, fields)
    fields += common_panel(context)
    _code(context, fields)
    project_form(context, fields)
    return fields


def _xabsl(context: WindowContext, fields: list[Field]) -> None:
    design = context.design
    parts = [f"{design.xabsl_name} in XABSL"] if design.xabsl_name else []
    parts += ["XABSL arithmetic"] if design.arithmetic else []
    parts += [f"time unit {design.time_unit}"] if design.time_unit else []

    def build() -> None:
        fields.append(text_field(context, _attribute_binding("Name in XABSL", "xabsl_name"), monospace=True))
        fields.append(choice_field(context, _attribute_binding("Arithmetic", "arithmetic"), lambda _design: ["xabsl"]))
        fields[-1].element.props("clearable")
        ui.label(texts.ARITHMETIC_HELP).classes("empty")
        fields.append(choice_field(context, _attribute_binding("Time unit", "time_unit"), lambda _design: ["s", "ms"]))
        fields[-1].element.props("clearable")
        ui.label(texts.TIME_UNIT_HELP).classes("empty")

    collapsible_section(context, "xabsl", "XABSL", "; ".join(parts) or "name, arithmetic, time unit", build)


def _common_doc() -> FieldBinding:
    return FieldBinding(
        label="Description (all states)",
        path=("common", "doc"),
        read=lambda design: design.common.doc,
        write=lambda design, value: replace(design, common=replace(design.common, doc=value)),
    )


def _code(context: WindowContext, fields: list[Field]) -> None:
    """Build the section of module and member code; collapsed, as code editors load a large script."""
    code_names = [
        name for name, code in (("module", context.design.module), ("members", context.design.members)) if code.texts
    ]
    hint = ", ".join(code_names) or "module and class members"

    def build() -> None:
        fields.extend([code_field(context, _module_code()), code_field(context, _member_code())])

    collapsible_section(context, "code", "Code", hint, build)


def common_panel(context: WindowContext) -> list[Field]:
    heading("Common transitions", hint="tested in every state, before its own transitions")
    decisions_list(context, COMMON, ("common", "transitions"), context.design.common.transitions)
    heading("Common actions", hint="run in every state, before its own actions")
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
        hint="every step",
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
            icon_button("close", f"Remove {use.alias}", _use_remover(context, use.alias))
    used = {use.component for use in context.design.uses} | {context.design.component}
    available_components = sorted(name for name in context.workspace.project.interfaces() if name not in used)
    with ui.row().classes("adders"), add_button("Component", "Add Component") as button:
        if not available_components:
            button.disable()
        with ui.menu().props("auto-close"):
            for name in available_components:
                ui.menu_item(name, on_click=_use_adder(context, name)).classes("mono")


def _use_adder(context: WindowContext, component: str) -> Callable[[], None]:
    return lambda: context.edit(f"add component {component}", lambda design: add_use(design, component))


def _use_remover(context: WindowContext, alias: str) -> Callable[[], None]:
    return lambda: context.edit(f"remove component {alias}", lambda design: remove_uses(design, [alias]))
