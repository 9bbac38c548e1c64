"""Asks before a tuned value is written into its file, and shows what the value changes in recorded runs."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.robots.robot_view import RobotView
from vicode.editor.panels.simulation.trust_dialog import REPLAY, ask_for_trust
from vicode.editor.panels.widgets import primary_button
from vicode.editor.session.code.code_sync import find_lacking
from vicode.runs.changed_values import ChangedValue
from vicode.runs.replay_report import OPEN_LOOP, changed_times, describe_unlike_record, summarize_effect
from vicode.runs.value_records import RecordReplays, RecordResult


class _DialogClosedError(Exception):
    """Ends the replays."""


class WriteBackDialog:
    """Shows the results as they arrive; writing does not wait for them."""

    def __init__(self, view: RobotView, value: ChangedValue, write: Callable[[], None]) -> None:
        self.view, self.value, self._write = view, value, write
        self._is_open = True
        self._results: dict[str, RecordResult] = {}
        before = value.text_in(view.project) or "the default of its type"
        title = f"Write {value.full_name} = {value.text}"
        with view.context.client, titled_dialog(title, "write-back-dialog") as self.dialog:
            ui.label(f"The file has {before}. With the new value, in recorded runs:")
            self.list = ui.column().classes("write-back-results")
            self.status = ui.label("Replaying recorded runs…").props('role="status"')
            ui.label(OPEN_LOOP).classes("small")
            with ui.row().classes("dialog-buttons"):
                ui.button("Cancel", on_click=self.dialog.close).props("flat no-caps")
                primary_button("Write into the file", self._accept)
        self.dialog.on("hide", self._close)

    async def replay(self) -> None:
        """Replay the records and show each result."""
        context = self.view.context
        problem = ""
        if not await ask_for_trust(context, REPLAY):
            problem = "The folder is not trusted, so its code does not run and nothing is replayed."
        elif find_lacking(context.workspace, context.design.component):
            problem = "Generated code has edits that the design lacks: apply them (Generate) to replay recorded runs."
        if not problem:
            replays = RecordReplays(
                project=self.view.project,
                value=self.value,
                sources=context.workspace.source_paths,
                folder=context.workspace.folder,
                on_progress=self._check_open,
            )
            robot = self.view.robot
            try:
                async for result in replays.results(robot.longest_recording if robot is not None else None):
                    self._check_open()
                    self._results[result.name] = result
                    self._show()
            except _DialogClosedError:
                return
        if self._is_open:
            if not problem and not self._results:
                problem = "No recorded run depends on this value. "
                problem += "Record one with: vicode run DESIGN --trace FILE --values"
            self.status.set_text(problem)
            self.status.set_visibility(bool(self.status.text))

    def _show(self) -> None:
        self.list.clear()
        with self.list:
            for each in self._results.values():
                _show_result(each)

    def _check_open(self, _count: int = 0) -> None:
        if not self._is_open:
            raise _DialogClosedError

    def _accept(self) -> None:
        self.dialog.close()
        self._write()

    def _close(self) -> None:
        self._is_open = False
        self.dialog.delete()


def _show_result(result: RecordResult) -> None:
    with ui.column().classes("write-back-result"):
        effect = result.effect
        words = f"Cannot be replayed: {result.problem}" if result.problem else "…"
        ui.label(f"{result.name}: {summarize_effect(effect) if effect is not None else words}")
        notes = [result.note]
        if effect is not None:
            notes.append(describe_unlike_record(effect))
            _show_times(changed_times(effect))
        for note in filter(None, notes):
            ui.label(note).classes("small")


def _show_times(rows: list[tuple[str, str, float, float]]) -> None:
    if not rows:
        return
    with ui.element("table").classes("write-back-times"):
        _show_row("th", "Time in state", "Before", "After")
        for component, state, *seconds in rows:
            _show_row("td", f"{component}: {state}", *(f"{each:.2f} s" for each in seconds))


def _show_row(tag: str, *cells: str) -> None:
    with ui.element("tr"):
        for text in cells:
            with ui.element(tag):
                ui.label(text)
