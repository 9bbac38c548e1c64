"""Python side of the canvas. It keeps the displayed scene, so that an element that mounts late or again receives it."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from inspect import isawaitable
from typing import Any

from nicegui import json, ui
from nicegui.events import GenericEventArguments

from vicode.decoding import MalformedEventError
from vicode.editor.canvas.commands import commands_json
from vicode.editor.canvas.protocol import (
    OnGesture,
    OnPointer,
    RemoteUser,
    SelectGesture,
    decode_gesture,
    item_json,
)
from vicode.editor.js_modules import CANVAS_JS
from vicode.editor.session.gestures.canvas_gestures import NodePosition
from vicode.editor.session.gestures.delivery import Inbox
from vicode.editor.view import ItemRef, Scene, SceneChanges
from vicode.model.design import Point


class Canvas(ui.element, component=CANVAS_JS / "vicode_canvas.js"):
    """Interactive diagram of a state machine.

    Args:
        on_gesture: called with every gesture; may be a coroutine function.
        on_pointer: called with the pointer position (None: outside the canvas) while other users are shown.
        on_malformed: called with the reason when the browser sent a malformed gesture, which is ignored.
    """

    def __init__(
        self,
        on_gesture: OnGesture,
        on_pointer: OnPointer = lambda _position: None,
        on_malformed: Callable[[str], None] = lambda _reason: None,
        inbox: Inbox | None = None,
    ) -> None:
        super().__init__()
        self._on_malformed = on_malformed
        self._inbox = inbox or Inbox(lambda _number: None)
        # Passed as a property and not by a call after mounting, so that the first key press finds the commands.
        self._props["commands"] = commands_json()
        self._on_gesture, self._on_pointer = on_gesture, on_pointer
        self._presence: list[RemoteUser] = []
        self._presence_painted = self._presence_pending = True
        self._scene: Scene | None = None
        self._selected: list[ItemRef] = []
        self._acked_seq = 0
        self._links_shown = True
        self._initial_target: tuple[str, str] | None = None
        self._is_mounted = False
        self._embedded_rev: int | None = None
        self._embedded_script = ""
        self.on_ready: Callable[[], None] = lambda: None
        self.on_inside: Callable[[], None] = lambda: None
        """Called when machines are shown in place, whose active states may be unknown."""
        self._active: tuple[list[str], int, list[str], dict[str, str]] = ([], -1, [], {})
        self._inside: dict[ItemRef, list[dict[str, Any]]] = {}
        self._breakpoints: list[dict[str, str]] = []
        self._heat: list[dict[str, str]] = []
        self.heat_words: Mapping[ItemRef, str] = {}
        """The figures of elements in the trace that is shown as a heat map."""
        self._controls_robot = False
        self._acknowledged = -1
        self._sent = -1
        # NiceGUI remounts an element when handlers are added after its first rendering.
        self.on("gesture", self._handle_gesture)
        self.on("ready", self._handle_ready)
        self.on("ack", self._handle_ack)
        self.on("pointer", self._handle_pointer)
        self.on("presence-painted", self._handle_presence_painted)

    def load(self, view: Scene) -> None:
        """Replace the scene. The view is kept if the component is the same as before; otherwise the scene is fitted."""
        self._scene = view
        if not self._is_mounted:
            self._embed_scene()
        self._call("load", view)
        self._send_selection()

    def apply(self, view: Scene, changes: SceneChanges) -> None:
        """Show the changes that lead to a scene."""
        self._scene, self._embedded_rev = view, None
        self._call("apply", changes)

    def select(self, items: Iterable[ItemRef]) -> None:
        """Set the selection; no gesture is reported for it."""
        selected = [item for item in items if item.kind != "design"]
        if selected == self._selected:
            # The browser may already have a newer selection: do not echo the one that it reported.
            return
        self._selected = selected
        self._send_selection()

    def center(self, of: str, identity: str) -> None:
        """Center one element at a readable zoom."""
        self._call("center", of, identity)

    def scroll_to_initial(self, of: str, identity: str) -> None:
        """Center one element when the page is mounted, or only scroll to it if the browser restores an earlier view."""
        self._initial_target = (of, identity)
        self._call("scrollToInitial", of, identity)

    def reveal_any(self, points: Sequence[Point]) -> None:
        """Pan to the first of these points, unless one of them is in view."""
        self._call("viewport.revealAny", [list(point) for point in points])

    def fit(self) -> None:
        self._call("fit")

    def state_renamed(self, old: str, new: str) -> None:
        """Report that another user renamed a state, so that an open rename field stays open."""
        self._call("rename.stateRenamed", old, new)

    def run_command(self, command: str) -> None:
        """Run a canvas command, as if its shortcut had been pressed."""
        self._call("commands.run", command)

    def focus(self) -> None:
        self._call("focus")

    def write_clipboard(self, text: str | None) -> None:
        """Answer a copy gesture with its text; None if there is nothing to copy."""
        self._call("clipboard.resolveCopy", text)

    def show_tooltip(self, item: ItemRef, sections: Sequence[Mapping[str, str]]) -> None:
        """Answer a tooltip gesture with sections of a name and a text; ignored if the tooltip was closed."""
        self._call("tooltip.addSections", {**item_json(item), "sections": list(sections)})

    def show_preview(self, positions: Sequence[NodePosition]) -> None:
        """Preview node positions; Enter and Escape are reported. An empty sequence ends the preview."""
        items = [{"of": node.kind, "id": node.id, "x": node.x, "y": node.y} for node in positions]
        self._call("showPreview", items, False)

    def end_preview(self) -> None:
        """End a preview whose positions were applied; the view stays."""
        self._call("showPreview", [], True)

    def show_inside(self, item: ItemRef, machines: Sequence[dict[str, Any]]) -> None:
        """Show machines {"alias", "component", "scene"} in place at a node, or none."""
        self._inside.pop(item, None)
        if machines:
            self._inside[item] = list(machines)
        self._call("insets.show", item_json(item), list(machines))
        self.on_inside()

    @property
    def shows_inside(self) -> bool:
        return bool(self._inside)

    def highlight_active(
        self, ids: Sequence[str], seq: int, transitions: Sequence[str] = (), inner: Mapping[str, str] | None = None
    ) -> None:
        """Highlight the active states of a running component and the transitions taken last.

        Until the browser has painted a call, only the newest later call is kept.

        Args:
            ids: the active states.
            seq: increases with every call; calls with a smaller number are ignored.
            transitions: the transitions taken last.
            inner: the active states of used components, by component.
        """
        if seq <= self._active[1]:
            return
        self._active = (list(ids), seq, list(transitions), dict(inner or {}))
        if self._sent == self._acknowledged:
            self._send_active()

    def set_breakpoints(self, items: Iterable[ItemRef]) -> None:
        self._breakpoints = [item_json(item) for item in items]
        self._call("setBreakpoints", self._breakpoints)

    def show_heat(self, colors: Mapping[ItemRef, str], words: Mapping[ItemRef, str]) -> None:
        """Color elements by the statistics of a trace, with figures for their tooltips; empty mappings end it."""
        self.heat_words = words
        self._heat = [{**item_json(item), "color": color} for item, color in colors.items()]
        self._call("painter.showHeat", self._heat)

    def set_controls_robot(self, flag: bool) -> None:
        """Offer in menus what needs control of a robot."""
        if flag != self._controls_robot:
            self._controls_robot = flag
            self._call("commands.setControlsRobot", flag)

    def show_presence(self, others: Sequence[RemoteUser]) -> None:
        """Show selections and pointers of other users; only the newest call is sent once the last one was painted."""
        self._presence, self._presence_pending = list(others), True
        if self._presence_painted:
            self._send_presence()

    def show_links(self, flag: bool) -> None:
        self._links_shown = flag
        self._call("showLinks", flag)

    def _call(self, method: str, *arguments: object) -> None:
        # A call before mounting would be lost; `_handle_ready` sends everything.
        if self._is_mounted:
            self.run_method("call", method, *arguments)

    def _embed_scene(self) -> None:
        """Embed the scene in the page, so that it is drawn before the page's socket is open.

        The scene is a separate script element: NiceGUI escapes its own elements character by character, which is slow.
        """
        self._remove_embedded_scene()
        scene, client = self._scene, self.client
        assert scene is not None
        if client._response_built:
            # Added to an open page: the scene arrives with the element.
            self._props["scene"], self._embedded_rev = json.dumps(scene), scene["rev"]
            return
        # Without "<" the text can neither end the script nor start a comment.
        text = json.dumps(scene).replace("<", "\\u003c")
        name = f"scene-{self.id}"
        self._embedded_script = f'<script type="application/json" id="{name}">{text}</script>'
        client._body_html += self._embedded_script
        self._props["scene"], self._embedded_rev = name, scene["rev"]

    def _remove_embedded_scene(self) -> None:
        """Drop the embedded scene; NiceGUI would keep it as long as the page is open."""
        if self._embedded_script:
            self.client._body_html = self.client._body_html.replace(self._embedded_script, "")
        elif self.client._response_built:
            with self._props.suspend_updates():
                self._props["scene"] = ""
        self._embedded_script, self._embedded_rev = "", None

    def _send_selection(self) -> None:
        self._call("select", [item_json(item) for item in self._selected], self._acked_seq)

    def _send_active(self) -> None:
        ids, self._sent, taken, inner = self._active
        self._call("highlightActive", ids, self._sent, taken, inner)

    def _send_presence(self) -> None:
        if self._is_mounted:
            self._presence_painted = self._presence_pending = False
            self._call("presence.show", self._presence)

    def _handle_pointer(self, event: GenericEventArguments) -> None:
        position = event.args["at"]
        point = (float(position["x"]), float(position["y"])) if position else None
        if point is None or all(math.isfinite(number) for number in point):
            self._on_pointer(point)

    def _handle_presence_painted(self) -> None:
        self._presence_painted = True
        if self._presence_pending:
            self._send_presence()

    async def _handle_gesture(self, event: GenericEventArguments) -> None:
        if not self._inbox.take(event.args):
            return
        try:
            report = decode_gesture(event.args)
        except MalformedEventError as error:
            self._on_malformed(str(error))
            return
        self._acked_seq = report.seq
        if isinstance(report.gesture, SelectGesture):
            self._selected = list(report.gesture.items)
        answer = self._on_gesture(report)
        if isawaitable(answer):
            await answer

    def _handle_ready(self, event: GenericEventArguments) -> None:
        self._is_mounted = True
        # A new page already shows the embedded scene, and the user may have started to edit it.
        is_new = self._embedded_rev is not None and event.args.get("rev") == self._embedded_rev
        self._remove_embedded_scene()
        if self._scene is not None and not is_new:
            self._call("load", self._scene)
        if not (is_new and self._links_shown):
            self._call("showLinks", self._links_shown)
        self._acked_seq = 0
        if not is_new or self._selected:
            self._send_selection()
        if self._initial_target:
            self._call("scrollToInitial", *self._initial_target)
            self._initial_target = None
        self._call("setBreakpoints", self._breakpoints)
        if self._heat:
            self._call("painter.showHeat", self._heat)
        self._call("commands.setControlsRobot", self._controls_robot)
        self._send_presence()
        for item, machines in self._inside.items():
            self._call("insets.show", item_json(item), machines)
        if self._active[1] >= 0:
            self._send_active()
        self.on_ready()

    def _handle_ack(self, event: GenericEventArguments) -> None:
        self._acknowledged = self._sent = event.args["seq"]
        if self._active[1] > self._acknowledged:
            self._send_active()
