"""The simulation of one window: begins and ends it, plays it, and shows on the canvas where it is."""

import asyncio
import time
from collections.abc import Callable
from typing import cast

from nicegui import run

from vicode.editor.canvas import Canvas
from vicode.editor.canvas.gesture import Item
from vicode.editor.panels.desk import Desk
from vicode.editor.session.simulation import (
    Breakpoints,
    NotReadyError,
    Phase,
    Simulation,
    Stage,
    Wish,
    meaning_of,
    prepare,
)
from vicode.editor.session.simulation.traces import TraceError, read_trace, script_of
from vicode.editor.view import Selected
from vicode.generators import UnsoundDesignError
from vicode.simulation import Moment, Stops
from vicode.simulation.resting import COUNT

SPEEDS = (0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 20.0)
_BEAT_S = 0.04
_MOST_AT_ONCE = 100
_TO_THE_END = 1_000_000


class Simulator:
    """What the commands and the panel of one window work on."""

    def __init__(self, desk: Desk, canvas: Canvas) -> None:
        """Begin with no simulation."""
        self.desk, self.canvas = desk, canvas
        self.simulation: Simulation | None = None
        self.breakpoints = Breakpoints()
        self.wish = Wish()
        self.trace: tuple[Moment, ...] = ()
        self.replays = False
        self.speed = 1.0
        self.pauses_on_errors = True
        self.is_playing = False
        self.is_running = False
        """Whether it makes more than a step without being played."""
        self.is_starting = False
        self.is_stale = False
        self.trouble = ""
        """Why it could not be started."""
        self.changes = 0
        """Counts what the panel has to show anew."""
        self.show: Callable[[], None] = lambda: None
        """Bring the panel up to date at once, if it is there."""
        self._meaning: object = None
        self._seen_project: object = None
        self._starting = asyncio.Lock()
        self._is_closed = False
        self._seq = 0
        canvas.client.on_disconnect(self.pause)
        canvas.client.on_delete(self.close)

    async def restart(self) -> None:
        """Begin anew with the design as it is now."""
        self.pause()
        async with self._starting:
            await self._start()

    async def step(self) -> None:
        """One iteration."""
        await self._go(1, Stops())

    async def step_to_change(self) -> None:
        """Go on until another state is entered, a breakpoint is hit, or the room for it is used up."""
        await self._go(_TO_THE_END, self._stops(changes=True))

    async def run_to(self, state: str) -> None:
        """Go on until a state is entered."""
        await self._go(_TO_THE_END, self._stops(also=state))

    async def run_to_time(self, seconds: float) -> None:
        """Show the moment at a time: a recorded one, or go on until then."""
        if not await self._ready():
            return
        simulation = self._running
        number = round(seconds * 1e9 / simulation.stage.setup.tick_ns) + 1
        if number <= len(simulation.recording):
            simulation.go_to(number)
        else:
            await self._go(number - simulation.cursor, self._stops())

    def back(self) -> None:
        """Show the iteration before."""
        self.pause()
        if self.simulation is not None:
            self.simulation.back()
        self.show()

    def toggle_play(self) -> None:
        """Play, or pause."""
        if self.is_playing or self.is_running:
            self.pause()
            return
        self.is_playing = True
        self.desk.begin(self._play(), "simulation")
        self._changed()

    def pause(self) -> None:
        """Come to rest."""
        self.is_playing = False
        if self.simulation is not None:
            self.simulation.pause()
        self._changed()

    def set_wish(self, wish: Wish) -> None:
        """Simulate in another way from the next start on."""
        self.wish = wish
        self.is_stale = self.simulation is not None
        self._changed()

    def take_trace(self, text: str, *, replays: bool) -> None:
        """Use a recorded trace: to look at, or to set the inputs.

        Raises:
            TraceError: It is no trace of this design.
        """
        self.trace, self.replays = read_trace(text, self.desk.design), replays
        self.is_stale = self.simulation is not None
        self._changed()

    def forget_trace(self) -> None:
        """Set the inputs by hand again."""
        self.trace, self.replays = (), False
        self.is_stale = self.simulation is not None
        self._changed()

    def toggle_breakpoints(self, *things: Selected) -> None:
        """Mark states and transitions to rest at, or take the marks away."""
        self.breakpoints = self.breakpoints.toggled(*things)
        self._show_stops()
        self._changed()

    def follow_project(self) -> None:
        """Notice changes of designs that this one uses, made elsewhere."""
        if self._seen_project is not self.desk.workspace.project:
            self._seen_project = self.desk.workspace.project
            self.design_changed()

    def design_changed(self) -> None:
        """End a run of a design that is no more; its past can still be looked at."""
        kept = self.breakpoints.within(self.desk.design)
        if kept != self.breakpoints:
            self.breakpoints = kept
            self._show_stops()
        simulation = self.simulation
        if simulation is None or simulation.phase is Phase.ENDED:
            return
        if meaning_of(self.desk.workspace.project, self.desk.design) != self._meaning:
            self.is_playing = False
            simulation.end()
            self.is_stale = True
            self._changed()

    def close(self) -> None:
        """End the simulation, as the window goes."""
        self._is_closed = True
        self.is_playing = False
        self._drop()

    def stop(self) -> None:
        """End the simulation, and show so."""
        self.is_playing = False
        self._drop()
        self.is_stale = False
        self._changed()

    @property
    def _running(self) -> Simulation:
        assert self.simulation is not None
        return self.simulation

    def _stops(self, *, changes: bool = False, also: str = "") -> Stops:
        return self.breakpoints.stops(changes=changes, errors=self.pauses_on_errors, also=also)

    async def _start(self) -> bool:
        self.is_starting = True
        self._changed()
        try:
            return await self._start_anew()
        finally:
            self.is_starting = False
            self._changed()

    async def _start_anew(self) -> bool:
        inputs = self.simulation.inputs if self.simulation and not self.simulation.replay else {}
        self._drop()
        self.trouble, self.is_stale = "", False
        stage = await self._prepare()
        if stage is not None and not self._is_closed:
            self._meaning = meaning_of(self.desk.workspace.project, stage.design)
            self.breakpoints = self.breakpoints.within(stage.design)
            self.simulation = simulation = Simulation(
                stage=stage,
                cwd=self.desk.workspace.folder,
                script=script_of(self.trace, stage.inputs) if self.trace and not self.replays else (),
                replay=self.trace if self.replays else (),
                on_change=self._changed,
            )
            simulation.take_over(inputs)
            if not simulation.replay:
                await simulation.begin()
        return self.simulation is not None and self.simulation.failure is None

    def _drop(self) -> None:
        if self.simulation is not None:
            self.simulation.on_change = lambda: None
            self.simulation.end()
        self.simulation = None

    async def _ready(self) -> bool:
        """Whether there is a simulation to step; one is begun if there was none, or none of the design as it is now."""
        async with self._starting:
            simulation = self.simulation
            if simulation is None or simulation.is_over:
                return await self._start()
            return True

    async def _go(self, count: int, stops: Stops) -> None:
        if self.is_playing:
            self.pause()
        self.is_running = count > 1
        try:
            if await self._ready():
                await self._running.step(count, stops)
        finally:
            self.is_running = False
        self._changed()
        self.show()

    async def _play(self) -> None:
        """Step as real time passes, times the speed, until something says rest."""
        reason = COUNT if await self._ready() else ""
        last, due = time.monotonic(), 1.0
        while self.is_playing and reason == COUNT and self.simulation is not None:
            now = time.monotonic()
            due += (now - last) * 1e9 * self.speed / self._running.stage.setup.tick_ns
            last = now
            # What a slow machine cannot do in time is not caught up.
            due, count = due % 1, min(int(due), _MOST_AT_ONCE)
            if count:
                reason = await self._running.step(count, self._stops())
            await asyncio.sleep(_BEAT_S)
        self.is_playing = False
        self._changed()

    async def _prepare(self) -> Stage | None:
        desk = self.desk
        workspace, design, wish = desk.workspace, desk.design, self.wish
        try:
            return await run.io_bound(prepare, workspace.project, design, wish, workspace.sources, workspace.folder)
        except (NotReadyError, UnsoundDesignError, TraceError) as error:
            self.trouble = str(error)
            return None

    def _changed(self) -> None:
        self.changes += 1
        self._show_active()

    def _show_active(self) -> None:
        """Mark on the canvas the active state and the transition that led there."""
        active: list[str] = []
        taken: list[str] = []
        simulation = self.simulation
        if simulation is not None and simulation.cursor:
            active = [simulation.recording.states[simulation.cursor - 1]]
            latest = simulation.recording.latest_transition(simulation.cursor)
            taken = [latest] if latest and simulation.phase is not Phase.ENDED else []
        self._seq += 1
        self.canvas.set_active(active, self._seq, taken)

    def _show_stops(self) -> None:
        items = [{"of": thing.of, "id": thing.id} for thing in sorted(self.breakpoints.things, key=_order)]
        self.canvas.set_stops(cast("list[Item]", items))


def _order(thing: Selected) -> tuple[str, str]:
    return (thing.of, thing.id)
