"""The inputs and commands of a design, and the form of a used component."""

from collections.abc import Iterator

from vicode.editor.session.forms.declaration_form import describe_value
from vicode.editor.session.forms.fields import other_nodes
from vicode.editor.session.forms.item_place import ItemPlace
from vicode.editor.session.forms.list_ids import ListIds
from vicode.editor.session.forms.nodes import (
    AddRow,
    Button,
    DeclarationLine,
    FormPart,
    Heading,
    ItemLink,
    ItemName,
    Node,
    Paragraph,
    Section,
    Title,
)
from vicode.editor.session.forms.project_form import SCOPE, declaration_lines, project_place
from vicode.editor.session.gestures import number_text
from vicode.model.design import Declaration, Design, Use
from vicode.model.expressions import BOOL
from vicode.model.project import INTERNAL, MISSING, WORLD, Interface, Project

_ORIGINS = {
    WORLD: "Provided by the world",
    INTERNAL: "Variables shared by all designs",
    MISSING: "Not implemented yet",
}


def interface_lists(project: Project, design: Design, ids: ListIds) -> tuple[Node, ...]:
    """The outputs of used components, which expressions can read, and the components that the design drives."""
    return (
        Heading(text="Inputs", hint="values that its guards can read"),
        *_used(project, design, ids, "outputs"),
        AddRow(kind="input", detail="Type", options="types", initial=BOOL),
        Heading(text="Commands", hint="what its states can trigger, such as motions"),
        *_used(project, design, ids, "parameters"),
        AddRow(kind="command", detail="Parameters", hint="speed, turn: int"),
    )


def _used(project: Project, design: Design, ids: ListIds, section: str) -> Iterator[Node]:
    """The used components of a list: a component with neither outputs nor parameters is a command."""
    places = {each.component: place for place, each in project_place(ids).items("components", project.components)}
    for use in design.uses:
        interface = project.interface(use.component)
        if interface is None:
            continue
        is_plain = section == "parameters" and not interface.readable
        declarations: tuple[Declaration, ...] = getattr(interface, section)
        if not declarations and not is_plain:
            continue
        place = places.get(use.component) if project.design(use.component) is None else None
        names = ", ".join(each.name for each in declarations)
        if place is None:
            yield ItemLink(label=use.alias, caption=names, opens=("components", use.alias), is_code=True)
        else:
            yield _shared(place, interface, section, use.alias, names)


def _shared(place: ItemPlace, interface: Interface, section: str, alias: str, names: str) -> Node:
    """A component of project.yaml; each output of one without an implementation has a line."""
    if section == "parameters":
        lines = declaration_lines(place, interface, "parameters")
    elif interface.implementation == MISSING:
        return declaration_lines(place, interface, "outputs", f"{alias}.")
    else:
        lines = declaration_lines(place, interface, "outputs")
    return Section(key=f"{section} of {alias}", title=alias, caption=names, nodes=(lines,), look="line")


def use_form(project: Project, use: Use, ids: ListIds) -> tuple[Node, ...]:
    """The form of a used component: its alias and interface."""
    interface = project.interface(use.component)
    head = (
        Title(text="Component", name=use.component),
        ItemName(path=("name",), label="Alias", value=use.alias),
        *other_nodes(use),
    )
    if interface is None:
        return (*head, Paragraph(text="Not declared in the project.", look="field-finding"))
    shown = _designed(use, interface) if project.design(use.component) else _hand_written(project, interface, ids)
    return (*head, *shown, Button(label="Remove component", icon="delete", action="remove", is_danger=True))


def _hand_written(project: Project, interface: Interface, ids: ListIds) -> tuple[Node, ...]:
    places = project_place(ids).items("components", project.components)
    key = next(place.key for place, each in places if each.component == interface.component)
    origin = _ORIGINS.get(interface.implementation, "Hand-written")
    return (Paragraph(text=origin, look="small"), SCOPE, FormPart(form=key))


def _designed(use: Use, interface: Interface) -> tuple[Node, ...]:
    rate = f"Runs at {number_text.format_number(interface.frequency_hz)} Hz"
    facts = [rate if interface.frequency_hz else "Runs on every step"]
    facts += [f"{interface.xabsl_name} in XABSL"] if interface.xabsl_name else []
    title = (Paragraph(text=interface.title, look="interface-title"),) if interface.title else ()
    return (
        *title,
        Paragraph(text=interface.doc, look="doc"),
        Paragraph(text="; ".join(facts), look="small"),
        Button(label="Open design", icon="open_in_new", action="open-design"),
        Heading(text=f"Outputs, read as {use.alias}.…"),
        *_table(interface.outputs),
        Heading(text="Parameters"),
        *_table(interface.parameters),
    )


def _table(declarations: tuple[Declaration, ...]) -> tuple[Node, ...]:
    rows = tuple(DeclarationLine(name=each.name, about=_about(each), doc=each.doc) for each in declarations)
    return rows or (Paragraph(text="None", look="empty"),)


def _about(declaration: Declaration) -> str:
    in_xabsl = f"{declaration.xabsl_name} in XABSL" if declaration.xabsl_name else ""
    return ", ".join(part for part in (describe_value(declaration), in_xabsl) if part)
