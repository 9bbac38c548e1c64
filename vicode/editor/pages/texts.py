"""Messages, empty states and error pages of the pages, and format functions for texts with values.

Labels of single widgets stay where the widget is built; texts of panels are in `vicode.editor.panels.texts`.
"""

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

NO_DESIGNS_TITLE = "No designs yet"
NO_DESIGNS_HELP = "A design is a state machine in a YAML file."
NO_DESIGNS_IN_PROJECT = "No designs yet. Create one from a template."
CREATE_FIRST_DESIGN = "Create your first design"
OPEN_SAMPLE = "Open the sample: a soccer player"
SAMPLE_HELP = "A soccer player with a simulated field, copied to the folder 'forward'."

MAYBE_REMOVED = "It may have been renamed or removed."
MAYBE_FIXED = "It may have been fixed or removed."
MAYBE_IN_UNREADABLE_FILE = "It may be in a file that cannot be read:"

CONNECTION_LOST = "No connection to the editor"
CONNECTION_LOST_EFFECT = (
    "Trying to reconnect. The editor keeps what you changed so far, saved or not, also if it is restarted. "
    "What you change now may be lost."
)

ITEM_MISSING = "This item no longer exists"
ONLY_PROJECT_COMPONENTS = "Only other components of this project can be added"
NO_CONFLICT = "No conflict to resolve"
LAYOUT_OUTDATED = "The design changed. Run the layout again."
SAVED_WITH_ERRORS = "Saved, but the file cannot be opened as a design yet"
LINE_UNREADABLE = "This line cannot be read"
LINE_EXISTS = "These states and transitions exist already"
NO_ERRORS_IN_FILE = "No errors. Save to open the design."


def nothing_inside(name: str) -> str:
    return f"No component that {name} uses has a design"


def no_matching_designs(text: str) -> str:
    return f"No designs match “{text}”"


def design_not_found(component: str) -> str:
    return f"Design {component} not found"


def file_not_found(file: str) -> str:
    return f"Unreadable file {file} not found"


def file_changed(file: str) -> str:
    return f"{file} was changed by another program. Reload the page."


def not_saved(reason: object) -> str:
    return f"Could not save: {reason}"


def not_generated(reason: object) -> str:
    return f"Code generation failed: {reason}"


def not_utf8(byte: int) -> str:
    return f"Not valid UTF-8 (byte {byte}). Convert the file to UTF-8."


def unreadable(reason: object) -> str:
    return f"Cannot read the file: {reason}"


def already_used(component: str, alias: str) -> str:
    return f"{component} is already used as {alias}"


def renamed_while_typing(old: str, new: str) -> str:
    return f"{old} was renamed to {new} by another user; your text will rename it again"


def hand_written_component(component: str) -> str:
    return f"{component} is hand-written and has no design"


def layout_running(states: str, limit_s: float) -> str:
    return f"Laying out {states} ({limit_s:g} s at most)"


def sample_failed(reason: str) -> str:
    return f"The sample was not copied to the folder 'forward': {reason}"


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
