"""The parameters, outputs, variables and arguments in a form."""

import json
from collections.abc import Sequence
from typing import Any

from vicode.editor.session import number_text
from vicode.editor.session.forms.fields import known_field
from vicode.editor.session.forms.form_paths import parse_path, resolve
from vicode.editor.session.forms.list_ids import ListIds
from vicode.editor.session.forms.nodes import (
    Adder,
    AdderList,
    Button,
    Card,
    Cards,
    Check,
    Choice,
    ItemName,
    Node,
    Section,
    TextField,
    form_json,
)
from vicode.findings import DesignPath
from vicode.model.design import Declaration, Design
from vicode.model.rename import SymbolRef

_ADDERS: dict[str, AdderList] = {
    "parameters": "parameters",
    "outputs": "outputs",
    "variables": "variables",
    "arguments": "arguments",
}


def declaration_cards(
    path: DesignPath, declarations: Sequence[Declaration], ids: ListIds, *, list_path: DesignPath, owner: str = ""
) -> Cards:
    """The list of declarations at a path of the form; `list_path` is its path in the design, `owner` its output."""
    section = str(path[-1])
    cards = []
    for index, (id_, each) in enumerate(zip(ids.ids(list_path, tuple(declarations)), declarations, strict=True)):
        card_path = (*path, id_)
        arguments = _arguments(each, card_path, (*list_path, index), ids) if section == "outputs" else ()
        cards.append(Card(id=id_, title=each.name, nodes=_nodes(each, section, card_path, arguments)))
    noun = section.removesuffix("s")
    return Cards(path=path, cards=tuple(cards), adders=_ADDERS[section], noun=noun, owner=owner)


def declaration_adders() -> dict[AdderList, Any]:
    """What can be added to the lists of declarations, as JSON values."""
    found: dict[AdderList, Any] = {}
    for section, key in _ADDERS.items():
        noun = section.removesuffix("s")
        added = new_declaration(section, noun)
        arguments = _arguments(added, (), (), ListIds()) if section == "outputs" else ()
        label = "Argument" if section == "arguments" else "Add"
        adder = Adder(label=label, icon="add", adds=noun, title="", nodes=_nodes(added, section, (), arguments))
        found[key] = json.loads(form_json([adder]))
    return found


def new_declaration(section: str, name: str) -> Declaration:
    if section == "arguments":
        return Declaration(name=name, type="float")
    return Declaration(name=name, initial="0")


def _nodes(declaration: Declaration, section: str, path: DesignPath, arguments: tuple[Node, ...]) -> tuple[Node, ...]:
    value = "Initial" if section in ("outputs", "variables") else "Default"
    more = [_text(declaration, "range", path), _text(declaration, "xabsl_name", path), *arguments]
    if section == "parameters":
        tunable = known_field(declaration, ("tunable",))
        more.append(Check(path=(*path, "tunable"), label=tunable.label, value=declaration.tunable))
    return (
        ItemName(path=(*path, "name"), label="Name", value=declaration.name),
        Choice(
            path=(*path, "type"),
            label="Type",
            value=known_field(declaration, ("type",)).read(declaration),
            options="types",
        ),
        TextField(path=(*path, "initial"), label=value, value=declaration.initial, is_code=True),
        _text(declaration, "unit", path),
        _text(declaration, "doc", path),
        Section(
            key="/".join(map(str, path)),
            title="More",
            caption=declaration_caption(declaration, section),
            nodes=tuple(more),
            is_local=True,
        ),
    )


def _text(declaration: Declaration, name: str, path: DesignPath) -> Node:
    field = known_field(declaration, (name,))
    return TextField(
        path=(*path, name),
        label=field.label,
        value=field.read(declaration),
        hint=field.hint,
        is_code=name != "doc",
        is_checked=name == "range",
    )


def _arguments(output: Declaration, path: DesignPath, owner: DesignPath, ids: ListIds) -> tuple[Node, ...]:
    """The arguments of an output. An output with arguments is a function, without a value."""
    in_form, in_design = (*path, "arguments"), (*owner, "arguments")
    cards = declaration_cards(in_form, output.arguments or (), ids, list_path=in_design, owner=output.name)
    if output.arguments is None:
        return (cards,)
    return (cards, Button(label="Remove arguments", icon="close", action="remove-arguments", path=in_form))


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


def declared_symbol(design: Design, ids: ListIds, path: str) -> SymbolRef | None:
    """The symbol whose name is at a path of the form; None if there is no such declaration."""
    match resolve(design, ids, (), parse_path(path)):
        case (str(section), int(index), "name"):
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
