"""The page of an experiment: results per seed, paths, ages of data, who waited for whom, and the thesis beside it."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import fmean

from vicode.diagram.palettes import DARK, LIGHT, css_variable_palette, palette_variables
from vicode.diagram.render import render_design
from vicode.diagram.svg import write_svg
from vicode.experiments.age_chart import AgeChart, build_age_chart
from vicode.experiments.definitions import Experiment
from vicode.experiments.path_chart import PathChart, build_path_chart, number_states
from vicode.experiments.runs import FaultResult, RunResult, RunsResult
from vicode.experiments.wait_chart import WaitChart, build_wait_chart, find_waiting_states
from vicode.model.design import Design
from vicode.simulated_robot.session import RobotTrack
from vicode.simulated_robot.world_map import WorldMap
from vicode.store import read_design
from vicode.templating import render

THESIS_FOLDER = Path(__file__).parent / "thesis"


@dataclass(frozen=True, slots=True, kw_only=True)
class VersionResult:
    """The runs of one version of the behavior, such as "design", and what its bridge used.

    Attributes:
        is_reference: Whether it is that of the thesis, which need not succeed.
        real_time: The robots of a run in real time; empty if there was none.
        faults: Runs in real time with faults of the robot.
    """

    title: str
    result: RunsResult
    is_reference: bool = False
    real_time: tuple[RobotTrack, ...] = ()
    faults: tuple[FaultResult, ...] = ()
    cpu_s: float = 0.0
    memory_mb: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class SummaryRow:
    """The runs of one version in one map."""

    version: str
    map: str
    runs: int
    passed: int
    contacts: int
    seconds: str
    overshoot: str
    changes: str
    has_passed: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class SeedRow:
    """One run."""

    version: str
    map: str
    seed: int
    seconds: str
    driven: str
    overshoot: str
    contacts: int
    changes: int
    problem: str


@dataclass(frozen=True, slots=True, kw_only=True)
class MapSection:
    """The charts of one map, one per version."""

    title: str
    doc: str
    charts: tuple[tuple[str, PathChart], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class EffortRow:
    """What one version needed: simulated seconds per second, processor time and memory of its bridge, ages of data."""

    version: str
    speed: str
    cpu: str
    memory: str
    mean_age: str
    highest_age: str
    command_age: str
    highest_command_age: str


@dataclass(frozen=True, slots=True, kw_only=True)
class FaultRow:
    """A run with a fault; `ages` are mean and highest of the data, then of the commands."""

    fault: str
    doc: str
    version: str
    ages: tuple[str, str, str, str]
    rests: int
    contacts: int


def write_page(experiment: Experiment, design: Design, versions: Sequence[VersionResult]) -> str:
    """The page as one file."""
    runs = [run for version in versions if not version.is_reference for run in version.result.runs]
    every_run = [run for version in versions for run in version.result.runs]
    colors = number_states(track for run in every_run for track in run.tracks)
    return render(
        "experiments/page.html.jinja",
        experiment=experiment,
        passed=sum(not run.problem for run in runs),
        runs=len(runs),
        summary=[_summary(experiment, version, world_map) for world_map in _maps(versions) for version in versions],
        references=_describe_references(versions),
        equal=_count_equal([version for version in versions if not version.is_reference]),
        pairs=len(versions[0].result.runs),
        seeds=[_seed_row(version, run) for version in versions for run in version.result.runs],
        uses=[_use(version) for version in versions],
        faults=[_fault_row(version, result) for version in versions for result in version.faults],
        states=list(colors.items()),
        sections=[_section(world_map, versions, colors) for world_map in _maps(versions)],
        waits=_waits(design, versions, colors),
        ages=_ages(versions),
        own_diagram=_diagram(design),
        thesis_diagram=_thesis_diagram(experiment),
        light=palette_variables(LIGHT),
        dark=palette_variables(DARK),
    )


def _describe_references(versions: Sequence[VersionResult]) -> list[str]:
    """How the versions of the thesis did, one sentence each."""
    sentences = []
    for version in versions:
        runs = version.result.runs
        if version.is_reference:
            failed = [run for run in runs if run.problem]
            problems = Counter(run.problem for run in failed)
            words = "; ".join(f"{number} × {problem}" for problem, number in problems.most_common())
            sentences.append(
                f"The option {version.title} succeeded in {len(runs) - len(failed)} of {len(runs)} runs"
                + (f": {words}." if words else ".")
            )
    return sentences


def _count_equal(versions: Sequence[VersionResult]) -> int:
    """The number of runs in which all versions did the same in every tick."""
    runs = zip(*(version.result.runs for version in versions), strict=True)
    return sum(len({tuple(tuple(track.points) for track in run.tracks) for run in pair}) == 1 for pair in runs)


def _maps(versions: Sequence[VersionResult]) -> tuple[WorldMap, ...]:
    return tuple({run.world_map.name: run.world_map for run in versions[0].result.runs}.values())


def _summary(experiment: Experiment, version: VersionResult, world_map: WorldMap) -> SummaryRow:
    runs = version.result.of_map(world_map.name)
    overshoots = [run.overshoot_deg for run in runs if run.overshoot_deg is not None]
    passed = sum(not run.problem for run in runs)
    return SummaryRow(
        version=version.title,
        map=world_map.name,
        runs=len(runs),
        passed=passed,
        contacts=sum(run.contacts for run in runs),
        seconds=_range([run.time_s for run in runs]),
        overshoot=_range(overshoots, 2) if experiment.turns else "",
        changes=_range([run.state_changes for run in runs], 0),
        has_passed=passed == len(runs),
    )


def _range(values: Sequence[float], digits: int = 1) -> str:
    return f"{fmean(values):.{digits}f} ({min(values):.{digits}f} to {max(values):.{digits}f})" if values else ""


def _seed_row(version: VersionResult, run: RunResult) -> SeedRow:
    return SeedRow(
        version=version.title,
        map=run.world_map.name,
        seed=run.seed,
        seconds=f"{run.time_s:.2f}",
        driven=f"{run.driven_m:.2f}",
        overshoot="" if run.overshoot_deg is None else f"{run.overshoot_deg:+.2f}",
        contacts=run.contacts,
        changes=run.state_changes,
        problem=run.problem,
    )


def _use(version: VersionResult) -> EffortRow:
    mean_age, highest_age, command_age, highest_command_age = _describe_ages(version.real_time)
    return EffortRow(
        version=version.title,
        speed=f"{version.result.speed:.0f} ×",
        cpu=f"{version.cpu_s:.1f} s",
        memory=f"{version.memory_mb:.0f} MB",
        mean_age=mean_age,
        highest_age=highest_age,
        command_age=command_age,
        highest_command_age=highest_command_age,
    )


def _describe_ages(tracks: Sequence[RobotTrack]) -> tuple[str, str, str, str]:
    """Mean and highest age of the data, then of the commands; empty texts if they are not known."""
    points = [point for track in tracks for point in track.points]
    ages = [point.age_ms for point in points if point.age_ms is not None]
    command_ages = [point.command_age_ms for point in points if point.command_age_ms is not None]
    texts = [(f"{fmean(each):.1f} ms", f"{max(each):.1f} ms") if each else ("", "") for each in (ages, command_ages)]
    return (*texts[0], *texts[1])


def _fault_row(version: VersionResult, result: FaultResult) -> FaultRow:
    return FaultRow(
        fault=result.fault.name,
        doc=result.fault.doc,
        version=version.title,
        ages=_describe_ages(result.tracks),
        rests=result.rests,
        contacts=result.contacts,
    )


def _section(world_map: WorldMap, versions: Sequence[VersionResult], colors: dict[str, int]) -> MapSection:
    charts = []
    for version in versions:
        first, *others = version.result.of_map(world_map.name)
        title = f"Paths in the world {world_map.name}, {version.title}"
        thin = [track for run in others for track in run.tracks]
        charts.append((version.title, build_path_chart(title, world_map, first.tracks, thin, colors)))
    return MapSection(title=world_map.name, doc=world_map.doc, charts=tuple(charts))


def _waits(
    design: Design, versions: Sequence[VersionResult], colors: dict[str, int]
) -> tuple[tuple[str, WaitChart], ...]:
    waiting = find_waiting_states(design)
    if not waiting:
        return ()
    return tuple(
        (version.title, build_wait_chart(version.result.runs[0].tracks, waiting, colors)) for version in versions
    )


def _ages(versions: Sequence[VersionResult]) -> AgeChart | None:
    runs = [
        (version.title, [point for track in version.real_time for point in track.points])
        for version in versions
        if version.real_time
    ]
    commands = [
        (f"{title}, obeyed commands", [replace(point, age_ms=point.command_age_ms) for point in points])
        for title, points in runs
    ]
    return build_age_chart([*runs, *commands]) if runs else None


def _thesis_diagram(experiment: Experiment) -> str:
    if not experiment.thesis_design:
        return ""
    path = THESIS_FOLDER / f"{experiment.thesis_design}.yaml"
    design = read_design(path.read_bytes(), path.name).design
    assert design is not None, f"{path.name} has errors"
    return _diagram(design)


def _diagram(design: Design) -> str:
    image = render_design(design, links=False, palette=css_variable_palette())
    return write_svg(image, is_embedded=True)
