"""What can be asked of the canvas, in one table: its keys, its menus, the palette and the help all read it."""

from dataclasses import KW_ONLY, dataclass
from enum import StrEnum
from typing import Any


class Group(StrEnum):
    """What belongs together in menus and in the help."""

    MAKE = "Make"
    CHANGE = "Change"
    EDIT = "Edit"
    ARRANGE = "Arrange"
    SEE = "See"
    RUN = "Simulate"
    WALK = "Get about"


@dataclass(frozen=True, slots=True)
class CanvasCommand:
    """A command of the canvas; `keys` are spelt "Ctrl+Shift+Z", several are several ways.

    `on` names what its menu entry belongs to: a kind of thing, "several" of them, or "nothing". Keys that only mean
    something together with a direction or a pointer are told by `shown`; such a command is in no menu.
    """

    name: str
    label: str
    group: Group
    keys: tuple[str, ...] = ()
    _: KW_ONLY
    on: tuple[str, ...] = ()
    shown: str = ""


_ARROWS = ("ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown")
_BOXES = ("states", "components", "several")
_FEW = ("states", "transitions", "several")


def _with_arrows(*held: str) -> tuple[str, ...]:
    return tuple(f"{keys}{arrow}" for keys in held for arrow in _ARROWS)


CANVAS_COMMANDS = (
    CanvasCommand("new-state", "New state", Group.MAKE, ("S",), on=("nothing",)),
    CanvasCommand("use", "Use a component…", Group.MAKE, ("U",), on=("nothing",)),
    CanvasCommand("new-next", "Transition to a new state", Group.MAKE, ("N",), on=("states", "common")),
    CanvasCommand("connect", "Connect to…", Group.MAKE, ("T",), on=("states", "components", "common")),
    CanvasCommand("finish", "End a connection at the target", Group.MAKE, ("Enter",)),
    CanvasCommand("open-guard", "Edit the guard", Group.CHANGE, ("Enter",), on=("transitions",)),
    CanvasCommand("open-design", "Open its design", Group.CHANGE, ("Enter",), on=("components",)),
    CanvasCommand("open-common", "Edit what is common", Group.CHANGE, ("Enter",), on=("common",)),
    CanvasCommand("rename", "Rename", Group.CHANGE, ("F2", "Enter"), on=("states", "components")),
    CanvasCommand("initial", "Start here", Group.CHANGE, ("I",), on=("states",)),
    CanvasCommand("final", "Final, or no longer", Group.CHANGE, ("F",), on=("states",)),
    CanvasCommand("disable", "Disable, or enable again", Group.CHANGE, ("D",), on=_FEW),
    CanvasCommand("reconnect-target", "Lead to another state…", Group.CHANGE, ("R",), on=("transitions",)),
    CanvasCommand("reconnect-source", "Start from another state…", Group.CHANGE, ("Shift+R",), on=("transitions",)),
    CanvasCommand("earlier", "Test earlier", Group.CHANGE, ("[",), on=("transitions",)),
    CanvasCommand("later", "Test later", Group.CHANGE, ("]",), on=("transitions",)),
    CanvasCommand("free-label", "Put the label back", Group.CHANGE, on=("transitions",)),
    CanvasCommand("undo", "Undo", Group.EDIT, ("Ctrl+Z",)),
    CanvasCommand("redo", "Redo", Group.EDIT, ("Ctrl+Shift+Z", "Ctrl+Y")),
    CanvasCommand("cut", "Cut", Group.EDIT, ("Ctrl+X",), on=_FEW),
    CanvasCommand("copy", "Copy", Group.EDIT, ("Ctrl+C",), on=(*_FEW, "common")),
    CanvasCommand("paste", "Paste", Group.EDIT, ("Ctrl+V",), on=(*_FEW, "common", "nothing")),
    CanvasCommand("duplicate", "Duplicate", Group.EDIT, ("Ctrl+D",), on=_FEW),
    CanvasCommand("delete", "Delete", Group.EDIT, ("Delete", "Backspace"), on=(*_FEW, "components", "links")),
    CanvasCommand("select-all", "Select all", Group.EDIT, ("Ctrl+A",), on=("nothing",)),
    CanvasCommand("align-left", "Align left sides", Group.ARRANGE, ("Alt+A",), on=("several",)),
    CanvasCommand("align-centre", "Align centres", Group.ARRANGE, ("Alt+H",), on=("several",)),
    CanvasCommand("align-right", "Align right sides", Group.ARRANGE, ("Alt+D",), on=("several",)),
    CanvasCommand("align-top", "Align tops", Group.ARRANGE, ("Alt+W",), on=("several",)),
    CanvasCommand("align-middle", "Align middles", Group.ARRANGE, ("Alt+V",), on=("several",)),
    CanvasCommand("align-bottom", "Align bottoms", Group.ARRANGE, ("Alt+S",), on=("several",)),
    CanvasCommand("distribute-across", "Equal gaps across", Group.ARRANGE, ("Alt+Shift+H",), on=("several",)),
    CanvasCommand("distribute-down", "Equal gaps downwards", Group.ARRANGE, ("Alt+Shift+V",), on=("several",)),
    CanvasCommand(
        "nudge", "Move by a step (a pixel with Shift)", Group.ARRANGE, _with_arrows("", "Shift+"), shown="Arrow keys"
    ),
    CanvasCommand("lay-out", "Lay out", Group.ARRANGE, on=("several", "nothing")),
    CanvasCommand("fit", "Zoom to everything", Group.SEE, ("1",), on=("nothing",)),
    CanvasCommand("zoom-selection", "Zoom to the selection", Group.SEE, ("2",), on=_BOXES),
    CanvasCommand("life-size", "Zoom to life size", Group.SEE, ("0",), on=("nothing",)),
    CanvasCommand("zoom-in", "Zoom in", Group.SEE, ("+", "=")),
    CanvasCommand("zoom-out", "Zoom out", Group.SEE, ("-",)),
    CanvasCommand("links", "Show or hide links to components", Group.SEE, on=("nothing",)),
    CanvasCommand("breakpoint", "Breakpoint, or none", Group.RUN, on=_FEW),
    CanvasCommand("simulate-here", "Run to here", Group.RUN, on=("states",)),
    CanvasCommand("menu", "Menu of what is selected", Group.WALK, ("Shift+F10", "ContextMenu"), shown="Shift+F10"),
    CanvasCommand("help", "Keys and gestures", Group.WALK, ("?",), on=("nothing",)),
    CanvasCommand("next", "Next thing, in the order of the design", Group.WALK, ("Tab",), shown="Tab"),
    CanvasCommand("previous", "Previous thing", Group.WALK, ("Shift+Tab",), shown="Shift+Tab"),
    CanvasCommand("go", "Nearest box in a direction", Group.WALK, _with_arrows("Ctrl+"), shown="Ctrl+Arrow keys"),
    CanvasCommand(
        "reach", "The same, and keep what is selected", Group.WALK, _with_arrows("Ctrl+Shift+"),
        shown="Ctrl+Shift+Arrow keys",
    ),
    CanvasCommand("cancel", "Leave what is half done; then select nothing", Group.WALK, ("Escape",), shown="Escape"),
)  # fmt: skip

BY_HAND = (
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


def as_plain() -> list[dict[str, Any]]:
    """The table as the browser takes it."""
    return [
        {
            "name": each.name,
            "label": each.label,
            "group": str(each.group),
            "keys": list(each.keys),
            "on": list(each.on),
        }
        for each in CANVAS_COMMANDS
    ]
