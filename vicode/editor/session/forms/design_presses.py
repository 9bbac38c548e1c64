"""What the buttons of the form of the design do: they add and remove declarations, constructs and used components."""

from collections.abc import Mapping
from dataclasses import replace

from vicode.editor.session import texts
from vicode.editor.session.document import DocumentSession
from vicode.editor.session.forms.declaration_form import new_declaration
from vicode.editor.session.forms.form_paths import parse_path, resolve
from vicode.editor.session.forms.form_places import FormResult
from vicode.editor.session.forms.list_ids import DECLARATION_LISTS
from vicode.editor.session.forms.presses import MOVES, Handler, Press
from vicode.editor.session.gestures.item_paths import change_item, item_at
from vicode.findings import DesignPath
from vicode.model.construct_edits import (
    CONSTRUCT_LISTS,
    add_competence,
    add_construct,
    move_construct,
    new_construct,
    remove_competence,
    remove_construct,
)
from vicode.model.design import Call, Declaration
from vicode.model.edits import add_use, remove_uses, unique_name
from vicode.model.names import is_valid_name

_NOUNS: Mapping[str | int, str] = {
    "latches": "latch",
    "interrupts": "interrupt",
    "steps": "step",
    "layers": "layer",
}
_MISSING = FormResult(error=texts.ITEM_MISSING)


def _add_card(press: Press, document: DocumentSession, owner: DesignPath) -> FormResult:
    path = _resolve(press, document)
    if path == ("competence",):
        document.edit("add competence", add_competence)
        return FormResult()
    if path and path[-1] == "modulates":
        return _add_modulation(press, document, path)
    if path not in CONSTRUCT_LISTS:
        return _add_declaration(press, document, owner)
    added = new_construct(document.design, path, press.text)
    if added is None:
        return _MISSING
    document.shared.list_ids.want(path, press.card)
    document.edit(f"add {_NOUNS[path[-1]]}", lambda design: add_construct(design, path, added))
    return FormResult()


def _add_modulation(press: Press, document: DocumentSession, path: DesignPath) -> FormResult:
    """Let a step or layer modulate a component."""
    calls = item_at(document.design, path)
    if calls is None or document.design.use(press.to) is None or press.to in {each.alias for each in calls}:
        return _MISSING
    document.edit(f"add {press.to}", lambda design: change_item(design, path, lambda old: (*old, Call(alias=press.to))))
    return FormResult()


def _remove_card(press: Press, document: DocumentSession, owner: DesignPath) -> FormResult:
    match _resolve(press, document):
        case ("competence",):
            document.edit("remove competence", remove_competence)
        case (*_, int(), "modulates", alias) as path:
            document.edit(
                f"remove {alias}",
                lambda design: change_item(
                    design, path[:-1], lambda calls: tuple(each for each in calls if each.alias != alias)
                ),
            )
        case (*_, int()) as path if path[:-1] in CONSTRUCT_LISTS:
            document.edit(f"remove {_NOUNS[path[-2]]}", lambda design: remove_construct(design, path))
        case _:
            return _remove_declaration(press, document, owner)
    return FormResult()


def _move_card(press: Press, document: DocumentSession, _owner: DesignPath) -> FormResult:
    path, by = _resolve(press, document), MOVES.get(press.to)
    if path is None or by is None or path[:-1] not in CONSTRUCT_LISTS:
        return _MISSING
    document.edit(f"move {_NOUNS[path[-2]]}", lambda design: move_construct(design, path, by))
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
    if not path or path[-2:-1] == () or path[-2] not in DECLARATION_LISTS or not isinstance(path[-1], int):
        return _MISSING
    index = path[-1]
    document.edit(
        f"remove {str(path[-2]).removesuffix('s')}",
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
    "move-card": _move_card,
    "remove-arguments": _remove_arguments,
    "add-use": _add_use,
    "remove-use": _remove_use,
}
