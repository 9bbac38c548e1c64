"""The section of the design form with the declarations of project.yaml."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.collapsible import collapsible_section
from vicode.editor.panels.fields import Field
from vicode.editor.panels.project.component_forms import agent_form, component_form
from vicode.editor.panels.project.declaration_forms import (
    add_remove_button,
    declaration_form,
    form_group,
    show_write_error,
)
from vicode.editor.panels.project.project_fields import (
    DOC,
    XABSL_NAME,
    TextAttribute,
    project_checkbox,
    project_custom_field,
    project_name_field,
    project_text_field,
    write_node,
    write_project,
)
from vicode.editor.panels.widgets import add_button, heading
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import project_edits
from vicode.editor.session.project_paths import ProjectNodePath
from vicode.editor.session.rename_symbol import validate_identifier
from vicode.model.design import Design
from vicode.model.project import Enumeration, Project

_PROJECT_ATTRIBUTES = (
    TextAttribute(label="Project name", attribute="name", validate=validate_identifier),
    replace(DOC, label="Project description"),
    TextAttribute(
        label="Languages",
        attribute="languages",
        hint="python",
        format=", ".join,
        parse=lambda text: tuple(text.replace(",", " ").split()),
    ),
    TextAttribute(label="World", attribute="world", hint="module:Class"),
)


def project_form(context: WindowContext, fields: list[Field]) -> None:
    project = context.workspace.project
    parts = (
        ("enumeration", project.enumerations),
        ("constant", project.constants),
        ("component", project.components),
        ("agent", project.agents),
    )
    counts = (texts.pluralize(len(nodes), noun) for noun, nodes in parts if nodes)

    def build() -> None:
        ui.label(texts.PROJECT_SCOPE).classes("empty")
        fields.extend(
            project_text_field(context, ProjectNodePath(steps=()), attribute) for attribute in _PROJECT_ATTRIBUTES
        )
        heading("Enumerations", hint="types with named values")
        for number in range(len(project.enumerations)):
            _enumeration(context, ProjectNodePath.top_level("enumerations", number), fields)
        _adder(context, "Enumeration", project_edits.add_enumeration)
        heading("Constants", hint="values available in all designs")
        for number in range(len(project.constants)):
            declaration_form(context, ProjectNodePath.top_level("constants", number), "Constant", fields)
        _adder(context, "Constant", project_edits.add_constant)
        heading("Hand-written components", hint="components without a design")
        for number in range(len(project.components)):
            _component(context, ProjectNodePath.top_level("components", number), fields)
        _adder(context, "Component", project_edits.add_component)
        heading("Agents", hint="entry points for running the project")
        for number in range(len(project.agents)):
            agent_form(context, ProjectNodePath.top_level("agents", number), fields)
        root = context.design.component
        _adder(context, "Agent", lambda project: project_edits.add_agent(project, root))

    collapsible_section(context, "project", f"Project {project.name}", ", ".join(counts) or "nothing declared", build)


def _adder(context: WindowContext, kind: str, change: Callable[[Project], Project]) -> None:
    summary = f"add {kind.lower()}"
    with ui.row().classes("adders"):
        add_button(
            kind,
            f"Add {kind} to the project",
            lambda: show_write_error(context, write_project(context, change, summary)),
        )


def _component(context: WindowContext, node_path: ProjectNodePath, fields: list[Field]) -> None:
    node = node_path.get(context.workspace.project)
    key, caption = f"project {node_path.steps} whole", node.implementation
    collapsible_section(
        context, key, node.component, caption, lambda: component_form(context, node_path, fields)
    ).classes("declaration-more declared-line")


def _enumeration(context: WindowContext, node_path: ProjectNodePath, fields: list[Field]) -> None:
    group, show_name = form_group(context, node_path, "shared removable")
    elements = range(len(node_path.get(context.workspace.project).elements))
    with group:
        fields.append(project_name_field(context, "Enumeration", node_path, show_name))
        fields.append(project_text_field(context, node_path, XABSL_NAME))
        add_remove_button(context, node_path, show_name)
        with ui.element("div").classes("wide"):
            fields.append(project_text_field(context, node_path, DOC))
        fields.append(
            project_checkbox(context, node_path, "Internal (elements numbered by the XABSL engine)", "internal")
        )
        for index in elements:
            _element(context, node_path, index, fields)
        with ui.row().classes("adders wide"):
            name = f"Add Element to {node_path.name(context.workspace.project)}"
            add_button(
                "Element",
                name,
                lambda: show_write_error(context, write_node(context, node_path, project_edits.add_element)),
            )

        def more() -> None:
            fields.extend(_xabsl_element(context, node_path, index) for index in elements)

        xabsl_names = [f"{name}: {other}" for name, other in node_path.get(context.workspace.project).xabsl_elements]
        key = f"project {node_path.steps}"
        collapsible_section(
            context, key, "Elements in XABSL", "; ".join(xabsl_names) or "names in XABSL", more
        ).classes("declaration-more")


def _element(context: WindowContext, node_path: ProjectNodePath, index: int, fields: list[Field]) -> None:
    inner = node_path.child("elements", index)

    def read(_design: Design) -> str:
        pair = inner.get(context.workspace.project)
        return str(pair[1]) if pair else ""

    def change(text: str) -> Callable[[Any], Any]:
        return lambda pair: (pair[0], text)

    group, show_name = form_group(context, inner, "element-row")
    with group:
        fields.append(project_name_field(context, f"Element {index + 1}", inner, show_name))
        meaning = TextAttribute(label="Meaning", attribute="doc")
        fields.append(project_custom_field(context, inner, meaning, (read, change)))
        add_remove_button(context, inner, show_name)


def _xabsl_element(context: WindowContext, node_path: ProjectNodePath, index: int) -> Field:
    def name(enumeration: Enumeration | None) -> str:
        names = enumeration.element_names if enumeration else ()
        return names[index] if index < len(names) else ""

    def read(_design: Design) -> str:
        node = node_path.get(context.workspace.project)
        return dict(node.xabsl_elements).get(name(node), "") if node else ""

    def change(text: str) -> Callable[[Any], Any]:
        def changed(enumeration: Enumeration) -> Enumeration:
            names = {**dict(enumeration.xabsl_elements), name(enumeration): text.strip()}
            pairs = ((each, names.get(each, "")) for each in enumeration.element_names)
            return replace(enumeration, xabsl_elements=tuple(pair for pair in pairs if pair[1]))

        return changed

    attribute = TextAttribute(label=f"Element {index + 1} in XABSL", attribute="xabsl_elements")
    return project_custom_field(context, node_path, attribute, (read, change))
