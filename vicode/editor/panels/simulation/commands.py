"""What a person can ask of the simulation."""

from collections.abc import Callable

from vicode.editor.panels.command import Command, Place
from vicode.editor.panels.simulation.simulator import Simulator
from vicode.editor.view import Selected

_STOPPABLE = ("states", "transitions")


def simulation_commands(simulator: Simulator, show: Callable[[], None]) -> tuple[Command, ...]:
    """All of them; `show` opens the panel."""

    async def run_to() -> None:
        await _run_to(simulator)

    def toggle() -> None:
        _toggle_breakpoint(simulator)

    def shown(act: Callable[[], object]) -> Callable[[], object]:
        def do() -> object:
            show()
            return act()

        return do

    rows: tuple[tuple[str, str, Callable[[], object], str, str], ...] = (
        ("simulate-start", "Simulate: start, or start again", shown(simulator.restart), "restart_alt", ""),
        ("simulate-play", "Simulate: play or pause", shown(simulator.toggle_play), "play_arrow", "F6"),
        ("simulate-step", "Simulate: one step", shown(simulator.step), "skip_next", "F10"),
        ("simulate-back", "Simulate: one step back", shown(simulator.back), "skip_previous", "Ctrl+Shift+F10"),
        ("simulate-change", "Simulate: run to the next state", shown(simulator.step_to_change), "forward", "Shift+F6"),
        ("simulate-here", "Simulate: run to the selected state", shown(run_to), "adjust", "Ctrl+F10"),
        ("simulate-stop", "Simulate: end", shown(simulator.stop), "stop", ""),
        ("breakpoint", "Breakpoint on or off at what is selected", toggle, "stop_circle", "F9"),
    )
    return tuple(
        Command(name, label, act, Place.SIMULATE, icon=icon, keys=(keys,) if keys else (), while_typing=True)
        for name, label, act, icon, keys in rows
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
