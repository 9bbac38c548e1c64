"""Commands of a page: run by a button, a key, a menu or the command palette."""

from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass
from enum import StrEnum

CommandHandler = Callable[[], object]


class MenuGroup(StrEnum):
    """The heading under which a command is listed."""

    DESIGN = "Design"
    EDIT = "Edit"
    VIEW = "View"
    SIMULATE = "Simulate"


@dataclass(frozen=True, slots=True, kw_only=True)
class TypedCommand:
    """A command that the text in the palette describes; without a handler `detail` says why it cannot run."""

    label: str
    detail: str
    handler: CommandHandler | None = None


@dataclass(frozen=True, slots=True)
class Command:
    """A command; `keys` are written "Ctrl+Shift+Z" (Ctrl is Cmd on a Mac).

    Without `while_typing`, text fields and the canvas handle the keys themselves. With `on_canvas`, only the canvas
    handles them.
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
