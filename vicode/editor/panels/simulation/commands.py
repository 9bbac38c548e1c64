"""What a person can ask of the simulation."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from vicode.editor.panels.command import Command, Place
from vicode.editor.view import Selected

if TYPE_CHECKING:
    from vicode.editor.panels.simulation.simulator import Simulator

_STOPPABLE = ("states", "transitions")


def simulation_commands(simulate: "Callable[[], Simulator]", show: Callable[[], None]) -> tuple[Command, ...]:
    """All of them; `simulate` gives the window's simulator, made when it is first wanted, `show` opens the panel."""

    def toggle() -> None:
        _toggle_breakpoint(simulate())

    def shown(act: "Callable[[Simulator], object]") -> Callable[[], object]:
        def do() -> object:
            show()
            return act(simulate())

        return do

    rows: tuple[tuple[str, str, Callable[[], object], str, str], ...] = (
        ("simulate-start", "Simulate: start, or start again", shown(lambda it: it.restart()), "restart_alt", ""),
        ("simulate-play", "Simulate: play or pause", shown(lambda it: it.toggle_play()), "play_arrow", "F6"),
        ("simulate-step", "Simulate: one step", shown(lambda it: it.step()), "skip_next", "F10"),
        ("simulate-back", "Simulate: one step back", shown(lambda it: it.back()), "skip_previous", "Ctrl+Shift+F10"),
        (
            "simulate-change",
            "Simulate: run to the next state",
            shown(lambda it: it.step_to_change()),
            "forward",
            "Shift+F6",
        ),
        ("simulate-here", "Simulate: run to the selected state", shown(_run_to), "adjust", "Ctrl+F10"),
        ("simulate-stop", "Simulate: end", shown(lambda it: it.stop()), "stop", ""),
        ("breakpoint", "Breakpoint on or off at what is selected", toggle, "stop_circle", "F9"),
    )
    return tuple(
        Command(name, label, act, Place.SIMULATE, icon=icon, keys=(keys,) if keys else (), while_typing=True)
        for name, label, act, icon, keys in rows
    )


async def _run_to(simulator: "Simulator") -> None:
    only = simulator.desk.only
    if only is None or only.of != "states":
        simulator.desk.say("Select the state to run to first", "info")
        return
    await simulator.run_to(only.id)


def _toggle_breakpoint(simulator: "Simulator") -> None:
    things = [Selected(of=thing.of, id=thing.id) for thing in simulator.desk.selected if thing.of in _STOPPABLE]
    if not things:
        simulator.desk.say("Select states or transitions to put breakpoints on first", "info")
        return
    simulator.toggle_breakpoints(*things)
