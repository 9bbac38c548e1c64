"""The drawing of the open design in one window: the canvas, what it shows, and the gestures made on it."""

from collections.abc import Mapping
from typing import Any, cast

from nicegui import ui

from vicode.editor.canvas import Canvas
from vicode.editor.canvas.gesture import Gesture, Item
from vicode.editor.panels.designs_list import design_url
from vicode.editor.panels.desk import Desk
from vicode.editor.session import apply_gesture
from vicode.editor.view import Scene, Selected, difference, scene_of

_FOCUS_GUARD = 'setTimeout(() => document.querySelector(".inspector textarea")?.focus(), 200)'


class Drawing:
    """Builds the canvas; `follow` brings it up to date after a change of the design."""

    def __init__(self, desk: Desk) -> None:
        """Draw the design as it is now."""
        self.desk = desk
        desk.reveal = self.reveal
        self.canvas = Canvas(self._gesture)
        self.canvas.classes("canvas")
        self.scene: Scene = self._draw()
        self.canvas.load(self.scene)

    def follow(self) -> None:
        """Draw what changed in the design, and forget selected things that are gone."""
        scene = self._draw()
        self.canvas.apply(difference(self.scene, scene))
        self.scene = scene
        self.desk.selected = tuple(thing for thing in self.desk.selected if self._exists(thing))

    def show_selection(self) -> None:
        """Select on the canvas what is selected on the desk."""
        items = [{"of": thing.of, "id": thing.id} for thing in self.desk.selected if thing.of != "design"]
        self.canvas.select(cast("list[Item]", items))

    def reveal(self, thing: Selected) -> None:
        """Bring a thing to the middle of the canvas, if it is drawn."""
        if any(item["id"] == thing.id for item in self.scene.get(thing.of, ()) or () if isinstance(item, dict)):
            self.canvas.centre(cast("Any", thing.of), thing.id)

    def _draw(self) -> Scene:
        desk = self.desk
        return scene_of(desk.workspace.project, desk.design, desk.document.findings, desk.document.rev)

    def _exists(self, thing: Selected) -> bool:
        if thing.of in ("design", "common"):
            return True
        return any(item["id"] == thing.id for item in self.scene[thing.of]) or (
            thing.of == "transitions" and self.desk.document.has_decision(thing.id)
        )

    def _gesture(self, gesture: Gesture) -> None:
        payload = cast("Mapping[str, Any]", gesture)
        match payload["kind"]:
            case "select":
                things = (Selected(of=str(item["of"]), id=str(item["id"])) for item in payload["items"])
                self.desk.select(*things)
            case "open":
                self._open(str(payload["of"]), str(payload["id"]))
            case _:
                outcome = apply_gesture(self.desk.document, payload)
                if outcome.refused:
                    self.desk.say(outcome.refused, "warning")
                    self.canvas.load(self.scene)
                if outcome.select is not None:
                    self.desk.select(*outcome.select)
                if outcome.rename:
                    self.canvas.rename_in_place(outcome.rename)

    def _open(self, of: str, identity: str) -> None:
        if of in ("transitions", "common"):
            self.desk.select(Selected(of=of, id=identity))
            ui.run_javascript(_FOCUS_GUARD)
            return
        use = self.desk.design.use(identity) if of == "components" else None
        if use is None:
            return
        if self.desk.workspace.project.design(use.component) is None:
            self.desk.say(f"{use.component} is hand-written: it has no design to open", "info")
        else:
            ui.navigate.to(design_url(self.desk.workspace, use.component))
