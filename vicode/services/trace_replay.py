"""Replays a trace with the designs of a project: as they are, or with other values."""

import asyncio
from collections.abc import Iterator, Sequence

from vicode.model.design import Design
from vicode.runs import RunConfig, prepare_run, used_components
from vicode.runs.changed_values import ChangedValue
from vicode.runs.replay import ReplayResult, replay_trace
from vicode.runs.value_replay import ValueEffect, prepare_value_replay, replay_values
from vicode.services.project_loader import LoadedProject, load_projects
from vicode.simulation import IterationResult
from vicode.store import OpenProject


def find_design(path: str, component: str) -> tuple[LoadedProject, Design]:
    """The design of the root component of a trace.

    Raises:
        OSError: There is none.
    """
    for opened in load_projects([path]):
        design = opened.open_project.project.design(component)
        if design is not None and component in opened.selected_designs:
            return opened, design
    raise OSError(f"{path} has no design of {component}, the root component of the trace; give it with --design")


def replay_design(
    opened: OpenProject,
    design: Design,
    iterations: Iterator[IterationResult],
    *,
    tolerance_ns: int = 0,
    allows_missing: bool = False,
) -> ReplayResult:
    """Run the recorded inputs through a design; see `replay_trace` for its errors."""
    project, folder = opened.project, opened.folder.resolve()
    prepared = prepare_run(project, design, RunConfig(), opened.design_paths, folder)
    names = (design.component, *used_components(project, design))
    return asyncio.run(
        replay_trace(
            prepared,
            folder,
            iterations,
            components=frozenset(name for name in names if project.design(name) is not None),
            tolerance_ns=tolerance_ns,
            allows_missing=allows_missing,
        )
    )


def replay_with_values(
    opened: OpenProject,
    design: Design,
    values: Sequence[ChangedValue],
    iterations: Iterator[IterationResult],
    *,
    allows_missing: bool = False,
) -> ValueEffect:
    """What other values of parameters and constants change in a recorded run."""
    folder = opened.folder.resolve()
    prepared = prepare_value_replay(opened.project, design, tuple(values), opened.design_paths, folder)
    return asyncio.run(replay_values(prepared, folder, iterations, allows_missing=allows_missing))
