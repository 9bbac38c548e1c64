"""Forms of the declarations in project.yaml: constants, and the interfaces of hand-written components."""

from nicegui import ui

from vicode.editor.panels.collapsible import collapsible_section
from vicode.editor.panels.declarations import (
    RANGE,
    TUNABLE,
    TYPE,
    UNIT,
    ChangeDeclaration,
    argument_buttons,
)
from vicode.editor.panels.fields import DOC, XABSL_NAME, Attribute, checkbox_field
from vicode.editor.panels.form import Form, ItemRows
from vicode.editor.panels.project.project_fields import (
    node_name,
    node_path,
    project_binding,
    project_name_field,
    project_text_field,
    write_node,
    write_project,
)
from vicode.editor.panels.project.removal import confirm_and_remove
from vicode.editor.panels.texts import sentence
from vicode.editor.panels.widgets import icon_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.forms.declaration_form import declaration_caption
from vicode.editor.session.item_paths import TrackedItem

_VALUES = {"constants": "Value", "parameters": "Default", "arguments": "Default"}
_ORDERED = ("elements", "arguments")


def declaration_form(form: Form, node: TrackedItem, label: str = "Name") -> None:
    """Build the form of a declaration; `label` is the label of the name field."""
    path = node_path(node)
    with form_group(form, node):
        project_name_field(form, label, node)
        value = Attribute(label=_VALUES.get(path.section, "Initial"), name="initial")
        for attribute in (TYPE, value, UNIT, DOC):
            project_text_field(form, node, attribute)
        add_buttons(form, node)

        def more() -> None:
            project_text_field(form, node, RANGE)
            project_text_field(form, node, XABSL_NAME)
            if path.section == "outputs":
                _arguments(form, node)
            if path.section == "constants":
                checkbox_field(form, project_binding(form, node, TUNABLE.label, TUNABLE.name))

        def caption() -> str:
            declaration = node.get()
            return declaration_caption(declaration, path.section) if declaration else ""

        key = f"project {path.steps}"
        section = collapsible_section(form, key, lambda: "More", caption, more)
        section.classes("declaration-more")


def form_group(form: Form, node: TrackedItem, look: str = "") -> ui.element:
    """Build a group for the form of a node."""
    group = ui.element("div").classes(f"declaration {look}").props("role=group")
    form.watch(lambda: f"{node_path(node).kind} {node_name(node)}", lambda label: set_label(group, label))
    return group


def set_label(element: ui.element, label: str, *, prop: str = "aria-label") -> None:
    element.props[prop] = label
    element.update()


def add_buttons(form: Form, node: TrackedItem) -> None:
    """Build the remove button, and a "Move up" button where the order matters."""
    context = form.context

    def move_up() -> None:
        path, what = node_path(node), f"move {node_name(node)} up"
        show_write_error(context, write_project(context, path.move_up, what, path, is_confirmed=True))

    def show_name(name: str) -> None:
        set_label(remove, f"Remove {name}")
        if up is not None:
            set_label(up, f"Move up {name}")

    is_ordered = node_path(node).section in _ORDERED
    up = icon_button("arrow_upward", "Move up", move_up).classes("move-up") if is_ordered else None
    remove = icon_button("close", "Remove", lambda: confirm_and_remove(context, node))
    form.watch(lambda: f"{node_path(node).kind} {node_name(node)}", show_name)
    if up is not None:
        form.watch(lambda: bool(node.path and node.path[-1]), up.set_visibility)


def _arguments(form: Form, output: TrackedItem) -> None:
    """Build the forms of the arguments. An output with arguments is a function, without a value."""

    def edit(change: ChangeDeclaration) -> None:
        show_write_error(form.context, write_node(form.context, output, change))

    ItemRows(form, output, "arguments", declaration_form)
    with ui.row().classes("adders"):
        argument_buttons(form, output, edit)


def show_write_error(context: WindowContext, error: str) -> None:
    if error:
        context.show_toast(sentence(error), "warning")
