"""Python side of the forms. It keeps what they show, so that an element that mounts late or again receives it."""

import secrets
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from nicegui import ui
from nicegui.events import GenericEventArguments

from vicode.decoding import MalformedEventError, decode_event
from vicode.editor.inspector.protocol import FORM_EVENTS, FormEvent
from vicode.editor.js_modules import INSPECTOR_JS
from vicode.editor.session.forms.edits import FORM_EDITS, FormEdit
from vicode.editor.session.forms.form_data import diff_forms
from vicode.editor.session.forms.form_paths import at_design
from vicode.editor.session.gestures.delivery import Inbox
from vicode.editor.view import ItemRef

_SERVER = secrets.token_hex(8)
"""Identifies this run of the server."""


class FormView(ui.element, component=INSPECTOR_JS / "vicode_inspector.js"):
    """The form of the selected item, drawn by the browser.

    Args:
        on_edit: called with every edit; answers its id, the own text and an error.
        on_event: called with all other events.
        on_malformed: called with the reason when the browser sent a malformed event, which is ignored.
        inbox: takes each edit and event once.
        on_ready: called before the forms are sent; whether the browser has typed texts that the server may not have.
    """

    def __init__(
        self,
        on_edit: Callable[[FormEdit], Mapping[str, object]],
        on_event: Callable[[FormEvent], None],
        on_malformed: Callable[[str], None],
        on_ready: Callable[[bool], None],
        inbox: Inbox,
    ) -> None:
        super().__init__()
        self._on_edit, self._on_event, self._on_malformed = on_edit, on_event, on_malformed
        self._on_ready, self._inbox = on_ready, inbox
        self._data: dict[str, Any] = {
            "rev": -1,
            "forms": {},
            "marks": {},
            "lists": {},
            "language": "",
            "open_sections": [],
            "server": _SERVER,
        }
        self._selection: tuple[list[dict[str, str]], int] = ([], 0)
        self._opened: ItemRef | None = None
        self._is_mounted = False
        # NiceGUI remounts an element when handlers are added after its first rendering.
        self.on("edit", self._apply_edit)
        self.on("request", self._handle_request)
        self.on("ready", self._handle_ready)

    def show(self, data: Mapping[str, Any], moved: Mapping[str, str]) -> None:
        """Show the forms, marks and lists of a revision; `moved` has the new keys of renamed and moved items."""
        before, self._data = self._data, {**self._data, **data}
        changes: dict[str, Any] = {"rev": data["rev"], "moved": dict(moved)}
        for part in ("forms", "marks"):
            if before[part] is not data[part]:
                changes[part] = diff_forms(before[part], data[part])
        if before["lists"] != data["lists"]:
            changes["lists"] = data["lists"]
        self._call("update", changes)

    def select(self, items: Iterable[ItemRef], seq: int) -> None:
        """Show the form of the selected item; `seq` is the number of the browser's selection that Python knows."""
        selection = ([{"of": item.kind, "id": item.id} for item in items], seq)
        if selection != self._selection:
            self._selection = selection
            self._call("select", *selection)

    def open(self, item: ItemRef) -> None:
        """Focus the first field of the form of the selected item."""
        self._opened = None if self._is_mounted else item
        self._call("open", {"of": item.kind, "id": item.id})

    def answer_completion(self, number: int, answer: Mapping[str, object]) -> None:
        self._call("complete", number, dict(answer))

    def show_fixes(self, labels: Iterable[str]) -> None:
        self._call("showFixes", list(labels))

    def _call(self, method: str, *arguments: object) -> None:
        # A call before mounting would be lost; `_handle_ready` sends everything.
        if self._is_mounted:
            self.run_method(method, *arguments)

    def _apply_edit(self, event: GenericEventArguments) -> None:
        if not self._inbox.take(event.args):
            return
        try:
            edit = at_design(decode_event(event.args, FORM_EDITS))
        except MalformedEventError as error:
            self._on_malformed(str(error))
            return
        self._call("update", {"acks": [{"id": edit.id, **self._on_edit(edit)}]})

    def _handle_request(self, event: GenericEventArguments) -> None:
        if not self._inbox.take(event.args):
            return
        try:
            decoded = at_design(decode_event(event.args, FORM_EVENTS))
        except MalformedEventError as error:
            self._on_malformed(str(error))
            return
        self._on_event(decoded)

    def _handle_ready(self, event: GenericEventArguments) -> None:
        self._on_ready(event.args.get("is_continued") is True)
        self._is_mounted = True
        self._call("load", self._data)
        self._call("select", *self._selection)
        if self._opened is not None:
            self.open(self._opened)
