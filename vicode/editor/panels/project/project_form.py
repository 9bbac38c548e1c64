"""The section of the design form with the declarations of project.yaml."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.collapsible import collapsible_section
from vicode.editor.panels.fields import DOC, XABSL_NAME, Attribute, Field, FieldKind, checkbox_field
from vicode.editor.panels.form import Form, ItemRows
from vicode.editor.panels.project.component_forms import agent_form, component_form
from vicode.editor.panels.project.declaration_forms import (
    add_buttons,
    declaration_form,
    form_group,
    set_label,
    show_write_error,
)
from vicode.editor.panels.project.project_fields import (
    node_name,
    node_path,
    project_binding,
    project_custom_field,
    project_name_field,
    project_node,
    project_text_field,
    write_node,
    write_project,
)
from vicode.editor.panels.widgets import add_button, heading
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import project_edits
from vicode.editor.session.item_paths import TrackedItem
from vicode.editor.session.rename_symbol import validate_identifier
from vicode.model.design import Design
from vicode.model.project import Enumeration, Project

_PROJECT_ATTRIBUTES = (
    Attribute(label="Project name", name="name", validate=validate_identifier),
    replace(DOC, label="Project description"),
    Attribute(
        label="Languages",
        name="languages",
        hint="python",
        format=", ".join,
        parse=lambda text: tuple(text.replace(",", " ").split()),
    ),
    Attribute(label="World", name="world", hint="module:Class"),
)
_INTERNAL = "Internal (elements numbered by the XABSL engine)"


def project_form(form: Form) -> None:
    """Build the section."""
    context, project = form.context, project_node(form)

    def caption() -> str:
        now = context.workspace.project
        parts = (
            ("enumeration", now.enumerations),
            ("constant", now.constants),
            ("component", now.components),
            ("agent", now.agents),
        )
        counts = (texts.pluralize(len(nodes), noun) for noun, nodes in parts if nodes)
        return ", ".join(counts) or "nothing declared"

    def build() -> None:
        ui.label(texts.PROJECT_SCOPE).classes("empty")
        for attribute in _PROJECT_ATTRIBUTES:
            project_text_field(form, project, attribute)
        heading("Enumerations", hint="types with named values")
        ItemRows(form, project, "enumerations", _enumeration)
        _adder(context, "Enumeration", project_edits.add_enumeration)
        heading("Constants", hint="values available in all designs")
        ItemRows(form, project, "constants", lambda row, node: declaration_form(row, node, "Constant"))
        _adder(context, "Constant", project_edits.add_constant)
        heading("Hand-written components", hint="components without a design")
        ItemRows(form, project, "components", _component)
        _adder(context, "Component", project_edits.add_component)
        heading("Agents", hint="entry points for running the project")
        ItemRows(form, project, "agents", agent_form)
        root = context.design.component
        _adder(context, "Agent", lambda project: project_edits.add_agent(project, root))

    def title() -> str:
        return f"Project {context.workspace.project.name}"

    collapsible_section(form, "project", title, caption, build, is_shared=True)


def _adder(context: WindowContext, kind: str, change: Callable[[Project], Project]) -> None:
    summary = f"add {kind.lower()}"
    with ui.row().classes("adders"):
        add_button(
            kind,
            f"Add {kind} to the project",
            lambda: show_write_error(context, write_project(context, change, summary)),
        )


def _component(form: Form, node: TrackedItem) -> None:
    section = collapsible_section(
        form,
        f"project {node_path(node).steps} whole",
        lambda: node_name(node),
        lambda: getattr(node.get(), "implementation", ""),
        lambda: component_form(form, node),
    )
    section.classes("declaration-more declared-line")


def _enumeration(form: Form, node: TrackedItem) -> None:
    context = form.context

    def add_element() -> None:
        show_write_error(context, write_node(context, node, project_edits.add_element))

    def caption() -> str:
        names = (f"{name}: {other}" for name, other in getattr(node.get(), "xabsl_elements", ()))
        return "; ".join(names) or "names in XABSL"

    with form_group(form, node, "shared removable"):
        project_name_field(form, "Enumeration", node)
        project_text_field(form, node, XABSL_NAME)
        add_buttons(form, node)
        with ui.element("div").classes("wide"):
            project_text_field(form, node, DOC)
        checkbox_field(form, project_binding(form, node, _INTERNAL, "internal")).element.classes("wide")
        ItemRows(form, node, "elements", _element)
        with ui.row().classes("adders wide"):
            button = add_button("Element", "Add Element", add_element)
            form.watch(lambda: f"Add Element to {node_name(node)}", lambda label: set_label(button, label))
        section = collapsible_section(
            form,
            f"project {node_path(node).steps}",
            lambda: "Elements in XABSL",
            caption,
            lambda: ItemRows(form, node, "elements", _xabsl_element),
        )
        section.classes("declaration-more")


def _element(form: Form, node: TrackedItem) -> None:
    def read(_design: Design) -> str:
        pair = node.get()
        return str(pair[1]) if pair else ""

    def change(text: str) -> Callable[[Any], Any]:
        return lambda pair: (pair[0], text)

    with form_group(form, node, "element-row"):
        _number(form, node, project_name_field(form, "Element", node), "Element {}")
        meaning = Attribute(label="Meaning", name="doc", kind=FieldKind.TEXT)
        project_custom_field(form, node, meaning, (read, change))
        add_buttons(form, node)


def _number(form: Form, node: TrackedItem, field: Field, label: str) -> None:
    """Label the field of an element with its number."""
    form.watch(
        lambda: label.format(int(node.path[-1]) + 1 if node.path else ""),
        lambda text: set_label(field.element, text, prop="label"),
    )


def _xabsl_element(form: Form, element: TrackedItem) -> None:
    enumeration = project_node(form, *(element.path or ())[:-2])

    def name() -> str:
        return node_name(element)

    def read(_design: Design) -> str:
        node = enumeration.get()
        return dict(node.xabsl_elements).get(name(), "") if node else ""

    def change(text: str) -> Callable[[Any], Any]:
        def changed(node: Enumeration) -> Enumeration:
            names = {**dict(node.xabsl_elements), name(): text}
            pairs = ((each, names.get(each, "")) for each in node.element_names)
            return replace(node, xabsl_elements=tuple(pair for pair in pairs if pair[1]))

        return changed

    attribute = Attribute(label="Element in XABSL", name="xabsl_elements")
    _number(form, element, project_custom_field(form, enumeration, attribute, (read, change)), "Element {} in XABSL")
