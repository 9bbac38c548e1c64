"""The process: reads a setup and requests from standard input, answers on what was its standard output."""

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
from pathlib import Path
from typing import BinaryIO

from vicode.bica import Component, CyclicUseError
from vicode.bica.errors import describe_exception, make_error_record
from vicode.bica.loading import UserCodeError, telling
from vicode.simulation.engine import Engine
from vicode.simulation.limits import Prints, TimeLimitError, limit_memory, time_limit
from vicode.simulation.messages import (
    Answer,
    Failed,
    Looked,
    Moment,
    Ready,
    Request,
    Rested,
    Setup,
    decode_request,
    decode_setup,
    encode_answer,
)
from vicode.simulation.resting import COUNT, reason_to_rest

START_LIMIT_S = 60.0


def main() -> int:
    """Serve until the other side hangs up; returns 1 after a failure."""
    requests, answers = _take_pipes()
    first = requests.readline()
    if not first:
        return 0
    setup = decode_setup(first)
    try:
        return _Worker(setup, answers).serve(_listen(requests, setup.folder))
    except BrokenPipeError:
        # The other side has gone, which the listening thread may not have heard yet.
        return 0
    finally:
        _clear(setup.folder)


def _take_pipes() -> tuple[BinaryIO, BinaryIO]:
    """Keep the pipes for ourselves: user code reads nothing, and what it writes past Python goes to standard error."""
    requests = os.fdopen(os.dup(0), "rb")
    answers = os.fdopen(os.dup(1), "wb")
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.dup2(2, 1)
    faulthandler.enable(file=os.fdopen(os.dup(2), "wb"), all_threads=False)
    return requests, answers


def _listen(requests: BinaryIO, folder: str) -> queue.SimpleQueue[bytes]:
    """Read in a thread of its own, which ends the process when the other side has gone, whatever user code does."""
    lines: queue.SimpleQueue[bytes] = queue.SimpleQueue()

    def read() -> None:
        # Who asks where the code is wants to hear of the thread that runs it.
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGABRT})
        for line in requests:
            lines.put(line)
        _clear(folder)
        os._exit(0)

    threading.Thread(target=read, daemon=True).start()
    return lines


def _clear(folder: str) -> None:
    if folder:
        shutil.rmtree(folder, ignore_errors=True)


class _Worker:
    def __init__(self, setup: Setup, answers: BinaryIO) -> None:
        self._setup, self._answers = setup, answers
        self._prints = Prints()
        self._engine: Engine | None = None
        self._moment: Moment
        self._was_done = False

    def serve(self, lines: queue.SimpleQueue[bytes]) -> int:
        self._settle()
        failed = self._guarded(START_LIMIT_S, self._start)
        while failed is None:
            request = decode_request(lines.get())
            failed = self._answer(request)
        self._say(failed)
        return 1

    def _settle(self) -> None:
        sys.stdout = sys.stderr = self._prints
        logging.basicConfig(level=logging.INFO, stream=self._prints, format="%(levelname)s %(name)s: %(message)s")
        sys.path[:0] = list(self._setup.path)
        limit_memory(self._setup.memory_bytes)

    def _start(self) -> None:
        self._engine = Engine(self._setup, self._prints)
        self._say(Ready())

    def _answer(self, request: Request) -> Failed | None:
        failed = self._guarded(self._setup.limit_s, lambda: self._take_inputs(request))
        return failed if request.do == "look" or failed is not None else self._run(request)

    def _run(self, request: Request) -> Failed | None:
        reason = COUNT
        moment: Moment | None = None
        for _step in range(request.count):
            failed = self._guarded(self._setup.limit_s, self._step)
            if failed is not None:
                return failed
            moment = self._moment
            stop = reason_to_rest(moment, request.stops, was_done=self._was_done)
            self._was_done = moment.done
            if request.quiet:
                continue
            self._say(moment)
            if stop:
                reason = stop
                break
        if request.quiet and moment is not None:
            self._say(moment)
        self._say(Rested(reason=reason))
        return None

    def _step(self) -> None:
        self._moment = self._running.step()

    @property
    def _running(self) -> Engine:
        assert self._engine is not None
        return self._engine

    def _take_inputs(self, request: Request) -> None:
        self._running.set_inputs(request.inputs)
        if request.do == "look":
            self._say(Looked(guards=self._running.look()))

    def _guarded(self, limit_s: float, do: Callable[[], None]) -> Failed | None:
        """Run what may call user code; returns what went wrong with it."""
        try:
            with time_limit(limit_s), telling("the world failed", only_users=True):
                do()
        except TimeLimitError as error:
            words = f"did not come to an end within {limit_s:g} s; it may run in a circle"
            return self._failed(error, words)
        except (UserCodeError, CyclicUseError) as error:
            return Failed(message=str(error), prints=self._prints.take()[0])
        except SystemExit as error:
            return self._failed(error, f"left the program by {describe_exception(error)}")
        except (KeyboardInterrupt, MemoryError, RecursionError) as error:
            return self._failed(error, describe_exception(error))
        return None

    def _failed(self, error: BaseException, words: str) -> Failed:
        """Say it with the place in the design, if a component was at work."""
        lines, _left_out = self._prints.take()
        component = _find_component(error)
        if component is None:
            return Failed(message=f"the code outside of all components {words}{_place(error)}", prints=lines)
        # Only the type says Exception; a record is made of its traceback.
        record = make_error_record(component, error)  # type: ignore[arg-type]
        return Failed(message=words, error={**asdict(record), "message": words}, prints=lines)

    def _say(self, answer: Answer) -> None:
        self._answers.write(encode_answer(answer))
        self._answers.flush()


def _find_component(error: BaseException) -> Component | None:
    """The component whose own code was at work deepest."""
    found = None
    traceback = error.__traceback__
    while traceback is not None:
        owner = traceback.tb_frame.f_locals.get("self")
        if isinstance(owner, Component) and traceback.tb_frame.f_globals.get("__package__") != "vicode.bica":
            found = owner
        traceback = traceback.tb_next
    return found


def _place(error: BaseException) -> str:
    """File and line of the deepest code that is not ours, in brackets."""
    place = ""
    traceback = error.__traceback__
    while traceback is not None:
        code = traceback.tb_frame.f_code
        if not str(traceback.tb_frame.f_globals.get("__package__")).startswith("vicode."):
            place = f" [{Path(code.co_filename).name}:{traceback.tb_lineno}]"
        traceback = traceback.tb_next
    return place
