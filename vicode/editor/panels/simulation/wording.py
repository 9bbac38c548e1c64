"""What the simulation says in its one line: why it cannot go on, where in the past it is, why it rested."""

from vicode.editor.panels.simulation.simulator import Simulator
from vicode.editor.session.simulation import Phase, Simulation
from vicode.editor.view.activation import mistake_of

_HINT = "F10 steps, F6 plays and pauses, Shift+F6 runs to the next state, F9 sets a breakpoint on what is selected."


def message_of(simulator: Simulator) -> tuple[str, str]:
    """What is to be said, and its kind: error, warning, past or info."""
    simulation = simulator.simulation
    if simulator.is_starting:
        return ("info", "Starting: the code is generated and loaded …")
    if simulator.trouble:
        return ("error", simulator.trouble)
    if simulator.is_stale and simulation is not None and simulation.phase is Phase.ENDED:
        return ("warning", "The design has changed: what is shown is the past of what it was.")
    if simulator.is_stale:
        return ("warning", "Start again to simulate it that way.")
    if simulation is None:
        return ("info", _HINT)
    return _message_in(simulation, is_moving=simulator.is_playing or simulator.is_running)


def _message_in(simulation: Simulation, *, is_moving: bool) -> tuple[str, str]:
    if simulation.failure is not None and not simulation.is_past:
        record = simulation.failure.error
        words = mistake_of(simulation.stage.design, record).words if record else simulation.failure.message
        return ("error", words)
    if simulation.is_past and not is_moving:
        behind = len(simulation.recording) - simulation.cursor
        return ("past", f"The past, {behind} iteration{'s' * (behind != 1)} before the newest.")
    moment = simulation.moment
    if moment is not None and moment.errors:
        return ("error", mistake_of(simulation.stage.design, moment.errors[0]).words)
    if simulation.note:
        return ("warning", simulation.note)
    return ("info", (not is_moving and _describe_rest(simulation)) or _HINT)


def _describe_rest(simulation: Simulation) -> str:
    """Why it came to rest, in words; nothing for a run that made all its steps."""
    state = simulation.moment.state if simulation.moment else ""
    words = {
        "transition": f"Stopped at a breakpoint: the transition to {state}",
        "state": f"Stopped on entering {state}",
        "error": "Stopped at an error",
        "done": f"Done: {state} is a final state",
        "finished": "The world has come to its end",
        "change": f"Entered {state}",
        "pause": "Paused",
        "end": "There is nothing after this",
    }
    return words.get(simulation.rested, "")
