"""Copy a runnable program to a folder or a robot: generated code, runtime, hand-written code, launcher."""

import argparse
import sys
from pathlib import Path

from vicode.cli.console import describe_python_topics
from vicode.cli.root_selection import select_root
from vicode.output import temporary_folder


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("path", metavar="DESIGN", help="design of the root component, or folder of a project with one agent")
    add("--to", metavar="[USER@HOST:]DIR", required=True, help="the folder; everything in it but log/ is replaced")
    add("--profile", metavar="NAME", default="", help="use the implementations and the world of this profile")
    add(
        "--language", choices=("python", "cpp"), default="python", help="language of the program (default: %(default)s)"
    )
    add(
        "--python",
        metavar="PROGRAM",
        default="python3",
        help="Python interpreter on the robot (default: %(default)s)",
    )
    add(
        "--arguments",
        metavar="TEXT",
        help="arguments of the program in the launcher (default: --real-time; with clock: world, and for C++, none)",
    )
    add("--dry-run", action="store_true", help="list the files and copy nothing")


def run(args: argparse.Namespace) -> int:
    """Build the folder in a temporary one and copy it; return 1 if the project has errors."""
    from vicode.deployment.cpp_program import LIVE_HINT
    from vicode.deployment.program import ProgramOptions, build_program, list_files
    from vicode.deployment.target import copy_program
    from vicode.generators import UnsoundDesignError
    from vicode.services.run_preparation import find_topics

    selected = select_root(args.path, args.profile, "deploy", args.language)
    if isinstance(selected, int):
        return selected
    opened, component = selected
    options = ProgramOptions(target=args.to, python=args.python, arguments=args.arguments)
    with temporary_folder("deploy") as folder:
        try:
            build_program(opened.open_project, component, folder, options, language=args.language)
        except UnsoundDesignError as error:
            print(f"vicode: {error}", file=sys.stderr)
            return 1
        if args.dry_run:
            print("".join(f"{path}\n" for path in list_files(folder)), end="")
            return 0
        copy_program(folder, args.to)
    if topics := find_topics(opened.open_project.project, component):
        print(_describe_needs(topics, args), file=sys.stderr)
    if args.language == "cpp" and "--watch" in (args.arguments or "") and not opened.open_project.project.live:
        print(f"vicode: {LIVE_HINT}", file=sys.stderr)
    print(f"deployed {component} to {args.to}: {_next_command(args)}")
    return 0


def _describe_needs(topics: tuple[str, ...], args: argparse.Namespace) -> str:
    if args.language == "cpp":
        return describe_python_topics(topics, "cpp")
    return f"topics need two packages on the robot: {args.python} -m pip install cyclonedds rosbags"


def _next_command(args: argparse.Namespace) -> str:
    """What to do after a deployment; a C++ program on this machine is built if that is possible."""
    from vicode.deployment.cpp_program import BUILD_SCRIPT, build_here
    from vicode.deployment.target import command_at, is_remote

    start = f"start it with {command_at(args.to, 'run')}"
    if args.language != "cpp" or (not is_remote(args.to) and build_here(Path(args.to))):
        return start
    return f"build it with {command_at(args.to, BUILD_SCRIPT)}, then {start}"
