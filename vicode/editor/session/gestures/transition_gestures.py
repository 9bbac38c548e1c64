"""Gestures of the canvas that edit transitions."""

from dataclasses import dataclass, replace
from typing import ClassVar, Literal

from vicode.editor.session import texts
from vicode.editor.session.document import DocumentSession
from vicode.editor.session.forms.text_merge import merge_texts
from vicode.editor.session.gestures.edits import (
    EditError,
    EditResult,
    StateName,
    TransitionKey,
    canvas_point,
    create_state,
    require_state,
)
from vicode.editor.view import ItemRef
from vicode.findings import DesignPath
from vicode.model.decision_keys import parse_transition_key, transition_key
from vicode.model.design import COMMON, Design, Guard, Point, Transition
from vicode.model.edits import add_transition, decisions_path, remove_decisions, reorder_decision, replace_decision
from vicode.model.guard_text import change_guard, write_guard
from vicode.model.traversal import LocatedDecision, find_decision, iter_decisions

_MAX_LABEL_OFFSET = 2_000


@dataclass(frozen=True, slots=True, kw_only=True)
class ConnectGesture:
    """Add a transition. The source may be `@common`.

    Without a target, it leads to the state of this name, or to a new one (see `CreateGesture`).

    `guard` is what the user typed, such as "distance < 0.5 after 2 s".
    """

    kind: ClassVar = "connect"
    source: StateName
    target: StateName | None = None
    x: float | None = None
    y: float | None = None
    name: str = ""
    guard: str = ""
    select: bool = True

    def apply(self, document: DocumentSession) -> EditResult:
        source, target = _require_source(document, self.source), self.target
        guard = change_guard(Guard(), self.guard, document.design.time_unit)
        if target is None and document.design.state(self.name) is not None:
            # The state is not in the browser yet.
            target = self.name
        if target is None:
            at = canvas_point(self.x or 0, self.y or 0)
            return create_state(document, at, self.name, source, guard, select=self.select)
        require_state(document, target)
        document.edit(texts.connect(source, target), lambda design: add_transition(design, source, target, guard))
        return _select_last_transition(document, source)


@dataclass(frozen=True, slots=True, kw_only=True)
class GuardGesture:
    """The user typed the expression and the time of a guard, over the text `base`. Its code stays."""

    kind: ClassVar = "guard"
    id: TransitionKey
    text: str
    base: str

    def apply(self, document: DocumentSession) -> EditResult:
        located = _require_decision(document, self.id)
        decision, unit = located.decision, document.design.time_unit
        now = write_guard(decision.guard, unit)
        typed = self.text if now is None else merge_texts(self.base, self.text, now)
        changed = replace(decision, guard=change_guard(decision.guard, typed, unit))
        document.edit(texts.edit_cell("when"), lambda design: replace_decision(design, located.path, changed))
        return EditResult()


@dataclass(frozen=True, slots=True, kw_only=True)
class ReconnectGesture:
    """Move one end of a transition to another state; the source may also become `@common`."""

    kind: ClassVar = "reconnect"
    id: TransitionKey
    end: Literal["source", "target"]
    state: StateName

    def apply(self, document: DocumentSession) -> EditResult:
        state = self.state
        transition, located = _require_transition(document, self.id)
        if self.end == "target":
            require_state(document, state)
            changed = replace(transition, to=state)
            document.edit(f"change target to {state}", lambda design: replace_decision(design, located.path, changed))
            return EditResult()
        if located.groups:
            raise EditError("the source of a transition in a decision tree cannot be changed")
        _require_source(document, state)
        document.edit(
            f"change source to {state.lstrip('@')}",
            lambda design: _with_source(design, located.path, transition, state),
        )
        return _select_last_transition(document, state)


@dataclass(frozen=True, slots=True, kw_only=True)
class ReorderGesture:
    """Change the priority of a transition: by -1 or 1 (`by`), or to the priority of the transition `onto`."""

    kind: ClassVar = "reorder"
    id: TransitionKey
    by: int | None = None
    onto: TransitionKey | None = None

    def apply(self, document: DocumentSession) -> EditResult:
        path = _require_decision(document, self.id).path
        index = int(path[-1]) + (1 if (self.by or 0) > 0 else -1)
        if self.onto is not None:
            onto = _require_decision(document, self.onto).path
            if onto[:-1] != path[:-1]:
                raise EditError("a transition in a decision tree can only be reordered within its branch")
            index = int(onto[-1])
        decisions = iter_decisions(document.design)
        last = max(int(located.path[-1]) for located in decisions if located.path[:-1] == path[:-1])
        index = max(0, min(index, last))
        document.edit(texts.REORDER_TRANSITIONS, lambda design: reorder_decision(design, path, index))
        return _select_transition((*path[:-1], index))


@dataclass(frozen=True, slots=True, kw_only=True)
class LabelGesture:
    """Position a label: fraction along the curve (0 to 1) and offset from it in pixels; None: automatic."""

    kind: ClassVar = "label"
    id: TransitionKey
    at: tuple[float, float] | None
    by: Literal["nudge"] | None = None

    def apply(self, document: DocumentSession) -> EditResult:
        transition, located = _require_transition(document, self.id)
        label_at: Point | None = None
        if self.at is not None:
            fraction, offset = self.at
            offset = max(-_MAX_LABEL_OFFSET, min(offset, _MAX_LABEL_OFFSET))
            label_at = (round(max(0.0, min(fraction, 1.0)), 3), round(offset))
        moved = replace(transition, label_at=label_at)
        document.edit(
            "move label",
            lambda design: replace_decision(design, located.path, moved),
            coalesce_key=f"label {self.id}" if self.by == "nudge" else "",
        )
        return EditResult()


def _require_source(document: DocumentSession, name: str) -> str:
    return name if name == COMMON else require_state(document, name).name


def _require_decision(document: DocumentSession, key: str) -> LocatedDecision:
    located = find_decision(document.design, parse_transition_key(key))
    if located is None:
        raise EditError(texts.TRANSITION_GONE)
    return located


def _require_transition(document: DocumentSession, key: str) -> tuple[Transition, LocatedDecision]:
    located = _require_decision(document, key)
    if not isinstance(located.decision, Transition):
        raise EditError(texts.TRANSITION_GONE)
    return located.decision, located


def _with_source(design: Design, path: DesignPath, transition: Transition, state: str) -> Design:
    smaller = remove_decisions(design, [path])
    moved = add_transition(smaller, state, transition.to, transition.guard)
    return replace_decision(moved, _last_path(moved, state), transition)


def _select_last_transition(document: DocumentSession, source: str) -> EditResult:
    return _select_transition(_last_path(document.design, source))


def _select_transition(path: DesignPath) -> EditResult:
    return EditResult(new_selection=(ItemRef(kind="transitions", id=transition_key(path)),))


def _last_path(design: Design, source: str) -> DesignPath:
    parent = decisions_path(design, source)
    paths = (located.path for located in iter_decisions(design) if located.path[:-1] == parent)
    return max(paths, default=(*parent, 0))
