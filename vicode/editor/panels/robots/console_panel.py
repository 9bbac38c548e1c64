"""The console of the robot that is shown: a line for commands, and their answers."""

import asyncio

from nicegui import ui
from nicegui.events import GenericEventArguments

from vicode.editor.panels.robots.robot_view import RobotView
from vicode.services.running_robots.console import ConsoleError

_MAX_LENGTH = 2000
_HINT = "The console commands a running robot: choose the source Robot."


class ConsolePanel(ui.element, component="console_panel.js"):
    """Runs one command after the other."""

    def __init__(self, view: RobotView) -> None:
        super().__init__()
        self._view, self._lock = view, asyncio.Lock()
        self.on("run", self._run)
        self.on("complete", self._complete)

    def refresh(self) -> None:
        hint = "" if self._view.is_shown else _HINT
        if self.props.get("hint") != hint:
            self.props["hint"] = hint
            self.update()

    async def _run(self, event: GenericEventArguments) -> None:
        line, number = _fields(event)
        async with self._lock:
            try:
                answer, failed = await self._view.console.run(line), False
            except ConsoleError as error:
                answer, failed = str(error), True
        self.run_method("answer", number, answer, failed)

    def _complete(self, event: GenericEventArguments) -> None:
        line, _number = _fields(event)
        self.run_method("offer", line, self._view.console.complete(line))


def _fields(event: GenericEventArguments) -> tuple[str, object]:
    """The line and the number of its answer."""
    fields = event.args if isinstance(event.args, dict) else {}
    return str(fields.get("line", ""))[:_MAX_LENGTH], fields.get("id")
