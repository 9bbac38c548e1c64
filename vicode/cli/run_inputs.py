"""`vicode run --set` and `--inputs`: a run without a world, whose inputs are given."""

import argparse
from pathlib import Path

from vicode.services.project_loader import LoadedProject

_WITHOUT_EFFECT = {"world": "--world", "reload": "--reload"}


class RunInputsError(Exception):
    """The inputs cannot be read or do not suit the design; the message is one line."""


def generate_with_inputs(
    opened: LoadedProject, component: str, folder: Path, args: argparse.Namespace
) -> tuple[str, str]:
    """Generate the component with stubs for hand-written ones; the paths of its class and of the world that sets them.

    Raises:
        RunInputsError: The inputs are wrong, or the design cannot be run with stubs.
        OSError: The file of inputs cannot be read.
    """
    from vicode.generators import UnsoundDesignError
    from vicode.runs.input_script import InputTextError, TimedInput, parse_input, parse_input_lines
    from vicode.runs.scripted import write_scripted_run
    from vicode.runs.setup import NotReadyError, RunConfig, prepare_run

    for name, option in _WITHOUT_EFFECT.items():
        if getattr(args, name):
            raise RunInputsError(f"{option} has no effect with --set or --inputs; leave it out")
    project = opened.open_project.project
    design = project.design(component)
    assert design is not None
    try:
        prepared = prepare_run(
            project, design, RunConfig(), opened.open_project.design_paths, opened.open_project.folder
        )
    except (NotReadyError, UnsoundDesignError) as error:
        raise RunInputsError(str(error)) from error
    timed: list[TimedInput] = []
    if args.inputs:
        try:
            text = Path(args.inputs).read_text(encoding="utf-8")
            timed += parse_input_lines(text, prepared.inputs, design)
        except UnicodeDecodeError as error:
            raise RunInputsError(f"{args.inputs} is not UTF-8 text") from error
        except InputTextError as error:
            raise RunInputsError(f"{args.inputs}:{error}") from error
    for given in args.set:
        try:
            timed.append(parse_input(given, prepared.inputs, design))
        except InputTextError as error:
            raise RunInputsError(f"--set {given}: {error}") from error
    return write_scripted_run(prepared, timed, folder)
