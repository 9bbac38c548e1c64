"""The fields that edits of forms change: found in the current design, read and written."""

from dataclasses import dataclass
from typing import Any

from vicode.editor.session.document import DocumentSession
from vicode.editor.session.forms.fields import field_of, initial_field
from vicode.editor.session.forms.form_field import FormField
from vicode.editor.session.forms.form_paths import file_path, is_in_list, item_path, parse_path, resolve, split_path
from vicode.editor.session.gestures.item_paths import change_item, item_at, rebase_path
from vicode.editor.view import ItemRef
from vicode.findings import DesignPath
from vicode.model.design import Design
from vicode.model.paths import describe_path

_INITIAL: DesignPath = ("initial",)


@dataclass(frozen=True, slots=True, kw_only=True)
class FormResult:
    """The answer to an edit.

    `own` is the text that the design has of the typed one, without the edits of others. `error` says why the edit was
    refused; the design is unchanged then, and the browser keeps the typed text.
    """

    own: str = ""
    error: str = ""
    new_selection: tuple[ItemRef, ...] | None = None
    renamed: tuple[ItemRef, ItemRef] | None = None
    """The old and the new item, if the edit renamed it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FormPlace:
    """A field in the current design: the path of its owner, the path in the file, and how it is read and written."""

    owner: DesignPath
    file_path: DesignPath
    field: FormField

    def owner_in(self, design: Design) -> Any:
        return item_at(design, self.owner)

    def read(self, design: Design) -> str:
        return str(self.field.read(self.owner_in(design)))

    def find_loss(self, design: Design) -> str:
        """Why the value of the design cannot be edited without a loss, or ""."""
        return self.field.find_loss(self.owner_in(design))

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
            f"edit {describe_path(self.file_path)}",
            lambda design: change_item(design, self.owner, lambda each: self.field.write(each, value)),
            coalesce_key="/".join(map(str, self.file_path)),
        )
        is_refused = document.shared.notice is not notice and document.rev == rev
        return FormResult(own=own, error=document.shared.notice.text if is_refused else "")


def find_place(document: DocumentSession, item: ItemRef, path: str, rev: int) -> FormPlace | None:
    """The field at a path of an item that the browser showed at `rev`; None if it no longer exists."""
    steps, design = parse_path(path), document.design
    if item.kind == "states" and steps == _INITIAL:
        state = rebase_owner(document, item_path(item), rev)
        return FormPlace(owner=(), file_path=_INITIAL, field=initial_field(str(state[1]))) if state else None
    found = _find_owner(document, item, steps, rev)
    if found is None:
        return None
    owner, attribute = found
    field = field_of(item_at(design, owner), attribute)
    start = 2 if item.kind != "design" else 0
    in_file = file_path(design, owner[:start], (*owner[start:], *attribute))
    return FormPlace(owner=owner, file_path=in_file, field=field) if field else None


def _find_owner(
    document: DocumentSession, item: ItemRef, steps: DesignPath, rev: int
) -> tuple[DesignPath, DesignPath] | None:
    """The path of the owner of a value, and the path of the value in it."""
    path = item_path(item)
    if path is None:
        return None
    if not is_in_list(steps):
        inner, attribute = split_path(steps)
        owner = rebase_owner(document, (*path, *inner), rev)
        return None if owner is None else (owner, attribute)
    # An id names the same action in all revisions.
    start = rebase_owner(document, path, rev)
    resolved = resolve(document.design, document.shared.list_ids, start, steps) if start is not None else None
    if start is None or resolved is None:
        return None
    inner, attribute = split_path(resolved)
    return (*start, *inner), attribute


def rebase_owner(document: DocumentSession, path: DesignPath | None, rev: int) -> DesignPath | None:
    """The path of an owner that the browser showed at `rev`, in the current design."""
    design = document.shared.design_at(rev)
    rebased = path
    # Step by step: an item that was both renamed and moved would not be recognized.
    for number in range(rev + 1, document.rev + 1):
        before, design = design, document.shared.design_at(number)
        if rebased is not None and item_at(before, rebased) is None:
            # The browser added it; the edit that did so came before this one.
            continue
        rebased = rebase_path(rebased, before, design) if rebased is not None else None
    return rebased if rebased is not None and item_at(document.design, rebased) is not None else None
