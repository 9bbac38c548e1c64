"""The Python side of the canvas: keeps what is shown, so that a page that mounts late or again gets it all."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from inspect import isawaitable
from typing import Any, cast

from nicegui import json, ui
from nicegui.events import GenericEventArguments

from vicode.editor.canvas.commands import commands_json
from vicode.editor.canvas.protocol import (
    ElementKind,
    Gesture,
    NodePosition,
    OnGesture,
    OnPointer,
    RemoteUser,
    Scene,
    SceneChanges,
    SceneItem,
)
from vicode.editor.js_modules import CANVAS_JS

_KINDS = ("states", "transitions", "components", "links")


class Canvas(ui.element, component=CANVAS_JS / "vicode_canvas.js"):
    """A state machine to look at and to work on.

    Args:
        on_gesture: called with every gesture (see `vicode.editor.canvas.protocol`); it may be a coroutine function.
        on_pointer: called with where the pointer is (None: not here), while other people are shown.
    """

    def __init__(self, on_gesture: OnGesture, on_pointer: OnPointer = lambda _at: None) -> None:
        super().__init__()
        # Not by a call after mounting: no key shall come too early.
        self._props["commands"] = commands_json()
        self._on_gesture, self._on_pointer = on_gesture, on_pointer
        self._presence: list[RemoteUser] = []
        self._presence_painted = self._presence_pending = True
        self._scene: dict[str, Any] | None = None
        self._selected: list[SceneItem] = []
        self._acked_seq = 0
        self._links_shown = True
        self._initial_target: tuple[ElementKind, str] | None = None
        self._pending_rename = ""
        self._is_mounted = False
        self._embedded_rev: int | None = None
        self._embedded_script = ""
        self.on_ready: Callable[[], None] = lambda: None
        self._active: tuple[list[str], int, list[str]] = ([], -1, [])
        self._breakpoints: list[SceneItem] = []
        self._acknowledged = -1
        self._sent = -1
        # Handlers added after the first rendering would make NiceGUI mount the element anew.
        self.on("gesture", self._handle_gesture)
        self.on("ready", self._handle_ready)
        self.on("ack", self._handle_ack)
        self.on("pointer", self._handle_pointer)
        self.on("presence-painted", self._handle_presence_painted)

    def load(self, view: Scene) -> None:
        """Show a whole scene; the view is kept when it is the same component as before, else all is fitted in."""
        self._scene = {**view, **{kind: {thing["id"]: thing for thing in view.get(kind, ())} for kind in _KINDS}}
        if not self._is_mounted:
            self._embed_scene()
        self._call("load", self._full_scene())

    def apply(self, changes: SceneChanges) -> None:
        """Bring the shown scene up to date by a difference."""
        if self._scene is None:
            raise RuntimeError("apply() needs a scene: call load() first")
        self._scene["rev"], self._embedded_rev = changes["rev"], None
        for kind, ids in changes.get("remove", {}).items():
            for identity in ids:
                self._scene[kind].pop(identity, None)
        for kind, things in changes.get("upsert", {}).items():
            self._scene[kind].update({thing["id"]: thing for thing in things})
        if "common" in changes:
            self._scene["common"] = changes["common"]
        self._call("apply", dict(changes))

    def select(self, items: Iterable[SceneItem]) -> None:
        """Select exactly these things; no gesture is reported for it."""
        wanted = list(items)
        if wanted == self._selected:
            # The hand may be a selection ahead by now: what it told is not told back to it.
            return
        self._selected = wanted
        self._call("select", self._selected, self._acked_seq)

    def centre(self, of: ElementKind, identity: str) -> None:
        """Bring one thing to the middle, large enough to be read."""
        self._call("centre", of, identity)

    def scroll_to_initial(self, of: ElementKind, identity: str) -> None:
        """Bring one thing into view once the page is there; where the view was kept by the browser, it stays."""
        self._initial_target = (of, identity)
        self._call("scrollToInitial", of, identity)

    def fit(self) -> None:
        """Show everything."""
        self._call("fit")

    def rename_in_place(self, state: str) -> None:
        """Open the name of a state for typing, as after creating it."""
        self._pending_rename = state
        if self._is_mounted:
            self._send_renaming()

    def state_renamed(self, old: str, new: str) -> None:
        """Tell that a drawn state is the same under another name, so that a name being typed there goes on."""
        self._call("stateRenamed", old, new)

    def run_command(self, command: str) -> None:
        """Do what a command of the canvas does, as if its key had been pressed."""
        self._call("runCommand", command)

    def focus(self) -> None:
        """Let the keys work on the canvas."""
        self._call("focus")

    def write_clipboard(self, text: str | None) -> None:
        """Answer a `Copy`: with its text, or None when there is nothing to copy."""
        self._call("writeClipboard", text)

    def show_tooltip(self, of: str, identity: str, sections: Sequence[Mapping[str, str]]) -> None:
        """Answer a `Peek`: sections of a name and a text, shown if the card is still there."""
        self._call("showTooltip", {"of": of, "id": identity, "sections": list(sections)})

    def show_preview(self, positions: Sequence[NodePosition]) -> None:
        """Show things at other places without taking them; Enter and Escape are reported. None of them ends it."""
        self._call("showPreview", list(positions), False)

    def end_preview(self) -> None:
        """End a preview and keep the view, as its places were taken."""
        self._call("showPreview", [], True)

    def highlight_active(self, ids: Sequence[str], seq: int, transitions: Sequence[str] = ()) -> None:
        """Highlight the states that are active in a running component, and the transitions that led there.

        Only the newest is shown: while a browser has not painted one, later ones wait and replace each other.

        Args:
            ids: the active states.
            seq: a number that grows with every call; an older one is ignored.
            transitions: the transitions taken last.
        """
        if seq <= self._active[1]:
            return
        self._active = (list(ids), seq, list(transitions))
        if self._sent == self._acknowledged:
            self._send_active()

    def set_breakpoints(self, items: Iterable[SceneItem]) -> None:
        """Show signs at exactly these things, where a run is to rest."""
        self._breakpoints = list(items)
        self._call("setBreakpoints", self._breakpoints)

    def show_presence(self, others: Sequence[RemoteUser]) -> None:
        """Show what other people have selected, and their pointers; only the newest, once the last was painted."""
        self._presence, self._presence_pending = list(others), True
        if self._presence_painted:
            self._send_presence()

    def show_links(self, flag: bool) -> None:
        """Show or hide what states require and modulate."""
        self._links_shown = flag
        self._call("showLinks", flag)

    def _call(self, method: str, *arguments: object) -> None:
        # Before the element is mounted a call would be lost; `_handle_ready` sends everything then.
        if self._is_mounted:
            self.run_method(method, *arguments)

    def _embed_scene(self) -> None:
        """Let the scene travel with the page, so that it is drawn before the page's socket is open.

        As a text beside NiceGUI's elements: what is among them is escaped sign by sign, which took longest of all.
        """
        self._remove_embedded_scene()
        scene, client = self._full_scene(), self.client
        if client._response_built:
            return
        # With no such sign nothing in it can end the script, or begin a comment.
        text = json.dumps(scene).replace("<", "\\u003c")
        name = f"scene-{self.id}"
        self._embedded_script = f'<script type="application/json" id="{name}">{text}</script>'
        client._body_html += self._embedded_script
        self._props["scene"], self._embedded_rev = name, scene["rev"]

    def _remove_embedded_scene(self) -> None:
        """Forget the text, which NiceGUI would keep as long as the page is open."""
        if self._embedded_script:
            self.client._body_html = self.client._body_html.replace(self._embedded_script, "")
        self._embedded_script, self._embedded_rev = "", None

    def _full_scene(self) -> dict[str, Any]:
        assert self._scene is not None
        return {**self._scene, **{kind: list(self._scene[kind].values()) for kind in _KINDS}}

    def _send_active(self) -> None:
        ids, self._sent, taken = self._active
        self._call("highlightActive", ids, self._sent, taken)

    def _send_renaming(self) -> None:
        if self._pending_rename:
            self._call("renameInPlace", self._pending_rename)
        self._pending_rename = ""

    def _send_presence(self) -> None:
        if self._is_mounted:
            self._presence_painted = self._presence_pending = False
            self._call("showPresence", self._presence)

    def _handle_pointer(self, event: GenericEventArguments) -> None:
        at = event.args["at"]
        point = (float(at["x"]), float(at["y"])) if at else None
        if point is None or all(math.isfinite(number) for number in point):
            self._on_pointer(point)

    def _handle_presence_painted(self) -> None:
        self._presence_painted = True
        if self._presence_pending:
            self._send_presence()

    async def _handle_gesture(self, event: GenericEventArguments) -> None:
        gesture = cast("Gesture", event.args)
        if gesture["kind"] == "select":
            self._selected, self._acked_seq = gesture["items"], gesture.get("client_seq", 0)
        answer = self._on_gesture(gesture)
        if isawaitable(answer):
            await answer

    def _handle_ready(self, event: GenericEventArguments) -> None:
        self._is_mounted = True
        # A page that is new shows what came with it, and somebody may have begun to work on that.
        is_new = self._embedded_rev is not None and event.args.get("rev") == self._embedded_rev
        self._remove_embedded_scene()
        if self._scene is not None and not is_new:
            self._call("load", self._full_scene())
        if not (is_new and self._links_shown):
            self._call("showLinks", self._links_shown)
        self._acked_seq = 0
        if not is_new or self._selected:
            self._call("select", self._selected, self._acked_seq)
        if self._initial_target:
            self._call("scrollToInitial", *self._initial_target)
            self._initial_target = None
        # A state made before this was heard, as what a page says while it opens comes in any order.
        self._send_renaming()
        self._call("setBreakpoints", self._breakpoints)
        self._send_presence()
        if self._active[1] >= 0:
            self._send_active()
        self.on_ready()

    def _handle_ack(self, event: GenericEventArguments) -> None:
        self._acknowledged = self._sent = event.args["seq"]
        if self._active[1] > self._acknowledged:
            self._send_active()
