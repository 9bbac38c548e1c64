"""The drawing of the open design in one window: the canvas, what it shows, and the gestures made on it."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, cast

from nicegui import ui

from vicode.editor.canvas import Canvas
from vicode.editor.canvas.commands import CANVAS_COMMANDS, CommandGroup
from vicode.editor.canvas.protocol import Gesture, SceneItem
from vicode.editor.panels.command import Command, MenuGroup
from vicode.editor.panels.use_dialog import ask_for_component
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import apply_gesture, clipboard, rebase_gesture, rebase_selection
from vicode.editor.session.gestures import parse_point
from vicode.editor.view import ItemRef, Scene, tooltip_sections
from vicode.editor.view.page_urls import design_url
from vicode.model.design import Point
from vicode.model.edits import add_use
from vicode.model.merge import find_renamed_states

# The field is there as soon as its code editor is, which is a large script to load the first time.
_FOCUS_GUARD = """
(function focus(left) {
  const field = document.querySelector(".inspector .expression-field .cm-content");
  if (field) field.focus();
  else if (left > 0) setTimeout(() => focus(left - 1), 50);
})(100);
"""

_PLACES = {CommandGroup.VIEW: MenuGroup.VIEW, CommandGroup.NAVIGATE: MenuGroup.VIEW}
# What the page does for the canvas, when its menu or keys ask for it.
_PAGE_COMMAND_NAMES = ("lay-out", "links", "help", "breakpoint", "simulate-here")


class CanvasController:
    """Builds the canvas; `update` brings it up to date after a change of the design."""

    def __init__(self, context: WindowContext) -> None:
        """Draw the design as it is now."""
        self.context = context
        self.on_preview: Callable[..., None] = lambda **_answer: None
        context.run_canvas_command = self.run_command
        self.page_commands: Mapping[str, Callable[[], object]] = {}
        context.reveal, context.is_shown = self.center_on, self._exists
        self.canvas = Canvas(self._on_gesture, self._share_pointer)
        self.canvas.classes("canvas")
        self.design = context.design
        self.scene: Scene = self._draw()
        self.canvas.load(self.scene)

    def commands(self, known: tuple[Command, ...]) -> tuple[Command, ...]:
        """What can be asked of the canvas, but for what the page knows already; the canvas hears the keys."""
        self.page_commands = {each.name: each.handler for each in known if each.name in _PAGE_COMMAND_NAMES}
        names = {each.name for each in known}
        return tuple(
            Command(
                each.name,
                each.label,
                partial(self.run_command, each.name),
                _PLACES.get(each.group, MenuGroup.EDIT),
                keys=each.keys,
                on_canvas=True,
            )
            for each in CANVAS_COMMANDS
            if each.name not in names and not each.keys_label
        )

    def run_command(self, command: str) -> None:
        """Do what a command of the canvas does."""
        self.canvas.run_command(command)

    def update(self) -> None:
        """Draw what changed in the design, and forget selected things that are gone."""
        scene = self._draw()
        if [state.name for state in self.design.states] != [state.name for state in self.context.design.states]:
            for old, new in find_renamed_states(self.design, self.context.design).items():
                self.canvas.state_renamed(old, new)
        self.canvas.apply(self.context.document.shared.scene_diff(self.scene, scene))
        self.scene = scene
        followed = [rebase_selection(thing, self.design, self.context.design) for thing in self.context.selected]
        self.design = self.context.design
        self.context.selected = tuple(thing for thing in followed if thing is not None and self._exists(thing))

    def show_selection(self) -> None:
        """Select on the canvas what is selected on the desk."""
        items = [{"of": thing.kind, "id": thing.id} for thing in self.context.selected if thing.kind != "design"]
        self.canvas.select(cast("list[SceneItem]", items))

    def center_on(self, thing: ItemRef) -> None:
        """Bring a thing to the middle of the canvas, if it is drawn."""
        if any(item["id"] == thing.id for item in self.scene.get(thing.kind, ()) or () if isinstance(item, dict)):
            self.canvas.centre(cast("Any", thing.kind), thing.id)

    def scroll_to_initial(self, thing: ItemRef) -> None:
        """Bring the thing that the page was opened for into view."""
        self.canvas.scroll_to_initial(cast("Any", thing.kind), thing.id)

    def _draw(self) -> Scene:
        desk = self.context
        return desk.document.shared.scene(desk.workspace.project)

    def _exists(self, thing: ItemRef) -> bool:
        if thing.kind in ("design", "common"):
            return True
        return any(item["id"] == thing.id for item in self.scene.get(thing.kind, ())) or (
            thing.kind == "transitions" and self.context.document.has_decision(thing.id)
        )

    def _on_gesture(self, gesture: Gesture) -> None:
        payload = cast("Mapping[str, Any]", gesture)
        match payload["kind"]:
            case "select":
                # Pressing a thing may take over a name typed just before, and the thing is called otherwise since.
                items = (self._rebase(payload) or {}).get("items", ())
                self.context.select(*(ItemRef(kind=str(item["of"]), id=str(item["id"])) for item in items))
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
                self.context.show_toast(words, "info")
            case "tooltip":
                self._show_tooltip(str(payload["of"]), str(payload["id"]))
            case "preview":
                self.on_preview(accepted=payload["accepted"] is True)
            case _:
                self._edit(payload)

    def _show_tooltip(self, of: str, identity: str) -> None:
        languages = self.context.workspace.project.languages
        try:
            sections = tooltip_sections(self.context.design, ItemRef(kind=of, id=identity), languages)
        except ValueError:
            # A key that no page of ours sends.
            return
        self.canvas.show_tooltip(of, identity, sections)

    def _edit(self, gesture: Mapping[str, Any]) -> None:
        payload = self._rebase(gesture)
        if payload is None:
            self.context.show_toast("That is gone by now", "warning")
            self.canvas.load(self.scene)
            return
        known, onto = self.context.workspace.project.interfaces(), self.context.selected
        more = {
            "duplicate": clipboard.duplicate_items,
            "paste": lambda document, wish: clipboard.paste(document, wish, known, onto),
        }
        outcome = apply_gesture(self.context.document, payload, more)
        if outcome.error:
            self.context.show_toast(outcome.error, "warning")
            self.canvas.load(self.scene)
        if outcome.note:
            self.context.show_toast(outcome.note, "info")
        if outcome.new_selection is not None:
            self.context.select(*outcome.new_selection)
        if outcome.state_to_rename:
            self.canvas.rename_in_place(outcome.state_to_rename)

    def _copy(self, payload: Mapping[str, Any]) -> None:
        try:
            text = clipboard.copy_as_text(self.context.design, payload["items"])
        except (KeyError, TypeError, AttributeError):
            # Only an old page, or somebody else's script, names things in another way.
            text = None
        self.canvas.write_clipboard(text)

    def _use(self, payload: Mapping[str, Any]) -> None:
        project = self.context.workspace.project
        try:
            at = parse_point(payload)
        except (KeyError, TypeError, ValueError):
            return
        usable = [each for name, each in sorted(project.interfaces().items()) if name != self.context.design.component]
        if payload.get("address") is None:
            ask_for_component(usable, lambda component: self._add_use(component, at))
            return
        dropped = (
            each.component
            for each in usable
            if design_url(self.context.workspace.key, each.component) == payload["address"]
        )
        component = next(dropped, None)
        if component is None:
            self.context.show_toast("Only another component of this project can be used here", "warning")
        else:
            self._add_use(component, at)

    def _add_use(self, component: str, at: Point) -> None:
        """Use a component at a place; one that is used already is only shown."""
        used = next((use.alias for use in self.context.design.uses if use.component == component), None)
        if used is None:
            self.context.edit(f"use {component}", lambda design: add_use(design, component, at))
            used = self.context.design.uses[-1].alias
        else:
            self.context.show_toast(f"{component} is used here already, as {used}", "info")
        self.context.select(ItemRef(kind="components", id=used))
        self.canvas.focus()

    def _rebase(self, payload: Mapping[str, Any]) -> Mapping[str, Any] | None:
        """A gesture as it is meant in the design as it is now; None when what it was made on is gone."""
        document, rev = self.context.document, payload.get("rev")
        shown = document.shared.design_at(rev if isinstance(rev, int) else document.rev)
        return rebase_gesture(payload, shown, document.design)

    def _share_pointer(self, at: Point | None) -> None:
        self.context.presence.update(self.context.window, pointer=at)

    def _open(self, of: str, identity: str) -> None:
        if of in ("transitions", "common"):
            self.context.select(ItemRef(kind=of, id=identity))
            ui.run_javascript(_FOCUS_GUARD)
            return
        use = self.context.design.use(identity) if of == "components" else None
        if use is not None:
            self.context.open_component(use.component)
