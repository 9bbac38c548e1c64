"""What the buttons of the form of the design do: they add and remove declarations and used components."""

from collections.abc import Mapping
from dataclasses import replace

from vicode.editor.session import texts
from vicode.editor.session.document import DocumentSession
from vicode.editor.session.forms.declaration_form import new_declaration
from vicode.editor.session.forms.form_paths import parse_path, resolve
from vicode.editor.session.forms.form_places import FormResult
from vicode.editor.session.forms.list_ids import DECLARATION_LISTS
from vicode.editor.session.forms.presses import Handler, Press
from vicode.editor.session.gestures.item_paths import change_item, item_at
from vicode.findings import DesignPath
from vicode.model.design import Declaration
from vicode.model.edits import add_use, remove_uses, unique_name
from vicode.model.names import is_valid_name

_MISSING = FormResult(error=texts.ITEM_MISSING)


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
    "add-card": _add_declaration,
    "remove-card": _remove_declaration,
    "remove-arguments": _remove_arguments,
    "add-use": _add_use,
    "remove-use": _remove_use,
}
