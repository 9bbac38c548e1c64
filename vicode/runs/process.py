"""The transport to a process on this machine: start, pipes, stack of stuck code, kill."""

import asyncio
import contextlib
import os
import re
import shutil
import signal
import sys
from dataclasses import replace
from pathlib import Path

from vicode.bica.errors import find_region
from vicode.output import apply_diffs, compare_files
from vicode.platform import kill_session, session_options
from vicode.runs.client import RunClient
from vicode.runs.setup import PreparedRun
from vicode.simulation.environment import fresh_environment
from vicode.simulation.isolation import has_launcher, isolation_problem, launch_command, make_temporary
from vicode.simulation.messages import MAX_MESSAGE_BYTES

_MAX_STDERR = 64_000
_FRAME = re.compile(r'File "(?P<file>[^"\n]+)", line (?P<line>\d+) in (?P<name>\S+)')


class ProcessTransport:
    """The standard streams of a process; `folder` holds its files and is removed with it."""

    def __init__(self, process: asyncio.subprocess.Process, folder: Path) -> None:
        self.process, self.folder = process, folder
        self._stderr_tail = b""
        self._is_closed = False
        self._listening = asyncio.create_task(self._read_stderr())

    async def send(self, line: bytes) -> None:
        assert self.process.stdin is not None
        self.process.stdin.write(line)
        await self.process.stdin.drain()

    async def receive(self) -> bytes:
        assert self.process.stdout is not None
        return await self.process.stdout.readline()

    async def interrupt(self) -> str:
        """Make the process report its stack."""
        with contextlib.suppress(ProcessLookupError):
            os.kill(self.process.pid, signal.SIGABRT)
        with contextlib.suppress(TimeoutError):
            await asyncio.wait_for(self.process.wait(), 1.0)
        await asyncio.sleep(0.05)
        return self._code_location()

    async def explain_end(self) -> tuple[str, tuple[str, ...]]:
        code = 0
        with contextlib.suppress(TimeoutError):
            code = await asyncio.wait_for(self.process.wait(), 2.0)
        await asyncio.sleep(0.05)
        words = f"was terminated by {signal.Signals(-code).name}" if code < 0 else f"exited with code {code}"
        tail = self._stderr_tail.decode(errors="replace").strip().splitlines()
        place = self._code_location()
        return f"{place}: {words}" if place else f"The code {words}", tuple(tail[-20:])

    def close(self) -> None:
        """Kill the process with all its descendants and remove its files."""
        if self._is_closed:
            return
        self._is_closed = True
        if self.process.stdin is not None:
            self.process.stdin.close()
        if has_launcher():
            # It kills all descendants, also those in other process groups.
            with contextlib.suppress(ProcessLookupError, PermissionError):
                os.kill(self.process.pid, signal.SIGTERM)
        else:
            kill_session(self.process.pid)
        shutil.rmtree(self.folder, ignore_errors=True)

    async def wait_closed(self) -> None:
        """Wait until a killed process is cleaned up."""
        with contextlib.suppress(TimeoutError):
            await asyncio.wait_for(asyncio.gather(self.process.wait(), self._listening, self._drain()), 10)
        kill_session(self.process.pid)

    async def _drain(self) -> None:
        assert self.process.stdout is not None
        while await self.process.stdout.read(1 << 16):
            pass

    def _code_location(self) -> str:
        """Design, region and line of the innermost user code, from the reported stack; "" if unknown."""
        for found in _FRAME.finditer(self._stderr_tail.decode(errors="replace")):
            file, line = found["file"], int(found["line"])
            if "vicode" in Path(file).parts or file.startswith("<"):
                continue
            region, before = find_region(file, line)
            where = f"{region}, line {line - before}" if region else f"{found['name']}, line {line}"
            return f"{Path(file).stem}, {where}"
        return ""

    async def _read_stderr(self) -> None:
        """Read standard error and keep the end of it."""
        assert self.process.stderr is not None
        while chunk := await self.process.stderr.read(4096):
            self._stderr_tail = (self._stderr_tail + chunk)[-_MAX_STDERR:]


async def start_process(prepared: PreparedRun, cwd: Path) -> RunClient:
    """Write the files of a prepared run into a private folder and start a process.

    Raises:
        RunFailedError: The code cannot be loaded.
        OSError: A file cannot be written, or the process cannot be started.
    """
    whole = make_temporary()
    folder = whole / "files"
    await asyncio.to_thread(lambda: apply_diffs(compare_files(prepared.files, folder), folder))
    transport = await launch_module("vicode.simulation", whole, prepared.setup.path, cwd)
    client = RunClient(transport, prepared.setup.limit_s)
    try:
        path = (str(folder / "python"), *prepared.setup.path)
        await client.set_up(replace(prepared.setup, path=path, folder=str(folder)))
    except BaseException:
        client.close()
        await client.wait_closed()
        raise
    return client


async def launch_module(
    module: str, whole: Path, readable: tuple[str, ...], cwd: Path, **environment: str
) -> ProcessTransport:
    """Start a module that runs user code, in a sandbox where the system has one.

    Args:
        module: The module of vicode.
        whole: The folder of `make_temporary`.
        readable: The folders that it may read, besides `cwd`.
        cwd: The current folder.
        environment: Variables to set.

    Raises:
        OSError: The process cannot be started.
    """
    is_isolated = not await asyncio.to_thread(isolation_problem)
    # -P: modules in the current folder must not shadow others. The hash seed determines the order of sets.
    process = await asyncio.create_subprocess_exec(
        *launch_command(
            [sys.executable, "-P", "-m", module], (*readable, str(cwd.resolve())), whole, is_isolated=is_isolated
        ),
        stdin=asyncio.subprocess.PIPE,
        stdout=asyncio.subprocess.PIPE,
        stderr=asyncio.subprocess.PIPE,
        limit=2 * MAX_MESSAGE_BYTES,
        cwd=cwd,
        env=fresh_environment(PYTHONDONTWRITEBYTECODE="1", PYTHONHASHSEED="0", **environment),
        **session_options(),
    )
    return ProcessTransport(process, whole)
