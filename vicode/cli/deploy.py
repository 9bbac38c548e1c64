"""Copy a runnable program to a folder or a robot: generated code, runtime, hand-written code, launcher."""

import argparse
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import IO

from vicode.cli.root_selection import select_root
from vicode.services.project_loader import LoadedProject
from vicode.store.projects import DEPLOYED_MARKER

_SKIPPED_FOLDERS = frozenset({"__pycache__", "node_modules", "venv", "build", "dist"})
_KEPT_FOLDER = "log"
_NO_FOLDER, _HAS_FILES, _NO_RSYNC = 11, 12, 13
"""Exit codes of the checks on the robot."""


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
    from vicode.generators import UnsoundDesignError

    selected = select_root(args.path, args.profile, "deploy", args.language)
    if isinstance(selected, int):
        return selected
    opened, component = selected
    with tempfile.TemporaryDirectory(prefix="vicode-deploy-") as name:
        folder = Path(name)
        try:
            if args.language == "cpp":
                build_cpp_program(opened, component, folder, args)
            else:
                build_program(opened, component, folder, args)
        except UnsoundDesignError as error:
            print(f"vicode: {error}", file=sys.stderr)
            return 1
        if args.dry_run:
            print("".join(f"{path}\n" for path in _list_files(folder)), end="")
            return 0
        _copy(folder, args.to)
    print(f"deployed {component} to {args.to}: {_next_command(args)}")
    return 0


def build_cpp_program(opened: LoadedProject, component: str, folder: Path, args: argparse.Namespace) -> None:
    """Write all files of a C++ program to a folder.

    Raises:
        OSError: The project has no C++ program.
        UnsoundDesignError: A design cannot be generated.
    """
    from vicode.cli.deploy_cpp import write_cpp_program

    generated = Path(opened.open_project.project.generated).parts[:1]
    _copy_hand_written(opened.open_project.folder, folder, generated)
    program = write_cpp_program(opened, component, folder)
    command = f"{program.launch} {args.arguments or ''}".rstrip()
    _write_launcher(folder, program.package, component, command, target=args.to)


def _next_command(args: argparse.Namespace) -> str:
    """What to do after a deployment; a C++ program on this machine is built if that is possible."""
    from vicode.cli.deploy_cpp import BUILD_SCRIPT, build_here

    start = f"start it with {_command_at(args.to, 'run')}"
    if args.language != "cpp" or (not _is_remote(args.to) and build_here(Path(args.to))):
        return start
    return f"build it with {_command_at(args.to, BUILD_SCRIPT)}, then {start}"


def build_program(opened: LoadedProject, component: str, folder: Path, args: argparse.Namespace) -> None:
    """Write all files of the program to a folder.

    Raises:
        OSError: A hand-written folder has the name of a generated package.
    """
    from vicode.generators import generate, python_class_path

    project = opened.open_project.project
    files = generate(
        project, components=[component], languages=["python"], standalone=True, sources=opened.design_paths
    )
    _copy_hand_written(opened.open_project.folder, folder, Path(project.generated).parts[:1])
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
    arguments = default if args.arguments is None else args.arguments
    command = f"exec {shlex.quote(args.python)} -m {package} {shlex.quote(name)} {arguments}".rstrip()
    comment = "# Ctrl-C and SIGTERM close the components and the world.\n"
    _write_launcher(folder, package, name, command, target=args.to, comment=comment)


def _component_name(opened: LoadedProject, component: str) -> str:
    """The name of a root component on the command line of its package."""
    agents = (agent.name for agent in opened.open_project.project.agents if agent.root == component)
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
    place = target.partition(":")[2] if _is_remote(target) else str(Path(target).resolve())
    escaped = place.replace("%", "%%")
    return escaped if escaped.startswith("/") else f"%h/{escaped.removeprefix('~/')}"


def _list_files(folder: Path) -> Iterator[str]:
    return iter(sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()))


def _is_remote(target: str) -> bool:
    head = target.partition(":")[0]
    return ":" in target and "/" not in head


def _command_at(target: str, script: str) -> str:
    if _is_remote(target):
        host, place = _split(target)
        # With a terminal (-t), Ctrl-C reaches the program; without one, it would go on when ssh ends.
        return f"ssh -t {host} {shlex.quote(shlex.quote(f'{place}/{script}'))}"
    return shlex.quote(str(Path(target, script)))


def _copy(folder: Path, target: str) -> None:
    """Copy a program to its folder, here or over ssh.

    Raises:
        OSError: The folder has other files, or a program for copying is missing or fails.
    """
    if _is_remote(target):
        _copy_over_ssh(folder, target)
    else:
        _copy_here(folder, Path(target))


def _copy_here(folder: Path, target: Path) -> None:
    if target.exists() and not target.is_dir():
        raise OSError(f"{target} is not a folder")
    if target.is_dir() and any(target.iterdir()) and not (target / DEPLOYED_MARKER).is_file():
        raise OSError(f"{target} has files that vicode did not deploy; choose an empty folder")
    target.mkdir(parents=True, exist_ok=True)
    for path in target.iterdir():
        # With the marker, a deployment that was interrupted can be repeated.
        if path.name in (_KEPT_FOLDER, DEPLOYED_MARKER):
            continue
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
        else:
            path.unlink()
    shutil.copytree(folder, target, dirs_exist_ok=True)


def _split(target: str) -> tuple[str, str]:
    """The host and the folder of a remote target; ssh starts in the home folder."""
    host, _colon, place = target.partition(":")
    place = place.removeprefix("~/").rstrip("/") or place[:1]
    if not place or place.startswith(("~", "-")) or host.startswith("-"):
        raise OSError(f"invalid target '{target}'; write user@host:folder, from the home folder or from /")
    return host, place


def _copy_over_ssh(folder: Path, target: str) -> None:
    host, place = _split(target)
    quoted = shlex.quote(place)
    checks = (
        f"mkdir -p {quoted} && cd {quoted} || exit {_NO_FOLDER}",
        f'test -e {DEPLOYED_MARKER} || test -z "$(ls -A)" || exit {_HAS_FILES}',
        f"command -v rsync > /dev/null || exit {_NO_RSYNC}",
    )
    code = _call(["ssh", "--", host, "; ".join(checks)])
    if code == _NO_FOLDER:
        raise OSError(f"the folder {place} cannot be created on {host}")
    if code == _HAS_FILES:
        raise OSError(f"{target} has files that vicode did not deploy; choose an empty folder")
    if code not in (0, _NO_RSYNC):
        raise OSError(f"{host} cannot be reached with ssh")
    if code == 0 and shutil.which("rsync"):
        # -s: a shell of the robot does not split or expand the name of the folder.
        copy = ["rsync", "-as", "--delete", f"--exclude=/{_KEPT_FOLDER}/", "--", f"{folder}/", f"{host}:{place}/"]
        failed = _call(copy)
    else:
        unpack = f"cd {quoted} && find . -mindepth 1 -maxdepth 1 ! -name {_KEPT_FOLDER} -exec rm -rf {{}} + && tar xf -"
        with subprocess.Popen(["tar", "cf", "-", "-C", str(folder), "."], stdout=subprocess.PIPE) as tar:
            failed = _call(["ssh", "--", host, unpack], stdin=tar.stdout)
    if failed:
        raise OSError(f"copying to {target} failed")


def _call(command: list[str], stdin: int | IO[bytes] | None = subprocess.DEVNULL) -> int:
    try:
        return subprocess.run(command, stdin=stdin, check=False).returncode
    except FileNotFoundError:
        raise OSError(f"the program {command[0]} is not installed") from None
