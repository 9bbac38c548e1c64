"""Simulates an open design: its inputs, the process that runs it, and the recorded past. Independent of NiceGUI."""

from vicode.editor.session.simulation.breakpoints import Breakpoints
from vicode.editor.session.simulation.inputs import DONE, PARAMETERS, SimulationInput, collect_tunable
from vicode.editor.session.simulation.recording import Recording
from vicode.editor.session.simulation.setup import (
    NotReadyError,
    PreparedRun,
    RunConfig,
    behavior_key,
    hand_written_components,
    prepare_run,
    prepare_view,
    stubbed_components,
    used_components,
)
from vicode.editor.session.simulation.simulation import Failure, RunStatus, Simulation

__all__ = [
    "DONE",
    "PARAMETERS",
    "Breakpoints",
    "Failure",
    "NotReadyError",
    "PreparedRun",
    "Recording",
    "RunConfig",
    "RunStatus",
    "Simulation",
    "SimulationInput",
    "behavior_key",
    "collect_tunable",
    "hand_written_components",
    "prepare_run",
    "prepare_view",
    "stubbed_components",
    "used_components",
]
