"""Both versions of a behavior, the design and the XABSL that is generated from it, and their runs."""

import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from vicode.experiments.bridge_process import running_bridge
from vicode.experiments.definitions import Experiment
from vicode.experiments.page import THESIS_FOLDER, VersionResult
from vicode.experiments.runs import FaultResult, run_real_time, run_seeds, run_with_fault
from vicode.generators import UnsoundDesignError, generate
from vicode.model.design import Design
from vicode.output import apply_diffs, compare_files, temporary_folder
from vicode.samples import copy_sample
from vicode.simulated_robot.faults import FAULTS
from vicode.simulated_robot.session import RobotTrack
from vicode.store import open_project

ProgressCallback = Callable[[str, int, int], None]
"""Receives what runs, and how many of how many runs are done."""

_REAL_TIME_S = 60.0
_THESIS_TITLE = "as printed in the thesis"


class ExperimentError(Exception):
    """The project does not have the behavior, or it has errors; the text says which."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PreparedBehavior:
    """The design that runs, and the arguments of `vicode bridge` for each version, by title."""

    design: Design
    bridges: tuple[tuple[str, tuple[str, ...]], ...]


@contextmanager
def prepare_behavior(experiment: Experiment, project_folder: Path | None) -> Iterator[PreparedBehavior]:
    """Provide both versions until the block ends.

    Args:
        experiment: The experiment.
        project_folder: The project to take the behavior from; None for the sample.

    Raises:
        ExperimentError: The project does not have the behavior, or it has errors.
        OSError: A file cannot be read or written.
    """
    with temporary_folder("experiment") as temporary:
        folder = project_folder
        if folder is None:
            folder = Path(temporary, experiment.sample)
            copy_sample(experiment.sample, folder)
        project = open_project(folder).project
        design = next((each for each in project.designs if each.component == experiment.behavior), None)
        if design is None:
            raise ExperimentError(f"{folder} has no design '{experiment.behavior}'")
        if not project.bridge.world:
            raise ExperimentError(
                f"the project in {folder} has no world for robots; set bridge: {{world: module:Class}}"
            )
        try:
            files = generate(project, languages=["xabsl"])
        except UnsoundDesignError as error:
            raise ExperimentError(f"{error}; 'vicode check {folder}' says more") from None
        apply_diffs(compare_files(files, Path(temporary)), Path(temporary))
        agents = Path(temporary, next(file.path for file in files if file.path.endswith("agents.xabsl")))
        world = ("--world", project.bridge.world, "--path", str(folder))
        bridges = [("design", (str(folder),)), ("XABSL", (str(agents), *world))]
        if experiment.thesis_option and project_folder is None:
            bridges.append((_THESIS_TITLE, (str(_copy_with_thesis_option(agents, experiment.thesis_option)), *world)))
        yield PreparedBehavior(design=design, bridges=tuple(bridges))


def _copy_with_thesis_option(agents: Path, option: str) -> Path:
    """Copy generated agents, with an option as printed in the thesis in place of the generated one."""
    copy = agents.parent.with_name(f"{agents.parent.name}-thesis")
    shutil.copytree(agents.parent, copy)
    (replaced,) = copy.rglob(option)
    shutil.copyfile(THESIS_FOLDER / option, replaced)
    return copy / agents.name


async def run_versions(
    experiment: Experiment,
    prepared: PreparedBehavior,
    *,
    seeds: int,
    has_real_time: bool,
    has_faults: bool = False,
    on_progress: ProgressCallback = lambda _name, _done, _all: None,
) -> tuple[VersionResult, ...]:
    """Run both versions with seeds 1 to `seeds`, each with its own bridge.

    Raises:
        BridgeStartError: A bridge did not start.
        BridgeError: A bridge refused a robot or closed a connection.
    """
    maps = experiment.load_maps()
    versions, done = [], 0
    total = len(prepared.bridges) * len(maps) * seeds

    def count_run() -> None:
        nonlocal done
        done += 1
        on_progress(title, done, total)

    for title, arguments in prepared.bridges:
        on_progress(title, done, total)
        real_time: tuple[RobotTrack, ...] = ()
        with running_bridge(arguments) as bridge:
            result = await run_seeds(experiment, maps, range(1, seeds + 1), port=bridge.port, on_run=count_run)
            if has_real_time and title != _THESIS_TITLE:
                on_progress(f"{title} in real time", done, total)
                real_time = await run_real_time(experiment, maps[-1], port=bridge.port, seconds=_REAL_TIME_S)
            faults: list[FaultResult] = []
            for fault in FAULTS if has_faults and title != _THESIS_TITLE else ():
                on_progress(f"{title}, {fault.name}", done, total)
                faults.append(await run_with_fault(experiment, maps[-1], fault, port=bridge.port))
        versions.append(
            VersionResult(
                title=title,
                result=result,
                is_reference=title == _THESIS_TITLE,
                real_time=real_time,
                faults=tuple(faults),
                cpu_s=bridge.cpu_s,
                memory_mb=bridge.memory_mb,
            )
        )
    return tuple(versions)
