"""Connects the canvas of one window to the design: draws changes and applies gestures."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import TypeVar

from vicode.editor.canvas import Canvas
from vicode.editor.canvas.commands import CANVAS_COMMANDS, CommandGroup
from vicode.editor.canvas.protocol import (
    CommandGesture,
    CopyGesture,
    GestureReport,
    InsideEditGesture,
    InsideGesture,
    OpenGesture,
    PasteGesture,
    PreviewGesture,
    SelectGesture,
    StateRenamedGesture,
    TooltipGesture,
    UseGesture,
)
from vicode.editor.pages import texts
from vicode.editor.pages.inside_views import InsideViews
from vicode.editor.panels.commands.command import Command, MenuGroup
from vicode.editor.panels.inspector.use_dialog import ask_for_component
from vicode.editor.panels.texts import invalid_event
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import EditResult, apply_edit, rebase_gesture, rebase_selection
from vicode.editor.session.gestures import clipboard
from vicode.editor.session.gestures.canvas_gestures import NoteGesture
from vicode.editor.session.gestures.edits import RequestedEdit, canvas_point
from vicode.editor.view import SCENE_LISTS, ItemRef, Scene, tooltip_sections
from vicode.editor.view.page_urls import design_url
from vicode.model.design import Point
from vicode.model.edits import add_use
from vicode.model.merge import find_renamed_states

_MENU_GROUPS = {CommandGroup.VIEW: MenuGroup.VIEW, CommandGroup.NAVIGATE: MenuGroup.VIEW}
# Commands of the page that the menu and the keys of the canvas trigger.
_PAGE_COMMAND_NAMES = (
    *("undo", "redo", "lay-out", "links", "help", "breakpoint", "simulate-here", "robot-enter"),
    *("extract", "inline"),
)

_G = TypeVar("_G")


class CanvasController:
    """Builds the canvas; `update` applies changes of the design to it."""

    def __init__(self, context: WindowContext) -> None:
        self.context = context
        self.on_preview: Callable[..., None] = lambda **_answer: None
        self.page_commands: Mapping[str, Callable[[], object]] = {}
        self.canvas = Canvas(self._on_gesture, self._share_pointer, self._on_malformed, context.inbox)
        self.canvas.classes("canvas")
        self.inside_views = InsideViews(context, self.canvas)
        self.design = context.design
        self.scene: Scene = self._draw()
        self.canvas.load(self.scene)

    def commands(self, known: tuple[Command, ...]) -> tuple[Command, ...]:
        """Return the canvas commands that are not among `known`. The canvas itself handles their keys."""
        self.page_commands = {command.name: command.handler for command in known if command.name in _PAGE_COMMAND_NAMES}
        names = {command.name for command in known}
        return tuple(
            Command(
                command.name,
                command.label,
                partial(self.canvas.run_command, command.name),
                _MENU_GROUPS.get(command.group, MenuGroup.EDIT),
                keys=command.keys,
                on_canvas=True,
            )
            for command in CANVAS_COMMANDS
            if command.name not in names and not command.keys_label
        )

    def update(self) -> None:
        """Draw the changes of the design, and remove deleted items from the selection."""
        scene = self._draw()
        if [state.name for state in self.design.states] != [state.name for state in self.context.design.states]:
            for old, new in find_renamed_states(self.design, self.context.design).items():
                self.canvas.state_renamed(old, new)
        self.canvas.apply(scene, self.context.document.shared.scene_diff(self.scene, scene))
        self.scene = scene
        self.inside_views.refresh()
        rebased = [rebase_selection(item, self.design, self.context.design) for item in self.context.selected]
        self.design = self.context.design
        self.context.selected = tuple(item for item in rebased if item is not None and self.exists(item))

    def show_selection(self) -> None:
        self.canvas.select(self.context.selected)

    def center_on(self, item: ItemRef) -> None:
        """Scroll an item to the middle of the canvas, if it is drawn."""
        if self._draws(item):
            self.canvas.center(item.kind, item.id)

    def scroll_to_initial(self, item: ItemRef) -> None:
        self.canvas.scroll_to_initial(item.kind, item.id)

    def _draw(self) -> Scene:
        return self.context.document.shared.scene(self.context.workspace.project)

    def exists(self, item: ItemRef) -> bool:
        """Whether an item is on the canvas."""
        if item.kind in ("design", "common"):
            return True
        return self._draws(item) or (item.kind == "transitions" and self.context.document.has_decision(item.id))

    def _draws(self, item: ItemRef) -> bool:
        return any(each["id"] == item.id for name in SCENE_LISTS if name == item.kind for each in self.scene[name])

    def _on_gesture(self, report: GestureReport) -> None:
        gesture, rev = report.gesture, report.rev
        self.context.selection_seq = report.seq
        match gesture:
            case SelectGesture():
                # The click may have committed a name that was being typed: the item may have a new name.
                rebased = self._rebase(gesture, rev)
                self.context.select(*(rebased.items if rebased else ()))
            case OpenGesture():
                self._open(gesture.item, is_open=gesture.is_open)
            case CommandGesture():
                self.page_commands.get(gesture.name, lambda: None)()
            case CopyGesture() | TooltipGesture() | InsideGesture():
                self._answer(gesture)
            case InsideEditGesture():
                self.inside_views.edit(gesture)
            case PasteGesture():
                self._paste(gesture)
            case UseGesture():
                self._use(gesture)
            case StateRenamedGesture():
                self.context.show_toast(
                    f"{gesture.old} was renamed to {gesture.new} by another user; your text will rename it again",
                    "info",
                )
            case PreviewGesture():
                self.on_preview(accepted=gesture.accepted)
            case _:
                self._edit(gesture, rev)

    def _answer(self, gesture: CopyGesture | TooltipGesture | InsideGesture) -> None:
        """Send what the canvas requests about its items."""
        match gesture:
            case CopyGesture():
                self.canvas.write_clipboard(clipboard.copy_as_text(self.context.design, gesture.items))
            case TooltipGesture():
                self._show_tooltip(gesture.item)
            case InsideGesture():
                self.inside_views.show(gesture)

    def _on_malformed(self, reason: str) -> None:
        self.context.show_toast(invalid_event(reason), "warning")

    def _show_tooltip(self, item: ItemRef) -> None:
        sections = tooltip_sections(self.context.workspace.project, self.context.design, item)
        if item in self.canvas.heat_words:
            sections = [{"name": "trace", "text": self.canvas.heat_words[item]}, *sections]
        self.canvas.show_tooltip(item, sections)

    def apply(self, edit: RequestedEdit) -> EditResult:
        """Apply an edit, and offer to undo what a single key did."""
        document, rev = self.context.document, self.context.document.rev
        result = apply_edit(document, edit)
        done = texts.describe_done(edit, document.design)
        if done and not result.error and document.rev != rev:
            entry_id = document.history.current_id
            self.context.page.offer_undo(done, lambda: self._undo_entry(entry_id))
        return result

    def _undo_entry(self, entry_id: int) -> None:
        if error := self.context.document.undo_entry(entry_id):
            self.context.show_toast(error, "warning")

    def _edit(self, gesture: RequestedEdit, rev: int) -> None:
        rebased = self._rebase(gesture, rev)
        result = self.apply(rebased) if rebased else EditResult(error="This item no longer exists")
        self.context.is_opening = isinstance(gesture, NoteGesture) and not result.error
        self._show_result(result)

    def _paste(self, gesture: PasteGesture) -> None:
        known, at = self.context.workspace.project.interfaces(), canvas_point(gesture.x, gesture.y)
        self._show_result(clipboard.paste(self.context.document, gesture.text, at, known, self.context.selected))

    def _show_result(self, result: EditResult) -> None:
        if result.error:
            self.context.show_toast(result.error, "warning")
            self.canvas.load(self.scene)
        if result.note:
            self.context.show_toast(result.note, "info")
        if result.new_selection is not None:
            self.context.select(*result.new_selection)

    def _use(self, gesture: UseGesture) -> None:
        project, at = self.context.workspace.project, canvas_point(gesture.x, gesture.y)
        usable = [each for name, each in sorted(project.interfaces().items()) if name != self.context.design.component]
        if gesture.address is None:
            ask_for_component(usable, lambda component: self._add_use(component, at))
            return
        dropped = (
            each.component
            for each in usable
            if design_url(self.context.workspace.key, each.component) == gesture.address
        )
        component = next(dropped, None)
        if component is None:
            self.context.show_toast("Only other components of this project can be added", "warning")
        else:
            self._add_use(component, at)

    def _add_use(self, component: str, at: Point) -> None:
        """Add a component at a position; select it if the design uses it already."""
        alias = next((use.alias for use in self.context.design.uses if use.component == component), None)
        if alias is None:
            self.context.edit(f"add component {component}", lambda design: add_use(design, component, at))
            alias = self.context.design.uses[-1].alias
        else:
            self.context.show_toast(f"{component} is already used as {alias}", "info")
        self.context.select(ItemRef(kind="components", id=alias))
        self.canvas.focus()

    def _rebase(self, gesture: _G, rev: int) -> _G | None:
        """Rebase a gesture on the current design; None if its item no longer exists."""
        document = self.context.document
        return rebase_gesture(gesture, document.shared.design_at(rev), document.design)

    def _share_pointer(self, at: Point | None) -> None:
        self.context.presence.update(self.context.window, pointer=at)

    def _open(self, item: ItemRef, *, is_open: bool) -> None:
        if item.kind in ("transitions", "common", "notes"):
            self.context.is_opening = not is_open
            self.context.select(item)
            self.context.notify_subscribers()
            return
        use = self.context.design.use(item.id) if item.kind == "components" else None
        if use is not None:
            self.context.page.open_component(use.component)
