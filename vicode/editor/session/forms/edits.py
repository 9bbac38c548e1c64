"""Edits that the browser makes in forms: typed texts, choices, and buttons."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Literal, Protocol

from vicode.editor.session import texts
from vicode.editor.session.document import DocumentSession
from vicode.editor.session.forms.fields import FormField, field_of, replace_text
from vicode.editor.session.forms.text_merge import merge_texts
from vicode.editor.session.item_paths import change_item, item_at, rebase_path
from vicode.editor.view import ItemRef, parse_transition_key, transition_key
from vicode.findings import DesignPath
from vicode.model.design import DecisionGroup, Design, Guard, Stay
from vicode.model.edits import add_transition, assign_id, decisions_path, remove_decisions, reorder_decision
from vicode.model.guard_text import settle_guard
from vicode.model.paths import describe_path

_NEW_PREDICATE = "return self.state_time > 2\n"


@dataclass(frozen=True, slots=True, kw_only=True)
class FormResult:
    """The answer to an edit.

    `own` is the text that the design has of the typed one, without the edits of others. `error` says why the edit was
    refused; the design is unchanged then, and the browser keeps the typed text.
    """

    own: str = ""
    error: str = ""
    new_selection: tuple[ItemRef, ...] | None = None


class FormEdit(Protocol):
    """An edit of the form of `item`; the browser showed revision `rev`, and numbers its edits by `id`."""

    kind: ClassVar[str]

    @property
    def id(self) -> int: ...

    def apply(self, document: DocumentSession) -> FormResult: ...


@dataclass(frozen=True, slots=True, kw_only=True)
class TextEdit:
    """The user typed `text` over `base`: the text of the design at `rev`, or that of the edit before."""

    kind: ClassVar = "text"
    id: int
    rev: int
    item: ItemRef
    path: str
    base: str
    text: str

    def apply(self, document: DocumentSession) -> FormResult:
        """Write the typed text, merged with what others changed since `rev`."""
        place = _find_place(document, self.item, self.path, self.rev)
        if place is None:
            return FormResult(error=texts.ITEM_MISSING)
        now = place.read(document.design)
        if error := place.field.validate(self.text):
            return FormResult(error=error)
        # The design may store a text without its outer spaces, for example: that is no edit of others.
        is_alone = place.stored(document.design, self.base) == now
        merged = self.text if is_alone else merge_texts(self.base, self.text, now)
        return place.write(document, merged, place.stored(document.design, self.text))


@dataclass(frozen=True, slots=True, kw_only=True)
class ChoiceEdit:
    """The user chose an option."""

    kind: ClassVar = "choose"
    id: int
    rev: int
    item: ItemRef
    path: str
    value: str

    def apply(self, document: DocumentSession) -> FormResult:
        place = _find_place(document, self.item, self.path, self.rev)
        return place.write(document, self.value) if place else FormResult(error=texts.ITEM_MISSING)


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckEdit:
    """The user turned a checkbox on or off."""

    kind: ClassVar = "check"
    id: int
    rev: int
    item: ItemRef
    path: str
    value: bool

    def apply(self, document: DocumentSession) -> FormResult:
        place = _find_place(document, self.item, self.path, self.rev)
        return place.write(document, self.value) if place else FormResult(error=texts.ITEM_MISSING)


@dataclass(frozen=True, slots=True, kw_only=True)
class ButtonEdit:
    """The user pressed a button: of the form, or of a row of a list at `path`."""

    kind: ClassVar = "press"
    id: int
    rev: int
    item: ItemRef
    action: Literal[
        "add-code", "remove-code", "remove", "add-transition", "add-stay", "add-group", "remove-row", "move-row"
    ]
    path: str = ""
    index: int = 0
    """The row of the list, from 0."""
    to: str = ""
    """The target of a new transition, or the new index of a row."""

    def apply(self, document: DocumentSession) -> FormResult:
        owner = _rebase(document, item_path(self.item), self.rev)
        if owner is None or not owner:
            return FormResult(error=texts.ITEM_MISSING)
        return _PRESSES[self.action](self, document, owner)


@dataclass(frozen=True, slots=True, kw_only=True)
class SettleEdit:
    """The user has finished typing into the expression or the time of a guard: times move to where they belong."""

    kind: ClassVar = "settle"
    id: int
    rev: int
    item: ItemRef
    path: str

    def apply(self, document: DocumentSession) -> FormResult:
        place = _find_place(document, self.item, self.path, self.rev)
        if place is None or not isinstance(guard := getattr(place.owner_in(document.design), "guard", None), Guard):
            return FormResult(error=texts.ITEM_MISSING)
        settled = settle_guard(guard, document.design.time_unit)
        if settled is not guard:
            document.edit(
                place.label,
                lambda design: change_item(design, (*place.owner, "guard"), lambda _guard: settled),
                coalesce_key=place.key,
            )
        return FormResult()


FORM_EDITS: Mapping[str, type[FormEdit]] = {
    each.kind: each for each in (TextEdit, ChoiceEdit, CheckEdit, ButtonEdit, SettleEdit)
}


@dataclass(frozen=True, slots=True, kw_only=True)
class _Place:
    """A field in the current design: the path of its owner, and the path of the value in the owner."""

    owner: DesignPath
    attribute: DesignPath
    field: FormField

    @property
    def path(self) -> DesignPath:
        """The path of the value in the file."""
        return (*self.owner, *(step for step in self.attribute if step != "guard"))

    @property
    def label(self) -> str:
        return f"edit {describe_path(self.path)}"

    @property
    def key(self) -> str:
        """The coalesce key: what is typed into one field is one edit."""
        return "/".join(map(str, self.path))

    def owner_in(self, design: Design) -> Any:
        return item_at(design, self.owner)

    def read(self, design: Design) -> str:
        return str(self.field.read(self.owner_in(design)))

    def stored(self, design: Design, text: str) -> str:
        """The text that the design would have after writing `text`."""
        return str(self.field.read(self.field.write(self.owner_in(design), text)))

    def write(self, document: DocumentSession, value: object, own: str = "") -> FormResult:
        """Write a value, unless it would lose content of the file."""
        owner = self.owner_in(document.design)
        if self.field.read(owner) == value:
            return FormResult(own=own)
        notice, rev = document.shared.notice, document.rev
        document.edit(
            self.label,
            lambda design: change_item(design, self.owner, lambda each: self.field.write(each, value)),
            coalesce_key=self.key,
        )
        is_refused = document.shared.notice is not notice and document.rev == rev
        return FormResult(own=own, error=document.shared.notice.text if is_refused else "")


def item_path(item: ItemRef) -> DesignPath:
    """The path of an item in the design."""
    match item:
        case ItemRef(kind="transitions", id=key):
            return parse_transition_key(key)
        case ItemRef(kind="states", id=name):
            return ("states", name)
        case _:
            return ()


def _find_place(document: DocumentSession, item: ItemRef, path: str, rev: int) -> _Place | None:
    steps = _parse(path)
    last = max((at for at, step in enumerate(steps) if isinstance(step, int)), default=-1) + 1
    owner = _rebase(document, (*item_path(item), *steps[:last]), rev)
    field = field_of(item_at(document.design, owner), steps[last:]) if owner else None
    return _Place(owner=owner, attribute=steps[last:], field=field) if owner and field else None


def _rebase(document: DocumentSession, path: DesignPath, rev: int) -> DesignPath | None:
    """The path of an owner that the browser showed at `rev`, in the current design."""
    design = document.shared.design_at(rev)
    rebased: DesignPath | None = path
    # Step by step: an item that was both renamed and moved would not be recognized.
    for number in range(rev + 1, document.rev + 1):
        before, design = design, document.shared.design_at(number)
        rebased = rebase_path(rebased, before, design) if rebased is not None else None
    return rebased if rebased is not None and item_at(document.design, rebased) is not None else None


def _parse(path: str) -> DesignPath:
    return tuple(int(step) if step.isdecimal() else step for step in path.split("/") if step)


_Press = Callable[[ButtonEdit, DocumentSession, DesignPath], FormResult]


def _add_code(_press: ButtonEdit, document: DocumentSession, owner: DesignPath) -> FormResult:
    def change(design: Design) -> Design:
        changed = change_item(design, (*owner, "guard"), _with_predicate)
        return assign_id(changed, owner)

    document.edit("add code", change)
    return FormResult()


def _with_predicate(guard: Guard) -> Guard:
    return replace(guard, code=replace_text(None, "python", _NEW_PREDICATE))


def _remove_code(_press: ButtonEdit, document: DocumentSession, owner: DesignPath) -> FormResult:
    document.edit(
        "remove code", lambda design: change_item(design, (*owner, "guard"), lambda guard: replace(guard, code=None))
    )
    return FormResult()


def _remove(_press: ButtonEdit, document: DocumentSession, owner: DesignPath) -> FormResult:
    document.edit("remove transition", lambda design: remove_decisions(design, [owner]))
    return FormResult(new_selection=())


def _add_transition(press: ButtonEdit, document: DocumentSession, owner: DesignPath) -> FormResult:
    source = str(owner[1]) if owner[0] == "states" else "@common"
    if document.design.state(press.to) is None:
        return FormResult(error=texts.ITEM_MISSING)
    document.edit(
        f"connect {source.lstrip('@')} to {press.to}", lambda design: add_transition(design, source, press.to)
    )
    path = decisions_path(document.design, source)
    last = len(item_at(document.design, path)) - 1
    return FormResult(new_selection=(ItemRef(kind="transitions", id=transition_key((*path, last))),))


def _add_stay(press: ButtonEdit, document: DocumentSession, owner: DesignPath) -> FormResult:
    return _append(press, document, owner, "stay", Stay())


def _add_group(press: ButtonEdit, document: DocumentSession, owner: DesignPath) -> FormResult:
    return _append(press, document, owner, "group", DecisionGroup(guard=Guard(when="True"), then=(Stay(),)))


def _append(
    press: ButtonEdit, document: DocumentSession, owner: DesignPath, noun: str, item: Stay | DecisionGroup
) -> FormResult:
    path = (*owner, *_parse(press.path))
    document.edit(f"add {noun}", lambda design: change_item(design, path, lambda items: (*items, item)))
    return FormResult()


def _remove_row(press: ButtonEdit, document: DocumentSession, _owner: DesignPath) -> FormResult:
    path = _row_path(press, document)
    if path is None:
        return FormResult(error=texts.ITEM_MISSING)
    document.edit("remove transition", lambda design: remove_decisions(design, [path]))
    return FormResult()


def _move_row(press: ButtonEdit, document: DocumentSession, _owner: DesignPath) -> FormResult:
    path = _row_path(press, document)
    if path is None or not press.to.isdecimal():
        return FormResult(error=texts.ITEM_MISSING)
    document.edit("reorder transitions", lambda design: reorder_decision(design, path, int(press.to)))
    return FormResult()


def _row_path(press: ButtonEdit, document: DocumentSession) -> DesignPath | None:
    return _rebase(document, (*item_path(press.item), *_parse(press.path), press.index), press.rev)


_PRESSES: Mapping[str, _Press] = {
    "add-code": _add_code,
    "remove-code": _remove_code,
    "remove": _remove,
    "add-transition": _add_transition,
    "add-stay": _add_stay,
    "add-group": _add_group,
    "remove-row": _remove_row,
    "move-row": _move_row,
}
