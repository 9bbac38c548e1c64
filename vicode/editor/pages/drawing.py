"""The drawing of the open design in one window: the canvas, what it shows, and the gestures made on it."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, cast

from nicegui import ui

from vicode.editor.canvas import Canvas
from vicode.editor.canvas.commands import CANVAS_COMMANDS, Group
from vicode.editor.canvas.gesture import Gesture, Item
from vicode.editor.panels.command import Command, Place
from vicode.editor.panels.desk import Desk
from vicode.editor.panels.use_dialog import ask_for_component
from vicode.editor.session import apply_gesture, clipboard, follow, follow_gesture
from vicode.editor.session.gestures import point_of
from vicode.editor.view import Scene, Selected, peek_of
from vicode.editor.view.address import design_address
from vicode.model.design import Point
from vicode.model.edits import add_use
from vicode.model.merging import renamed_states

# The field is there as soon as its code editor is, which is a large script to load the first time.
_FOCUS_GUARD = """
(function focus(left) {
  const field = document.querySelector(".inspector .expression-field .cm-content");
  if (field) field.focus();
  else if (left > 0) setTimeout(() => focus(left - 1), 50);
})(100);
"""

_PLACES = {Group.SEE: Place.VIEW, Group.WALK: Place.VIEW}
# What the page does for the canvas, when its menu or keys ask for it.
_OF_THE_PAGE = ("lay-out", "links", "help", "breakpoint", "simulate-here")


class Drawing:
    """Builds the canvas; `follow` brings it up to date after a change of the design."""

    def __init__(self, desk: Desk) -> None:
        """Draw the design as it is now."""
        self.desk = desk
        self.on_preview: Callable[..., None] = lambda **_answer: None
        desk.run = self.run
        self.page_commands: Mapping[str, Callable[[], object]] = {}
        desk.reveal, desk.is_there = self.reveal, self._exists
        self.canvas = Canvas(self._gesture, self._point)
        self.canvas.classes("canvas")
        self.design = desk.design
        self.scene: Scene = self._draw()
        self.canvas.load(self.scene)

    def commands(self, known: tuple[Command, ...]) -> tuple[Command, ...]:
        """What can be asked of the canvas, but for what the page knows already; the canvas hears the keys."""
        self.page_commands = {each.name: each.act for each in known if each.name in _OF_THE_PAGE}
        names = {each.name for each in known}
        return tuple(
            Command(
                each.name,
                each.label,
                partial(self.run, each.name),
                _PLACES.get(each.group, Place.EDIT),
                keys=each.keys,
                on_canvas=True,
            )
            for each in CANVAS_COMMANDS
            if each.name not in names and not each.shown
        )

    def run(self, command: str) -> None:
        """Do what a command of the canvas does."""
        self.canvas.run(command)

    def follow(self) -> None:
        """Draw what changed in the design, and forget selected things that are gone."""
        scene = self._draw()
        if [state.name for state in self.design.states] != [state.name for state in self.desk.design.states]:
            for old, new in renamed_states(self.design, self.desk.design).items():
                self.canvas.state_renamed(old, new)
        self.canvas.apply(self.desk.document.sheet.changes(self.scene, scene))
        self.scene = scene
        followed = [follow(thing, self.design, self.desk.design) for thing in self.desk.selected]
        self.design = self.desk.design
        self.desk.selected = tuple(thing for thing in followed if thing is not None and self._exists(thing))

    def show_selection(self) -> None:
        """Select on the canvas what is selected on the desk."""
        items = [{"of": thing.of, "id": thing.id} for thing in self.desk.selected if thing.of != "design"]
        self.canvas.select(cast("list[Item]", items))

    def reveal(self, thing: Selected) -> None:
        """Bring a thing to the middle of the canvas, if it is drawn."""
        if any(item["id"] == thing.id for item in self.scene.get(thing.of, ()) or () if isinstance(item, dict)):
            self.canvas.centre(cast("Any", thing.of), thing.id)

    def arrive_at(self, thing: Selected) -> None:
        """Bring the thing that the page was opened for into view."""
        self.canvas.arrive_at(cast("Any", thing.of), thing.id)

    def _draw(self) -> Scene:
        desk = self.desk
        return desk.document.sheet.scene(desk.workspace.project)

    def _exists(self, thing: Selected) -> bool:
        if thing.of in ("design", "common"):
            return True
        return any(item["id"] == thing.id for item in self.scene.get(thing.of, ())) or (
            thing.of == "transitions" and self.desk.document.has_decision(thing.id)
        )

    def _gesture(self, gesture: Gesture) -> None:
        payload = cast("Mapping[str, Any]", gesture)
        match payload["kind"]:
            case "select":
                # Pressing a thing may take over a name typed just before, and the thing is called otherwise since.
                items = (self._brought_up_to_date(payload) or {}).get("items", ())
                self.desk.select(*(Selected(of=str(item["of"]), id=str(item["id"])) for item in items))
            case "open":
                self._open(str(payload["of"]), str(payload["id"]))
            case "command":
                self.page_commands.get(str(payload["name"]), lambda: None)()
            case "copy":
                self._copy(payload)
            case "use":
                self._use(payload)
            case "renamed-meanwhile":
                words = f"{payload['name']} is called {payload['id']} by now: what you type becomes its name"
                self.desk.say(words, "info")
            case "peek":
                self._peek(str(payload["of"]), str(payload["id"]))
            case "preview":
                self.on_preview(wanted=payload["wanted"] is True)
            case _:
                self._edit(payload)

    def _peek(self, of: str, identity: str) -> None:
        languages = self.desk.workspace.project.languages
        try:
            sections = peek_of(self.desk.design, Selected(of=of, id=identity), languages)
        except ValueError:
            # A key that no page of ours sends.
            return
        self.canvas.tell_peek(of, identity, sections)

    def _edit(self, gesture: Mapping[str, Any]) -> None:
        payload = self._brought_up_to_date(gesture)
        if payload is None:
            self.desk.say("That is gone by now", "warning")
            self.canvas.load(self.scene)
            return
        known, onto = self.desk.workspace.project.interfaces(), self.desk.selected
        more = {
            "duplicate": clipboard.duplicate,
            "paste": lambda document, wish: clipboard.paste(document, wish, known, onto),
        }
        outcome = apply_gesture(self.desk.document, payload, more)
        if outcome.refused:
            self.desk.say(outcome.refused, "warning")
            self.canvas.load(self.scene)
        if outcome.note:
            self.desk.say(outcome.note, "info")
        if outcome.select is not None:
            self.desk.select(*outcome.select)
        if outcome.rename:
            self.canvas.rename_in_place(outcome.rename)

    def _copy(self, payload: Mapping[str, Any]) -> None:
        try:
            text = clipboard.copied(self.desk.design, payload["items"])
        except (KeyError, TypeError, AttributeError):
            # Only an old page, or somebody else's script, names things in another way.
            text = None
        self.canvas.put_on_clipboard(text)

    def _use(self, payload: Mapping[str, Any]) -> None:
        project = self.desk.workspace.project
        try:
            at = point_of(payload)
        except (KeyError, TypeError, ValueError):
            return
        usable = [each for name, each in sorted(project.interfaces().items()) if name != self.desk.design.component]
        if payload.get("address") is None:
            ask_for_component(usable, lambda component: self._use_at(component, at))
            return
        dropped = (
            each.component
            for each in usable
            if design_address(self.desk.workspace.key, each.component) == payload["address"]
        )
        component = next(dropped, None)
        if component is None:
            self.desk.say("Only another component of this project can be used here", "warning")
        else:
            self._use_at(component, at)

    def _use_at(self, component: str, at: Point) -> None:
        """Use a component at a place; one that is used already is only shown."""
        used = next((use.alias for use in self.desk.design.uses if use.component == component), None)
        if used is None:
            self.desk.edit(f"use {component}", lambda design: add_use(design, component, at))
            used = self.desk.design.uses[-1].alias
        else:
            self.desk.say(f"{component} is used here already, as {used}", "info")
        self.desk.select(Selected(of="components", id=used))
        self.canvas.focus()

    def _brought_up_to_date(self, payload: Mapping[str, Any]) -> Mapping[str, Any] | None:
        """A gesture as it is meant in the design as it is now; None when what it was made on is gone."""
        document, rev = self.desk.document, payload.get("rev")
        shown = document.sheet.design_at(rev if isinstance(rev, int) else document.rev)
        return follow_gesture(payload, shown, document.design)

    def _point(self, at: Point | None) -> None:
        self.desk.company.turn(self.desk.window, pointer=at)

    def _open(self, of: str, identity: str) -> None:
        if of in ("transitions", "common"):
            self.desk.select(Selected(of=of, id=identity))
            ui.run_javascript(_FOCUS_GUARD)
            return
        use = self.desk.design.use(identity) if of == "components" else None
        if use is not None:
            self.desk.open(use.component)
