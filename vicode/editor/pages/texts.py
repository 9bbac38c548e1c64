"""Sentences that describe what an edit or a line of the palette does."""

from collections.abc import Sequence

from vicode.editor.panels.texts import pluralize
from vicode.editor.session.gestures.canvas_gestures import DisableGesture, NoteGesture, StateFlagGesture
from vicode.editor.session.gestures.edits import RequestedEdit
from vicode.editor.session.gestures.transition_gestures import ReorderGesture
from vicode.editor.view import ItemRef
from vicode.model.decision_keys import parse_transition_key
from vicode.model.design import Design
from vicode.model.traversal import find_decision

_MAX_NAMED = 4


def create_line(states: Sequence[str], transitions: int) -> str:
    """What a line of states and transitions creates, such as "Create Drive, Pour and 2 transitions"."""
    more = [f"{len(states) - _MAX_NAMED} more states"] if len(states) > _MAX_NAMED else []
    counted = [pluralize(transitions, "transition")] if transitions else []
    *first, last = [*states[:_MAX_NAMED], *more, *counted]
    return f"Create {', '.join(first)} and {last}" if first else f"Create {last}"


def describe_done(edit: RequestedEdit, design: Design) -> str:
    """What an edit by a single key did, such as "Kick is final"; "" for edits that show themselves."""
    match edit:
        case DisableGesture(items=items):
            verb = "Disabled" if any(_is_disabled(design, item) for item in items) else "Enabled"
            return f"{verb} {items[0].id if len(items) == 1 and items[0].kind == 'states' else _counted(items)}"
        case StateFlagGesture(mark="initial", id=name):
            return f"{name} is the initial state"
        case StateFlagGesture(id=name):
            state = design.state(name)
            return f"{name} is {'final' if state is not None and state.final else 'no longer final'}"
        case ReorderGesture(by=int()):
            return "Changed the order of transitions"
        case NoteGesture():
            return "Added a note"
        case _:
            return ""


def _counted(items: Sequence[ItemRef]) -> str:
    named = [each for each in items if each.kind in ("states", "transitions")]
    kinds = {each.kind for each in named}
    return pluralize(len(named), str(kinds.pop()).removesuffix("s") if len(kinds) == 1 else "item")


def _is_disabled(design: Design, item: ItemRef) -> bool:
    if item.kind == "transitions":
        located = find_decision(design, parse_transition_key(item.id))
        return located is not None and located.decision.disabled
    state = design.state(item.id) if item.kind == "states" else None
    return state is not None and state.disabled
