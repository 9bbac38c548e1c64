"""Forms that are updated in place: elements stay while the values, names and positions of their items change."""

from collections import deque
from collections.abc import Callable, Hashable, Sequence
from typing import Any, TypeVar

from nicegui import ui

from vicode.editor.panels.text_input import TextInput
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.item_paths import TrackedItem
from vicode.findings import DesignPath

_MAX_REMOVED_PARTS = 8
_NOT_RENDERED = "not-rendered"

T = TypeVar("T")
ItemKey = tuple[TrackedItem, Hashable]
"""The item of a row and its shape."""


class RemovedTexts:
    """Keeps the text fields of removed parts: the browser may still send text that was typed before it knew.

    They stand in a slot that the browser does not render.
    """

    def __init__(self) -> None:
        self._host = ui.element("div").classes("hidden")
        self._host.add_slot(_NOT_RENDERED)
        self._parts: deque[list[ui.element]] = deque()

    def remove(self, part: ui.element) -> None:
        """Delete an element, except for the text fields in it."""
        fields: list[ui.element] = []
        fields += [each for each in part.descendants() if isinstance(each, TextInput | ui.codemirror)]
        for field in fields:
            field.move(self._host, target_slot=_NOT_RENDERED)
        part.delete()
        if fields:
            self._parts.append(fields)
        if len(self._parts) > _MAX_REMOVED_PARTS:
            for field in self._parts.popleft():
                field.delete()


class Form:
    """A form or a row in one: what `refresh` updates."""

    def __init__(self, context: WindowContext, removed: RemovedTexts) -> None:
        self.context, self.removed = context, removed
        self._refreshers: list[Callable[[], None]] = []

    def on_refresh(self, refresh: Callable[[], None]) -> None:
        """Call `refresh` after each change of design or project."""
        self._refreshers.append(refresh)

    def watch(self, read: Callable[[], T], show: Callable[[T], object]) -> None:
        """Show a value now and after each change of it."""
        shown: list[T] = []

        def refresh() -> None:
            value = read()
            if [value] != shown:
                shown[:] = [value]
                show(value)

        self.on_refresh(refresh)
        refresh()

    def refresh(self) -> None:
        for refresh in tuple(self._refreshers):
            refresh()

    def item(self, *path: str | int) -> TrackedItem:
        return TrackedItem(lambda: self.context.design, path)


class Rows:
    """A list in a form: a refresh creates, moves and removes rows, and keeps those whose keys remain.

    Args:
        form: the form.
        list_keys: returns the keys of the rows in their order.
        build: builds the row of a key; it adds what can change to the form of the row.
        css_class: of each row; by default, their content is laid out as that of the surrounding element.
    """

    def __init__(
        self,
        form: Form,
        list_keys: Callable[[], Sequence[Any]],
        build: Callable[[Form, Any], object],
        css_class: str = "form-rows",
    ) -> None:
        self.form, self._list_keys, self._build, self._css_class = form, list_keys, build, css_class
        self._rows: dict[Hashable, tuple[ui.element, Form]] = {}
        self.container = ui.element("div").classes("form-rows")
        form.on_refresh(self.refresh)
        self.refresh()

    @property
    def keys(self) -> list[Any]:
        return list(self._rows)

    def refresh(self) -> None:
        keys = self._list_keys()
        for key in self._rows.keys() - set(keys):
            self.form.removed.remove(self._rows.pop(key)[0])
        for index, key in enumerate(keys):
            if key in self._rows:
                self._rows[key][1].refresh()
            else:
                self._add(key)
            row = self._rows[key][0]
            if self.container.default_slot.children[index] is not row:
                row.move(target_index=index)

    def _add(self, key: Any) -> None:
        form = Form(self.form.context, self.form.removed)
        with self.container, ui.element("div").classes(self._css_class) as row:
            self._build(form, key)
        self._rows[key] = (row, form)


class ItemRows(Rows):
    """One row per item of a list of the design or project. A row is built anew only if its `shape` changes."""

    def __init__(
        self,
        form: Form,
        owner: TrackedItem,
        section: str,
        build: Callable[[Form, TrackedItem], None],
        shape: Callable[[Any], Hashable] = type,
    ) -> None:
        self._owner, self._section, self._shape = owner, section, shape
        super().__init__(form, self._list_items, lambda row, key: build(row, key[0]))

    def _list_items(self) -> list[ItemKey]:
        rows: dict[tuple[DesignPath | None, Hashable], ItemKey] = {(key[0].path, key[1]): key for key in self.keys}
        keys = []
        for index, item in enumerate(self._owner.child(self._section).get() or ()):
            child, shape = self._owner.child(self._section, index), self._shape(item)
            keys.append(rows.get((child.path, shape), (child, shape)))
        return keys
