"""The checks that take longer, in a process beside the server, while they are switched on."""

import asyncio

from nicegui import run, ui

from vicode.check.behavior import find_deep
from vicode.editor.panels.window_context import WindowContext

_PAUSE_S = 0.3
_HINT = "Also search for runs that break properties, states that alternate, and robots that wait for each other"


class DeepCheck:
    """A switch; the results join the findings of the design, and are found anew after each edit."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._checked: object = None
        self._is_running = False
        self.switch = ui.switch("Deep check", on_change=self._toggle).props("dense size=xs").classes("deep-check")
        with self.switch:
            ui.tooltip(_HINT).props('anchor="top middle" self="bottom middle"')

    def refresh(self) -> None:
        """Check again if the project has changed."""
        is_on = bool(self.switch.value)
        if is_on and not self._is_running and self._context.workspace.project is not self._checked:
            self._is_running = True
            self._context.run_in_background(self._check(), "deep check")

    def _toggle(self) -> None:
        self._checked = None
        self._context.document.shared.set_deep_findings(())
        self.refresh()

    async def _check(self) -> None:
        try:
            while not self._context.is_closed and self.switch.value:
                await asyncio.sleep(_PAUSE_S)
                project, component = self._context.workspace.project, self._context.design.component
                found = await run.cpu_bound(find_deep, project, component)
                if project is self._context.workspace.project:
                    self._checked = project
                    if self.switch.value:
                        self._context.document.shared.set_deep_findings(found or ())
                    return
        finally:
            self._is_running = False
