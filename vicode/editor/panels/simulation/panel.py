"""The panel below the canvas: controls, inputs, guards of the active state, and results."""

import asyncio
import time
from contextlib import suppress

from nicegui import ui

from vicode.editor.panels.robots.console_panel import ConsolePanel
from vicode.editor.panels.simulation.activation_and_output import ActivationTree, ConsoleOutput
from vicode.editor.panels.simulation.controller import SimulationController
from vicode.editor.panels.simulation.controls import SimulationControls
from vicode.editor.panels.simulation.guards_list import GuardsList
from vicode.editor.panels.simulation.input_source import InputSourceForm
from vicode.editor.panels.simulation.inputs_form import InputsForm
from vicode.editor.panels.simulation.timeline import Timeline
from vicode.editor.panels.simulation.why_not_view import WhyNotView
from vicode.editor.panels.tabs import Tabs

_POLL_INTERVAL_S = 0.08
_AGE_INTERVAL_S = 1.0
_FIT_DELAY_S = 0.3
_DRAW_TIMEOUT_S = 2.0
_IS_DRAWN = "new Promise((resolve) => setTimeout(resolve))"
_RESULT_TABS = ("Plot", "Active components", "Output", "Console")


class SimulationPanel:
    """The panel, built when first shown; polls the controller several times per second at any simulation speed."""

    def __init__(self, controller: SimulationController) -> None:
        self.controller = controller
        self._shown: tuple[int, str] = (-1, "")
        with ui.element("div").classes("simulation"):
            self.controls = SimulationControls(controller)
            with ui.element("div").classes("simulation-body"):
                with ui.element("section").classes("simulation-part").props('aria-label="Inputs"'):
                    self.input_source = InputSourceForm(controller)
                    self.inputs = InputsForm(controller)
                with ui.element("section").classes("simulation-part").props('aria-label="Guards of the active state"'):
                    self.guards = GuardsList(controller)
                    self.why_not = WhyNotView(controller)
                with ui.element("section").classes("simulation-part simulation-results").props('aria-label="Results"'):
                    self.tabs = Tabs(_RESULT_TABS, "simulation-results", "Results")
        builders = (
            lambda: Timeline(controller),
            lambda: ActivationTree(controller),
            lambda: ConsoleOutput(controller),
            lambda: ConsolePanel(controller.robot),
        )
        self.tabs.build(dict(zip(_RESULT_TABS, builders, strict=True)))
        controller.refresh_panel = self._poll
        ui.timer(_POLL_INTERVAL_S, self._poll_unhurried)
        # A robot that sends nothing changes nothing but the age of what it sent.
        ui.timer(_AGE_INTERVAL_S, self.input_source.robot_form.refresh)
        # The panel takes space from the canvas; the active state must stay visible.
        ui.timer(_FIT_DELAY_S, controller.canvas.fit, once=True)

    def refresh(self) -> None:
        self.controller.check_design()
        self._shown = (-1, "")
        self._poll()

    async def _poll_unhurried(self) -> None:
        """Refresh; then leave the browser as much time for its user as it needed to show the change.

        Without this, a slow browser shows changes that are long over, and answers no click.
        """
        before = self._shown
        self._poll()
        if self._shown == before:
            return
        start_s = time.monotonic()
        with suppress(TimeoutError):
            await ui.run_javascript(_IS_DRAWN, timeout=_DRAW_TIMEOUT_S)
        await asyncio.sleep(time.monotonic() - start_s)

    def _poll(self) -> None:
        self.controller.check_project()
        before, self._shown = self._shown, (self.controller.revision, self.why_not.target)
        if before[0] != self._shown[0]:
            for part in (self.controls, self.input_source, self.inputs, self.guards, self.tabs):
                part.refresh()
        if before != self._shown:
            self.why_not.refresh()
