"""The command line that repeats a simulation."""

import shlex
from dataclasses import dataclass

from vicode.model.names import snake_case
from vicode.runs.input_script import TimedInput, format_input
from vicode.runs.inputs import SimulationInput
from vicode.runs.setup import RunConfig
from vicode.runs.simulation import Simulation
from vicode.simulation import Inputs

_MOST_OPTIONS = 8


class NotRepeatableError(Exception):
    """No command line repeats the simulation; the message is the reason."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TerminalCommand:
    """A command line; with many inputs, also the text of the file that it reads them from."""

    command: str
    inputs_file: str = ""
    inputs_text: str = ""


def terminal_command(design: str, simulation: Simulation, config: RunConfig) -> TerminalCommand:
    """The command that repeats what was simulated so far.

    Args:
        design: The path of the design.
        simulation: Its inputs and its past.
        config: How it was started.

    Raises:
        NotRepeatableError: It shows a recorded run, or only some components have manual inputs.
    """
    if simulation.is_view:
        raise NotRepeatableError("a recorded run is shown, not a simulation")
    if simulation.recording.dropped:
        raise NotRepeatableError("the first iterations are no longer recorded")
    if config.stubbed:
        raise NotRepeatableError("only some components have manual inputs; vicode run replaces all or none")
    words = ["vicode", "run", design]
    lines = _input_lines(simulation) if config.stubbed is None else []
    file = f"{snake_case(simulation.prepared.design.component)}.inputs.txt" if len(lines) > _MOST_OPTIONS else ""
    words += ["--inputs", file] if file else [word for line in lines for word in ("--set", line)]
    if config.stubbed is not None and config.seed:
        words += ["--seed", str(config.seed)]
    if config.tick_ms:
        words += ["--tick-ms", f"{config.tick_ms:g}"]
    if len(simulation.recording):
        words += ["--ticks", str(len(simulation.recording))]
    text = "".join(f"{line}\n" for line in lines) if file else ""
    return TerminalCommand(command=shlex.join(words), inputs_file=file, inputs_text=text)


def _input_lines(simulation: Simulation) -> list[str]:
    """The inputs that the user changed; without any the first one, so that hand-written components stay replaced."""
    inputs = {each.key: each for each in simulation.prepared.inputs}
    known = {each.key: _initial(each) for each in inputs.values()}
    recording, timed = simulation.recording, []
    for number in range(1, len(recording) + 1):
        for each, value in _changed(recording.changes_before(number), inputs):
            if value != known[each.key]:
                known[each.key] = value
                time_ns = recording.times_ns[number - 1]
                timed.append(TimedInput(time_ns=time_ns, input=each, value=value))
    if not timed and inputs:
        first = next(iter(inputs.values()))
        timed = [TimedInput(time_ns=0, input=first, value=first.initial)]
    lines = [format_input(each) for each in timed]
    if None in lines:
        raise NotRepeatableError("a function has values for particular arguments")
    return [line for line in lines if line is not None]


def _initial(each: SimulationInput) -> object:
    return each.initial if each.arguments is None else {"value": each.initial, "table": []}


def _changed(changes: Inputs, inputs: dict[tuple[str, str], SimulationInput]) -> list[tuple[SimulationInput, object]]:
    pairs = [((component, name), value) for component, values in changes.items() for name, value in values.items()]
    return [(inputs[key], value) for key, value in pairs if key in inputs]
