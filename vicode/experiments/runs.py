"""Runs the seeds of an experiment against a bridge: several at once in lock step, one in real time."""

import asyncio
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from vicode.experiments.definitions import FULL_CIRCLE_DEG, Experiment
from vicode.simulated_robot.arena import Arena
from vicode.simulated_robot.faults import Fault
from vicode.simulated_robot.session import BridgeAddress, RobotTrack, SimulationSession
from vicode.simulated_robot.world_map import WorldMap

"""Receives simulated seconds as they pass."""

_AT_ONCE = 6
_SETTLE_S = 0.5
_FAST_PERIOD_S = 0.005
_FAULT_S = 12.0


@dataclass(frozen=True, slots=True, kw_only=True)
class RunResult:
    """One run.

    Attributes:
        problem: Why it has failed, "" if it has not.
        overshoot_deg: Degrees turned beyond a circle, None if the experiment is no circle.
    """

    world_map: WorldMap
    seed: int
    tracks: tuple[RobotTrack, ...]
    time_s: float
    problem: str
    overshoot_deg: float | None

    @property
    def contacts(self) -> int:
        return sum(track.robot.contacts for track in self.tracks)

    @property
    def state_changes(self) -> int:
        return sum(track.state_changes for track in self.tracks)

    @property
    def driven_m(self) -> float:
        return sum(track.robot.driven_m for track in self.tracks)


@dataclass(frozen=True, slots=True, kw_only=True)
class RunsResult:
    """All runs of one version of the behavior, and the real time that they took."""

    runs: tuple[RunResult, ...]
    wall_s: float

    @property
    def speed(self) -> float:
        """Simulated seconds per second; robots of one world count once."""
        return sum(run.time_s for run in self.runs) / self.wall_s if self.wall_s else 0.0

    def of_map(self, name: str) -> tuple[RunResult, ...]:
        return tuple(run for run in self.runs if run.world_map.name == name)


@dataclass(frozen=True, slots=True, kw_only=True)
class FaultResult:
    """A run with a fault."""

    fault: Fault
    tracks: tuple[RobotTrack, ...]

    @property
    def rests(self) -> int:
        """How often the watchdog of the bridge stopped a robot."""
        return sum("at rest" in notice for track in self.tracks for notice in track.notices)

    @property
    def contacts(self) -> int:
        return sum(track.robot.contacts for track in self.tracks)


async def run_seeds(
    experiment: Experiment, maps: Sequence[WorldMap], seeds: Iterable[int], *, port: int, on_run: Callable[[], None]
) -> RunsResult:
    """Run all seeds in all maps in lock step; `on_run` is called after each run."""
    slots = asyncio.Semaphore(_AT_ONCE)

    async def run(world_map: WorldMap, seed: int) -> RunResult:
        async with slots:
            result = await run_once(experiment, world_map, seed, port=port)
            on_run()
            return result

    start = time.perf_counter()
    chosen = list(seeds)
    runs = await asyncio.gather(*(run(world_map, seed) for world_map in maps for seed in chosen))
    return RunsResult(runs=tuple(runs), wall_s=time.perf_counter() - start)


async def run_once(experiment: Experiment, world_map: WorldMap, seed: int, *, port: int) -> RunResult:
    """Run one seed in lock step."""
    session = _session(experiment, world_map, seed, port=port)
    arena = session.arena
    over_since: list[float] = []

    def is_over() -> bool:
        # A robot that was told to stop rolls on for a moment.
        if not over_since and experiment.is_over(arena, session.tracks):
            over_since.append(arena.now_s)
        return bool(over_since) and arena.now_s >= over_since[0] + _SETTLE_S

    await session.run_lock_step(experiment.seconds, is_over=is_over)
    turned = session.tracks[0].robot.turned
    return RunResult(
        world_map=world_map,
        seed=seed,
        tracks=session.tracks,
        time_s=over_since[0] if over_since else arena.now_s,
        problem=experiment.find_problem(arena, session.tracks),
        overshoot_deg=turned - FULL_CIRCLE_DEG if experiment.turns else None,
    )


async def run_real_time(
    experiment: Experiment, world_map: WorldMap, *, port: int, seconds: float
) -> tuple[RobotTrack, ...]:
    """Run in real time, with ten times as many messages as ticks of the behavior; for the age of its data."""
    session = _session(experiment, world_map, 1, port=port, name="real-time-")
    arena = session.arena
    await session.run_real_time(
        min(seconds, experiment.seconds),
        is_over=lambda: experiment.is_over(arena, session.tracks),
        period_s=_FAST_PERIOD_S,
    )
    return session.tracks


async def run_with_fault(experiment: Experiment, world_map: WorldMap, fault: Fault, *, port: int) -> FaultResult:
    """Run in real time for a while, with a robot that does something wrong."""
    session = _session(experiment, world_map, 1, port=port, name=f"{fault.name.replace(' ', '-')}-")
    await session.run_real_time(_FAULT_S, period_s=_FAST_PERIOD_S, fault=fault)
    return FaultResult(fault=fault, tracks=session.tracks)


def _session(experiment: Experiment, world_map: WorldMap, seed: int, *, port: int, name: str = "") -> SimulationSession:
    run = f"{name}{world_map.name}-{seed}"
    address = BridgeAddress(port=port, behavior=experiment.behavior, name=f"{run}-", team=run)
    return SimulationSession(Arena(world_map, robots=experiment.robots, seed=seed), address)
