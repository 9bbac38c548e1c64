"""The actions in a form: assignments, calls of used components, code."""

import json
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from vicode.editor.session.forms.decision_form import code_texts
from vicode.editor.session.forms.fields import known_field, other_nodes
from vicode.editor.session.forms.form_field import replace_text
from vicode.editor.session.forms.nodes import Adder, AdderList, Card, Cards, CodeText, Node, form_json
from vicode.editor.session.forms.pairs import find_error, parse_pairs
from vicode.findings import DesignPath
from vicode.model.design import Action, Assign, Call, Declaration, Design, RunCode
from vicode.model.expressions import build_scope
from vicode.model.project import Project

_NEW_CALL = Call(alias="")
_NEW_CODE = RunCode(code=replace_text(None, "python", ""))


def action_cards(
    project: Project, path: DesignPath, actions: tuple[Action, ...], ids: Sequence[str], *, calls: bool = True
) -> Cards:
    """The list of actions at a path of the item, without those that are derived from a construct."""
    cards = tuple(
        Card(id=id_, title=_title(action), nodes=_nodes(project, action, (*path, id_)))
        for id_, action in zip(ids, actions, strict=True)
        if not (isinstance(action, Assign) and action.origin)
    )
    return Cards(path=path, cards=cards, adders="actions" if calls else "effects", is_ordered=True)


def modulation_cards(project: Project, calls: tuple[Call, ...], base: DesignPath = ()) -> Cards:
    """The components that a state, or a step or layer at `base`, modulates, with their parameters."""
    path = (*base, "modulates")
    cards = tuple(
        Card(id=call.alias, title=call.alias, nodes=_nodes(project, call, (*path, call.alias))) for call in calls
    )
    return Cards(path=path, cards=cards, adders="modulates")


def adders(project: Project, design: Design) -> dict[AdderList, Any]:
    """What can be added to the lists of a design, as JSON values."""
    effects = [
        Adder(
            label="Set",
            icon="edit_note",
            adds="set",
            title="Set",
            nodes=_nodes(project, Assign(values=(_first_assignment(project, design),)), ()),
        ),
        Adder(
            label="Code",
            icon="code",
            adds="code",
            title="Code",
            nodes=_nodes(project, _NEW_CODE, ()),
        ),
    ]
    call = Adder(
        label="Call",
        icon="call_made",
        adds="call",
        title="Call",
        nodes=_nodes(project, _NEW_CALL, ()),
        options="uses",
    )
    modulation = replace(call, label="Component", icon="add", adds="modulation", title="", is_unique=True)
    actions = [effects[0], call, effects[1]] if design.uses else effects
    return {
        "actions": json.loads(form_json(actions)),
        "effects": json.loads(form_json(effects)),
        "modulates": json.loads(form_json([modulation] if design.uses else [])),
    }


def new_action(kind: str, alias: str, text: str) -> Action | None:
    """A new action: "set" with the assignments of a text, "call" of an alias, or "code"; None if it is none of them."""
    match kind:
        case "set" if text.strip() and not find_error(text):
            return Assign(values=parse_pairs(text))
        case "call":
            return Call(alias=alias)
        case "code":
            return _NEW_CODE
        case _:
            return None


def settable_declarations(project: Project, design: Design) -> tuple[Declaration, ...]:
    """The variables and outputs of the design, and variables of used components as `alias.variable`."""
    declarations = [each for each in (*design.variables, *design.outputs) if not each.origin]
    for use in design.uses:
        interface = project.interface(use.component)
        variables = interface.variables if interface else ()
        declarations += [replace(each, name=f"{use.alias}.{each.name}") for each in variables]
    return tuple(declarations)


def component_parameters(project: Project, design: Design, alias: str) -> tuple[Declaration, ...]:
    """The parameters of a used component."""
    use = design.use(alias)
    interface = project.interface(use.component) if use else None
    return interface.parameters if interface else ()


def parameter_hints(project: Project, design: Design) -> dict[str, str]:
    """The parameters of each used component with their units, as the hint of an empty field."""
    return {
        use.alias: ", ".join(
            f"{each.name}{f' [{each.unit}]' if each.unit else ''}"
            for each in component_parameters(project, design, use.alias)
        )
        or "no parameters"
        for use in design.uses
    }


def _title(action: Action) -> str:
    match action:
        case Assign():
            return "Set"
        case Call(alias=alias):
            return f"Call {alias}"
        case RunCode():
            return "Code"


def _nodes(project: Project, action: Action, path: DesignPath) -> tuple[Node, ...]:
    match action:
        case RunCode():
            text = code_texts(project, action, ("code",), path)
        case Assign():
            text = _pairs(action, "values", path)
        case Call():
            text = _pairs(action, "arguments", path)
    return (text, *other_nodes(action, path))


def _pairs(owner: Assign | Call, name: str, path: DesignPath) -> CodeText:
    field = known_field(owner, (name,))
    return CodeText(
        path=(*path, name),
        label=field.label,
        value=field.read(owner),
        language="pairs",
        alias=owner.alias if isinstance(owner, Call) else "",
        is_checked=True,
    )


def _first_assignment(project: Project, design: Design) -> tuple[str, str]:
    """The first name that can be set, and a value of its type."""
    settable = settable_declarations(project, design)
    if not settable:
        return ("name", "0")
    scope = build_scope(project, design)
    type_ = scope.type_of(settable[0])
    elements = scope.enumerations.get(type_, ())
    zero = f"{type_}.{elements[0]}" if elements else {"bool": "False"}.get(type_, "0")
    return (settable[0].name, zero)
