"""What project.yaml declares for all designs, in a fold of every design's form."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from nicegui import ui

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
    TextAttribute(label="Name of the project", attribute="name", validate=validate_identifier),
    replace(DOC, label="Doc of the project"),
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
    """Build the fold."""
    project = context.workspace.project
    parts = (
        ("enumeration", project.enumerations),
        ("constant", project.constants),
        ("component", project.components),
        ("agent", project.agents),
    )
    counts = (f"{len(things)} {word}{'s' * (len(things) != 1)}" for word, things in parts if things)

    def build() -> None:
        ui.label("Of all designs; a change is written into project.yaml at once.").classes("empty")
        fields.extend(project_text_field(context, ProjectNodePath(steps=()), line) for line in _PROJECT_ATTRIBUTES)
        heading("Enumerations", hint="types whose values are named")
        for number in range(len(project.enumerations)):
            _enumeration(context, ProjectNodePath.top_level("enumerations", number), fields)
        _adder(context, "Enumeration", project_edits.add_enumeration)
        heading("Constants", hint="values that all designs may use")
        for number in range(len(project.constants)):
            declaration_form(context, ProjectNodePath.top_level("constants", number), "Constant", fields)
        _adder(context, "Constant", project_edits.add_constant)
        heading("Hand-written components", hint="and what they offer")
        for number in range(len(project.components)):
            _component(context, ProjectNodePath.top_level("components", number), fields)
        _adder(context, "Component", project_edits.add_component)
        heading("Agents", hint="names for running the project")
        for number in range(len(project.agents)):
            agent_form(context, ProjectNodePath.top_level("agents", number), fields)
        root = context.design.component
        _adder(context, "Agent", lambda project: project_edits.add_agent(project, root))

    collapsible_section(
        context, "project", f"Project {project.name}", ", ".join(counts) or "nothing declared yet", build
    )


def _adder(context: WindowContext, kind: str, change: Callable[[Project], Project]) -> None:
    words = f"one more {kind.lower()}"
    with ui.row().classes("adders"):
        add_button(
            kind,
            f"{kind}: one more in the project",
            lambda: show_write_error(context, write_project(context, change, words)),
        )


def _component(context: WindowContext, spot: ProjectNodePath, fields: list[Field]) -> None:
    found = spot.get(context.workspace.project)
    key, caption = f"project {spot.steps} whole", found.implementation
    collapsible_section(context, key, found.component, caption, lambda: component_form(context, spot, fields)).classes(
        "declaration-more declared-line"
    )


def _enumeration(context: WindowContext, spot: ProjectNodePath, fields: list[Field]) -> None:
    whole, called = form_group(context, spot, "shared removable")
    elements = range(len(spot.get(context.workspace.project).elements))
    with whole:
        fields.append(project_name_field(context, "Enumeration", spot, called))
        fields.append(project_text_field(context, spot, XABSL_NAME))
        add_remove_button(context, spot, called)
        with ui.element("div").classes("wide"):
            fields.append(project_text_field(context, spot, DOC))
        fields.append(project_checkbox(context, spot, "Internal: XABSL's engine numbers its elements", "internal"))
        for at in elements:
            _element(context, spot, at, fields)
        with ui.row().classes("adders wide"):
            name = f"Element: one more of {spot.name(context.workspace.project)}"
            add_button(
                "Element", name, lambda: show_write_error(context, write_node(context, spot, project_edits.add_element))
            )

        def more() -> None:
            fields.extend(_xabsl_element(context, spot, at) for at in elements)

        said = [f"{name} is {other}" for name, other in spot.get(context.workspace.project).xabsl_elements]
        key = f"project {spot.steps}"
        collapsible_section(context, key, "Elements in XABSL", "; ".join(said) or "other names", more).classes(
            "declaration-more"
        )


def _element(context: WindowContext, spot: ProjectNodePath, at: int, fields: list[Field]) -> None:
    """An element with what it means."""
    inner = spot.child("elements", at)

    def read(_design: Design) -> str:
        pair = inner.get(context.workspace.project)
        return str(pair[1]) if pair else ""

    def change(text: str) -> Callable[[Any], Any]:
        return lambda pair: (pair[0], text)

    whole, called = form_group(context, inner, "element-row")
    with whole:
        fields.append(project_name_field(context, f"Element {at + 1}", inner, called))
        meaning = TextAttribute(label="Meaning", attribute="doc")
        fields.append(project_custom_field(context, inner, meaning, (read, change)))
        add_remove_button(context, inner, called)


def _xabsl_element(context: WindowContext, spot: ProjectNodePath, at: int) -> Field:
    """The name of an element in XABSL."""

    def name(enumeration: Enumeration | None) -> str:
        names = enumeration.element_names if enumeration else ()
        return names[at] if at < len(names) else ""

    def read(_design: Design) -> str:
        found = spot.get(context.workspace.project)
        return dict(found.xabsl_elements).get(name(found), "") if found else ""

    def change(text: str) -> Callable[[Any], Any]:
        def changed(enumeration: Enumeration) -> Enumeration:
            known = {**dict(enumeration.xabsl_elements), name(enumeration): text.strip()}
            pairs = ((each, known.get(each, "")) for each in enumeration.element_names)
            return replace(enumeration, xabsl_elements=tuple(pair for pair in pairs if pair[1]))

        return changed

    line = TextAttribute(label=f"Element {at + 1} in XABSL", attribute="xabsl_elements")
    return project_custom_field(context, spot, line, (read, change))
