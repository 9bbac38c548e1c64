"""The process: reads a setup and requests from standard input, writes responses to its original standard output."""

from __future__ import annotations

import faulthandler
import logging
import os
import queue
import shutil
import signal
import sys
import threading
from collections.abc import Callable
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO

from vicode.bica import Component, CyclicUseError
from vicode.bica.errors import describe_exception, make_error_record
from vicode.bica.loader import UserCodeError, wrap_user_errors
from vicode.simulation.host import RunHost
from vicode.simulation.limits import CapturedOutput, TimeLimitError, limit_memory, time_limit
from vicode.simulation.messages import (
    Failed,
    Inspected,
    IterationResult,
    Ready,
    Request,
    Response,
    Setup,
    Stopped,
    decode_request,
    decode_setup,
    encode_response,
)
from vicode.simulation.stop_reasons import COUNT_REACHED, stop_reason

START_LIMIT_S = 60.0


def main() -> int:
    """Serve until the editor disconnects; returns 1 after a failure."""
    requests, answers = _claim_pipes()
    first = requests.readline()
    if not first:
        return 0
    setup = decode_setup(first)
    try:
        return _Worker(setup, answers).serve(_start_reader(requests, setup.folder))
    except BrokenPipeError:
        # The editor has disconnected, which the reader thread may not have noticed yet.
        return 0
    finally:
        _remove_folder(setup.folder)


def _claim_pipes() -> tuple[BinaryIO, BinaryIO]:
    """Keep the pipes private: user code reads nothing, and what it writes past Python goes to standard error."""
    requests = os.fdopen(os.dup(0), "rb")
    answers = os.fdopen(os.dup(1), "wb")
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.dup2(2, 1)
    faulthandler.enable(file=os.fdopen(os.dup(2), "wb"), all_threads=False)
    return requests, answers


def _start_reader(requests: BinaryIO, folder: str) -> queue.SimpleQueue[bytes]:
    """Read in a separate thread, which ends the process when the editor disconnects, whatever user code does."""
    lines: queue.SimpleQueue[bytes] = queue.SimpleQueue()

    def read() -> None:
        # The stack shown for a timeout must be that of the thread that runs user code.
        signals: Any = signal
        if hasattr(signal, "pthread_sigmask"):
            signals.pthread_sigmask(signals.SIG_BLOCK, {signal.SIGABRT})
        for line in requests:
            lines.put(line)
        _remove_folder(folder)
        os._exit(0)

    threading.Thread(target=read, daemon=True).start()
    return lines


def _remove_folder(folder: str) -> None:
    if folder:
        shutil.rmtree(folder, ignore_errors=True)


class _Worker:
    def __init__(self, setup: Setup, answers: BinaryIO) -> None:
        self._setup, self._output = setup, answers
        self._prints = CapturedOutput()
        self._host: RunHost | None = None
        self._result: IterationResult
        self._was_done = False

    def serve(self, lines: queue.SimpleQueue[bytes]) -> int:
        self._configure_process()
        failed = self._run_limited(START_LIMIT_S, self._start)
        while failed is None:
            request = decode_request(lines.get())
            failed = self._handle(request)
        self._send(failed)
        return 1

    def _configure_process(self) -> None:
        sys.stdout = sys.stderr = self._prints
        logging.basicConfig(level=logging.INFO, stream=self._prints, format="%(levelname)s %(name)s: %(message)s")
        sys.path[:0] = list(self._setup.path)
        limit_memory(self._setup.memory_bytes)

    def _start(self) -> None:
        self._host = RunHost(self._setup, self._prints)
        self._send(Ready())

    def _handle(self, request: Request) -> Failed | None:
        failed = self._run_limited(self._setup.limit_s, lambda: self._apply_inputs(request))
        return failed if request.kind == "inspect" or failed is not None else self._run(request)

    def _run(self, request: Request) -> Failed | None:
        reason = COUNT_REACHED
        iteration: IterationResult | None = None
        for index in range(request.count):
            failed = self._run_limited(self._setup.limit_s, partial(self._step, request, index))
            if failed is not None:
                return failed
            iteration = self._result
            stop = stop_reason(iteration, request.stops, was_done=self._was_done)
            self._was_done = iteration.done
            if request.suppress_events:
                continue
            self._send(iteration)
            if stop and not request.script:
                reason = stop
                break
        if request.suppress_events and iteration is not None:
            self._send(iteration)
        self._send(Stopped(reason=reason))
        return None

    def _step(self, request: Request, index: int) -> None:
        if index < len(request.script):
            self._running.set_inputs(request.script[index])
        self._result = self._running.step(request.times_ns[index] if index < len(request.times_ns) else None)

    @property
    def _running(self) -> RunHost:
        assert self._host is not None
        return self._host

    def _apply_inputs(self, request: Request) -> None:
        if request.start is None:
            self._running.set_inputs(request.inputs)
        else:
            self._running.continue_from(request.start, request.inputs)
        if request.kind == "inspect":
            self._send(Inspected(guards=self._running.evaluate_guards()))

    def _run_limited(self, limit_s: float, do: Callable[[], None]) -> Failed | None:
        """Run code that may call user code; returns the failure, if any."""
        try:
            with time_limit(limit_s), wrap_user_errors("the world failed", only_user_code=True):
                do()
        except TimeLimitError as error:
            words = f"did not end within {limit_s:g} s; it may contain an endless loop"
            return self._failed(error, words)
        except (UserCodeError, CyclicUseError) as error:
            return Failed(message=str(error), prints=self._prints.drain()[0])
        except SystemExit as error:
            return self._failed(error, f"ended the program with {describe_exception(error)}")
        except (KeyboardInterrupt, MemoryError, RecursionError) as error:
            return self._failed(error, describe_exception(error))
        return None

    def _failed(self, error: BaseException, words: str) -> Failed:
        """A failure with the location in the design, if a component was running."""
        lines, _left_out = self._prints.drain()
        component = _find_component(error)
        if component is None:
            return Failed(message=f"code outside of all components {words}{_user_code_location(error)}", prints=lines)
        record = make_error_record(component, error)
        return Failed(message=words, error={**asdict(record), "message": words}, prints=lines)

    def _send(self, answer: Response) -> None:
        self._output.write(encode_response(answer))
        self._output.flush()


def _find_component(error: BaseException) -> Component | None:
    """The innermost component whose own code was running."""
    found = None
    traceback = error.__traceback__
    while traceback is not None:
        owner = traceback.tb_frame.f_locals.get("self")
        if isinstance(owner, Component) and traceback.tb_frame.f_globals.get("__package__") != "vicode.bica":
            found = owner
        traceback = traceback.tb_next
    return found


def _user_code_location(error: BaseException) -> str:
    """File and line of the innermost user code, in brackets."""
    place = ""
    traceback = error.__traceback__
    while traceback is not None:
        code = traceback.tb_frame.f_code
        if not str(traceback.tb_frame.f_globals.get("__package__")).startswith("vicode."):
            place = f" [{Path(code.co_filename).name}:{traceback.tb_lineno}]"
        traceback = traceback.tb_next
    return place
