"""Forms of components without a design, and of agents."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.collapsible import collapsible_section
from vicode.editor.panels.declarations import describe_declaration
from vicode.editor.panels.fields import DOC, FREQUENCY, XABSL_NAME, Attribute, FieldKind, choice_field
from vicode.editor.panels.form import Form, ItemRows
from vicode.editor.panels.project.declaration_forms import add_buttons, declaration_form, form_group, show_write_error
from vicode.editor.panels.project.project_fields import (
    node_name,
    node_path,
    project_binding,
    project_name_field,
    project_text_field,
    write_node,
)
from vicode.editor.panels.widgets import add_button, heading
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.item_paths import TrackedItem
from vicode.editor.session.project_edits import add_declaration

TITLE = Attribute(label="Title", name="title", kind=FieldKind.TEXT)
_IMPLEMENTATION = Attribute(
    label="Implementation", name="implementation", hint="none yet; module:Class, world or internal"
)
_SECTIONS = (
    ("outputs", "Outputs", "values other components can read"),
    ("variables", "Variables", "values other components can read and set"),
    ("parameters", "Parameters", "values set by the states that modulate this component"),
)


def component_form(form: Form, node: TrackedItem, *, alias: str = "") -> None:
    """Build the form of a component without a design; `alias` is its name in the open design."""
    with form_group(form, node, "shared removable"):
        project_name_field(form, "Name", node)
        project_text_field(form, node, FREQUENCY)
        add_buttons(form, node)
        for attribute in (_IMPLEMENTATION, TITLE, DOC, XABSL_NAME):
            with ui.element("div").classes("wide"):
                project_text_field(form, node, attribute)
    for section, title, hint in _SECTIONS:
        heading(title, hint=f"{hint} as {alias}.…" if alias and section != "parameters" else hint)
        ItemRows(form, node, section, declaration_row)
        declaration_adder(form.context, node, section)


def declaration_adder(context: WindowContext, node: TrackedItem, section: str) -> None:
    """Build the button that adds a declaration to a section of a component."""
    with ui.row().classes("adders"):
        add_button("Add", f"Add {section.removesuffix('s')}", _adder(context, node, section))


def _adder(context: WindowContext, node: TrackedItem, section: str) -> Callable[[], None]:
    return lambda: show_write_error(
        context, write_node(context, node, lambda component: add_declaration(component, section))
    )


def declaration_row(form: Form, node: TrackedItem, prefix: str = "") -> None:
    """Build the collapsible form of a declaration; `prefix` precedes its name in the title."""
    section = collapsible_section(
        form,
        f"project {node_path(node).steps} whole {prefix}",
        lambda: prefix + node_name(node),
        lambda: describe_declaration(node.get()),
        lambda: declaration_form(form, node),
    )
    section.classes("declaration-more declared-line")


def agent_form(form: Form, node: TrackedItem) -> None:
    with form_group(form, node, "shared removable"):
        project_name_field(form, "Agent", node)
        binding = project_binding(form, node, "Root", "root")
        choice_field(form, binding, lambda _design: sorted(form.context.workspace.project.interfaces()))
        add_buttons(form, node)
        for attribute in (TITLE, XABSL_NAME, DOC):
            with ui.element("div").classes("wide" if attribute is DOC else ""):
                project_text_field(form, node, attribute)
