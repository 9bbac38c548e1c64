"""The command palette: finds designs, items and commands by name, and opens them."""

from collections.abc import Callable, Sequence
from typing import Any

from nicegui import ui
from nicegui.events import GenericEventArguments

from vicode.editor.panels.commands.command import Command, TypedCommand
from vicode.editor.panels.texts import pluralize
from vicode.editor.session.search.search_index import (
    SearchIndex,
    SearchItem,
    SearchKind,
    SearchMatch,
    SearchTarget,
    rank_items,
)

NavigateTo = Callable[[SearchTarget], object]

_ICONS = {
    SearchKind.COMMAND: "bolt",
    SearchKind.COMPONENT: "account_tree",
    SearchKind.STATE: "crop_16_9",
    SearchKind.USE: "hexagon",
    SearchKind.DECLARATION: "data_object",
    SearchKind.TRANSITION: "trending_flat",
    SearchKind.FRAME: "crop_free",
    SearchKind.NOTE: "sticky_note_2",
}
_MAX_DETAIL_LENGTH = 160


class CommandPalette(ui.element, component="command_palette.js"):
    """A dialog over the page; `open` shows it.

    Args:
        index: the search index.
        navigate: opens a search result.
    """

    def __init__(self, index: SearchIndex, navigate: NavigateTo) -> None:
        super().__init__()
        self._index, self._navigate = index, navigate
        self.commands: Sequence[Command] = ()
        self.current: SearchTarget | None = None
        """The open design, None on the home page."""
        self.interpret: Callable[[str], TypedCommand | None] = lambda _text: None
        """The command that a text describes by itself; it is listed first."""
        self._items: list[SearchItem] = []
        self._last_result: tuple[str, tuple[SearchMatch, ...]] = ("", ())
        self._opening_id: object = None
        # Adding handlers after the first rendering would make NiceGUI mount the element again.
        self.on("ask", self._on_query)
        self.on("choose", self._on_choose)

    def open(self) -> None:
        self.run_method("open")

    def _reload_items(self, event: GenericEventArguments) -> None:
        """Load the searchable items, once each time the palette is opened."""
        opening = event.args.get("opening") if isinstance(event.args, dict) else None
        if opening == self._opening_id:
            return
        self._opening_id = opening
        self._items = [*self._index.items(), *(_command_item(command) for command in self.commands)]
        self._last_result = ("", ())

    def _on_query(self, event: GenericEventArguments) -> None:
        self._reload_items(event)
        text = _text(event)
        typed, matches = self.interpret(text), self._find(text)
        hits = [*([_typed_hit(typed)] if typed else []), *(_hit(match) for match in matches)]
        count = pluralize(len(hits), "result") if hits else "No results."
        self.run_method("answer", {"text": text, "hits": hits, "words": count})

    def _on_choose(self, event: GenericEventArguments) -> None:
        self._reload_items(event)
        matches = self._find(_text(event))
        index = event.args.get("index")
        typed = self.interpret(_text(event))
        if typed is not None and index == 0:
            # The text stays, to be corrected.
            _ = typed.handler() if typed.handler else self.run_method("open", _text(event))
            return
        if typed is not None and isinstance(index, int):
            index -= 1
        if not isinstance(index, int) or not 0 <= index < len(matches):
            return
        item = matches[index].item
        if item.target is not None:
            self._navigate(item.target)
            return
        command = next((each for each in self.commands if each.name == item.command), None)
        if command is not None:
            command.handler()

    def _find(self, text: str) -> tuple[SearchMatch, ...]:
        if not self._last_result[1] or self._last_result[0] != text:
            self._last_result = text, rank_items(self._items, text, self.current)
        return self._last_result[1]


def _text(event: GenericEventArguments) -> str:
    return str(event.args.get("text", "")) if isinstance(event.args, dict) else ""


def _command_item(command: Command) -> SearchItem:
    return SearchItem(
        SearchKind.COMMAND,
        command.label,
        "",
        str(command.menu_group),
        command=command.name,
        keys=", ".join(command.keys),
    )


def _typed_hit(typed: TypedCommand) -> dict[str, Any]:
    parts = [{"text": typed.label, "found": False}]
    common = {"kind": str(SearchKind.COMMAND), "parts": parts, "detail": typed.detail, "where": "", "keys": ""}
    return {**common, "icon": "add" if typed.handler else "error_outline", "refused": typed.handler is None}


def _hit(match: SearchMatch) -> dict[str, Any]:
    item = match.item
    return {
        "icon": _ICONS[item.kind],
        "kind": str(item.kind),
        "parts": _parts(item.title, match.positions),
        "detail": " ".join(item.detail.split())[:_MAX_DETAIL_LENGTH],
        "where": item.location,
        "keys": item.keys,
    }


def _parts(title: str, positions: Sequence[int]) -> list[dict[str, Any]]:
    """Split a title into runs of matched and unmatched letters."""
    matched_positions = set(positions)
    parts: list[dict[str, Any]] = []
    for position, letter in enumerate(title):
        is_found = position in matched_positions
        if parts and parts[-1]["found"] == is_found:
            parts[-1]["text"] += letter
        else:
            parts.append({"text": letter, "found": is_found})
    return parts
