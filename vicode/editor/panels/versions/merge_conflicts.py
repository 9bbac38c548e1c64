"""The merge conflicts in the text of a file, with both sides and buttons that take one."""

from collections.abc import Callable

from nicegui import ui

from vicode.store import TextConflict, find_conflicts, resolve_conflicts


class MergeConflictList:
    """Shows the conflicts of a text; a button replaces the text by `set_text`."""

    def __init__(self, get_text: Callable[[], str], set_text: Callable[[str], None]) -> None:
        self.get_text, self.set_text = get_text, set_text
        self.shown: tuple[tuple[str, str, str], ...] = ()
        self.box = ui.column().classes("conflict-list merge-conflicts")
        self.box.set_visibility(False)

    def refresh(self) -> None:
        """Show the conflicts of the current text."""
        conflicts = find_conflicts(self.get_text())
        contents = tuple((conflict.name, conflict.ours, conflict.theirs) for conflict in conflicts)
        if contents == self.shown:
            return
        self.shown = contents
        self.box.set_visibility(bool(conflicts))
        self.box.clear()
        with self.box:
            for index, conflict in enumerate(conflicts):
                self._conflict(index, conflict)

    def _conflict(self, index: int, conflict: TextConflict) -> None:
        name = conflict.name or f"line {self.get_text().count(chr(10), 0, conflict.parts[0].start) + 1}"
        ui.label(f"Conflict in {name}").classes("conflict-place").props("role=heading aria-level=2")
        with ui.element("div").classes("conflict-sides"):
            self._side(index, "ours", (conflict.ours, conflict.theirs), takes_theirs=False)
            self._side(index, "theirs", (conflict.theirs, conflict.ours), takes_theirs=True)

    def _side(self, index: int, side: str, texts: tuple[str, str], *, takes_theirs: bool) -> None:
        other = set(texts[1].splitlines())
        with ui.element("div").classes("conflict-side is-text"):
            with ui.row().classes("conflict-head"):
                ui.label(side.capitalize()).classes("conflict-title")
                ui.button(f"Take {side}", on_click=lambda: self._take(index, takes_theirs=takes_theirs)).props(
                    "outline dense no-caps"
                )
            for line in texts[0].splitlines() or ["(nothing)"]:
                ui.label(line or " ").classes("conflict-line mono" + ("" if line in other else " differs"))

    def _take(self, index: int, *, takes_theirs: bool) -> None:
        """Replace a conflict by one of its sides, unless the text has changed since it was shown."""
        text = self.get_text()
        conflicts = find_conflicts(text)
        if tuple((each.name, each.ours, each.theirs) for each in conflicts) == self.shown:
            self.set_text(resolve_conflicts(text, conflicts[index : index + 1], takes_theirs=takes_theirs))
