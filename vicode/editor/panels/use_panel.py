"""The selected component: what it shows to this design, and the states that use it."""

from nicegui import ui

from vicode.editor.panels.fields import Field, FieldBinding
from vicode.editor.panels.name_field import name_field, rename_node
from vicode.editor.panels.project.component_forms import component_form
from vicode.editor.panels.widgets import heading, panel_title
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import number_text
from vicode.editor.session.project_paths import ProjectNodePath
from vicode.editor.view import ItemRef
from vicode.model.design import Declaration, Use
from vicode.model.edits import remove_link, remove_uses
from vicode.model.project import INTERNAL, WORLD, Interface


def use_panel(context: WindowContext, alias: str) -> list[Field]:
    """Build the panel of a used component: the name it has here, and what it shows."""
    use = context.design.use(alias)
    if use is None:
        return []
    project = context.workspace.project
    interface = project.interface(use.component)
    panel_title("Component", use.component)
    fields: list[Field] = [_alias(context, alias)]
    if interface is None:
        ui.label("Nothing in the project declares it.").classes("field-finding")
        return fields
    if project.design(use.component) is None:
        _hand_written(context, use, fields)
    else:
        _designed(context, use, interface)

    def remove() -> None:
        context.edit(f"stop using {alias}", lambda design: remove_uses(design, [alias]))
        context.select()

    ui.button("Stop using it", icon="delete", on_click=remove).props("flat dense no-caps color=negative")
    return fields


def _hand_written(context: WindowContext, use: Use, fields: list[Field]) -> None:
    """Of a component without a design the form: what it shows stands in project.yaml."""
    components = context.workspace.project.components
    number = next(at for at, each in enumerate(components) if each.component == use.component)
    ui.label(_ORIGINS.get(components[number].implementation, "Written by hand")).classes("small")
    ui.label("Of all designs; a change is written into project.yaml at once.").classes("empty")
    component_form(context, ProjectNodePath.top_level("components", number), fields, alias=use.alias)


def _designed(context: WindowContext, use: Use, interface: Interface) -> None:
    """Of a component with a design what it shows: its form is elsewhere."""
    alias = use.alias
    if interface.title:
        ui.label(interface.title).classes("interface-title")
    ui.label(interface.doc).classes("doc")
    ui.label(_facts(interface)).classes("small")
    ui.button("Open its design", icon="open_in_new", on_click=lambda: context.open_component(use.component)).props(
        "flat no-caps dense"
    )
    heading(f"Outputs, read as {alias}.…")
    _table(interface.outputs)
    heading("Parameters")
    _table(interface.parameters)


def _alias(context: WindowContext, alias: str) -> Field:
    def take(old: str, new: str) -> str:
        return rename_node(context, ItemRef(kind="components", id=old), new)

    bound = FieldBinding(
        label="Used here as",
        read=lambda design: alias if design.use(alias) else "",
        write=lambda design, _value: design,
        path=("uses", alias),
    )
    return name_field(context, bound, take)


def _facts(interface: Interface) -> str:
    """What project.yaml says of it beside its declarations."""
    rate = (
        f"Works at {number_text.format_number(interface.frequency_hz)} Hz"
        if interface.frequency_hz
        else "Works at every step"
    )
    return rate + (f", in XABSL {interface.xabsl_name}" if interface.xabsl_name else "")


def _about(declaration: Declaration) -> str:
    """Type, unit, range, value, arguments and the name in XABSL, as far as they are said."""
    given = declaration.arguments
    parts = [
        f"takes {', '.join(each.name for each in given) or 'nothing'}" if given is not None else "",
        declaration.type,
        declaration.unit,
        f"{number_text.format_number(declaration.range[0])} to {number_text.format_number(declaration.range[1])}"
        if declaration.range
        else "",
        f"= {declaration.initial}" if declaration.initial else "",
        f"in XABSL {declaration.xabsl_name}" if declaration.xabsl_name else "",
    ]
    return ", ".join(part for part in parts if part)


_ORIGINS = {WORLD: "Handed on to the world", INTERNAL: "A memory that all designs share"}


def _table(declarations: tuple[Declaration, ...]) -> None:
    if not declarations:
        ui.label("None.").classes("empty")
    for declaration in declarations:
        with ui.row().classes("interface-row"):
            ui.label(declaration.name).classes("mono")
            ui.label(_about(declaration)).classes("interface-type")
            ui.label(declaration.doc).classes("interface-doc")


def link_panel(context: WindowContext, key: str) -> list[Field]:
    """Build the panel of a link between a state and a component."""
    kind, state, alias = key.split("/")
    panel_title(f"{state} {kind}", alias)
    ui.button("Open the state", on_click=lambda: context.select(ItemRef(kind="states", id=state))).props(
        "flat dense no-caps"
    )

    def remove() -> None:
        context.edit(
            f"{state}: no {alias}", lambda design: remove_link(design, state, alias, modulates=kind == "modulates")
        )
        context.select()

    ui.button("Remove", icon="delete", on_click=remove).props("flat dense no-caps color=negative")
    return []
