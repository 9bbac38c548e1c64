"""Simulates an open design: what can be set, the process that runs it, the past that was recorded. Knows no NiceGUI."""

from vicode.editor.session.simulation.breakpoints import Breakpoints
from vicode.editor.session.simulation.inputs import DONE, PARAMETERS, Input
from vicode.editor.session.simulation.recording import Recording
from vicode.editor.session.simulation.setup import (
    NotReadyError,
    Stage,
    Wish,
    hand_written,
    meaning_of,
    prepare,
    stood_in_of,
    used_components,
)
from vicode.editor.session.simulation.simulation import Failure, Phase, Simulation

__all__ = [
    "DONE",
    "PARAMETERS",
    "Breakpoints",
    "Failure",
    "Input",
    "NotReadyError",
    "Phase",
    "Recording",
    "Simulation",
    "Stage",
    "Wish",
    "hand_written",
    "meaning_of",
    "prepare",
    "stood_in_of",
    "used_components",
]
