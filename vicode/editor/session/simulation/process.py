"""The process that runs user code, as seen from the editor: start, requests, time limit, kill."""

import asyncio
import contextlib
import os
import re
import shutil
import signal
import sys
import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from vicode.bica.errors import find_region
from vicode.editor.session.simulation.setup import PreparedRun
from vicode.output import apply_diffs, compare_files
from vicode.simulation import (
    Failed,
    Inputs,
    Inspected,
    IterationResult,
    ProtocolError,
    Ready,
    Request,
    Response,
    Stopped,
    decode_response,
    encode_request,
    encode_setup,
)
from vicode.simulation.environment import fresh_environment
from vicode.simulation.messages import MAX_MESSAGE_BYTES

_START_LIMIT_S = 75.0
_GRACE_S = 3.0
_QUIET_LIMIT_S = 120.0
_MAX_STDERR = 64_000
_FRAME = re.compile(r'File "(?P<file>[^"\n]+)", line (?P<line>\d+) in (?P<name>\S+)')

OnIteration = Callable[[IterationResult], None]


class RunFailedError(Exception):
    """The run cannot continue; `error` is the record with the location in the design, if known."""

    def __init__(self, message: str, error: dict[str, Any] | None = None, prints: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.message, self.error, self.prints = message, error, prints


class RunProcess:
    """A process that holds one component, created by `start_process`."""

    def __init__(self, process: asyncio.subprocess.Process, folder: Path, limit_s: float) -> None:
        self._process, self._folder, self._limit_s = process, folder, limit_s
        self._stderr_tail = b""
        self._is_killed = False
        self._listening = asyncio.create_task(self._read_stderr())

    @property
    def pid(self) -> int:
        return self._process.pid

    async def run(self, request: Request, on_iteration: OnIteration) -> Stopped:
        """Run iterations and call `on_iteration` for each.

        Raises:
            RunFailedError: The run cannot continue.
        """
        limit_s = _QUIET_LIMIT_S if request.suppress_events else self._limit_s + _GRACE_S
        await self._send(encode_request(request))
        while True:
            answer = await self._receive(limit_s)
            if isinstance(answer, Stopped):
                return answer
            if isinstance(answer, IterationResult):
                on_iteration(answer)

    async def evaluate_guards(self, inputs: Inputs) -> Inspected:
        """Set inputs and evaluate the guards, without a step.

        Raises:
            RunFailedError: The run cannot continue.
        """
        await self._send(encode_request(Request(kind="inspect", inputs=inputs)))
        answer = await self._receive(self._limit_s + _GRACE_S)
        if not isinstance(answer, Inspected):
            raise RunFailedError("Protocol error: unexpected response.")
        return answer

    async def wait_until_ready(self) -> None:
        """Wait until the code is loaded.

        Raises:
            RunFailedError: It cannot be loaded.
        """
        answer = await self._receive(_START_LIMIT_S)
        if not isinstance(answer, Ready):
            raise RunFailedError("Protocol error: unexpected first response.")

    def kill(self) -> None:
        """Kill the process group and remove its files."""
        if self._is_killed:
            return
        self._is_killed = True
        if self._process.stdin is not None:
            self._process.stdin.close()
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(self._process.pid, signal.SIGKILL)
        shutil.rmtree(self._folder, ignore_errors=True)

    async def wait_closed(self) -> None:
        """Wait until a killed process is cleaned up."""
        with contextlib.suppress(TimeoutError):
            await asyncio.wait_for(asyncio.gather(self._process.wait(), self._listening, self._drain()), 10)

    async def _drain(self) -> None:
        assert self._process.stdout is not None
        while await self._process.stdout.read(1 << 16):
            pass

    async def _send(self, line: bytes) -> None:
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(line)
            await self._process.stdin.drain()
        except (BrokenPipeError, ConnectionResetError) as error:
            raise await self._exit_error() from error

    async def _receive(self, limit_s: float) -> Response:
        assert self._process.stdout is not None
        try:
            line = await asyncio.wait_for(self._process.stdout.readline(), limit_s)
            answer = decode_response(line) if line else None
        except TimeoutError:
            raise await self._timeout_error(limit_s) from None
        except (ValueError, ProtocolError) as error:
            self.kill()
            raise RunFailedError(f"Protocol error: {error}") from error
        if answer is None:
            raise await self._exit_error()
        if isinstance(answer, Failed):
            raise RunFailedError(answer.message, answer.error, tuple(answer.prints))
        return answer

    async def _timeout_error(self, limit_s: float) -> RunFailedError:
        """Kill the process, after it has reported its stack."""
        with contextlib.suppress(ProcessLookupError):
            os.kill(self._process.pid, signal.SIGABRT)
        with contextlib.suppress(TimeoutError):
            await asyncio.wait_for(self._process.wait(), 1.0)
        await asyncio.sleep(0.05)
        error = RunFailedError(f"{self._code_location()}did not end within {limit_s:g} s and was killed")
        self.kill()
        return error

    async def _exit_error(self) -> RunFailedError:
        code = 0
        with contextlib.suppress(TimeoutError):
            code = await asyncio.wait_for(self._process.wait(), 2.0)
        await asyncio.sleep(0.05)
        words = f"was terminated by {signal.Signals(-code).name}" if code < 0 else f"exited with code {code}"
        tail = self._stderr_tail.decode(errors="replace").strip().splitlines()
        error = RunFailedError(f"{self._code_location()}{words}", prints=tuple(tail[-20:]))
        self.kill()
        return error

    def _code_location(self) -> str:
        """Design, region and line of the innermost user code, from the reported stack."""
        for found in _FRAME.finditer(self._stderr_tail.decode(errors="replace")):
            file, line = found["file"], int(found["line"])
            if "/vicode/" in file or file.startswith("<"):
                continue
            region, before = find_region(file, line)
            where = f"{region}, line {line - before}" if region else f"{found['name']}, line {line}"
            return f"{Path(file).stem}, {where}: "
        return "The code "

    async def _read_stderr(self) -> None:
        """Keep the end of what is written to standard error."""
        assert self._process.stderr is not None
        while chunk := await self._process.stderr.read(4096):
            self._stderr_tail = (self._stderr_tail + chunk)[-_MAX_STDERR:]


async def start_process(prepared: PreparedRun, cwd: Path) -> RunProcess:
    """Write the files of a prepared run into a private folder and start a process.

    Raises:
        RunFailedError: The code cannot be loaded.
        OSError: A file cannot be written, or the process cannot be started.
    """
    folder = Path(tempfile.mkdtemp(prefix="vicode-simulation-"))
    await asyncio.to_thread(lambda: apply_diffs(compare_files(prepared.files, folder), folder))
    # -P: modules in the current folder must not shadow others. The hash seed determines the order of sets.
    process = await asyncio.create_subprocess_exec(
        *(sys.executable, "-P", "-m", "vicode.simulation"),
        stdin=asyncio.subprocess.PIPE,
        stdout=asyncio.subprocess.PIPE,
        stderr=asyncio.subprocess.PIPE,
        limit=2 * MAX_MESSAGE_BYTES,
        cwd=cwd,
        env=fresh_environment(PYTHONDONTWRITEBYTECODE="1", PYTHONHASHSEED="0"),
        start_new_session=True,
    )
    runner = RunProcess(process, folder, prepared.setup.limit_s)
    try:
        path = (str(folder / "python"), *prepared.setup.path)
        setup = replace(prepared.setup, path=path, folder=str(folder))
        await runner._send(encode_setup(setup))
        await runner.wait_until_ready()
    except BaseException:
        runner.kill()
        await runner.wait_closed()
        raise
    return runner
