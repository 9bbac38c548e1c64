"""Forms of the declarations in project.yaml: constants, and the interfaces of hand-written components."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.collapsible import collapsible_section
from vicode.editor.panels.declarations import add_argument, declaration_caption, remove_arguments
from vicode.editor.panels.fields import Field
from vicode.editor.panels.project.project_fields import (
    DOC,
    RANGE,
    XABSL_NAME,
    TextAttribute,
    project_name_field,
    project_text_field,
    write_node,
    write_project,
)
from vicode.editor.panels.project.removal import confirm_and_remove
from vicode.editor.panels.texts import sentence
from vicode.editor.panels.widgets import add_button, icon_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.project_paths import ProjectNodePath

_VALUES = {"constant": "Value", "parameter": "Default", "argument": "Default"}
_ORDERED = ("elements", "arguments")
_UNIT = TextAttribute(label="Unit", attribute="unit")


def declaration_form(
    context: WindowContext,
    node_path: ProjectNodePath,
    label: str,
    fields: list[Field],
    on_refresh: Callable[[], None] = lambda: None,
) -> None:
    """Build the form of a declaration; `label` is the label of the name field."""
    group, show_name = form_group(context, node_path)
    with group:
        fields.append(project_name_field(context, label, node_path, show_name))
        value = _VALUES.get(node_path.kind, "Initial")
        attributes = (
            TextAttribute(label="Type", attribute="type"),
            TextAttribute(label=value, attribute="initial"),
            _UNIT,
            DOC,
        )
        fields.extend(project_text_field(context, node_path, attribute, on_refresh) for attribute in attributes)
        add_remove_button(context, node_path, show_name)

        def more() -> None:
            fields.append(project_text_field(context, node_path, RANGE, caption))
            fields.append(project_text_field(context, node_path, XABSL_NAME, caption))
            if node_path.kind == "output":
                _arguments(context, node_path, fields)

        def caption() -> None:
            node = node_path.get(context.workspace.project)
            summary = declaration_caption(node, node_path.kind) if node is not None else ""
            for group in sections:
                group.props["caption"] = summary
                group.update()

        # `caption` runs before the section exists if the section is open.
        sections: list[ui.expansion] = []
        sections.append(
            collapsible_section(context, f"project {node_path.steps}", "More", "", more).classes("declaration-more")
        )
        caption()


def form_group(
    context: WindowContext, node_path: ProjectNodePath, look: str = ""
) -> tuple[ui.element, Callable[[str], None]]:
    """Build a group for the form of a node; return it with a function that sets its name."""
    group = ui.element("div").classes(f"declaration {look}").props("role=group")

    def show_name(name: str) -> None:
        group.props["aria-label"] = f"{node_path.kind} {name}"
        group.update()
        for button in group.default_slot.children:
            if isinstance(button, ui.button):
                verb = "Move up" if "move-up" in button.classes else "Remove"
                button.props["aria-label"] = f"{verb} {node_path.kind} {name}"
                button.update()

    show_name(node_path.name(context.workspace.project))
    return group, show_name


def add_remove_button(context: WindowContext, node_path: ProjectNodePath, show_name: Callable[[str], None]) -> None:
    """Build the remove button, and a "Move up" button where the order matters."""
    if node_path.section in _ORDERED and node_path.steps[-1][1]:

        def move_up() -> None:
            what = f"move {node_path.name(context.workspace.project)} up"
            show_write_error(context, write_project(context, node_path.move_up, what, node_path, is_confirmed=True))

        icon_button("arrow_upward", "Move up", move_up).classes("move-up")
    icon_button("close", "Remove", lambda: confirm_and_remove(context, node_path))
    show_name(node_path.name(context.workspace.project))


def _arguments(context: WindowContext, node_path: ProjectNodePath, fields: list[Field]) -> None:
    """Build the forms of the arguments. An output with arguments is a function, without a value."""
    output = node_path.get(context.workspace.project)
    if output is None:
        return
    for number in range(len(output.arguments or ())):
        declaration_form(context, node_path.child("arguments", number), "Name", fields)
    with ui.row().classes("adders"):
        name = f"Add Argument to {output.name}"
        add_button("Argument", name, lambda: show_write_error(context, write_node(context, node_path, add_argument)))
        if output.arguments is not None:
            label = f"Remove arguments of {output.name}"
            add_button(
                "Remove arguments",
                label,
                lambda: show_write_error(context, write_node(context, node_path, remove_arguments)),
                icon="close",
            )


def show_write_error(context: WindowContext, error: str) -> None:
    if error:
        context.show_toast(sentence(error), "warning")
