"""The panel below the canvas: controls, inputs to the left, guards of the active state, and what happened."""

from nicegui import ui

from vicode.editor.panels.simulation.controls import Controls
from vicode.editor.panels.simulation.guards_list import GuardsList
from vicode.editor.panels.simulation.happenings import ActivationTree, Output
from vicode.editor.panels.simulation.inputs_form import InputsForm
from vicode.editor.panels.simulation.simulator import Simulator
from vicode.editor.panels.simulation.timeline import Timeline
from vicode.editor.panels.simulation.ways import Ways
from vicode.editor.panels.tabs import Tabs

_BEAT_S = 0.08
_SETTLED_S = 0.3
_HAPPENINGS = ("Plot", "Active components", "Output")


class SimulationPanel:
    """Built when first shown; follows the simulator some times a second, however fast that runs."""

    def __init__(self, simulator: Simulator) -> None:
        """Build it."""
        self.simulator = simulator
        self._shown = -1
        with ui.element("div").classes("simulation"):
            self.controls = Controls(simulator)
            with ui.element("div").classes("simulation-body"):
                with ui.element("section").classes("simulation-part").props('aria-label="Inputs"'):
                    self.ways = Ways(simulator)
                    self.inputs = InputsForm(simulator)
                with ui.element("section").classes("simulation-part").props('aria-label="Guards of the active state"'):
                    self.guards = GuardsList(simulator)
                with ui.element("section").classes("simulation-part happenings").props('aria-label="What happened"'):
                    self.tabs = Tabs(_HAPPENINGS, "happenings", "What happened")
        builders = lambda: Timeline(simulator), lambda: ActivationTree(simulator), lambda: Output(simulator)
        self.tabs.begin(dict(zip(_HAPPENINGS, builders, strict=True)))
        simulator.show = self._follow
        ui.timer(_BEAT_S, self._follow)
        # The panel takes room from the drawing, and what is active there is to be seen.
        ui.timer(_SETTLED_S, simulator.canvas.fit, once=True)

    def refresh(self) -> None:
        """The design or the selection changed."""
        self.simulator.design_changed()
        self._shown = -1
        self._follow()

    def _follow(self) -> None:
        self.simulator.follow_project()
        if self._shown == self.simulator.changes:
            return
        self._shown = self.simulator.changes
        for part in (self.controls, self.ways, self.inputs, self.guards, self.tabs):
            part.refresh()
