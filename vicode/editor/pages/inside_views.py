"""The machines of used components that one window shows in place on its canvas."""

from dataclasses import dataclass, field
from typing import Any

from vicode.decoding import MalformedEventError, decode_event
from vicode.editor.canvas import Canvas
from vicode.editor.canvas.protocol import InsideEditGesture, InsideGesture
from vicode.editor.panels.texts import invalid_event, not_saved, sentence
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import DiskConflictError, DocumentSession, apply_edit, rebase_gesture
from vicode.editor.session.descriptions import error_reason
from vicode.editor.session.gestures.canvas_gestures import EDIT_GESTURES
from vicode.editor.view import ItemRef, make_scene
from vicode.model.design import Call, Design


@dataclass(eq=False)
class InsideViews:
    """Answers the canvas, and keeps what it shows up to date while the designs change."""

    context: WindowContext
    canvas: Canvas
    _shown: dict[ItemRef, dict[str, Design]] = field(default_factory=dict)

    def show(self, gesture: InsideGesture) -> None:
        item = gesture.item
        designs = self._designs(item) if gesture.shown else {}
        if gesture.shown and not designs:
            self.context.show_toast(f"No component that {item.id} uses has a design", "info")
        self._send(item, designs)

    def refresh(self) -> None:
        for item, shown in list(self._shown.items()):
            designs = self._designs(item)
            if designs != shown:
                self._send(item, designs)

    def edit(self, gesture: InsideEditGesture) -> None:
        """Edit a shown component in its own document, which is saved if it was."""
        document = self._document(gesture.component)
        if document is None:
            return
        was_saved = document.is_saved
        try:
            error = _apply(document, gesture)
        except MalformedEventError as malformed:
            error = invalid_event(str(malformed))
        if not error and was_saved:
            error = self._save(document)
        if error:
            self.context.show_toast(sentence(error), "warning")
            # What the browser shows already, such as a moved state, is drawn again.
            self._shown = {item: {} for item in self._shown}
        self.refresh()

    def _document(self, component: str) -> DocumentSession | None:
        """The document of a component that is shown, as this user edits it."""
        shown = any(design.component == component for designs in self._shown.values() for design in designs.values())
        document = self.context.workspace.open_document(component) if shown else None
        return None if document is None else DocumentSession(document.shared, self.context.document.user_id)

    def _save(self, document: DocumentSession) -> str:
        try:
            self.context.workspace.save(document)
        except DiskConflictError:
            return f"another program has changed {document.file.name}"
        except (OSError, ValueError) as error:
            return not_saved(document.file.name, error_reason(error))
        return ""

    def _send(self, item: ItemRef, designs: dict[str, Design]) -> None:
        self._shown.pop(item, None)
        if designs:
            self._shown[item] = designs
        self.canvas.show_inside(item, [self._machine(alias, design) for alias, design in designs.items()])

    def _machine(self, alias: str, design: Design) -> dict[str, Any]:
        workspace, component = self.context.workspace, design.component
        document = workspace.open_document(component)
        scene = make_scene(workspace.project, design, (), document.rev if document else 0)
        return {"alias": alias, "component": component, "file": workspace.files[component].name, "scene": scene}

    def _designs(self, item: ItemRef) -> dict[str, Design]:
        """The designs of a used component, or of the components that a state requires, modulates or calls, by alias."""
        design, project = self.context.design, self.context.workspace.project
        aliases: tuple[str, ...] = (item.id,) if item.kind == "components" else ()
        state = design.state(item.id) if item.kind == "states" else None
        if state is not None:
            aliases = (*state.requires, *(action.alias for action in state.all_actions if isinstance(action, Call)))
        uses = [use for alias in dict.fromkeys(aliases) if (use := design.use(alias)) is not None]
        found = ((use.alias, project.design(use.component)) for use in uses)
        return {alias: inner for alias, inner in found if inner is not None}


def _apply(document: DocumentSession, gesture: InsideEditGesture) -> str:
    """Apply the edit to the current design; returns an error message or an empty string."""
    if gesture.edit in ({"kind": "undo"}, {"kind": "redo"}):
        return document.undo() if gesture.edit["kind"] == "undo" else document.redo()
    edit = decode_event(gesture.edit, {each.kind: each for each in EDIT_GESTURES})
    rebased = rebase_gesture(edit, document.shared.design_at(gesture.seen), document.design)
    return apply_edit(document, rebased).error if rebased else "this item no longer exists"
