"""The guards of the active state in priority order, with their truth values."""

from functools import partial
from typing import Any

from nicegui import ui

from vicode.editor.panels.simulation.controller import SimulationController
from vicode.editor.view import ItemRef
from vicode.editor.view.guard_rows import GuardRow, list_guard_rows

_ICONS = {"true": "check_circle", "false": "cancel", "unknown": "help"}


class GuardsList:
    """The list of guards, rebuilt when the active state changes; otherwise only changed values are updated."""

    def __init__(self, controller: SimulationController) -> None:
        self.controller = controller
        self._structure_key: object = None
        self._shown: list[tuple[GuardRow, Any, Any, Any]] = []
        with ui.row().classes("heading guards-heading"):
            self.title = ui.label("Guards")
            self.hint = ui.label().classes("heading-hint")
        self.body = ui.column().classes("guards")

    def refresh(self) -> None:
        simulation = self.controller.simulation
        if simulation is None:
            self._rebuild((), "Guards", "", None)
            return
        iteration, design = simulation.shown_iteration, simulation.prepared.design
        state = iteration.state if iteration else "" if simulation.is_view else design.initial
        if not state:
            self._rebuild((), "Guards", "not active", None)
            return
        rows = list_guard_rows(design, state, simulation.guards)
        seconds = iteration.step.get("state_time_ns", 0) / 1e9 if iteration else 0.0
        stops = frozenset(self.controller.breakpoints.items)
        shape = (state, tuple((row.key, row.text, row.outcome) for row in rows), stops)
        waits = "" if iteration is None or iteration.worked else " · not tested now"
        self._rebuild(rows, f"Guards of {state}", f"{seconds:.2f} s in this state{waits}", shape)
        for row, (_old, icon, word, reads) in zip(rows, self._shown, strict=True):
            _show(row, icon, word, reads)

    def _rebuild(self, rows: tuple[GuardRow, ...], title: str, hint: str, shape: object) -> None:
        if self.title.text != title:
            self.title.set_text(title)
        if self.hint.text != hint:
            self.hint.set_text(hint)
        if shape == self._structure_key and (rows or shape is not None):
            return
        self._structure_key = shape
        self.body.clear()
        with self.body:
            if not rows:
                words = "No transitions." if shape else "Guards appear here while the simulation runs."
                ui.label(words).classes("empty")
            self._shown = [self._row(row) for row in rows]

    def _row(self, row: GuardRow) -> tuple[GuardRow, Any, Any, Any]:
        item = ItemRef(kind="transitions", id=row.key)
        is_stop = item in self.controller.breakpoints.items
        with ui.element("div").classes("guard-row").style(f"padding-left: {12 * row.depth}px"):
            self._gutter(row, item, is_stop=is_stop)
            button = ui.element("button").classes("guard").props('type="button"')
            with button.on("click", partial(self.controller.context.show, item)):
                icon = ui.icon("help").props('aria-hidden="true"').classes("guard-icon")
                word = ui.label().classes("guard-truth")
                ui.label(row.outcome + (" (common)" if row.is_common else "")).classes("guard-outcome")
                ui.label(row.text).classes("guard-text mono")
                reads = ui.label().classes("guard-reads mono")
        return row, icon, word, reads

    def _gutter(self, row: GuardRow, item: ItemRef, *, is_stop: bool) -> None:
        """A button that toggles a breakpoint on the transition."""
        if not row.can_have_breakpoint:
            ui.element("span").classes("gutter")
            return
        words = f"{'Remove the breakpoint' if is_stop else 'Breakpoint'} on {row.outcome}"
        gutter = ui.element("button").classes("gutter" + (" has-breakpoint" if is_stop else ""))
        gutter.props(f'type="button" aria-pressed="{str(is_stop).lower()}"')
        gutter.props["aria-label"] = words
        gutter.on("click", lambda: self.controller.toggle_breakpoints(item))


def _show(row: GuardRow, icon: Any, word: Any, reads: Any) -> None:
    if word.text != row.holds:
        word.set_text(row.holds)
        icon.set_name(_ICONS[row.holds])
        for part in (icon, word):
            part.classes(add=f"is-{row.holds}", remove=" ".join(f"is-{each}" for each in _ICONS if each != row.holds))
    if reads.text != row.reads:
        reads.set_text(row.reads)
