"""Forms of components without a design, and of agents."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.collapsible import collapsible_section
from vicode.editor.panels.declarations import format_arguments
from vicode.editor.panels.fields import Field
from vicode.editor.panels.project.declaration_forms import (
    add_remove_button,
    declaration_form,
    form_group,
    show_write_error,
)
from vicode.editor.panels.project.project_fields import (
    DOC,
    FREQUENCY,
    XABSL_NAME,
    TextAttribute,
    project_choice_field,
    project_name_field,
    project_text_field,
    write_node,
)
from vicode.editor.panels.widgets import add_button, heading
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import number_text
from vicode.editor.session.project_edits import add_declaration
from vicode.editor.session.project_paths import ProjectNodePath
from vicode.model.design import Declaration

TITLE = TextAttribute(label="Title", attribute="title")
_IMPLEMENTATION = TextAttribute(
    label="Implementation", attribute="implementation", hint="module:Class, world or internal"
)
_SECTIONS = (
    ("outputs", "Outputs", "values other components can read"),
    ("variables", "Variables", "values other components can read and set"),
    ("parameters", "Parameters", "inputs other components can set"),
)


def component_form(context: WindowContext, node_path: ProjectNodePath, fields: list[Field], *, alias: str = "") -> None:
    """Build the form of a component without a design; `alias` is its name in the open design."""
    group, show_name = form_group(context, node_path, "shared removable")
    with group:
        fields.append(project_name_field(context, "Name", node_path, show_name))
        fields.append(project_text_field(context, node_path, FREQUENCY))
        add_remove_button(context, node_path, show_name)
        for attribute in (_IMPLEMENTATION, TITLE, DOC):
            with ui.element("div").classes("wide"):
                fields.append(project_text_field(context, node_path, attribute))
        with ui.element("div").classes("wide"):
            fields.append(project_text_field(context, node_path, XABSL_NAME))
    component = node_path.get(context.workspace.project)
    for section, title, hint in _SECTIONS:
        heading(title, hint=f"{hint} as {alias}.…" if alias and section != "parameters" else hint)
        for number in range(len(getattr(component, section))):
            _declaration(context, node_path.child(section, number), fields)
        with ui.row().classes("adders"):
            add_button("Add", f"Add {section.removesuffix('s')}", _adder(context, node_path, section))


def _adder(context: WindowContext, node_path: ProjectNodePath, section: str) -> Callable[[], None]:
    return lambda: show_write_error(
        context, write_node(context, node_path, lambda component: add_declaration(component, section))
    )


def _declaration(context: WindowContext, node_path: ProjectNodePath, fields: list[Field]) -> None:
    def show() -> None:
        node = node_path.get(context.workspace.project)
        for section in sections if node is not None else ():
            if (section.text, section.props.get("caption")) != (node.name, _about(node)):
                section.props["caption"] = _about(node)
                section.set_text(node.name)

    def build() -> None:
        declaration_form(context, node_path, "Name", fields, show)

    node = node_path.get(context.workspace.project)
    key = f"project {node_path.steps} whole"
    # `show` runs before the section exists if the section is open.
    sections: list[ui.expansion] = []
    sections.append(
        collapsible_section(context, key, node.name, _about(node), build).classes("declaration-more declared-line")
    )


def _about(declaration: Declaration) -> str:
    """Describe type, unit, range, value and arguments, then the description."""
    arguments, range_ = declaration.arguments, declaration.range
    parts = (
        format_arguments(arguments) if arguments is not None else "",
        declaration.type,
        declaration.unit,
        f"{number_text.format_number(range_[0])} to {number_text.format_number(range_[1])}" if range_ else "",
        f"= {declaration.initial}" if declaration.initial else "",
    )
    summary = ", ".join(part for part in parts if part)
    return ": ".join(part for part in (summary, declaration.doc) if part)


def agent_form(context: WindowContext, node_path: ProjectNodePath, fields: list[Field]) -> None:
    group, show_name = form_group(context, node_path, "shared removable")
    with group:
        fields.append(project_name_field(context, "Agent", node_path, show_name))
        fields.append(
            project_choice_field(
                context, node_path, "Root", "root", lambda: sorted(context.workspace.project.interfaces())
            )
        )
        add_remove_button(context, node_path, show_name)
        for attribute in (TITLE, XABSL_NAME, DOC):
            with ui.element("div").classes("wide" if attribute is DOC else ""):
                fields.append(project_text_field(context, node_path, attribute))
