"""What project.yaml declares for all designs, in a fold of every design's form."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from nicegui import ui

from vicode.editor.panels.desk import Desk
from vicode.editor.panels.fields import Field
from vicode.editor.panels.folds import fold
from vicode.editor.panels.project.components import agent_form, component_form
from vicode.editor.panels.project.declared import declaration_form, group, remover, tell
from vicode.editor.panels.project.fields import (
    DOC,
    XABSL_NAME,
    Line,
    flag_in_file,
    line_in_file,
    name_in_file,
    typed_in_file,
    write,
    write_project,
)
from vicode.editor.panels.rows import add_button, heading
from vicode.editor.session import project_edits
from vicode.editor.session.declared_names import refuse_shape
from vicode.editor.session.project_spots import Spot
from vicode.model.design import Design
from vicode.model.project import Enumeration, Project

_OF_THE_PROJECT = (
    Line(label="Name of the project", attribute="name", refuse=refuse_shape),
    replace(DOC, label="Doc of the project"),
    Line(
        label="Languages",
        attribute="languages",
        hint="python",
        text_of=", ".join,
        value_of=lambda text: tuple(text.replace(",", " ").split()),
    ),
    Line(label="World", attribute="world", hint="module:Class"),
)


def project_form(desk: Desk, fields: list[Field]) -> None:
    """Build the fold."""
    project = desk.workspace.project
    parts = (
        ("enumeration", project.enumerations),
        ("constant", project.constants),
        ("component", project.components),
        ("agent", project.agents),
    )
    counts = (f"{len(things)} {word}{'s' * (len(things) != 1)}" for word, things in parts if things)

    def build() -> None:
        ui.label("Of all designs; a change is written into project.yaml at once.").classes("empty")
        fields.extend(line_in_file(desk, Spot(steps=()), line) for line in _OF_THE_PROJECT)
        heading("Enumerations", hint="types whose values are named")
        for number in range(len(project.enumerations)):
            _enumeration(desk, Spot.of("enumerations", number), fields)
        _adder(desk, "Enumeration", project_edits.add_enumeration)
        heading("Constants", hint="values that all designs may use")
        for number in range(len(project.constants)):
            declaration_form(desk, Spot.of("constants", number), "Constant", fields)
        _adder(desk, "Constant", project_edits.add_constant)
        heading("Hand-written components", hint="and what they offer")
        for number in range(len(project.components)):
            _component(desk, Spot.of("components", number), fields)
        _adder(desk, "Component", project_edits.add_component)
        heading("Agents", hint="names for running the project")
        for number in range(len(project.agents)):
            agent_form(desk, Spot.of("agents", number), fields)
        root = desk.design.component
        _adder(desk, "Agent", lambda project: project_edits.add_agent(project, root))

    fold(desk, "project", f"Project {project.name}", ", ".join(counts) or "nothing declared yet", build)


def _adder(desk: Desk, kind: str, change: Callable[[Project], Project]) -> None:
    words = f"one more {kind.lower()}"
    with ui.row().classes("adders"):
        add_button(kind, f"{kind}: one more in the project", lambda: tell(desk, write_project(desk, change, words)))


def _component(desk: Desk, spot: Spot, fields: list[Field]) -> None:
    found = spot.read(desk.workspace.project)
    key, caption = f"project {spot.steps} whole", found.implementation
    fold(desk, key, found.component, caption, lambda: component_form(desk, spot, fields)).classes(
        "declaration-more declared-line"
    )


def _enumeration(desk: Desk, spot: Spot, fields: list[Field]) -> None:
    whole, called = group(desk, spot, "shared removable")
    elements = range(len(spot.read(desk.workspace.project).elements))
    with whole:
        fields.append(name_in_file(desk, "Enumeration", spot, called))
        fields.append(line_in_file(desk, spot, XABSL_NAME))
        remover(desk, spot, called)
        with ui.element("div").classes("wide"):
            fields.append(line_in_file(desk, spot, DOC))
        fields.append(flag_in_file(desk, spot, "Internal: XABSL's engine numbers its elements", "internal"))
        for at in elements:
            _element(desk, spot, at, fields)
        with ui.row().classes("adders wide"):
            name = f"Element: one more of {spot.name(desk.workspace.project)}"
            add_button("Element", name, lambda: tell(desk, write(desk, spot, project_edits.add_element)))

        def more() -> None:
            fields.extend(_xabsl_element(desk, spot, at) for at in elements)

        said = [f"{name} is {other}" for name, other in spot.read(desk.workspace.project).xabsl_elements]
        key = f"project {spot.steps}"
        fold(desk, key, "Elements in XABSL", "; ".join(said) or "other names", more).classes("declaration-more")


def _element(desk: Desk, spot: Spot, at: int, fields: list[Field]) -> None:
    """An element with what it means."""
    inner = spot.inner("elements", at)

    def read(_design: Design) -> str:
        pair = inner.read(desk.workspace.project)
        return str(pair[1]) if pair else ""

    def change(text: str) -> Callable[[Any], Any]:
        return lambda pair: (pair[0], text)

    whole, called = group(desk, inner, "element-row")
    with whole:
        fields.append(name_in_file(desk, f"Element {at + 1}", inner, called))
        meaning = Line(label="Meaning", attribute="doc")
        fields.append(typed_in_file(desk, inner, meaning, (read, change)))
        remover(desk, inner, called)


def _xabsl_element(desk: Desk, spot: Spot, at: int) -> Field:
    """The name of an element in XABSL."""

    def name(enumeration: Enumeration | None) -> str:
        names = enumeration.element_names if enumeration else ()
        return names[at] if at < len(names) else ""

    def read(_design: Design) -> str:
        found = spot.read(desk.workspace.project)
        return dict(found.xabsl_elements).get(name(found), "") if found else ""

    def change(text: str) -> Callable[[Any], Any]:
        def changed(enumeration: Enumeration) -> Enumeration:
            known = {**dict(enumeration.xabsl_elements), name(enumeration): text.strip()}
            pairs = ((each, known.get(each, "")) for each in enumeration.element_names)
            return replace(enumeration, xabsl_elements=tuple(pair for pair in pairs if pair[1]))

        return changed

    line = Line(label=f"Element {at + 1} in XABSL", attribute="xabsl_elements")
    return typed_in_file(desk, spot, line, (read, change))
