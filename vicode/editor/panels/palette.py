"""The search palette: finds everything of the folder by name, and goes there."""

from collections.abc import Callable, Sequence
from typing import Any

from nicegui import ui
from nicegui.events import GenericEventArguments

from vicode.editor.panels.command import Command
from vicode.editor.session.finding_things import Goal, Index, Kind, Match, Thing, rank

Go = Callable[[Goal], object]

_ICONS = {
    Kind.COMMAND: "bolt",
    Kind.COMPONENT: "account_tree",
    Kind.STATE: "crop_16_9",
    Kind.USE: "hexagon",
    Kind.DECLARATION: "data_object",
    Kind.TRANSITION: "trending_flat",
}
_LONGEST_DETAIL = 160


class Palette(ui.element, component="vicode_palette.js"):
    """Opens over the page; `open` shows it.

    Args:
        index: what there is to find.
        go: leads to a thing.
        here: the design that is open, None on the home page.
    """

    def __init__(self, index: Index, go: Go, here: Goal | None = None) -> None:
        """Build it closed."""
        super().__init__()
        self._index, self._go, self._here = index, go, here
        self.commands: Sequence[Command] = ()
        self._things: list[Thing] = []
        self._told: tuple[str, tuple[Match, ...]] = ("", ())
        self._opening: object = None
        # Handlers added after the first rendering would make NiceGUI mount the element anew.
        self.on("ask", self._hear_ask)
        self.on("choose", self._hear_choose)

    def open(self) -> None:
        """Show it."""
        self.run_method("open")

    def _take_stock(self, event: GenericEventArguments) -> None:
        """Look at what there is now, once every time it is opened."""
        opening = event.args.get("opening") if isinstance(event.args, dict) else None
        if opening == self._opening:
            return
        self._opening = opening
        self._things = [*self._index.things(), *(_thing_of(command) for command in self.commands)]
        self._told = ("", ())

    def _hear_ask(self, event: GenericEventArguments) -> None:
        self._take_stock(event)
        text = _text(event)
        matches = self._find(text)
        count = f"{len(matches)} found" if matches else "Nothing found: try fewer or other letters"
        self.run_method("answer", {"text": text, "hits": [_hit(match) for match in matches], "words": count})

    def _hear_choose(self, event: GenericEventArguments) -> None:
        self._take_stock(event)
        matches = self._find(_text(event))
        index = event.args.get("index")
        if not isinstance(index, int) or not 0 <= index < len(matches):
            return
        thing = matches[index].thing
        if thing.goal is not None:
            self._go(thing.goal)
            return
        command = next((each for each in self.commands if each.name == thing.command), None)
        if command is not None:
            command.act()

    def _find(self, text: str) -> tuple[Match, ...]:
        if not self._told[1] or self._told[0] != text:
            self._told = text, rank(self._things, text, self._here)
        return self._told[1]


def _text(event: GenericEventArguments) -> str:
    return str(event.args.get("text", "")) if isinstance(event.args, dict) else ""


def _thing_of(command: Command) -> Thing:
    return Thing(
        Kind.COMMAND, command.label, "", str(command.place), command=command.name, keys=", ".join(command.keys)
    )


def _hit(match: Match) -> dict[str, Any]:
    """What a line of the list shows; all of it is set as text."""
    thing = match.thing
    return {
        "icon": _ICONS[thing.kind],
        "kind": str(thing.kind),
        "parts": _parts(thing.title, match.places),
        "detail": " ".join(thing.detail.split())[:_LONGEST_DETAIL],
        "where": thing.where,
        "keys": thing.keys,
    }


def _parts(title: str, places: Sequence[int]) -> list[dict[str, Any]]:
    """The title in runs of letters that were found or not."""
    found = set(places)
    parts: list[dict[str, Any]] = []
    for at, letter in enumerate(title):
        is_found = at in found
        if parts and parts[-1]["found"] == is_found:
            parts[-1]["text"] += letter
        else:
            parts.append({"text": letter, "found": is_found})
    return parts
