"""Builds the folder of a runnable program: generated and hand-written code, the runtime, a launcher, a systemd unit."""

import shlex
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from vicode.deployment.cpp_program import write_cpp_program
from vicode.deployment.target import is_remote
from vicode.generators import generate, python_class_path
from vicode.store import OpenProject
from vicode.store.projects import DEPLOYED_MARKER

_SKIPPED_FOLDERS = frozenset({"__pycache__", "node_modules", "venv", "build", "dist"})


@dataclass(frozen=True, slots=True, kw_only=True)
class ProgramOptions:
    """How a program is started.

    Attributes:
        target: The folder for which it is built, as `[USER@HOST:]DIR`.
        python: The Python interpreter there.
        arguments: The arguments of the program in the launcher; None for the default.
    """

    target: str
    python: str = "python3"
    arguments: str | None = None


def build_program(
    opened: OpenProject,
    component: str,
    folder: Path,
    options: ProgramOptions,
    *,
    language: Literal["python", "cpp"] = "python",
) -> None:
    """Write all files of the program of a root component to an empty folder.

    Raises:
        OSError: The project has no C++ program, or a hand-written folder has the name of a generated package.
        UnsoundDesignError: A design cannot be generated.
    """
    build = _build_cpp_program if language == "cpp" else _build_python_program
    build(opened, component, folder, options)


def list_files(folder: Path) -> Iterator[str]:
    """The paths of all files in a folder, relative to it and sorted."""
    return iter(sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()))


def _build_python_program(opened: OpenProject, component: str, folder: Path, options: ProgramOptions) -> None:
    """Write all files of the program to a folder.

    Raises:
        OSError: A hand-written folder has the name of a generated package.
    """
    project = opened.project
    files = generate(
        project, components=[component], languages=["python"], standalone=True, sources=opened.design_paths
    )
    _copy_hand_written(opened.folder, folder, Path(project.generated).parts[:1])
    for file in files:
        target = folder / file.path.removeprefix("python/")
        if target.exists():
            raise OSError(f"{target.relative_to(folder)} is generated, but the project has a file of this name")
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(file.text, encoding="utf-8")
    class_path = python_class_path(project, component)
    package = class_path.partition(".")[0]
    name = _component_name(opened, component)
    # A world that sets the pace needs no clock of the program.
    default = "" if project.clock else "--real-time"
    arguments = default if options.arguments is None else options.arguments
    command = f"exec {shlex.quote(options.python)} -m {package} {shlex.quote(name)} {arguments}".rstrip()
    comment = "# Ctrl-C and SIGTERM close the components and the world.\n"
    _write_launcher(folder, package, name, command, target=options.target, comment=comment)


def _build_cpp_program(opened: OpenProject, component: str, folder: Path, options: ProgramOptions) -> None:
    """Write all files of a C++ program to a folder.

    Raises:
        OSError: The project has no C++ program.
        UnsoundDesignError: A design cannot be generated.
    """
    generated = Path(opened.project.generated).parts[:1]
    _copy_hand_written(opened.folder, folder, generated)
    program = write_cpp_program(opened, component, folder)
    command = f"{program.launch} {options.arguments or ''}".rstrip()
    _write_launcher(folder, program.package, component, command, target=options.target)


def _component_name(opened: OpenProject, component: str) -> str:
    """The name of a root component on the command line of its package."""
    agents = (agent.name for agent in opened.project.agents if agent.root == component)
    return next(agents, component)


def _copy_hand_written(source: Path, target: Path, generated: tuple[str, ...]) -> None:
    """Copy the files of a project but hidden, generated and temporary ones."""
    skipped = _SKIPPED_FOLDERS | set(generated)

    def ignore(folder: str, names: list[str]) -> list[str]:
        is_top = Path(folder) == source
        return [
            name
            for name in names
            if name.startswith(".")
            or (name in skipped and (is_top or name in _SKIPPED_FOLDERS))
            or not _can_be_copied(Path(folder) / name)
        ]

    shutil.copytree(source, target, ignore=ignore, dirs_exist_ok=True)


def _can_be_copied(path: Path) -> bool:
    """Whether a path is a file, or a folder that is no deployed program and no link to one that contains it."""
    if path.is_dir():
        is_loop = path.is_symlink() and path.parent.resolve().is_relative_to(path.resolve())
        return not is_loop and not (path / DEPLOYED_MARKER).is_file()
    # Reading a pipe would block.
    return path.is_file()


def _write_launcher(
    folder: Path, package: str, component: str, command: str, *, target: str, comment: str = ""
) -> None:
    """Write launcher, systemd unit and marker."""
    (folder / DEPLOYED_MARKER).write_text(f"{package}\n", encoding="utf-8")
    launcher = folder / "run"
    launcher.write_text(f'#!/bin/sh\n{comment}cd "$(dirname "$0")" || exit 1\n{command} "$@"\n', encoding="utf-8")
    launcher.chmod(0o755)
    (folder / f"{package}.service").write_text(
        f"""\
# systemctl --user enable --now $PWD/{package}.service
# loginctl enable-linger             the program runs without a login, and from the start of the machine
# systemctl --user edit {package}    variables: [Service] Environment=VICODE_WATCH=7070
[Unit]
Description={package} ({component})

[Service]
WorkingDirectory={_unit_place(target)}
# systemd starts no program with quotes or a backslash in its path.
ExecStart=/bin/sh run
Restart=on-failure
# The program stops the robot after SIGTERM and ends with 128 + 15.
KillSignal=SIGTERM
SuccessExitStatus=143
TimeoutStopSec=10

[Install]
WantedBy=default.target
"""
    )


def _unit_place(target: str) -> str:
    """The folder of a target as a systemd unit names it: %h is the home folder, where ssh starts."""
    if not target.isprintable():
        raise OSError(f"invalid target {target!r}")
    place = target.partition(":")[2] if is_remote(target) else str(Path(target).resolve())
    escaped = place.replace("%", "%%")
    return escaped if escaped.startswith("/") else f"%h/{escaped.removeprefix('~/')}"
