"""BICA runtime: iterative components that step each other.

The package uses only the standard library. Copied into a robot program, it runs without vicode.
"""

from .clock import Clock, PacedClock, PacingWorld, RealClock, SimulatedClock, StoppableClock, WorldClock
from .component import RESERVED_NAMES, Component, State
from .errors import ComponentError, CyclicUseError, ErrorRecord
from .observer import IterationRecord, Observer, StepRecord
from .root import Root
from .team import Team, TeamMessage
from .timing import CycleTimes
from .xabsl import XabslComponent

__all__ = [
    "RESERVED_NAMES",
    "Clock",
    "Component",
    "ComponentError",
    "CycleTimes",
    "CyclicUseError",
    "ErrorRecord",
    "IterationRecord",
    "Observer",
    "PacedClock",
    "PacingWorld",
    "RealClock",
    "Root",
    "SimulatedClock",
    "State",
    "StepRecord",
    "StoppableClock",
    "Team",
    "TeamMessage",
    "WorldClock",
    "XabslComponent",
]
