"""The page that edits a design: canvas in the middle, designs to the left, inspector to the right, findings below."""

import contextlib
from collections.abc import Mapping
from typing import Any, cast

from nicegui import background_tasks, run, ui

from vicode.diagram.layout import lay_out
from vicode.editor.canvas import Canvas
from vicode.editor.canvas.gesture import Gesture, Item
from vicode.editor.pages.keys import listen_to_keys
from vicode.editor.pages.look import Theme, add_look
from vicode.editor.panels.code_panel import CodePanel
from vicode.editor.panels.designs_list import DesignsList, design_url
from vicode.editor.panels.desk import Desk
from vicode.editor.panels.findings_panel import FindingsPanel
from vicode.editor.panels.header import Commands, Header
from vicode.editor.panels.inspector import Inspector
from vicode.editor.panels.save_dialog import ask_about_disk
from vicode.editor.session import ChangedOnDiskError, Document, Library, Workspace, apply_gesture, take_places
from vicode.editor.view import Scene, Selected, difference, scene_of

_FOCUS_GUARD = 'setTimeout(() => document.querySelector(".inspector textarea")?.focus(), 200)'


class DesignPage:
    """One window on one design; everything in it can be rebuilt from the document."""

    def __init__(self, library: Library, workspace: Workspace, document: Document) -> None:
        """Build the page for the browser that asks for it."""
        self.desk = Desk(workspace=workspace, document=document, say=_say, reveal=self._reveal)
        self.links_shown = True
        self.theme = Theme(self.desk.code_editors)
        add_look()
        with ui.element("div").classes("shell"):
            commands = Commands(
                save=self._save,
                generate=self._generate,
                lay_out=self._lay_out,
                toggle_links=self._links,
                toggle_theme=self._theme,
            )
            self.header = Header(self.desk, commands)
            self.designs = DesignsList(library, (workspace.key, document.design.component), _say)
            with ui.element("main").classes("stage"):
                self.canvas = Canvas(self._gesture)
                self.canvas.classes("canvas")
            self.findings = FindingsPanel(self.desk)
            with ui.element("aside").classes("side").props('aria-label="Inspector"'):
                self._side()
        listen_to_keys(save=self._save, undo=document.undo, redo=document.redo)
        self.scene: Scene = self._draw()
        self.canvas.load(self.scene)
        self.desk.listen(self._refresh)
        self._refresh()
        unwatch = document.watch(lambda _document: self._changed())
        ui.context.client.on_delete(unwatch)
        ui.timer(1.0, self._follow_disk)

    def _follow_disk(self) -> None:
        # The folder itself may go while the editor is open; what is open here stays, and can be saved elsewhere.
        with contextlib.suppress(OSError):
            self.desk.workspace.follow_disk()
        self.designs.refresh()

    def _side(self) -> None:
        with ui.tabs().props("dense no-caps align=left").classes("side-tabs") as tabs:
            inspect = ui.tab("Inspect")
            code = ui.tab("Generated code")
        with ui.tab_panels(tabs, value=inspect, keep_alive=True).props("animated=false").classes("side-panels"):
            with ui.tab_panel(inspect):
                self.inspector = Inspector(self.desk)
            with ui.tab_panel(code):
                self.code = CodePanel(self.desk)
        tabs.on_value_change(lambda event: self.code.show(flag=event.value == "Generated code"))

    def _draw(self) -> Scene:
        desk = self.desk
        return scene_of(desk.workspace.project, desk.design, desk.document.findings, desk.document.rev)

    def _changed(self) -> None:
        scene = self._draw()
        self.canvas.apply(difference(self.scene, scene))
        self.scene = scene
        alive = tuple(thing for thing in self.desk.selected if self._exists(thing))
        if alive != self.desk.selected:
            self.desk.selected = alive
        self.desk.tell()

    def _exists(self, thing: Selected) -> bool:
        if thing.of in ("design", "common"):
            return True
        return any(item["id"] == thing.id for item in self.scene[thing.of]) or (
            thing.of == "transitions" and self.desk.document.has_decision(thing.id)
        )

    def _refresh(self) -> None:
        items = [{"of": thing.of, "id": thing.id} for thing in self.desk.selected if thing.of != "design"]
        self.canvas.select(cast("list[Item]", items))
        self.header.refresh()
        self.findings.refresh()
        self.inspector.refresh()
        self.code.refresh()

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
                    _say(outcome.refused, "warning")
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
            _say(f"{use.component} is hand-written: it has no design to open", "info")
        else:
            ui.navigate.to(design_url(self.desk.workspace, use.component))

    def _reveal(self, thing: Selected) -> None:
        if any(item["id"] == thing.id for item in self.scene.get(thing.of, ()) or () if isinstance(item, dict)):
            self.canvas.centre(cast("Any", thing.of), thing.id)

    async def _lay_out(self) -> None:
        """Graphviz works beside the server; its answer is one edit, so undo takes it back."""
        desk = self.desk
        only = [thing.id for thing in desk.selected if thing.of == "states"] or None
        layout = await run.io_bound(lay_out, desk.design, only=only)
        if layout is None or self.canvas.is_deleted:
            return
        desk.edit("lay out", lambda design: take_places(design, layout.placement, only))
        if layout.note:
            _say(layout.note, "info")
        self.canvas.fit()

    def _links(self) -> None:
        self.links_shown = not self.links_shown
        self.canvas.show_links(self.links_shown)

    def _theme(self) -> None:
        _say(self.theme.toggle(), "info")

    def _save(self) -> bool:
        try:
            self.desk.workspace.save(self.desk.document)
        except ChangedOnDiskError:
            ask_about_disk(self.desk)
            return False
        except (OSError, ValueError) as error:
            # A design may hold for a while what no file can: two declarations of one name.
            _say(f"Not saved: {error}", "negative")
            return False
        _say("Saved", "positive")
        return True

    def _generate(self) -> None:
        if self.desk.document.is_saved or self._save():
            background_tasks.create(self._write_code(), name="generate")

    async def _write_code(self) -> None:
        try:
            outcome = await run.io_bound(self.desk.workspace.generate, self.desk.document)
        except ChangedOnDiskError:
            with self.canvas.client:
                ask_about_disk(self.desk)
            return
        except OSError as error:
            with self.canvas.client:
                _say(f"Not generated: {error}", "negative")
            return
        if outcome is None or self.canvas.is_deleted:
            return
        with self.canvas.client:
            _say(outcome.words, "positive" if outcome.is_sound else "negative")


def _say(text: str, kind: str) -> None:
    ui.notify(text, type=cast("Any", kind), position="bottom", timeout=3500 if kind != "negative" else 8000)
