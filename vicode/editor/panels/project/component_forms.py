"""Forms of components that have no design, but a class written by hand or by vicode; and of agents."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.collapsible import collapsible_section
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
    ("outputs", "Outputs", "what others may read"),
    ("variables", "Variables", "what others may read and set"),
    ("parameters", "Parameters", "what others may modulate in it"),
)


def component_form(context: WindowContext, spot: ProjectNodePath, fields: list[Field], *, alias: str = "") -> None:
    """Build the form of a component without a design, as it is used under an alias, if there is one."""
    whole, called = form_group(context, spot, "shared removable")
    with whole:
        fields.append(project_name_field(context, "Name", spot, called))
        fields.append(project_text_field(context, spot, FREQUENCY))
        add_remove_button(context, spot, called)
        for line in (_IMPLEMENTATION, TITLE, DOC):
            with ui.element("div").classes("wide"):
                fields.append(project_text_field(context, spot, line))
        with ui.element("div").classes("wide"):
            fields.append(project_text_field(context, spot, XABSL_NAME))
    component = spot.get(context.workspace.project)
    for section, title, hint in _SECTIONS:
        heading(title, hint=f"{hint} as {alias}.…" if alias and section != "parameters" else hint)
        for number in range(len(getattr(component, section))):
            _declaration(context, spot.child(section, number), fields)
        with ui.row().classes("adders"):
            add_button("Declare", f"Declare: one more of the {section}", _adder(context, spot, section))


def _adder(context: WindowContext, spot: ProjectNodePath, section: str) -> Callable[[], None]:
    return lambda: show_write_error(
        context, write_node(context, spot, lambda component: add_declaration(component, section))
    )


def _declaration(context: WindowContext, spot: ProjectNodePath, fields: list[Field]) -> None:
    """A declaration as a line that opens."""

    def show() -> None:
        found = spot.get(context.workspace.project)
        for whole in told if found is not None else ():
            if (whole.text, whole.props.get("caption")) != (found.name, _about(found)):
                whole.props["caption"] = _about(found)
                whole.set_text(found.name)

    def build() -> None:
        declaration_form(context, spot, "Name", fields, show)

    found = spot.get(context.workspace.project)
    key = f"project {spot.steps} whole"
    # What is open is built at once, before there is a fold to tell.
    told: list[ui.expansion] = []
    told.append(
        collapsible_section(context, key, found.name, _about(found), build).classes("declaration-more declared-line")
    )


def _about(declaration: Declaration) -> str:
    """Type, unit, range, value and arguments, as far as they are said; then its doc."""
    given, ends = declaration.arguments, declaration.range
    parts = (
        f"takes {', '.join(each.name for each in given) or 'nothing'}" if given is not None else "",
        declaration.type,
        declaration.unit,
        f"{number_text.format_number(ends[0])} to {number_text.format_number(ends[1])}" if ends else "",
        f"= {declaration.initial}" if declaration.initial else "",
    )
    said = ", ".join(part for part in parts if part)
    return ": ".join(part for part in (said, declaration.doc) if part)


def agent_form(context: WindowContext, spot: ProjectNodePath, fields: list[Field]) -> None:
    """Build the form of an agent."""
    whole, called = form_group(context, spot, "shared removable")
    with whole:
        fields.append(project_name_field(context, "Agent", spot, called))
        fields.append(
            project_choice_field(context, spot, "Root", "root", lambda: sorted(context.workspace.project.interfaces()))
        )
        add_remove_button(context, spot, called)
        for line in (TITLE, XABSL_NAME, DOC):
            with ui.element("div").classes("wide" if line is DOC else ""):
                fields.append(project_text_field(context, spot, line))
