"""The table of canvas commands; keyboard, context menu, command palette and help read it."""

from dataclasses import KW_ONLY, dataclass
from enum import StrEnum
from typing import Any


class CommandGroup(StrEnum):
    """Section of the context menu and of the help."""

    CREATE = "Create"
    MODIFY = "Modify"
    EDIT = "Edit"
    ARRANGE = "Arrange"
    VIEW = "View"
    RUN = "Simulate"
    NAVIGATE = "Navigate"


@dataclass(frozen=True, slots=True)
class CanvasCommand:
    """A command of the canvas.

    Attributes:
        keys: alternative shortcuts, written as "Ctrl+Shift+Z".
        menus: the selections whose context menu contains the command: an element kind, "several" or "nothing".
        keys_label: text for the help instead of `keys`; such a command is not listed in the command palette.
    """

    name: str
    label: str
    group: CommandGroup
    keys: tuple[str, ...] = ()
    _: KW_ONLY
    menus: tuple[str, ...] = ()
    keys_label: str = ""


_ARROWS = ("ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown")
_NODES = ("states", "components", "frames", "notes", "several")
_STATES_AND_TRANSITIONS = ("states", "transitions", "several")
_COPYABLE = (*_STATES_AND_TRANSITIONS, "frames", "notes")
_DELETABLE = (*_COPYABLE, "components", "links")


def _with_arrows(*held: str) -> tuple[str, ...]:
    return tuple(f"{keys}{arrow}" for keys in held for arrow in _ARROWS)


_CREATE, _MODIFY, _EDIT, _ARRANGE, _VIEW, _RUN, _NAVIGATE = CommandGroup

CANVAS_COMMANDS = (
    CanvasCommand("new-state", "New state", _CREATE, ("S",), menus=("nothing",)),
    CanvasCommand("use", "Add component…", _CREATE, ("U",), menus=("nothing",)),
    CanvasCommand("new-note", "Add note", _CREATE, ("M",), menus=("nothing",)),
    CanvasCommand("frame", "Frame selection", _CREATE, ("G",), menus=("states", "several")),
    CanvasCommand("frame-states", "Frame states…", _CREATE, menus=("nothing",)),
    CanvasCommand("new-target", "Add transition to new state", _CREATE, ("N",), menus=("states", "common")),
    CanvasCommand("connect", "Connect to…", _CREATE, ("T",), menus=("states", "components", "common")),
    CanvasCommand("finish-connection", "Finish connection", _CREATE, ("Enter",)),
    CanvasCommand("open-guard", "Edit guard", _MODIFY, ("F2", "Enter"), menus=("transitions",)),
    CanvasCommand("open-design", "Open design", _MODIFY, ("Enter",), menus=("components",)),
    CanvasCommand("open-note", "Edit note", _MODIFY, ("Enter",), menus=("notes",)),
    CanvasCommand("open-common", "Edit common transitions and actions", _MODIFY, ("Enter",), menus=("common",)),
    CanvasCommand("rename", "Rename", _MODIFY, ("F2", "Enter"), menus=("states", "components", "frames")),
    CanvasCommand("initial", "Set as initial state", _MODIFY, ("I",), menus=("states",)),
    CanvasCommand("final", "Toggle final", _MODIFY, ("F",), menus=("states",)),
    CanvasCommand("disable", "Disable or enable", _MODIFY, ("D",), menus=_STATES_AND_TRANSITIONS),
    CanvasCommand("extract", "Extract component…", _MODIFY, menus=("states", "several")),
    CanvasCommand("inline", "Inline component", _MODIFY, menus=("states",)),
    CanvasCommand("reconnect-target", "Change target…", _MODIFY, ("R",), menus=("transitions",)),
    CanvasCommand("reconnect-source", "Change source…", _MODIFY, ("Shift+R",), menus=("transitions",)),
    CanvasCommand("move-up", "Move up", _MODIFY, ("[",), menus=("transitions",)),
    CanvasCommand("move-down", "Move down", _MODIFY, ("]",), menus=("transitions",)),
    CanvasCommand("reset-label", "Reset label position", _MODIFY, menus=("transitions",)),
    CanvasCommand("undo", "Undo", _EDIT, ("Ctrl+Z",)),
    CanvasCommand("redo", "Redo", _EDIT, ("Ctrl+Shift+Z", "Ctrl+Y")),
    CanvasCommand("cut", "Cut", _EDIT, ("Ctrl+X",), menus=_COPYABLE),
    CanvasCommand("copy", "Copy", _EDIT, ("Ctrl+C",), menus=(*_COPYABLE, "common")),
    CanvasCommand("paste", "Paste", _EDIT, ("Ctrl+V",), menus=(*_STATES_AND_TRANSITIONS, "common", "nothing")),
    CanvasCommand("duplicate", "Duplicate", _EDIT, ("Ctrl+D",), menus=_COPYABLE),
    CanvasCommand(
        "delete", "Delete", _EDIT, ("Delete", "Backspace"), menus=_DELETABLE
    ),
    CanvasCommand("select-all", "Select all", _EDIT, ("Ctrl+A",), menus=("nothing",)),
    CanvasCommand("align-left", "Align left edges", _ARRANGE, ("Alt+A",), menus=("several",)),
    CanvasCommand("align-center", "Align centers", _ARRANGE, ("Alt+H",), menus=("several",)),
    CanvasCommand("align-right", "Align right edges", _ARRANGE, ("Alt+D",), menus=("several",)),
    CanvasCommand("align-top", "Align top edges", _ARRANGE, ("Alt+W",), menus=("several",)),
    CanvasCommand("align-middle", "Align middles", _ARRANGE, ("Alt+V",), menus=("several",)),
    CanvasCommand("align-bottom", "Align bottom edges", _ARRANGE, ("Alt+S",), menus=("several",)),
    CanvasCommand("distribute-across", "Distribute horizontally", _ARRANGE, ("Alt+Shift+H",), menus=("several",)),
    CanvasCommand("distribute-down", "Distribute vertically", _ARRANGE, ("Alt+Shift+V",), menus=("several",)),
    CanvasCommand(
        "nudge", "Move by one grid step (Shift: one pixel)", _ARRANGE, _with_arrows("", "Shift+"),
        keys_label="Arrow keys",
    ),
    CanvasCommand("lay-out", "Auto layout", _ARRANGE, menus=("several", "nothing")),
    CanvasCommand("fit", "Zoom to fit", _VIEW, ("1",), menus=("nothing",)),
    CanvasCommand("zoom-selection", "Zoom to selection", _VIEW, ("2",), menus=_NODES),
    CanvasCommand("focus-1", "Focus on neighbors", _VIEW, ("3",), menus=("states", "components", "common")),
    CanvasCommand(
        "focus-2", "Focus on neighbors within two transitions", _VIEW, ("4",), menus=("states", "components", "common")
    ),
    CanvasCommand("show-all", "Show all after a focus on neighbors", _VIEW, menus=("nothing",)),
    CanvasCommand("actual-size", "Zoom to 100%", _VIEW, ("0",), menus=("nothing",)),
    CanvasCommand("zoom-in", "Zoom in", _VIEW, ("+", "=")),
    CanvasCommand("zoom-out", "Zoom out", _VIEW, ("-",)),
    CanvasCommand("inside", "Show or hide inside", _VIEW, ("E",), menus=("states", "components")),
    CanvasCommand("links", "Show or hide links to components", _VIEW, menus=("nothing",)),
    CanvasCommand("breakpoint", "Toggle breakpoint", _RUN, menus=_STATES_AND_TRANSITIONS),
    CanvasCommand("simulate-here", "Run to here", _RUN, menus=("states",)),
    CanvasCommand("robot-enter", "Go to this state", _RUN, menus=("states",)),
    CanvasCommand("menu", "Open context menu", _NAVIGATE, ("Shift+F10", "ContextMenu"), keys_label="Shift+F10"),
    CanvasCommand("help", "Keyboard shortcuts and gestures", _NAVIGATE, ("?",), menus=("nothing",)),
    CanvasCommand("next", "Select next element", _NAVIGATE, ("Tab",), keys_label="Tab"),
    CanvasCommand("previous", "Select previous element", _NAVIGATE, ("Shift+Tab",), keys_label="Shift+Tab"),
    CanvasCommand(
        "select-nearest", "Select nearest node in the arrow direction", _NAVIGATE, _with_arrows("Ctrl+"),
        keys_label="Ctrl+Arrow keys",
    ),
    CanvasCommand(
        "add-nearest", "Add nearest node in the arrow direction to selection", _NAVIGATE, _with_arrows("Ctrl+Shift+"),
        keys_label="Ctrl+Shift+Arrow keys",
    ),
    CanvasCommand(
        "cancel", "Cancel gesture, leave neighbors or clear selection", _NAVIGATE, ("Escape",), keys_label="Escape"
    ),
)  # fmt: skip

GESTURE_HELP = (
    (
        "Double-click",
        "new state; on a state or a frame's title: rename; on a transition: edit guard; on a component: open design",
    ),
    (
        "Drag from the edge of a state",
        "new transition, then its guard; dropped on empty space: also a new state; dropped on a component: link",
    ),
    ("Drag an end of a selected transition", "change source or target"),
    ("Drag a label", "move the label; dropped on another label of the same state: change priority"),
    ("Drag the title of a frame", "move the frame with everything inside"),
    ("Drag a node", "move; snaps to other nodes unless Alt is held"),
    ("Drag on empty space", "select; Shift or Ctrl adds to the selection"),
    ("Shift+click or Ctrl+click", "add to or remove from the selection"),
    ("Right-click", "context menu"),
    ("Space+drag or middle-button drag", "pan"),
    ("Wheel", "zoom at the pointer; on a touchpad, two fingers pan and a pinch zooms"),
    ("Drag a design from the list", "add it as a component"),
    ("Touch", "one finger selects and drags, or pans on empty space; long press opens the menu; two fingers zoom"),
)
"""Pointer gestures for the help: gesture and effect."""


def commands_json() -> list[dict[str, Any]]:
    """Return the table in the form that the browser receives."""
    return [
        {
            "name": command.name,
            "label": command.label,
            "group": str(command.group),
            "keys": list(command.keys),
            "menus": list(command.menus),
        }
        for command in CANVAS_COMMANDS
    ]
