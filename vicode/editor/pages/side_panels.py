"""The panels around the diagram: the dock below and the side panel on the right."""

from typing import TYPE_CHECKING

from nicegui import ui

from vicode.editor.canvas import Canvas
from vicode.editor.panels.commands.command import Command, MenuGroup
from vicode.editor.panels.findings.finding_navigation import FindingNavigator
from vicode.editor.panels.simulation.commands import simulation_commands
from vicode.editor.panels.splitters import add_splitters, dock_splitter, side_splitter
from vicode.editor.panels.tabs import Tabs
from vicode.editor.panels.window_context import WindowContext

if TYPE_CHECKING:
    from vicode.editor.panels.commands.search_panel import SearchPanel
    from vicode.editor.panels.simulation.controller import SimulationController
    from vicode.editor.panels.simulation.panel import SimulationPanel
    from vicode.editor.panels.versions.comparison_dialog import ComparisonDialog

_DOCK = _FINDINGS, _SEARCH, _HISTORY, _SIMULATE = "Findings", "Search", "History", "Simulate"
_SIDE = _INSPECT, _CODE = "Inspect", "Generated code"
_FOCUS_SEARCH = """
(function focus(left) {
  const box = document.querySelector(".search-text input");
  if (box?.offsetParent) { box.focus(); box.select(); }
  else if (left > 0) setTimeout(() => focus(left - 1), 50);
})(100);
"""


class SideTabs:
    """Both tab bars, which stay while the window shows other designs."""

    def __init__(self) -> None:
        self.has_shown_robot = False
        """Whether the live view of a robot was opened; later, the user chooses the tab."""
        add_splitters()
        with ui.element("section").classes("dock").props('aria-label="Bottom panel"'):
            dock_splitter()
            self.dock = Tabs(_DOCK, "dock", "Bottom panels")
        with ui.element("aside").classes("side").props('aria-label="Inspector"'):
            side_splitter()
            self.side = Tabs(_SIDE, "side", "Side panels")

    def clear(self) -> None:
        self.dock.clear()
        self.side.clear()


class SidePanels:
    """The panels of one design. `build` adds them, after the diagram is shown, as they take longer to load."""

    def __init__(self, context: WindowContext, canvas: Canvas, findings: FindingNavigator, tabs: SideTabs) -> None:
        self._context, self._canvas, self._finding_navigator = context, canvas, findings
        self._tabs, self._dock, self._side = tabs, tabs.dock, tabs.side
        self._simulator: SimulationController | None = None
        self._comparison: ComparisonDialog | None = None

    def build(self) -> None:
        from vicode.editor.panels.code.code_panel import CodePanel
        from vicode.editor.panels.findings.findings_panel import FindingsPanel
        from vicode.editor.panels.inspector.inspector import Inspector
        from vicode.editor.panels.versions.history_panel import HistoryPanel

        context = self._context
        if context.workspace.robots.is_open:
            # The canvas shows the robot whichever tab is open.
            self._simulate()
            if not self._tabs.has_shown_robot:
                self._tabs.has_shown_robot = True
                self._dock.show(_SIMULATE)
        self._side.build({_INSPECT: lambda: Inspector(context), _CODE: lambda: CodePanel(context, self._compare)})
        self._dock.build(
            {
                _FINDINGS: lambda: FindingsPanel(context, self._finding_navigator),
                _SEARCH: self._search_panel,
                _HISTORY: lambda: HistoryPanel(context),
                _SIMULATE: self._simulation_panel,
            }
        )

    def commands(self) -> tuple[Command, ...]:
        return (
            *simulation_commands(self._simulate, lambda: self._dock.show(_SIMULATE)),
            Command(
                "compare-languages",
                "Compare languages…",
                self._compare,
                MenuGroup.DESIGN,
                icon="compare_arrows",
            ),
            Command(
                "search",
                "Search and replace in all texts",
                self._open_search,
                MenuGroup.EDIT,
                icon="search",
                keys=("Ctrl+Shift+F",),
                while_typing=True,
            ),
        )

    async def view_run(self, trace: str) -> None:
        """View a recorded run of the design in Simulate, from its beginning."""
        with self._canvas.client:
            self._dock.show(_SIMULATE)
            controller = self._simulate()
            controller.use_trace(trace, is_replay=True)
            await controller.restart()
            controller.toggle_play()

    def design_changed(self) -> None:
        if self._simulator is not None:
            self._simulator.check_design()

    def refresh(self) -> None:
        self._dock.refresh()
        self._side.refresh()

    def _compare(self) -> None:
        from vicode.editor.panels.versions.comparison_dialog import ComparisonDialog

        if self._comparison is None:
            self._comparison = ComparisonDialog(self._context)
        self._comparison.open()

    def _open_search(self) -> None:
        self._dock.show(_SEARCH)
        ui.run_javascript(_FOCUS_SEARCH)

    def _simulate(self) -> "SimulationController":
        from vicode.editor.panels.simulation.controller import SimulationController

        if self._simulator is None:
            with self._canvas.client:
                self._simulator = SimulationController(self._context, self._canvas)
        return self._simulator

    def _search_panel(self) -> "SearchPanel":
        from vicode.editor.panels.commands.search_panel import SearchPanel

        return SearchPanel(self._context)

    def _simulation_panel(self) -> "SimulationPanel":
        from vicode.editor.panels.simulation.panel import SimulationPanel

        return SimulationPanel(self._simulate())
