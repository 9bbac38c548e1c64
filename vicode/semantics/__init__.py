"""Interprets designs as docs/semantics.md defines them, without a plan and without generated code.

The interpreter is the reference of the generators: `vicode conform` compares every language with it. It therefore
shares no code with them and with the runtime, but only the model. Each module implements a section of the page, and
docstrings name the rules.
"""

from vicode.semantics.component_step import ComponentStep, Outcome
from vicode.semantics.evaluation import evaluate
from vicode.semantics.interpreter import Interpreter
from vicode.semantics.machine import Machine, NotInterpretableError, build_machines
from vicode.semantics.memory import RobotMemory
from vicode.semantics.team import RobotReport, TeamMemory
from vicode.semantics.values import InputFunction, Value

__all__ = [
    "ComponentStep",
    "InputFunction",
    "Interpreter",
    "Machine",
    "NotInterpretableError",
    "Outcome",
    "RobotMemory",
    "RobotReport",
    "TeamMemory",
    "Value",
    "build_machines",
    "evaluate",
]
