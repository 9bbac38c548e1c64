"""The forms of a used component and of a link to it."""

from dataclasses import replace

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.fields import Attribute, attribute_binding
from vicode.editor.panels.form import Form
from vicode.editor.panels.name_field import name_field, node_renamer
from vicode.editor.panels.project.component_forms import component_form
from vicode.editor.panels.project.project_fields import project_node
from vicode.editor.panels.widgets import heading, panel_title
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import number_text
from vicode.editor.session.forms.declaration_form import format_arguments
from vicode.editor.view import ItemRef
from vicode.model.design import Declaration, Use
from vicode.model.edits import remove_link, remove_uses
from vicode.model.project import INTERNAL, MISSING, WORLD, Interface

_ALIAS = Attribute(label="Alias", name="alias")


def use_panel(form: Form, alias: str) -> None:
    """Build the form of a used component: its alias and interface."""
    context, item = form.context, form.item("uses", alias)
    component = item.get().component
    project = context.workspace.project
    interface = project.interface(component)
    panel_title("Component", component)
    binding = replace(attribute_binding(item, _ALIAS), get_path=lambda: item.path or ())
    name_field(form, binding, node_renamer(context, "components"))
    if interface is None:
        ui.label(texts.NOT_DECLARED).classes("field-finding")
        return
    if project.design(component) is None:
        _hand_written(form, component, alias)
    else:
        _designed(context, item.get(), interface)

    def remove() -> None:
        use = item.get()
        if use is not None:
            context.edit(f"remove component {use.alias}", lambda design: remove_uses(design, [use.alias]))
        context.select()

    ui.button("Remove component", icon="delete", on_click=remove).props("flat dense no-caps color=negative")


def _hand_written(form: Form, component: str, alias: str) -> None:
    """Build the form of a component without a design, declared in project.yaml."""
    components = form.context.workspace.project.components
    number = next(at for at, each in enumerate(components) if each.component == component)
    ui.label(_ORIGINS.get(components[number].implementation, "Hand-written")).classes("small")
    ui.label(texts.PROJECT_SCOPE).classes("empty")
    component_form(form, project_node(form, "components", number), alias=alias)


def _designed(context: WindowContext, use: Use, interface: Interface) -> None:
    alias = use.alias
    if interface.title:
        ui.label(interface.title).classes("interface-title")
    ui.label(interface.doc).classes("doc")
    ui.label(_facts(interface)).classes("small")
    ui.button("Open design", icon="open_in_new", on_click=lambda: context.page.open_component(use.component)).props(
        "flat no-caps dense"
    )
    heading(f"Outputs, read as {alias}.…")
    _table(interface.outputs)
    heading("Parameters")
    _table(interface.parameters)


def _facts(interface: Interface) -> str:
    """Describe frequency and XABSL name."""
    rate = (
        f"Runs at {number_text.format_number(interface.frequency_hz)} Hz"
        if interface.frequency_hz
        else "Runs on every step"
    )
    return rate + (f"; {interface.xabsl_name} in XABSL" if interface.xabsl_name else "")


def _about(declaration: Declaration) -> str:
    """Describe type, unit, range, value, arguments and XABSL name."""
    arguments = declaration.arguments
    parts = [
        format_arguments(arguments) if arguments is not None else "",
        declaration.type,
        declaration.unit,
        f"{number_text.format_number(declaration.range[0])} to {number_text.format_number(declaration.range[1])}"
        if declaration.range
        else "",
        f"= {declaration.initial}" if declaration.initial else "",
        f"{declaration.xabsl_name} in XABSL" if declaration.xabsl_name else "",
    ]
    return ", ".join(part for part in parts if part)


_ORIGINS = {
    WORLD: "Provided by the world",
    INTERNAL: "Variables shared by all designs",
    MISSING: texts.NOT_IMPLEMENTED,
}


def _table(declarations: tuple[Declaration, ...]) -> None:
    if not declarations:
        ui.label(texts.NO_DECLARATIONS).classes("empty")
    for declaration in declarations:
        with ui.row().classes("interface-row"):
            ui.label(declaration.name).classes("mono")
            ui.label(_about(declaration)).classes("interface-type")
            ui.label(declaration.doc).classes("interface-doc")


def link_panel(context: WindowContext, key: str) -> None:
    kind, state, alias = key.split("/")
    panel_title(f"{state} {kind}", alias)
    ui.button("Go to state", on_click=lambda: context.select(ItemRef(kind="states", id=state))).props(
        "flat dense no-caps"
    )

    def remove() -> None:
        context.edit(
            f"unlink {alias} from {state}",
            lambda design: remove_link(design, state, alias, modulates=kind == "modulates"),
        )
        context.select()

    ui.button("Remove", icon="delete", on_click=remove).props("flat dense no-caps color=negative")
