"""What the buttons of the form of the design do: declarations, constructs and used components."""

from collections.abc import Mapping
from dataclasses import replace

from vicode.editor.session import texts
from vicode.editor.session.document import DocumentSession
from vicode.editor.session.forms.declaration_form import new_declaration
from vicode.editor.session.forms.form_paths import parse_path, resolve
from vicode.editor.session.forms.form_places import FormResult
from vicode.editor.session.forms.list_ids import CONSTRUCT_LISTS, DECLARATION_LISTS, noun_of
from vicode.editor.session.forms.presses import PRESSES, Handler, Press
from vicode.editor.session.gestures.item_paths import change_item, item_at
from vicode.findings import DesignPath
from vicode.model.construct_edits import has_empty_state, new_construct
from vicode.model.design import Call, CompetenceStep, Declaration, Layer
from vicode.model.edits import add_use, remove_states, remove_uses, unique_name
from vicode.model.names import is_valid_name
from vicode.model.traversal import Construct

_LISTS = (*DECLARATION_LISTS, *CONSTRUCT_LISTS)
_MISSING = FormResult(error=texts.ITEM_MISSING)


def _add_card(press: Press, document: DocumentSession, owner: DesignPath) -> FormResult:
    """Add a declaration, a construct, or a component that a step or layer modulates."""
    path, design = _resolve(press, document), document.design
    added: Construct | Call | None = None
    match path:
        case ("latches" | "interrupts" | "layers",) | ("competence",) | ("competence", "steps"):
            added = new_construct(design, path, press.text)
        case (*_, int(), "modulates") if press.to not in {each.alias for each in item_at(design, path)}:
            added = Call(alias=press.to) if design.use(press.to) else None
        case _:
            return _add_declaration(press, document, owner)
    if added is None:
        return _MISSING
    document.shared.list_ids.want(path, press.card)
    changed = added if path == ("competence",) else (*(item_at(design, path) or ()), added)
    owner_path, name = path[:-1], str(path[-1])
    is_whole = path in (("competence",), ("layers",)) and has_empty_state(design)
    replaced = {"states": (), "initial": ""} if is_whole else {}
    document.edit(
        f"add {press.to or noun_of(name)}",
        lambda old: change_item(old, owner_path, lambda each: replace(each, **{name: changed, **replaced})),
    )
    return FormResult()


def _remove_card(press: Press, document: DocumentSession, owner: DesignPath) -> FormResult:
    path = _resolve(press, document)
    item = item_at(document.design, path) if path else None
    state = document.design.state(item.name) if isinstance(item, CompetenceStep | Layer) else None
    if path == ("competence",):
        document.edit("remove competence", lambda design: replace(design, competence=None))
    elif state is not None and state.origin:
        document.edit(f"remove {state.name}", lambda design: remove_states(design, [state.name]))
    elif isinstance(item, Call):
        return PRESSES["remove-card"](press, document, owner)
    else:
        return _remove_declaration(press, document, owner)
    return FormResult()


def _add_declaration(press: Press, document: DocumentSession, _owner: DesignPath) -> FormResult:
    """Add a declaration with the id and the name that the browser has given it, unless the name is taken."""
    path, design = _resolve(press, document), document.design
    owner = item_at(design, path[:-1]) if path else None
    section = str(path[-1]) if path else ""
    is_list = section in DECLARATION_LISTS and hasattr(owner, section)
    if path is None or not is_list or (section == "arguments" and path[0] != "outputs"):
        return _MISSING
    known: tuple[Declaration, ...] = getattr(owner, section) or ()
    taken = {each.name for each in known} | {each.name for _section, each in design.declarations() if len(path) == 1}
    noun = section.removesuffix("s")
    name = press.text if is_valid_name(press.text) and press.text not in taken else unique_name(noun, taken)
    changed = {section: (*known, new_declaration(section, name))}
    document.shared.list_ids.want(path, press.card)
    document.edit(f"add {noun}", lambda old: change_item(old, path[:-1], lambda each: replace(each, **changed)))
    return FormResult()


def _remove_declaration(press: Press, document: DocumentSession, _owner: DesignPath) -> FormResult:
    path = _resolve(press, document)
    if not path or path[-2:-1] == () or path[-2] not in _LISTS or not isinstance(path[-1], int):
        return _MISSING
    index = path[-1]
    document.edit(
        f"remove {noun_of(str(path[-2]))}",
        lambda design: change_item(design, path[:-1], lambda items: (*items[:index], *items[index + 1 :])),
    )
    return FormResult()


def _remove_arguments(press: Press, document: DocumentSession, _owner: DesignPath) -> FormResult:
    """Turn an output with arguments into a value."""
    match _resolve(press, document):
        case ("outputs", int(index), "arguments"):
            document.edit(
                "remove arguments",
                lambda design: change_item(design, ("outputs", index), lambda output: replace(output, arguments=None)),
            )
            return FormResult()
        case _:
            return _MISSING


def _add_use(press: Press, document: DocumentSession, _owner: DesignPath) -> FormResult:
    if not is_valid_name(press.to):
        return _MISSING
    document.edit(f"add component {press.to}", lambda design: add_use(design, press.to))
    return FormResult()


def _remove_use(press: Press, document: DocumentSession, _owner: DesignPath) -> FormResult:
    if document.design.use(press.to) is None:
        return _MISSING
    document.edit(f"remove component {press.to}", lambda design: remove_uses(design, [press.to]))
    return FormResult()


def _resolve(press: Press, document: DocumentSession) -> DesignPath | None:
    return resolve(document.design, document.shared.list_ids, (), parse_path(press.path))


DESIGN_PRESSES: Mapping[str, Handler] = {
    "add-card": _add_card,
    "remove-card": _remove_card,
    "move-card": PRESSES["move-card"],
    "remove-arguments": _remove_arguments,
    "add-use": _add_use,
    "remove-use": _remove_use,
}
