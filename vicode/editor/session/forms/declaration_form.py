"""The parameters, outputs, variables, constants and arguments in a form."""

import json
from collections.abc import Sequence
from functools import cache
from typing import Any

from vicode.editor.session.forms.fields import field_node, known_field, other_nodes
from vicode.editor.session.forms.form_paths import parse_path, resolve
from vicode.editor.session.forms.item_place import ItemPlace
from vicode.editor.session.forms.list_ids import ListIds
from vicode.editor.session.forms.nodes import (
    Adder,
    AdderList,
    Button,
    Card,
    Cards,
    Choice,
    DeclarationList,
    Group,
    ItemName,
    Node,
    Section,
    TextField,
    form_json,
)
from vicode.editor.session.gestures import number_text
from vicode.model.design import Declaration, Design
from vicode.model.rename import SymbolRef

_LISTS: tuple[DeclarationList, ...] = ("parameters", "outputs", "variables")
_VALUES = {"constants": "Value", "parameters": "Default", "arguments": "Default"}


def declaration_cards(
    place: ItemPlace,
    section: DeclarationList,
    declarations: Sequence[Declaration],
    *,
    owner: str = "",
    is_shared: bool = False,
) -> Cards:
    """A list of declarations; `place` is that of its owner. Those of project.yaml are shared by the designs."""
    cards = (
        Card(id=each.id, title=declaration.name, nodes=(declaration_group(each, declaration, is_shared=is_shared),))
        for each, declaration in place.items(section, declarations)
        if not declaration.origin
    )
    return Cards(
        path=place.within(section),
        cards=tuple(cards),
        adders="component-arguments" if is_shared else section,
        noun=section.removesuffix("s"),
        owner=owner,
    )


@cache
def declaration_adders() -> dict[AdderList, Any]:
    """What can be added to the lists of declarations of a design, as JSON values."""
    found: dict[AdderList, Any] = {section: adder_json("Add", _new_group(section)) for section in _LISTS}
    found["arguments"] = adder_json("Argument", _new_group("arguments"))
    found["component-arguments"] = adder_json("Argument", _new_group("arguments", is_shared=True))
    return found


def _new_group(section: str, *, is_shared: bool = False) -> Node:
    added = new_declaration(section, section.removesuffix("s"))
    return declaration_group(ItemPlace(section=section), added, is_shared=is_shared)


def adder_json(label: str, node: Node, base: str = "") -> list[Any]:
    """The button that adds an item to a list; `base` is a free name for it, by default derived from its list."""
    adder = Adder(label=label, icon="add", adds="declaration", title=base, nodes=(node,))
    buttons: list[Any] = json.loads(form_json([adder]))
    return buttons


def new_declaration(section: str, name: str) -> Declaration:
    if section == "arguments":
        return Declaration(name=name, type="float")
    return Declaration(name=name, initial="0")


def declaration_group(place: ItemPlace, declaration: Declaration, *, is_shared: bool = False) -> Group:
    """The form of a declaration; that of project.yaml writes texts when they are finished, and orders arguments."""
    value = TextField(
        path=place.within("initial"),
        label=_VALUES.get(place.section, "Initial"),
        value=declaration.initial,
        is_code=True,
        is_committed=is_shared,
    )
    fields = (
        ItemName(
            path=place.within("name"),
            label="Constant" if place.section == "constants" else "Name",
            value=declaration.name,
        ),
        Choice(
            path=place.within("type"),
            label="Type",
            value=known_field(declaration, ("type",)).read(declaration),
            options="types",
        ),
        value,
        field_node(declaration, "unit", place.path, is_committed=is_shared),
        field_node(declaration, "doc", place.path, is_committed=is_shared),
        _more(place, declaration, is_shared=is_shared),
    )
    return Group(
        path=place.path,
        noun=place.noun,
        title=declaration.name,
        nodes=fields,
        can_move_up=is_shared and place.section == "arguments" and not place.is_first,
    )


def _more(place: ItemPlace, declaration: Declaration, *, is_shared: bool) -> Section:
    nodes: list[Node] = [
        field_node(declaration, name, place.path, is_committed=is_shared) for name in ("range", "xabsl_name")
    ]
    if place.section == "outputs":
        nodes += _arguments(place, declaration, is_shared=is_shared)
    if place.section == ("constants" if is_shared else "parameters"):
        nodes.append(field_node(declaration, "tunable", place.path))
    nodes += other_nodes(declaration, place.path, noun=place.noun, is_committed=is_shared)
    caption = declaration_caption(declaration, place.section)
    return Section(key=place.key, title="More", caption=caption, nodes=tuple(nodes), look="more")


def _arguments(place: ItemPlace, output: Declaration, *, is_shared: bool) -> list[Node]:
    """The arguments of an output. An output with arguments is a function, without a value."""
    cards = declaration_cards(place, "arguments", output.arguments or (), owner=output.name, is_shared=is_shared)
    if output.arguments is None:
        return [cards]
    path = place.within("arguments")
    return [cards, Button(label="Remove arguments", icon="close", action="remove-arguments", path=path)]


def declaration_caption(declaration: Declaration, section: str) -> str:
    """Summarize the section "More": its values, else the available fields."""
    parts = []
    if declaration.range is not None:
        low, high = declaration.range
        parts.append(f"range {number_text.format_number(low)} to {number_text.format_number(high)}")
    if declaration.arguments is not None:
        parts.append(format_arguments(declaration.arguments))
    if declaration.xabsl_name:
        parts.append(f"{declaration.xabsl_name} in XABSL")
    return "; ".join(parts) or ("range, XABSL, arguments" if section == "outputs" else "range, XABSL")


def describe_declaration(declaration: Declaration) -> str:
    """Describe type, unit, range, value and arguments, then the description."""
    summary = describe_value(declaration)
    return ": ".join(part for part in (summary, declaration.doc) if part)


def describe_value(declaration: Declaration) -> str:
    """Describe type, unit, range, value and arguments."""
    arguments, range_ = declaration.arguments, declaration.range
    parts = (
        format_arguments(arguments) if arguments is not None else "",
        declaration.type,
        declaration.unit,
        f"{number_text.format_number(range_[0])} to {number_text.format_number(range_[1])}" if range_ else "",
        f"= {declaration.initial}" if declaration.initial else "",
    )
    return ", ".join(part for part in parts if part)


def declared_symbol(design: Design, ids: ListIds, path: str) -> SymbolRef | None:
    """The symbol whose name is at a path of the form; None if there is no such declaration."""
    match resolve(design, ids, (), parse_path(path)):
        case ("latches", int(index), "name"):
            return SymbolRef(component=design.component, section="variables", name=design.latches[index].name)
        case ("parameters" | "outputs" | "variables" as section, int(index), "name"):
            name = getattr(design, section)[index].name
            return SymbolRef(component=design.component, section=section, name=name)
        case ("outputs", int(index), "arguments", int(at), "name"):
            output = design.outputs[index]
            name = (output.arguments or ())[at].name
            return SymbolRef(component=design.component, section="arguments", name=name, owner=output.name)
        case _:
            return None


def format_arguments(arguments: tuple[Declaration, ...]) -> str:
    return f"arguments {', '.join(argument.name for argument in arguments)}" if arguments else "no arguments"
