"""The edit history of the design as a list; a click or Enter goes to that step."""

import time
from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.versions.revisions_dialog import show_revisions
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.history_rows import HistoryRow, list_history_rows
from vicode.editor.session.presence import DISK_USER

_PAGE = 60
_WALK = """(event) => {
  const row = event.target.closest(".history-row");
  const next = { ArrowDown: row?.nextElementSibling, ArrowUp: row?.previousElementSibling }[event.key];
  if (next) { next.focus(); event.preventDefault(); }
}"""


class HistoryPanel:
    """Builds the list; `refresh` adds new steps and marks the current one."""

    def __init__(self, context: WindowContext) -> None:
        self.context = context
        self.limit = _PAGE
        self.shown: dict[int, HistoryRow] = {}
        self.rows: dict[int, ui.element] = {}
        ui.button("Compare with git revision…", icon="history", on_click=self._show_revisions).props(
            "flat dense no-caps"
        ).classes("revisions-button")
        self.list = ui.element("div").classes("history-list").props('role="group" aria-label="History"')
        self.list.on("keydown", js_handler=_WALK)
        self.more = ui.button("Show older steps", on_click=self._show_more).props("flat dense no-caps")

    def refresh(self) -> None:
        """Show the current history; unchanged rows stay."""
        history = self.context.document.history
        lines = {line.entry.id: line for line in list_history_rows(history, self.limit)}
        for id_ in [each for each in self.shown if each not in lines]:
            self.rows.pop(id_).delete()
            del self.shown[id_]
        with self.list:
            for index, (id_, line) in enumerate(lines.items()):
                if id_ not in self.shown:
                    self.rows[id_] = self._row(line)
                    self.rows[id_].move(target_index=index)
                elif self.shown[id_] != line:
                    self._style_row(self.rows[id_], line)
        self.shown = lines
        self.more.set_visibility(len(history.entries) > len(lines))

    async def _show_revisions(self) -> None:
        await show_revisions(self.context)

    def _row(self, line: HistoryRow) -> ui.element:
        step, users = line.entry, self.context.document.shared.users
        row = ui.element("button").classes("history-row").props('type="button"')
        with row:
            ui.icon("play_arrow").classes("history-now").props('aria-hidden="true"')
            ui.label(time.strftime("%H:%M:%S", time.localtime(step.at_s))).classes("history-time mono")
            ui.label(step.label).classes("history-label")
            ui.label(users.name_of(step.user_id) if step.user_id else "").classes("history-person")
        row.on("click", self._jump_handler(step.id))
        self._style_row(row, line)
        return row

    def _style_row(self, row: ui.element, line: HistoryRow) -> None:
        row.classes(add="is-now" if line.is_current else None, remove=None if line.is_current else "is-now")
        row.classes(add="is-ahead" if line.is_ahead else None, remove=None if line.is_ahead else "is-ahead")
        row.style(f"--depth: {min(line.depth, 8)}")
        row.props('aria-current="step"') if line.is_current else row.props(remove="aria-current")

    def _show_more(self) -> None:
        self.limit += _PAGE
        self.refresh()

    def _jump_handler(self, step: int) -> Callable[[], None]:
        def jump() -> None:
            left_steps = self._describe_left_steps(step)
            if left_steps:
                self._ask(step, left_steps)
            else:
                self._jump(step)

        return jump

    def _jump(self, step: int) -> None:
        error = self.context.document.jump_to(step)
        if error:
            self.context.show_toast(error, "warning")

    def _describe_left_steps(self, step: int) -> str:
        """Describe the steps of other users that a jump would leave: "3 steps of Ana"; "" if there are none."""
        document = self.context.document
        kept_ids = {each.id for each in document.history.moved_to(step).path}
        left_steps = [each for each in document.history.path if each.id not in kept_ids]
        counts: dict[str, int] = {}
        for each in left_steps:
            if each.user_id not in ("", DISK_USER, document.user_id):
                counts[each.user_id] = counts.get(each.user_id, 0) + 1
        name = document.shared.users.name_of
        return " and ".join(
            f"{count} {'step' if count == 1 else 'steps'} of {name(who)}" for who, count in counts.items()
        )

    def _ask(self, step: int, left_steps: str) -> None:
        label = self.context.document.history.entries[step].label
        with titled_dialog(f"Go to “{label}”?") as dialog:
            ui.label(f"This undoes {left_steps} for all users. The steps stay in the history.")

            def jump() -> None:
                self._jump(step)
                dialog.close()

            with ui.row().classes("dialog-buttons"):
                ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
                primary_button("Go to step", jump)
