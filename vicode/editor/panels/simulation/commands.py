"""What a person can ask of the simulation."""

from collections.abc import Callable

from vicode.editor.panels.command import Command, Place
from vicode.editor.panels.simulation.simulator import Simulator
from vicode.editor.view import Selected

_STOPPABLE = ("states", "transitions")


def simulation_commands(simulator: Simulator, show: Callable[[], None]) -> tuple[Command, ...]:
    """All of them; `show` opens the panel."""

    def shown(act: Callable[[], object]) -> Callable[[], object]:
        def do() -> object:
            show()
            return act()

        return do

    place = Place.SIMULATE
    rows: tuple[tuple[str, str, Callable[[], object], str, str], ...] = (
        ("simulate-start", "Simulate: start, or start again", simulator.restart, "restart_alt", ""),
        ("simulate-play", "Simulate: play or pause", simulator.toggle_play, "play_arrow", "F6"),
        ("simulate-step", "Simulate: one step", simulator.step, "skip_next", "F10"),
        ("simulate-back", "Simulate: one step back", simulator.back, "skip_previous", "Ctrl+Shift+F10"),
        (
            "simulate-change",
            "Simulate: run until the state changes",
            simulator.step_to_change,
            "fast_forward",
            "Shift+F6",
        ),
        ("simulate-here", "Simulate: run to the selected state", lambda: _run_to(simulator), "adjust", "Ctrl+F10"),
        ("simulate-stop", "Simulate: end", simulator.stop, "stop", ""),
    )
    breakpoints = Command(
        "breakpoint",
        "Breakpoint on or off at what is selected",
        lambda: _toggle_breakpoint(simulator),
        place,
        icon="stop_circle",
        keys=("F9",),
        while_typing=True,
    )
    return (
        *(
            Command(name, label, shown(act), place, icon=icon, keys=(keys,) if keys else (), while_typing=True)
            for name, label, act, icon, keys in rows
        ),
        breakpoints,
    )


async def _run_to(simulator: Simulator) -> None:
    only = simulator.desk.only
    if only is None or only.of != "states":
        simulator.desk.say("Select the state to run to first", "info")
        return
    await simulator.run_to(only.id)


def _toggle_breakpoint(simulator: Simulator) -> None:
    things = [Selected(of=thing.of, id=thing.id) for thing in simulator.desk.selected if thing.of in _STOPPABLE]
    if not things:
        simulator.desk.say("Select states or transitions to put breakpoints on first", "info")
        return
    simulator.toggle_breakpoints(*things)
