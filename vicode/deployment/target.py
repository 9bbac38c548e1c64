"""The folder of a deployed program, on this machine or on a robot: copies over ssh, and the commands to type there."""

import shlex
import shutil
import subprocess
from pathlib import Path
from typing import IO

from vicode.store.projects import DEPLOYED_MARKER

_KEPT_FOLDER = "log"
_NO_FOLDER, _HAS_FILES, _NO_RSYNC = 11, 12, 13
"""Exit codes of the checks on the robot."""


def copy_program(folder: Path, target: str) -> None:
    """Copy a program to its folder, here or over ssh.

    Raises:
        OSError: The folder has other files, or a program for copying is missing or fails.
    """
    if is_remote(target):
        _copy_over_ssh(folder, target)
    else:
        _copy_here(folder, Path(target))


def is_remote(target: str) -> bool:
    head = target.partition(":")[0]
    return ":" in target and "/" not in head


def command_at(target: str, script: str) -> str:
    if is_remote(target):
        host, place = _split(target)
        # With a terminal (-t), Ctrl-C reaches the program; without one, it would go on when ssh ends.
        return f"ssh -t {host} {shlex.quote(shlex.quote(f'{place}/{script}'))}"
    return shlex.quote(str(Path(target, script)))


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
