"""The form of the design: description, frequency, declarations, used components, common transitions and actions."""

from collections.abc import Callable, Sequence
from dataclasses import replace

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.code_language_tabs import code_fields
from vicode.editor.panels.collapsible import collapsible_section
from vicode.editor.panels.declarations import SECTIONS, declarations_form
from vicode.editor.panels.fields import (
    DOC,
    FREQUENCY,
    XABSL_NAME,
    Attribute,
    FieldKind,
    ListOptions,
    attribute_binding,
    attribute_field,
    choice_field,
    state_names,
)
from vicode.editor.panels.form import Form, Rows
from vicode.editor.panels.interface_lists import commands_list, inputs_list
from vicode.editor.panels.project.project_form import project_form
from vicode.editor.panels.texts import pluralize
from vicode.editor.panels.widgets import add_button, heading, icon_button, panel_title
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.item_paths import TrackedItem
from vicode.editor.view import ItemRef
from vicode.model.design import COMMON, Design, Use
from vicode.model.edits import add_use, remove_uses

_INITIAL = Attribute(label="Initial state", name="initial")
_RESUME = Attribute(label="Resume where it left off", name="resume", kind=FieldKind.CHECKBOX)
_XABSL_CHOICES = (
    (Attribute(label="Arithmetic", name="arithmetic", help=texts.ARITHMETIC_HELP), ("xabsl",)),
    (Attribute(label="Time unit", name="time_unit", help=texts.TIME_UNIT_HELP), ("s", "ms")),
)


def design_panel(form: Form) -> None:
    design = form.item()
    panel_title("Component", form.context.design.component)
    attribute_field(form, design, DOC)
    with ui.element("div").classes("field-row"):
        choice_field(form, attribute_binding(design, _INITIAL), state_names)
        attribute_field(form, design, FREQUENCY)
    attribute_field(form, design, _RESUME)
    inputs_list(form)
    commands_list(form)
    _xabsl(form, design)
    heading("Uses", hint="components this design requires or modulates")
    _uses(form)
    for section, title, hint in SECTIONS:
        heading(title, hint=hint)
        declarations_form(form, section)
    _common(form)
    _code(form, design)
    project_form(form)


def _xabsl(form: Form, item: TrackedItem) -> None:
    def caption() -> str:
        design = form.context.design
        parts = [f"{design.xabsl_name} in XABSL"] if design.xabsl_name else []
        parts += ["XABSL arithmetic"] if design.arithmetic else []
        parts += [f"time unit {design.time_unit}"] if design.time_unit else []
        return "; ".join(parts) or "name, arithmetic, time unit"

    def build() -> None:
        attribute_field(form, item, XABSL_NAME)
        for attribute, options in _XABSL_CHOICES:
            choice_field(form, attribute_binding(item, attribute), _list_options(options)).element.props("clearable")
            ui.label(attribute.help).classes("empty")

    collapsible_section(form, "xabsl", lambda: "XABSL", caption, build, is_shared=True)


def _list_options(options: Sequence[str]) -> ListOptions:
    return lambda _design: options


def _code(form: Form, design: TrackedItem) -> None:
    """Build the section of module and member code; collapsed, as code editors load a large script."""

    def caption() -> str:
        names = [name for name in ("module", "members") if getattr(form.context.design, name).texts]
        return ", ".join(names) or "module and class members"

    def build() -> None:
        for name in ("module", "members"):
            code_fields(form, design, name, name.capitalize())

    collapsible_section(form, "code", lambda: "Code", caption, build, is_shared=True)


def _common(form: Form) -> None:
    """Build a row that leads to the form of the common transitions and actions."""
    context = form.context
    heading("Every state", hint="transitions and actions before those of each state")
    row = ui.element("button").props('type="button"').classes("choice use-row")
    row.on("click", lambda: context.select(ItemRef(kind="common", id=COMMON)))
    with row:
        ui.label("Common transitions and actions")
        count = ui.label().classes("component-name ellipsis")
    form.watch(lambda: _describe_common(context.design), count.set_text)


def _describe_common(design: Design) -> str:
    common = design.common
    parts = [
        pluralize(len(items), noun)
        for items, noun in ((common.transitions, "transition"), (common.actions, "action"))
        if items
    ]
    return ", ".join(parts) or "none"


def _uses(form: Form) -> None:
    context = form.context

    def build_use(_row: Form, use: Use) -> None:
        with ui.row().classes("use-row"):
            ui.label(use.alias).classes("mono alias")
            ui.label(use.component).classes("component-name")
            icon_button("close", f"Remove {use.alias}", _use_remover(context, use.alias))

    def unused_components() -> list[str]:
        used = {use.component for use in context.design.uses} | {context.design.component}
        return sorted(name for name in context.workspace.project.interfaces() if name not in used)

    def fill_menu() -> None:
        menu.clear()
        with menu:
            for name in unused_components():
                ui.menu_item(name, on_click=_use_adder(context, name)).classes("mono")

    Rows(form, lambda: [replace(use, at=None) for use in context.design.uses], build_use)
    with ui.row().classes("adders"), add_button("Component", "Add Component") as button:
        # Filled when it opens, as a project may have many components.
        menu = ui.menu().props("auto-close").on("before-show", fill_menu)
    form.watch(lambda: bool(unused_components()), button.set_enabled)


def _use_adder(context: WindowContext, component: str) -> Callable[[], None]:
    return lambda: context.edit(f"add component {component}", lambda design: add_use(design, component))


def _use_remover(context: WindowContext, alias: str) -> Callable[[], None]:
    return lambda: context.edit(f"remove component {alias}", lambda design: remove_uses(design, [alias]))
