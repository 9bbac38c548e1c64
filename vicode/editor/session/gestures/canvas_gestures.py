"""Gestures of the canvas that edit the open design."""

from collections.abc import Collection, Iterable
from dataclasses import dataclass, field, replace
from typing import ClassVar, Literal

from vicode.diagram.drawn_transitions import shows_common
from vicode.diagram.layered_layout import NodeLayout
from vicode.editor.session import texts
from vicode.editor.session.document import DocumentSession
from vicode.editor.session.gestures.clipboard import DuplicateGesture
from vicode.editor.session.gestures.edits import (
    ComponentAlias,
    EditError,
    EditResult,
    RequestedEdit,
    StateName,
    canvas_point,
    create_state,
    naming_key,
    require_state,
)
from vicode.editor.session.gestures.transition_gestures import (
    ConnectGesture,
    GuardGesture,
    LabelGesture,
    ReconnectGesture,
    ReorderGesture,
)
from vicode.editor.view import ItemKind, ItemRef
from vicode.model.decision_keys import parse_transition_key
from vicode.model.design import Design, DiagramNote, Point
from vicode.model.diagram_edits import add_frame, move_notes, remove_frames, remove_notes, rename_frame
from vicode.model.edits import (
    add_modulation,
    add_requirement,
    move_nodes,
    remove_decisions,
    remove_link,
    remove_states,
    remove_uses,
    rename_state,
    rename_use,
    set_disabled,
    unique_name,
    update_state,
)
from vicode.model.names import MAX_NAME_LENGTH, is_valid_name
from vicode.model.traversal import find_decision
from vicode.services import messages
from vicode.services.rename.name_errors import state_name_error


@dataclass(frozen=True, slots=True, kw_only=True)
class NodePosition:
    """A node and its center, in world units."""

    kind: ItemKind = field(metadata={"json": "of"})
    id: str
    x: float
    y: float


@dataclass(frozen=True, slots=True, kw_only=True)
class MoveGesture:
    """The user moved nodes. The canvas already shows the new positions and accepts an echo or a correction."""

    kind: ClassVar = "move"
    items: tuple[NodePosition, ...]
    how: str = "drag"
    """Command that moved them: "drag", "nudge", "align-left", …"""

    def apply(self, document: DocumentSession) -> EditResult:
        moved: dict[str, dict[str, Point]] = {"states": {}, "components": {}, "common": {}, "notes": {}}
        for item in self.items:
            moved.setdefault(item.kind, {})[item.id] = canvas_point(item.x, item.y)
        common = next(iter(moved["common"].values()), None)
        label = texts.move_items(len(self.items), next(iter(moved["states"]), "component"))
        # Successive nudges of the same items are one edit, like the letters of a word.
        items = sorted((item.kind, item.id) for item in self.items)
        document.edit(
            texts.ALIGNMENTS.get(self.how, label),
            lambda design: move_notes(move_nodes(design, moved["states"], moved["components"], common), moved["notes"]),
            coalesce_key=f"nudge {items}" if self.how == "nudge" else "",
        )
        return EditResult()


@dataclass(frozen=True, slots=True, kw_only=True)
class CreateGesture:
    """Create a state with its center at (x, y), and select it if wanted; without a name it gets one."""

    kind: ClassVar = "create"
    x: float
    y: float
    name: str = ""
    select: bool = True

    def apply(self, document: DocumentSession) -> EditResult:
        return create_state(document, canvas_point(self.x, self.y), self.name, select=self.select)


@dataclass(frozen=True, slots=True, kw_only=True)
class NoteGesture:
    """Add a note with its center at (x, y), and select it."""

    kind: ClassVar = "note"
    x: float
    y: float

    def apply(self, document: DocumentSession) -> EditResult:
        name = unique_name("note", {note.name for note in document.design.notes})
        note = DiagramNote(name=name, text="Note", at=canvas_point(self.x, self.y))
        document.edit("add note", lambda design: replace(design, notes=(*design.notes, note)))
        return EditResult(new_selection=(ItemRef(kind="notes", id=name),))


@dataclass(frozen=True, slots=True, kw_only=True)
class FrameGesture:
    """Draw a frame around states, and select it; without a title it gets one."""

    kind: ClassVar = "frame"
    states: tuple[StateName, ...]
    title: str = ""

    def apply(self, document: DocumentSession) -> EditResult:
        known = [name for name in dict.fromkeys(self.states) if document.design.state(name) is not None]
        if not known:
            raise EditError("select the states to draw a frame around")
        wanted = _title(self.title) or "Frame"
        title = unique_name(wanted, {frame.name for frame in document.design.frames})
        document.edit(f"add frame {title}", lambda design: add_frame(design, title, known))
        return EditResult(new_selection=(ItemRef(kind="frames", id=title),))


@dataclass(frozen=True, slots=True, kw_only=True)
class RenameGesture:
    """Rename a state, a component's alias or a frame. The name may be taken or invalid."""

    kind: ClassVar = "rename"
    item: ItemRef
    name: str

    def apply(self, document: DocumentSession) -> EditResult:
        if self.item.kind == "frames":
            return self._rename_frame(document)
        old, new, design = self.item.id, self.name.strip(), document.design
        is_use = self.item.kind == "components"
        if not is_use:
            require_state(document, old)
        if old == new:
            return EditResult()
        if (
            error := _alias_error(design, new)
            if is_use
            else state_name_error(new, {each.name for each in design.states})
        ):
            raise EditError(error)
        rename = rename_use if is_use else rename_state
        key = "" if is_use else naming_key(document, old)
        label = texts.add_state(new) if key else texts.rename(old, new)
        document.edit(label, lambda design: rename(design, old, new), coalesce_key=key)
        return EditResult(new_selection=(replace(self.item, id=new),))

    def _rename_frame(self, document: DocumentSession) -> EditResult:
        old, new, design = self.item.id, _title(self.name), document.design
        if old == new:
            return EditResult()
        if not new or design.frame(new) is not None or design.frame(old) is None:
            raise EditError(messages.name_exists("frame", new) if new else "a frame needs a title")
        document.edit(texts.rename(old, new), lambda design: rename_frame(design, old, new))
        return EditResult(new_selection=(replace(self.item, id=new),))


@dataclass(frozen=True, slots=True, kw_only=True)
class DeleteGesture:
    """Delete elements."""

    kind: ClassVar = "delete"
    items: tuple[ItemRef, ...]

    def apply(self, document: DocumentSession) -> EditResult:
        links = [item.id.split("/") for item in self.items if item.kind == "links"]
        if any(len(link) != 3 for link in links):
            raise EditError(texts.INVALID_REQUEST)

        def change(design: Design) -> Design:
            paths = [parse_transition_key(key) for key in _ids(self.items, "transitions")]
            smaller = remove_decisions(design, paths)
            for kind, state, alias in links:
                smaller = remove_link(smaller, state, alias, modulates=kind == "modulates")
            smaller = remove_frames(smaller, _ids(self.items, "frames"))
            smaller = remove_uses(remove_notes(smaller, _ids(self.items, "notes")), _ids(self.items, "components"))
            return remove_states(smaller, _ids(self.items, "states"))

        document.edit(texts.delete_items(len(self.items)), change)
        return EditResult(new_selection=())


@dataclass(frozen=True, slots=True, kw_only=True)
class DisableGesture:
    """Disable states and transitions; enable them if all of them are disabled."""

    kind: ClassVar = "disable"
    items: tuple[ItemRef, ...]

    def apply(self, document: DocumentSession) -> EditResult:
        design = document.design
        named = _ids(self.items, "states")
        states = [state for state in design.states if state.name in named]
        located = [find_decision(design, parse_transition_key(key)) for key in _ids(self.items, "transitions")]
        decisions = [decision for decision in located if decision is not None]
        if not states and not decisions:
            raise EditError("select states or transitions to disable")
        are_disabled = [*(state.disabled for state in states), *(each.decision.disabled for each in decisions)]
        disabled = not all(are_disabled)
        names, paths = [state.name for state in states], [decision.path for decision in decisions]
        label = texts.set_disabled(names, len(paths), disabled=disabled)
        document.edit(label, lambda old: set_disabled(old, names, paths, disabled=disabled))
        return EditResult()


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkGesture:
    """Let a state require or modulate a component.

    A link drawn from the component is `requires`. A link drawn from the state is `modulates`, or `requires` if the
    component has `"parameters": 0` in the scene; without that key its parameters are unknown.
    """

    kind: ClassVar = "link"
    kind_of_link: Literal["requires", "modulates"]
    state: StateName
    component: ComponentAlias

    def apply(self, document: DocumentSession) -> EditResult:
        state, alias = require_state(document, self.state).name, self.component
        if document.design.use(alias) is None:
            raise EditError(texts.unused_alias(alias))
        add = add_requirement if self.kind_of_link == "requires" else add_modulation
        document.edit(texts.add_link(state, self.kind_of_link, alias), lambda design: add(design, state, alias))
        return EditResult()


@dataclass(frozen=True, slots=True, kw_only=True)
class StateFlagGesture:
    """Make a state the initial state, or toggle whether it is final."""

    kind: ClassVar = "mark"
    mark: Literal["initial", "final"]
    id: StateName

    def apply(self, document: DocumentSession) -> EditResult:
        state = require_state(document, self.id)
        if self.mark == "initial":
            document.edit(f"make {state.name} the initial state", lambda design: replace(design, initial=state.name))
            return EditResult()
        document.edit(
            texts.set_final(state.name, final=not state.final),
            lambda design: update_state(design, state.name, lambda old: replace(old, final=not state.final)),
        )
        return EditResult()


EDIT_GESTURES: tuple[type[RequestedEdit], ...] = (
    MoveGesture,
    CreateGesture,
    NoteGesture,
    FrameGesture,
    RenameGesture,
    DeleteGesture,
    DisableGesture,
    LinkGesture,
    StateFlagGesture,
    ConnectGesture,
    GuardGesture,
    ReconnectGesture,
    ReorderGesture,
    LabelGesture,
    DuplicateGesture,
)
"""The gestures that `apply_edit` applies."""


def apply_layout(design: Design, layout: NodeLayout, only: Collection[str] | None) -> Design:
    """Move all nodes, or `only` some states with their notes, to the positions of a layout."""
    design = move_notes(design, layout.notes)
    if only is not None:
        return move_nodes(design, {name: point for name, point in layout.states.items() if name in only})
    has_common = shows_common(design)
    return move_nodes(design, layout.states, layout.uses, layout.common if has_common else None)


def _title(text: str) -> str:
    """The title of a frame: one line, up to the length of a name."""
    return " ".join(text.split())[:MAX_NAME_LENGTH]


def _alias_error(design: Design, alias: str) -> str:
    if not is_valid_name(alias):
        return texts.invalid_alias(alias)
    return f"there is already a component with the alias {alias}" if design.use(alias) else ""


def _ids(items: Iterable[ItemRef], kind: ItemKind) -> list[str]:
    return [item.id for item in items if item.kind == kind]
