"""Runs of designs: their inputs, the process that runs them, the recorded past, and the comparison of two runs."""

from vicode.runs.inputs import DONE, PARAMETERS, SimulationInput, collect_tunable
from vicode.runs.recording import Recording
from vicode.runs.setup import (
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
from vicode.runs.simulation import Failure, RunStatus, Simulation

__all__ = [
    "DONE",
    "PARAMETERS",
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
