"""What the buttons of forms do."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, Literal, Protocol

from vicode.editor.session import texts
from vicode.editor.session.document import DocumentSession
from vicode.editor.session.forms.action_form import new_action
from vicode.editor.session.forms.form_field import replace_text
from vicode.editor.session.forms.form_paths import item_path, parse_path, resolve
from vicode.editor.session.forms.form_places import FormResult, rebase_owner
from vicode.editor.session.forms.list_ids import ACTION_LISTS, CONSTRUCT_LISTS, noun_of
from vicode.editor.session.gestures.item_paths import change_item, item_at
from vicode.editor.view import ItemRef
from vicode.findings import DesignPath
from vicode.model.decision_keys import transition_key
from vicode.model.design import COMMON, DecisionGroup, Design, Guard, Stay
from vicode.model.diagram_edits import remove_frames, remove_notes
from vicode.model.edits import (
    add_modulation,
    add_transition,
    assign_id,
    decisions_path,
    remove_decisions,
    remove_uses,
    reorder_decision,
)

FormAction = Literal[
    "add-code",
    "remove-code",
    "remove",
    "add-transition",
    "add-stay",
    "add-group",
    "remove-row",
    "move-row",
    "add-card",
    "remove-card",
    "move-card",
    "remove-arguments",
    "add-use",
    "remove-use",
    "add-input",
    "add-command",
    "open-design",
]
_NEW_PREDICATE = "return self.state_time > 2\n"
_DECISION_LISTS = ("transitions", "then", "else")
_MOVES = {"-1": -1, "1": 1}


class Press(Protocol):
    """A press on a button; see `edits.ButtonEdit`."""

    @property
    def rev(self) -> int: ...
    @property
    def item(self) -> ItemRef: ...
    @property
    def path(self) -> str: ...
    @property
    def index(self) -> int: ...
    @property
    def to(self) -> str: ...
    @property
    def adds(self) -> str: ...
    @property
    def card(self) -> str: ...
    @property
    def text(self) -> str: ...


Handler = Callable[[Press, DocumentSession, DesignPath], FormResult]
_MISSING = FormResult(error=texts.ITEM_MISSING)


def _add_code(_press: Press, document: DocumentSession, owner: DesignPath) -> FormResult:
    def change(design: Design) -> Design:
        changed = change_item(design, (*owner, "guard"), _with_predicate)
        return assign_id(changed, owner)

    document.edit("add code", change)
    return FormResult()


def _with_predicate(guard: Guard) -> Guard:
    return replace(guard, code=replace_text(None, "python", _NEW_PREDICATE))


def _remove_code(_press: Press, document: DocumentSession, owner: DesignPath) -> FormResult:
    document.edit(
        "remove code", lambda design: change_item(design, (*owner, "guard"), lambda guard: replace(guard, code=None))
    )
    return FormResult()


def _remove(_press: Press, document: DocumentSession, owner: DesignPath) -> FormResult:
    match owner:
        case ("frames", str(title)):
            document.edit(f"remove frame {title}", lambda design: remove_frames(design, [title]))
        case ("uses", str(alias)):
            document.edit(f"remove component {alias}", lambda design: remove_uses(design, [alias]))
        case ("notes", str(name)):
            document.edit("remove note", lambda design: remove_notes(design, [name]))
        case (*_, int()):
            document.edit("remove transition", lambda design: remove_decisions(design, [owner]))
        case _:
            return _MISSING
    return FormResult(new_selection=())


def _add_transition(press: Press, document: DocumentSession, owner: DesignPath) -> FormResult:
    source = str(owner[1]) if owner[0] == "states" else COMMON
    if document.design.state(press.to) is None:
        return _MISSING
    document.edit(
        f"connect {source.lstrip('@')} to {press.to}", lambda design: add_transition(design, source, press.to)
    )
    path = decisions_path(document.design, source)
    last = len(item_at(document.design, path)) - 1
    return FormResult(new_selection=(ItemRef(kind="transitions", id=transition_key((*path, last))),))


def _add_stay(press: Press, document: DocumentSession, owner: DesignPath) -> FormResult:
    return _append(press, document, owner, "stay", Stay())


def _add_group(press: Press, document: DocumentSession, owner: DesignPath) -> FormResult:
    return _append(press, document, owner, "group", DecisionGroup(guard=Guard(when="True"), then=(Stay(),)))


def _append(
    press: Press, document: DocumentSession, owner: DesignPath, noun: str, item: Stay | DecisionGroup
) -> FormResult:
    path = (*owner, *parse_path(press.path))
    if path[-1] not in _DECISION_LISTS or not isinstance(item_at(document.design, path), tuple):
        return _MISSING
    document.edit(f"add {noun}", lambda design: change_item(design, path, lambda items: (*items, item)))
    return FormResult()


def _remove_row(press: Press, document: DocumentSession, _owner: DesignPath) -> FormResult:
    path = _row_path(press, document)
    if path is None:
        return _MISSING
    document.edit("remove transition", lambda design: remove_decisions(design, [path]))
    return FormResult()


def _move_row(press: Press, document: DocumentSession, _owner: DesignPath) -> FormResult:
    path = _row_path(press, document)
    if path is None or not press.to.isdecimal():
        return _MISSING
    document.edit("reorder transitions", lambda design: reorder_decision(design, path, int(press.to)))
    return FormResult()


def _row_path(press: Press, document: DocumentSession) -> DesignPath | None:
    steps = parse_path(press.path)
    item = item_path(press.item)
    if item is None or not steps or steps[-1] not in _DECISION_LISTS:
        return None
    return rebase_owner(document, (*item, *steps, press.index), press.rev)


def _add_card(press: Press, document: DocumentSession, owner: DesignPath) -> FormResult:
    """Add an action with the id that the browser has given its card, or a modulated component."""
    if press.adds in ("call", "modulation") and document.design.use(press.to) is None:
        return _MISSING
    if press.adds == "modulation":
        return _add_modulation(press, document, owner)
    path, action = (*owner, press.path), new_action(press.adds, press.to, press.text)
    if action is None or press.path not in ACTION_LISTS or item_at(document.design, path) is None:
        return _MISSING
    document.shared.list_ids.want(path, press.card)
    document.edit(f"add {press.adds}", lambda design: change_item(design, path, lambda items: (*items, action)))
    return FormResult()


def _add_modulation(press: Press, document: DocumentSession, owner: DesignPath) -> FormResult:
    if owner[:1] != ("states",):
        return _MISSING
    document.edit(
        texts.add_link(str(owner[1]), "modulates", press.to),
        lambda design: add_modulation(design, str(owner[1]), press.to),
    )
    return FormResult()


def _remove_card(press: Press, document: DocumentSession, owner: DesignPath) -> FormResult:
    found = _find_card(press, document, owner)
    if found is None:
        return _MISSING
    path, index = found
    noun = "component" if path[-1] == "modulates" else "action"
    document.edit(
        f"remove {noun}",
        lambda design: change_item(design, path, lambda items: (*items[:index], *items[index + 1 :])),
    )
    return FormResult()


def _move_card(press: Press, document: DocumentSession, owner: DesignPath) -> FormResult:
    found, by = _find_card(press, document, owner), _MOVES.get(press.to)
    if found is None or by is None:
        return _MISSING
    path, index = found

    def move(items: tuple[Any, ...]) -> tuple[Any, ...]:
        rest = [*items[:index], *items[index + 1 :]]
        rest.insert(max(0, index + by), items[index])
        return tuple(rest)

    noun = "action" if path[-1] in ACTION_LISTS else noun_of(str(path[-1]))
    document.edit(f"move {noun}", lambda design: change_item(design, path, move))
    return FormResult()


def _find_card(press: Press, document: DocumentSession, owner: DesignPath) -> tuple[DesignPath, int] | None:
    """The path of the list, and the index of the item of a card."""
    resolved = resolve(document.design, document.shared.list_ids, owner, parse_path(press.path))
    match resolved:
        case (*_, "modulates", alias):
            path = (*owner, *resolved[:-1])
            calls = item_at(document.design, path) or ()
            index = next((at for at, call in enumerate(calls) if call.alias == str(alias)), None)
            return None if index is None else (path, index)
        case (*_, section, int(at)) if section in (*ACTION_LISTS, *CONSTRUCT_LISTS):
            return (*owner, *resolved[:-1]), at
        case _:
            return None


PRESSES: Mapping[str, Handler] = {
    "add-code": _add_code,
    "remove-code": _remove_code,
    "remove": _remove,
    "add-transition": _add_transition,
    "add-stay": _add_stay,
    "add-group": _add_group,
    "remove-row": _remove_row,
    "move-row": _move_row,
    "add-card": _add_card,
    "remove-card": _remove_card,
    "move-card": _move_card,
}
