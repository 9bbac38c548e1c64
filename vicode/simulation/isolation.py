"""Whether and how a simulation is isolated from the machine; see `vicode.simulation.launcher`."""

import ctypes
import functools
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from vicode.simulation.launcher import LaunchConfig

SANDBOX_VARIABLE = "VICODE_SANDBOX"
_PROBE_TIMEOUT_S = 20.0
_LAUNCHER = Path(__file__).resolve().with_name("launcher.py")


@functools.cache
def isolation_problem() -> str:
    """Why simulations are not isolated on this machine, or "" if they are; takes a tenth of a second once."""
    if os.environ.get(SANDBOX_VARIABLE) == "off":
        return f"{SANDBOX_VARIABLE} is off"
    if not has_launcher():
        return "this system has no sandbox for it"
    temporary = make_temporary()
    probe = launch_command([sys.executable, "-I", "-S", "-c", ""], (), temporary, is_isolated=True)
    try:
        # The sandbox of the probe does not contain the current folder.
        done = subprocess.run(
            probe, cwd="/", stdin=subprocess.DEVNULL, capture_output=True, timeout=_PROBE_TIMEOUT_S, check=False
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        return str(error)
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
    reason = done.stderr.decode(errors="replace").strip().split("\n")[-1]
    return "" if done.returncode == 0 else f"this system has no user namespaces for it ({reason[:100]})"


@functools.cache
def has_launcher() -> bool:
    """Whether the system ends what a program has started when the program ends: Linux."""
    return hasattr(os, "fork") and hasattr(ctypes.CDLL(None), "prctl")


def make_temporary() -> Path:
    """Create the temporary folder of a program."""
    folder = Path(tempfile.mkdtemp(prefix="vicode-simulation-")).resolve()
    for name in ("files", "root"):
        (folder / name).mkdir()
    return folder


def launch_command(command: list[str], readable: tuple[str, ...], temporary: Path, *, is_isolated: bool) -> list[str]:
    """The command that starts another one, which ends with all its descendants where the system has a launcher.

    Args:
        command: the program with its arguments.
        readable: the folders that an isolated program may read, besides Python.
        temporary: the folder of `make_temporary`: it may write to `files`; removed unless
            the program fails.
        is_isolated: whether it runs in a sandbox.
    """
    if not has_launcher():
        return command
    paths = sorted({os.path.realpath(path) for path in (*readable, *_python_folders())} | {*readable})
    config: LaunchConfig = {
        "command": command,
        "is_isolated": is_isolated,
        "readable": paths,
        "writable": [str(temporary / "files")],
        "root": str(temporary / "root"),
        "temporary": str(temporary),
    }
    # Without the modules of site-packages it starts in a fraction of the time.
    return [sys.executable, "-I", "-S", str(_LAUNCHER), json.dumps(config)]


def _python_folders() -> tuple[str, ...]:
    """The interpreter, and where it finds modules; the first entry is that of the program that runs now."""
    given = sys.path if sys.flags.safe_path else sys.path[1:]
    given = [*given, *os.environ.get("PYTHONPATH", "").split(os.pathsep), str(Path(__file__).parents[2])]
    return (sys.prefix, sys.base_prefix, *(path for path in given if path and Path(path).is_dir()))
