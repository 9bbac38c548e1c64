"""A bridge in a separate process, for the time of an experiment."""

import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import psutil

from vicode.platform import session_options
from vicode.simulation.environment import fresh_environment

_ADDRESS = re.compile(r"127\.0\.0\.1:(\d+)")
_PEAK_MEMORY = re.compile(r"VmHWM:\s+(\d+) kB")
_END_TIMEOUT_S = 10.0


class BridgeStartError(Exception):
    """The bridge did not start; the text is what it printed."""


@dataclass(slots=True)
class BridgeUse:
    """The port of a running bridge; after it has ended, the processor time that it took, and its peak memory."""

    port: int
    cpu_s: float = 0.0
    memory_mb: float = 0.0


@contextmanager
def running_bridge(arguments: Sequence[str]) -> Iterator[BridgeUse]:
    """Run `vicode bridge` with arguments on a free port.

    Raises:
        BridgeStartError: It ended before it listened.
    """
    command = [sys.executable, "-P", "-m", "vicode", "bridge", *arguments, "--port", "0"]
    with tempfile.TemporaryFile() as errors:
        # In a separate session, the bridge does not receive Ctrl-C from the terminal; it ends with the block.
        process = subprocess.Popen(
            command,
            stdout=subprocess.PIPE,
            stderr=errors,
            stdin=subprocess.DEVNULL,
            env=fresh_environment(),
            **session_options(),
        )
        try:
            use = BridgeUse(_read_port(process))
            yield use
            use.memory_mb = _read_peak_memory(process.pid)
            times = psutil.Process(process.pid).cpu_times()
            use.cpu_s = times.user + times.system
        except BridgeStartError as error:
            process.wait(_END_TIMEOUT_S)
            errors.seek(0)
            raise BridgeStartError(f"{error}\n{errors.read().decode(errors='replace')}".strip()) from None
        finally:
            _end(process)


def _read_port(process: subprocess.Popen[bytes]) -> int:
    assert process.stdout is not None
    printed = ""
    for line in process.stdout:
        printed += line.decode(errors="replace")
        if match := _ADDRESS.search(printed):
            return int(match.group(1))
    raise BridgeStartError(f"the bridge did not start: {printed}")


def _read_peak_memory(process_id: int) -> float:
    """The peak memory of a process in MB, 0 where the system does not tell.

    The resource usage of a child is no alternative: it counts the memory of its parent until the program starts.
    """
    try:
        status = Path(f"/proc/{process_id}/status").read_text(encoding="utf-8")
    except OSError:
        return 0.0
    match = _PEAK_MEMORY.search(status)
    return int(match.group(1)) / 1024 if match else 0.0


def _end(process: subprocess.Popen[bytes]) -> None:
    process.terminate()
    try:
        process.wait(_END_TIMEOUT_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
    if process.stdout is not None:
        process.stdout.close()
