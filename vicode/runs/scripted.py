"""Writes a run without a world, whose inputs are given before it starts."""

from collections.abc import Iterable
from pathlib import Path

from vicode.output import apply_diffs, compare_files
from vicode.runs.input_script import TimedInput, make_script
from vicode.runs.setup import PreparedRun
from vicode.simulation.scripted_run import MAIN, MODULE, WORLD, write_run


def write_scripted_run(prepared: PreparedRun, inputs: Iterable[TimedInput], folder: Path) -> tuple[str, str]:
    """Write a run with stubs for hand-written components; the paths of its class and of the world that sets inputs."""
    apply_diffs(compare_files(prepared.files, folder), folder)
    write_run(folder / "python", prepared.setup, make_script(inputs))
    return f"{MODULE}:{MAIN}", f"{MODULE}:{WORLD}"
