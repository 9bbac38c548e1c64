"""Forms of components that have no design, but a class written by hand or by vicode; and of agents."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.desk import Desk
from vicode.editor.panels.fields import Field
from vicode.editor.panels.folds import fold
from vicode.editor.panels.project.declared import declaration_form, group, remover, tell
from vicode.editor.panels.project.fields import (
    DOC,
    FREQUENCY,
    XABSL_NAME,
    Line,
    choice_in_file,
    line_in_file,
    name_in_file,
    write,
)
from vicode.editor.panels.rows import add_button, heading
from vicode.editor.session import numbers
from vicode.editor.session.project_edits import add_declaration
from vicode.editor.session.project_spots import Spot
from vicode.model.design import Declaration

TITLE = Line(label="Title", attribute="title")
_IMPLEMENTATION = Line(label="Implementation", attribute="implementation", hint="module:Class, world or internal")
_SECTIONS = (
    ("outputs", "Outputs", "what others may read"),
    ("variables", "Variables", "what others may read and set"),
    ("parameters", "Parameters", "what others may modulate in it"),
)


def component_form(desk: Desk, spot: Spot, fields: list[Field], *, alias: str = "") -> None:
    """Build the form of a component without a design, as it is used under an alias, if there is one."""
    whole, called = group(desk, spot, "shared removable")
    with whole:
        fields.append(name_in_file(desk, "Name", spot, called))
        fields.append(line_in_file(desk, spot, FREQUENCY))
        remover(desk, spot, called)
        for line in (_IMPLEMENTATION, TITLE, DOC):
            with ui.element("div").classes("wide"):
                fields.append(line_in_file(desk, spot, line))
        with ui.element("div").classes("wide"):
            fields.append(line_in_file(desk, spot, XABSL_NAME))
    component = spot.read(desk.workspace.project)
    for section, title, hint in _SECTIONS:
        heading(title, hint=f"{hint} as {alias}.…" if alias and section != "parameters" else hint)
        for number in range(len(getattr(component, section))):
            _declaration(desk, spot.inner(section, number), fields)
        with ui.row().classes("adders"):
            add_button("Declare", f"Declare: one more of the {section}", _adder(desk, spot, section))


def _adder(desk: Desk, spot: Spot, section: str) -> Callable[[], None]:
    return lambda: tell(desk, write(desk, spot, lambda component: add_declaration(component, section)))


def _declaration(desk: Desk, spot: Spot, fields: list[Field]) -> None:
    """A declaration as a line that opens."""

    def show() -> None:
        found = spot.read(desk.workspace.project)
        for whole in told if found is not None else ():
            if (whole.text, whole.props.get("caption")) != (found.name, _about(found)):
                whole.props["caption"] = _about(found)
                whole.set_text(found.name)

    def build() -> None:
        declaration_form(desk, spot, "Name", fields, show)

    found = spot.read(desk.workspace.project)
    key = f"project {spot.steps} whole"
    # What is open is built at once, before there is a fold to tell.
    told: list[ui.expansion] = []
    told.append(fold(desk, key, found.name, _about(found), build).classes("declaration-more declared-line"))


def _about(declaration: Declaration) -> str:
    """Type, unit, range, value and arguments, as far as they are said; then its doc."""
    given, ends = declaration.arguments, declaration.range
    parts = (
        f"takes {', '.join(each.name for each in given) or 'nothing'}" if given is not None else "",
        declaration.type,
        declaration.unit,
        f"{numbers.text_of(ends[0])} to {numbers.text_of(ends[1])}" if ends else "",
        f"= {declaration.initial}" if declaration.initial else "",
    )
    said = ", ".join(part for part in parts if part)
    return ": ".join(part for part in (said, declaration.doc) if part)


def agent_form(desk: Desk, spot: Spot, fields: list[Field]) -> None:
    """Build the form of an agent."""
    whole, called = group(desk, spot, "shared removable")
    with whole:
        fields.append(name_in_file(desk, "Agent", spot, called))
        fields.append(choice_in_file(desk, spot, "Root", "root", lambda: sorted(desk.workspace.project.interfaces())))
        remover(desk, spot, called)
        for line in (TITLE, XABSL_NAME, DOC):
            with ui.element("div").classes("wide" if line is DOC else ""):
                fields.append(line_in_file(desk, spot, line))
