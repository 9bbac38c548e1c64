"""Edits that the browser makes in forms: typed texts, choices, names, and buttons."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Protocol

from vicode.editor.session import texts
from vicode.editor.session.document import DocumentSession
from vicode.editor.session.forms.design_presses import DESIGN_PRESSES
from vicode.editor.session.forms.form_paths import item_path
from vicode.editor.session.forms.form_places import FormPlace, FormResult, find_place, rebase_owner
from vicode.editor.session.forms.presses import PRESSES, FormAction
from vicode.editor.session.forms.text_merge import merge_texts
from vicode.editor.session.gestures.canvas_gestures import RenameGesture
from vicode.editor.session.gestures.edits import apply_edit
from vicode.editor.session.gestures.item_paths import change_item
from vicode.editor.view import ItemRef
from vicode.model.design import Guard
from vicode.model.guard_text import settle_guard
from vicode.model.paths import describe_path


def rename_item(document: DocumentSession, item: ItemRef, name: str) -> FormResult:
    """Rename a state, a step or layer by its state, a frame, or the alias of a component."""
    result = apply_edit(document, RenameGesture(item=item, name=name))
    selection = result.new_selection
    renamed = None if selection is None else (item, selection[0])
    return FormResult(own=item.id if renamed is None else renamed[1].id, error=result.error, renamed=renamed)


class FormEdit(Protocol):
    """An edit of the form of `item`; the browser showed revision `rev`, and numbers its edits by `id`."""

    kind: ClassVar[str]

    @property
    def id(self) -> int: ...

    @property
    def item(self) -> ItemRef: ...
    @property
    def path(self) -> str: ...

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
        place = find_place(document, self.item, self.path, self.rev)
        if place is None:
            return FormResult(error=texts.ITEM_MISSING)
        now = place.read(document.design)
        merged = self._merge(document, place, now)
        error = place.field.validate(self.text) or place.field.validate(merged) or place.find_loss(document.design)
        if error:
            return FormResult(error=error)
        return place.write(document, merged, place.stored(document.design, self.text))

    def _merge(self, document: DocumentSession, place: FormPlace, now: str) -> str:
        # A text that was refused is not in the design: this one replaces what it was to replace.
        is_refused = bool(place.field.validate(self.base))
        # The design may store a text without its outer spaces, for example: that is no edit of others.
        is_alone = is_refused or place.stored(document.design, self.base) == now
        return self.text if is_alone else merge_texts(self.base, self.text, now)


@dataclass(frozen=True, slots=True, kw_only=True)
class NameEdit:
    """The user entered a new name of the item."""

    kind: ClassVar = "name"
    id: int
    rev: int
    item: ItemRef
    path: str
    base: str
    text: str

    def apply(self, document: DocumentSession) -> FormResult:
        owner = rebase_owner(document, item_path(self.item), self.rev)
        if self.item.kind not in ("states", "frames", "components") or not owner:
            return FormResult(error=texts.ITEM_MISSING)
        return rename_item(document, ItemRef(kind=self.item.kind, id=str(owner[1])), self.text)


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
        place = find_place(document, self.item, self.path, self.rev)
        if place is None:
            return FormResult(error=texts.ITEM_MISSING)
        error = place.field.validate(self.value)
        return FormResult(error=error) if error else place.write(document, self.value)


@dataclass(frozen=True, slots=True, kw_only=True)
class ChoicesEdit:
    """The user chose `value` from a list of options, where the form showed `base`."""

    kind: ClassVar = "choose-several"
    id: int
    rev: int
    item: ItemRef
    path: str
    base: tuple[str, ...]
    value: tuple[str, ...]

    def apply(self, document: DocumentSession) -> FormResult:
        """Add and remove what the user has; what others have added or removed since stays so."""
        place = find_place(document, self.item, self.path, self.rev)
        now = None if place is None else place.field.read(place.owner_in(document.design))
        if place is None or not isinstance(now, tuple):
            return FormResult(error=texts.ITEM_MISSING)
        kept = [each for each in now if each in self.value or each not in self.base]
        added = [each for each in self.value if each not in self.base and each not in kept]
        error = place.field.validate((*kept, *added))
        return FormResult(error=error) if error else place.write(document, (*kept, *added))


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
        place = find_place(document, self.item, self.path, self.rev)
        return place.write(document, self.value) if place else FormResult(error=texts.ITEM_MISSING)


@dataclass(frozen=True, slots=True, kw_only=True)
class ButtonEdit:
    """The user pressed a button: of the form, or of a row or card of a list."""

    kind: ClassVar = "press"
    id: int
    rev: int
    item: ItemRef
    action: FormAction
    path: str = ""
    """The list; of a card, the path of the card."""
    index: int = 0
    """The row of the list, from 0."""
    to: str = ""
    """The target of a new transition, the component of a new call, or the new index of a row."""
    adds: str = ""
    """What a new card contains: "set", "call", "code", "modulation" or "declaration"."""
    card: str = ""
    """The id of a new card, chosen by the browser."""
    text: str = ""
    """The text, or the name of the declaration, that the browser shows in the new card."""

    def apply(self, document: DocumentSession) -> FormResult:
        owner = rebase_owner(document, item_path(self.item), self.rev)
        if owner is None:
            return FormResult(error=texts.ITEM_MISSING)
        handler = (PRESSES if owner else DESIGN_PRESSES).get(self.action)
        return FormResult(error=texts.ITEM_MISSING) if handler is None else handler(self, document, owner)


@dataclass(frozen=True, slots=True, kw_only=True)
class SettleEdit:
    """The user has finished typing into the expression or the time of a guard: times move to where they belong."""

    kind: ClassVar = "settle"
    id: int
    rev: int
    item: ItemRef
    path: str

    def apply(self, document: DocumentSession) -> FormResult:
        place = find_place(document, self.item, self.path, self.rev)
        guard = getattr(place.owner_in(document.design), "guard", None) if place is not None else None
        if place is None or not isinstance(guard, Guard):
            return FormResult(error=texts.ITEM_MISSING)
        settled = settle_guard(guard, document.design.time_unit)
        if settled is not guard:
            document.edit(
                f"edit {describe_path(place.file_path)}",
                lambda design: change_item(design, (*place.owner, "guard"), lambda _guard: settled),
                coalesce_key="/".join(map(str, place.file_path)),
            )
        return FormResult()


FORM_EDITS: Mapping[str, type[FormEdit]] = {
    each.kind: each for each in (TextEdit, NameEdit, ChoiceEdit, ChoicesEdit, CheckEdit, ButtonEdit, SettleEdit)
}
