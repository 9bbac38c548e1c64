"""A command: one thing a person can ask of the page, by a button, a key, a menu or the palette."""

from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass
from enum import StrEnum

CommandHandler = Callable[[], object]


class MenuGroup(StrEnum):
    """Under which heading a command is listed."""

    DESIGN = "Design"
    EDIT = "Edit"
    VIEW = "View"
    SIMULATE = "Simulate"


@dataclass(frozen=True, slots=True)
class Command:
    """What the page can do; `keys` are spelt "Ctrl+Shift+Z" (Ctrl is Cmd on a Mac).

    Keys of a command that is not `while_typing` are left to text fields and to the canvas, which have their own;
    `on_canvas`: only the canvas hears them.
    """

    name: str
    label: str
    handler: CommandHandler
    menu_group: MenuGroup
    _: KW_ONLY
    icon: str = ""
    keys: tuple[str, ...] = ()
    while_typing: bool = False
    on_canvas: bool = False
