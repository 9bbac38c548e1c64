"""What stands beside the drawing: the dock below it and the side to its right, filled once the drawing is shown."""

from typing import TYPE_CHECKING

from nicegui import ui

from vicode.editor.canvas import Canvas
from vicode.editor.panels.command import Command, MenuGroup
from vicode.editor.panels.finding_navigation import FindingNavigator
from vicode.editor.panels.simulation.commands import simulation_commands
from vicode.editor.panels.splitters import add_splitters, dock_splitter, side_splitter
from vicode.editor.panels.tabs import Tabs
from vicode.editor.panels.window_context import WindowContext

if TYPE_CHECKING:
    from vicode.editor.panels.search_panel import SearchPanel
    from vicode.editor.panels.simulation.controller import SimulationController
    from vicode.editor.panels.simulation.panel import SimulationPanel

_DOCK = _FINDINGS, _SEARCH, _HISTORY, _SIMULATE = "Findings", "Search", "History", "Simulate"
_SIDE = _INSPECT, _CODE = "Inspect", "Generated code"
_FOCUS_SEARCH = """
(function focus(left) {
  const box = document.querySelector(".search-text input");
  if (box?.offsetParent) { box.focus(); box.select(); }
  else if (left > 0) setTimeout(() => focus(left - 1), 50);
})(100);
"""


class SidePanels:
    """Builds both with their tabs; `build` fills them. The panels take longer to load than all that is drawn before."""

    def __init__(self, context: WindowContext, canvas: Canvas, problems: FindingNavigator) -> None:
        """Make room for the panels."""
        self._context, self._canvas, self._finding_navigator = context, canvas, problems
        self._simulator: SimulationController | None = None
        add_splitters()
        with ui.element("section").classes("dock").props('aria-label="Below the drawing"'):
            dock_splitter()
            self.dock = Tabs(_DOCK, "dock", "Panels below")
        with ui.element("aside").classes("side").props('aria-label="Inspector"'):
            side_splitter()
            self.side = Tabs(_SIDE, "side", "Panels beside")

    def build(self) -> None:
        """Build the panels that are in sight."""
        from vicode.editor.panels.code_panel import CodePanel
        from vicode.editor.panels.findings_panel import FindingsPanel
        from vicode.editor.panels.history_panel import HistoryPanel
        from vicode.editor.panels.inspector import Inspector

        desk = self._context
        self.side.build({_INSPECT: lambda: Inspector(desk), _CODE: lambda: CodePanel(desk)})
        self.dock.build(
            {
                _FINDINGS: lambda: FindingsPanel(desk, self._finding_navigator),
                _SEARCH: self._search_panel,
                _HISTORY: lambda: HistoryPanel(desk),
                _SIMULATE: self._simulation_panel,
            }
        )

    def commands(self) -> tuple[Command, ...]:
        """What can be asked of the panels below."""
        return (
            *simulation_commands(self._simulate, lambda: self.dock.show(_SIMULATE)),
            Command(
                name="search",
                label="Search and replace in all texts",
                handler=self._open_search,
                menu_group=MenuGroup.EDIT,
                icon="search",
                keys=("Ctrl+Shift+F",),
                while_typing=True,
            ),
        )

    def design_changed(self) -> None:
        """Let what runs know that it is no longer what is drawn."""
        if self._simulator is not None:
            self._simulator.check_design()

    def refresh(self) -> None:
        """Show the desk as it is now."""
        self.dock.refresh()
        self.side.refresh()

    def _open_search(self) -> None:
        self.dock.show(_SEARCH)
        ui.run_javascript(_FOCUS_SEARCH)

    def _simulate(self) -> "SimulationController":
        from vicode.editor.panels.simulation.controller import SimulationController

        if self._simulator is None:
            with self._canvas.client:
                self._simulator = SimulationController(self._context, self._canvas)
        return self._simulator

    def _search_panel(self) -> "SearchPanel":
        from vicode.editor.panels.search_panel import SearchPanel

        return SearchPanel(self._context)

    def _simulation_panel(self) -> "SimulationPanel":
        from vicode.editor.panels.simulation.panel import SimulationPanel

        return SimulationPanel(self._simulate())
