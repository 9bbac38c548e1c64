"""What can be asked of the canvas, in one table: its keys, its menus, the palette and the help all read it."""

from dataclasses import KW_ONLY, dataclass
from enum import StrEnum
from typing import Any


class CommandGroup(StrEnum):
    """What belongs together in menus and in the help."""

    CREATE = "Make"
    MODIFY = "Change"
    EDIT = "Edit"
    ARRANGE = "Arrange"
    VIEW = "See"
    RUN = "Simulate"
    NAVIGATE = "Get about"


@dataclass(frozen=True, slots=True)
class CanvasCommand:
    """A command of the canvas; `keys` are spelt "Ctrl+Shift+Z", several are several ways.

    `on` names what its menu entry belongs to: a kind of thing, "several" of them, or "nothing". Keys that only mean
    something together with a direction or a pointer are told by `keys_label`; such a command is in no menu.
    """

    name: str
    label: str
    group: CommandGroup
    keys: tuple[str, ...] = ()
    _: KW_ONLY
    menus: tuple[str, ...] = ()
    keys_label: str = ""


_ARROWS = ("ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown")
_NODES = ("states", "components", "several")
_STATES_AND_TRANSITIONS = ("states", "transitions", "several")


def _with_arrows(*held: str) -> tuple[str, ...]:
    return tuple(f"{keys}{arrow}" for keys in held for arrow in _ARROWS)


CANVAS_COMMANDS = (
    CanvasCommand("new-state", "New state", CommandGroup.CREATE, ("S",), menus=("nothing",)),
    CanvasCommand("use", "Use a component…", CommandGroup.CREATE, ("U",), menus=("nothing",)),
    CanvasCommand("new-target", "Transition to a new state", CommandGroup.CREATE, ("N",), menus=("states", "common")),
    CanvasCommand("connect", "Connect to…", CommandGroup.CREATE, ("T",), menus=("states", "components", "common")),
    CanvasCommand("finish-connection", "End a connection at the target", CommandGroup.CREATE, ("Enter",)),
    CanvasCommand("open-guard", "Edit the guard", CommandGroup.MODIFY, ("Enter",), menus=("transitions",)),
    CanvasCommand("open-design", "Open its design", CommandGroup.MODIFY, ("Enter",), menus=("components",)),
    CanvasCommand("open-common", "Edit what is common", CommandGroup.MODIFY, ("Enter",), menus=("common",)),
    CanvasCommand("rename", "Rename", CommandGroup.MODIFY, ("F2", "Enter"), menus=("states", "components")),
    CanvasCommand("initial", "Start here", CommandGroup.MODIFY, ("I",), menus=("states",)),
    CanvasCommand("final", "Final, or no longer", CommandGroup.MODIFY, ("F",), menus=("states",)),
    CanvasCommand("disable", "Disable, or enable again", CommandGroup.MODIFY, ("D",), menus=_STATES_AND_TRANSITIONS),
    CanvasCommand("reconnect-target", "Lead to another state…", CommandGroup.MODIFY, ("R",), menus=("transitions",)),
    CanvasCommand("reconnect-source", "Start from another state…", CommandGroup.MODIFY, ("Shift+R",), menus=("transitions",)),
    CanvasCommand("move-up", "Test earlier", CommandGroup.MODIFY, ("[",), menus=("transitions",)),
    CanvasCommand("move-down", "Test later", CommandGroup.MODIFY, ("]",), menus=("transitions",)),
    CanvasCommand("reset-label", "Put the label back", CommandGroup.MODIFY, menus=("transitions",)),
    CanvasCommand("undo", "Undo", CommandGroup.EDIT, ("Ctrl+Z",)),
    CanvasCommand("redo", "Redo", CommandGroup.EDIT, ("Ctrl+Shift+Z", "Ctrl+Y")),
    CanvasCommand("cut", "Cut", CommandGroup.EDIT, ("Ctrl+X",), menus=_STATES_AND_TRANSITIONS),
    CanvasCommand("copy", "Copy", CommandGroup.EDIT, ("Ctrl+C",), menus=(*_STATES_AND_TRANSITIONS, "common")),
    CanvasCommand("paste", "Paste", CommandGroup.EDIT, ("Ctrl+V",), menus=(*_STATES_AND_TRANSITIONS, "common", "nothing")),
    CanvasCommand("duplicate", "Duplicate", CommandGroup.EDIT, ("Ctrl+D",), menus=_STATES_AND_TRANSITIONS),
    CanvasCommand("delete", "Delete", CommandGroup.EDIT, ("Delete", "Backspace"), menus=(*_STATES_AND_TRANSITIONS, "components", "links")),
    CanvasCommand("select-all", "Select all", CommandGroup.EDIT, ("Ctrl+A",), menus=("nothing",)),
    CanvasCommand("align-left", "Align left sides", CommandGroup.ARRANGE, ("Alt+A",), menus=("several",)),
    CanvasCommand("align-centre", "Align centres", CommandGroup.ARRANGE, ("Alt+H",), menus=("several",)),
    CanvasCommand("align-right", "Align right sides", CommandGroup.ARRANGE, ("Alt+D",), menus=("several",)),
    CanvasCommand("align-top", "Align tops", CommandGroup.ARRANGE, ("Alt+W",), menus=("several",)),
    CanvasCommand("align-middle", "Align middles", CommandGroup.ARRANGE, ("Alt+V",), menus=("several",)),
    CanvasCommand("align-bottom", "Align bottoms", CommandGroup.ARRANGE, ("Alt+S",), menus=("several",)),
    CanvasCommand("distribute-across", "Equal gaps across", CommandGroup.ARRANGE, ("Alt+Shift+H",), menus=("several",)),
    CanvasCommand("distribute-down", "Equal gaps downwards", CommandGroup.ARRANGE, ("Alt+Shift+V",), menus=("several",)),
    CanvasCommand(
        "nudge", "Move by a step (a pixel with Shift)", CommandGroup.ARRANGE, _with_arrows("", "Shift+"), keys_label="Arrow keys"
    ),
    CanvasCommand("lay-out", "Lay out", CommandGroup.ARRANGE, menus=("several", "nothing")),
    CanvasCommand("fit", "Zoom to everything", CommandGroup.VIEW, ("1",), menus=("nothing",)),
    CanvasCommand("zoom-selection", "Zoom to the selection", CommandGroup.VIEW, ("2",), menus=_NODES),
    CanvasCommand("actual-size", "Zoom to life size", CommandGroup.VIEW, ("0",), menus=("nothing",)),
    CanvasCommand("zoom-in", "Zoom in", CommandGroup.VIEW, ("+", "=")),
    CanvasCommand("zoom-out", "Zoom out", CommandGroup.VIEW, ("-",)),
    CanvasCommand("links", "Show or hide links to components", CommandGroup.VIEW, menus=("nothing",)),
    CanvasCommand("breakpoint", "Breakpoint, or none", CommandGroup.RUN, menus=_STATES_AND_TRANSITIONS),
    CanvasCommand("simulate-here", "Run to here", CommandGroup.RUN, menus=("states",)),
    CanvasCommand("menu", "Menu of what is selected", CommandGroup.NAVIGATE, ("Shift+F10", "ContextMenu"), keys_label="Shift+F10"),
    CanvasCommand("help", "Keys and gestures", CommandGroup.NAVIGATE, ("?",), menus=("nothing",)),
    CanvasCommand("next", "Next thing, in the order of the design", CommandGroup.NAVIGATE, ("Tab",), keys_label="Tab"),
    CanvasCommand("previous", "Previous thing", CommandGroup.NAVIGATE, ("Shift+Tab",), keys_label="Shift+Tab"),
    CanvasCommand("select-nearest", "Nearest box in a direction", CommandGroup.NAVIGATE, _with_arrows("Ctrl+"), keys_label="Ctrl+Arrow keys"),
    CanvasCommand(
        "add-nearest", "The same, and keep what is selected", CommandGroup.NAVIGATE, _with_arrows("Ctrl+Shift+"),
        keys_label="Ctrl+Shift+Arrow keys",
    ),
    CanvasCommand("cancel", "Leave what is half done; then select nothing", CommandGroup.NAVIGATE, ("Escape",), keys_label="Escape"),
)  # fmt: skip

GESTURE_HELP = (
    ("Double click", "a new state; on a state its name, on an arrow its guard, on a component its design"),
    ("Drag from the edge of a state", "a transition, to nothing with a new state; to a component a link"),
    ("Drag an end of a selected arrow", "leads elsewhere"),
    ("Drag a label", "along or off its arrow; on another label of the state: tested there"),
    ("Drag", "moves; near others it lines up, with Alt it does not"),
    ("Drag over nothing", "selects; with Shift or Ctrl adds"),
    ("Shift or Ctrl and click", "adds or takes away"),
    ("Right click", "menu"),
    ("Space, or middle button, and drag", "pans"),
    ("Wheel", "zooms at the pointer; two fingers pan, a pinch zooms"),
    ("Drag a design from the list", "uses it here"),
    ("Touch", "one finger selects and drags, over nothing pans; held it opens the menu; two fingers zoom"),
)
"""What a hand does, for the help: gesture and meaning."""


def commands_json() -> list[dict[str, Any]]:
    """The table as the browser takes it."""
    return [
        {
            "name": each.name,
            "label": each.label,
            "group": str(each.group),
            "keys": list(each.keys),
            "on": list(each.menus),
        }
        for each in CANVAS_COMMANDS
    ]
