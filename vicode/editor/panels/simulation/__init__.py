"""The panel that simulates the open design, and what stands behind it in one window."""

from vicode.editor.panels.simulation.commands import simulation_commands
from vicode.editor.panels.simulation.panel import SimulationPanel
from vicode.editor.panels.simulation.simulator import Simulator

__all__ = ["SimulationPanel", "Simulator", "simulation_commands"]
