"""Run a component and show its state changes."""

import argparse
import contextlib
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.bica import options
from vicode.cli.root_selection import select_root
from vicode.output import temporary_folder
from vicode.services.project_loader import LoadedProject

if TYPE_CHECKING:
    from vicode.runs.foreground import TracePrinter
    from vicode.traces.descriptions import TraceRecord

_DEFAULT_SECONDS = 60.0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("path", metavar="DESIGN", help="design of the root component, or folder of a project with one agent")
    add(
        "--seconds",
        type=options.seconds,
        metavar="S",
        help="stop after S seconds (default: 60; with --real-time: no limit)",
    )
    add("--ticks", type=options.count, metavar="N", help="stop after N iterations")
    add("--seed", type=int, default=0, metavar="N", help="random seed of the world (default: %(default)s)")
    add("--profile", metavar="NAME", default="", help="use the implementations and the world of this profile")
    add("--world", metavar="MODULE:CLASS", help="use another world than that of project.yaml")
    add(
        "--set",
        action="append",
        default=[],
        metavar="[TIME:]NAME=VALUE",
        help="run without a world: set an input, at the start or at a time, as in --set '2.5 s: Eyes.distance=0.4'",
    )
    add("--inputs", metavar="FILE", help="like --set, with one input on each line of FILE")
    add("--reload", action="store_true", help="exchange the code during the run when a design or a module changes")
    add("--watch", metavar="ADDRESS", help="let 'vicode attach' connect: PORT, HOST:PORT or unix:PATH (docs/live.md)")
    add("--control", action="store_true", help="with --watch: let viewers pause and change the run")
    add("--without-hold", action="store_true", help="with --control: also if the world has no hold() (docs/live.md)")
    add("--net", metavar="NAME", help="connect to other robots under this name, with --real-time (docs/network.md)")
    add("--team", metavar="TEAM", help="with --net: coordinate with the robots of this team")
    add("--on-call", action="store_true", help="with --net: step the component only while other robots call it")
    add("--trace", metavar="FILE", help="write a trace (docs/traces.md) to FILE; - is the standard output")
    add("--values", action="store_true", help="include outputs and variables in the trace, for replay in the editor")
    _add_pace(parser)
    add("--until-done", action="store_true", help="stop when the root component is done")
    add(
        "--on-error",
        choices=("continue", "stop"),
        default="continue",
        help="what to do after an exception in a component (default: %(default)s)",
    )
    add("--plain", action="store_true", help="print one line per state change; the default if stdout is not a terminal")


def _add_pace(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("--real-time", action="store_true", help="run in real time instead of as fast as possible")
    add(
        "--clock",
        choices=(options.TICKS, options.WORLD),
        help="who sets the pace: ticks, or the world (default: that of project.yaml; with --world: ticks)",
    )
    add(
        "--hold-after",
        type=options.seconds,
        default=options.HOLD_AFTER_S,
        metavar="S",
        help="in real time: hold the robot when an iteration is late by more than S seconds (default: %(default)s)",
    )
    add(
        "--tick-ms",
        type=options.tick_ms,
        metavar="MS",
        help="time between iterations (default: a period that fits the frequencies, at most 20 ms)",
    )


def run(args: argparse.Namespace) -> int:
    """Generate into a temporary folder, run the code in a new process, and show its progress."""
    from vicode.services.run_preparation import generate_for_run, needs_bridge

    if args.control and args.watch is None:
        print("vicode: --control has no effect without --watch; add --watch 7070", file=sys.stderr)
        return 2
    has_inputs = bool(args.set or args.inputs)
    selected = select_root(args.path, args.profile, "run", are_inputs_given=has_inputs)
    if isinstance(selected, int):
        return selected
    opened, component = selected
    if not args.world and not has_inputs and needs_bridge(opened.open_project.project, component):
        print(
            f"vicode: {component} needs the world of a bridge; start it with: vicode bridge {args.path}",
            file=sys.stderr,
        )
        return 2
    with temporary_folder("run") as folder:
        if has_inputs:
            from vicode.cli.run_inputs import RunInputsError, generate_with_inputs

            try:
                class_path, args.world = generate_with_inputs(opened, component, folder, args)
            except RunInputsError as error:
                print(f"vicode: {error}", file=sys.stderr)
                return 2
        else:
            class_path = generate_for_run(opened.open_project, component, folder)
        if args.reload:
            from vicode.cli.run_reload import start_watching

            start_watching(args, folder)
        if args.trace == "-" and not Path("/dev/fd").exists():
            print("vicode: this system has no /dev/fd for '--trace -'; write the trace to a file", file=sys.stderr)
            return 2
        if args.trace != "-":
            return _run_process(opened, _command(opened, (component, class_path), folder, args), is_plain=args.plain)
        with _duplicate_stdout() as descriptor, contextlib.redirect_stdout(sys.stderr):
            args.trace = f"/dev/fd/{descriptor}"
            command = _command(opened, (component, class_path), folder, args)
            return _run_process(opened, command, is_plain=True, kept=(descriptor,))


@contextlib.contextmanager
def _duplicate_stdout() -> Iterator[int]:
    """A descriptor of the standard output, which the child writes the trace to."""
    descriptor = os.dup(sys.stdout.fileno())
    try:
        yield descriptor
    finally:
        os.close(descriptor)


def _command(opened: LoadedProject, names: tuple[str, str], folder: Path, args: argparse.Namespace) -> list[str]:
    from vicode.runs.property_watch import reads_values

    component, class_path = names
    # -P: files in the current folder must not shadow modules.
    command = [sys.executable, "-P", "-m", "vicode.bica", class_path, "--stream", "--path", str(folder / "python")]
    command += ["--path", str(opened.open_project.folder.resolve()), "--seed", str(args.seed)]
    world = args.world or opened.open_project.project.world
    if world:
        command += ["--world", world]
    seconds = args.seconds
    clock = args.clock or (options.TICKS if args.world else opened.open_project.project.clock or options.TICKS)
    if seconds is None and args.ticks is None and not args.real_time and clock != options.WORLD:
        seconds = _DEFAULT_SECONDS
    given = {
        "--seconds": seconds,
        "--ticks": args.ticks,
        "--tick-ms": args.tick_ms,
        "--clock": clock,
        "--hold-after": args.hold_after,
        "--trace": args.trace,
        "--watch": args.watch,
        "--net": args.net,
        "--team": args.team,
    }
    command += [part for name, value in given.items() if value is not None for part in (name, str(value))]
    command += ["--on-error", args.on_error]
    command += _origin(opened, component) if args.trace is not None else []
    flags = {
        "--values": args.values or (args.trace is None and reads_values(opened.open_project.project)),
        "--real-time": args.real_time,
        "--until-done": args.until_done,
        "--control": args.control,
        "--without-hold": args.without_hold,
        "--on-call": args.on_call,
        "--reload": args.reload,
    }
    return command + [name for name, is_given in flags.items() if is_given]


def _origin(opened: LoadedProject, component: str) -> list[str]:
    """The options that name what runs in the trace."""
    from vicode.services.run_preparation import find_origin

    origin = find_origin(opened.open_project, component)
    return ["--design", origin.design, *(["--revision", origin.revision] if origin.revision else [])]


def _run_process(opened: LoadedProject, command: list[str], *, is_plain: bool, kept: tuple[int, ...] = ()) -> int:
    from vicode.platform import session_options
    from vicode.runs.foreground import follow_process
    from vicode.runs.property_watch import watch_properties
    from vicode.simulation.environment import fresh_environment
    from vicode.traces.descriptions import describe_summary

    is_live = sys.stdout.isatty() and not is_plain
    # In a separate session, the child does not receive Ctrl-C from the terminal; it is forwarded once.
    child = subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE if is_live else None,
        stdin=subprocess.DEVNULL,
        text=True,
        encoding="utf-8",
        errors="replace",
        env=fresh_environment(),
        **session_options(),
        pass_fds=kept,
    )
    printer: TracePrinter = PlainTracePrinter()
    if is_live:
        from vicode.cli.live_view import LiveTracePrinter

        printer = LiveTracePrinter()
    watch = watch_properties(opened.open_project.project, printer)
    end = follow_process(child, watch or printer)
    if end.summary is not None:
        width = shutil.get_terminal_size().columns if sys.stdout.isatty() else None
        print(describe_summary(end.summary, width), end="", flush=True)
    if end.problem:
        print(end.problem, file=sys.stderr)
    return end.exit_code or int(watch is not None and watch.broken > 0)


class PlainTracePrinter:
    """Prints one line per state change."""

    def show_iteration(self, _record: "TraceRecord", changes: list[str], /) -> None:
        for change in changes:
            print(change, flush=True)

    def show_text(self, text: str) -> None:
        """Print it to stdout."""
        print(text, flush=True)

    def show_notice(self, text: str) -> None:
        """Print it to stderr: a program may read stdout."""
        print(text, file=sys.stderr, flush=True)

    def close(self) -> None:
        """Do nothing."""
