"""The commands of the simulation."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from vicode.editor.panels.commands.command import Command, MenuGroup
from vicode.editor.view import ItemRef

if TYPE_CHECKING:
    from vicode.editor.panels.simulation.controller import SimulationController

_BREAKPOINT_KINDS = ("states", "transitions")


def simulation_commands(
    get_controller: "Callable[[], SimulationController]", show_panel: Callable[[], None]
) -> tuple[Command, ...]:
    """The commands; `get_controller` returns the controller of the window, created on first use."""

    def toggle() -> None:
        _toggle_breakpoint(get_controller())

    def shown(act: "Callable[[SimulationController], object]") -> Callable[[], object]:
        def do() -> object:
            show_panel()
            return act(get_controller())

        return do

    rows: tuple[tuple[str, str, Callable[[], object], str, str], ...] = (
        ("simulate-start", "Simulate: start or restart", shown(lambda it: it.restart()), "restart_alt", ""),
        ("simulate-play", "Simulate: play or pause", shown(lambda it: it.toggle_play()), "play_arrow", "F6"),
        ("simulate-step", "Simulate: step", shown(lambda it: it.step()), "skip_next", "F10"),
        (
            "simulate-back",
            "Simulate: step back",
            shown(lambda it: it.step_back()),
            "skip_previous",
            "Ctrl+Shift+F10",
        ),
        (
            "simulate-change",
            "Simulate: run to the next state",
            shown(lambda it: it.step_to_change()),
            "forward",
            "Shift+F6",
        ),
        ("simulate-here", "Simulate: run to the selected state", shown(_run_to), "adjust", "Ctrl+F10"),
        ("robot-enter", "Robot: go to the selected state", shown(_enter), "login", ""),
        ("simulate-terminal", "Simulate: run this in the terminal…", _show_terminal(get_controller), "terminal", ""),
        ("simulate-stop", "Simulate: stop", shown(lambda it: it.stop()), "stop", ""),
        ("breakpoint", "Toggle breakpoint on the selection", toggle, "stop_circle", "F9"),
    )
    return tuple(
        Command(name, label, act, MenuGroup.SIMULATE, icon=icon, keys=(keys,) if keys else (), while_typing=True)
        for name, label, act, icon, keys in rows
    )


def _show_terminal(get_controller: "Callable[[], SimulationController]") -> Callable[[], object]:
    from vicode.editor.panels.simulation.terminal_dialog import show_terminal_command  # noqa: PLC0415

    return lambda: show_terminal_command(get_controller())


async def _run_to(simulator: "SimulationController") -> None:
    only = simulator.context.single_selection
    if only is None or only.kind != "states":
        simulator.context.show_toast("Select a state to run to", "info")
        return
    await simulator.run_to(only.id)


def _enter(simulator: "SimulationController") -> None:
    simulator.robot.enter(simulator.context.single_selection)


def _toggle_breakpoint(simulator: "SimulationController") -> None:
    items = [
        ItemRef(kind=item.kind, id=item.id) for item in simulator.context.selected if item.kind in _BREAKPOINT_KINDS
    ]
    if not items:
        simulator.context.show_toast("Select states or transitions for breakpoints", "info")
        return
    simulator.toggle_breakpoints(*items)
