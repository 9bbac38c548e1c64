"""Runs a component by the protocol of the simulation, over any transport."""

import asyncio
from collections.abc import Callable
from typing import Any, Protocol

from vicode.simulation import (
    Failed,
    Inputs,
    Inspected,
    IterationResult,
    ProtocolError,
    Ready,
    Request,
    Response,
    Setup,
    Stopped,
    decode_response,
    encode_request,
    encode_setup,
)

_START_LIMIT_S = 75.0
_GRACE_S = 3.0
_QUIET_LIMIT_S = 120.0

OnIteration = Callable[[IterationResult], None]


class RunFailedError(Exception):
    """The run cannot continue; `error` is the record with the location in the design, if known."""

    def __init__(self, message: str, error: dict[str, Any] | None = None, prints: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.message, self.error, self.prints = message, error, prints


class Transport(Protocol):
    """Carries lines of the protocol (`vicode.simulation.messages`) to and from the program that runs a component."""

    async def send(self, line: bytes) -> None:
        """Send a line.

        Raises:
            ConnectionError: The program has ended.
        """

    async def receive(self) -> bytes:
        """Receive a line; empty after the program has ended.

        Raises:
            ValueError: The line is too long.
        """

    async def interrupt(self) -> str:
        """Stop code that does not end, and return its location, such as "lamp, Lit.actions, line 2", or ""."""

    async def explain_end(self) -> tuple[str, tuple[str, ...]]:
        """Explain why the program has ended, such as "The code exited with code 3", with its last output."""

    def close(self) -> None:
        """End the program and release what belongs to it."""

    async def wait_closed(self) -> None:
        """Wait until `close` has taken effect."""


class RunClient:
    """Runs one component behind a transport; `limit_s` is the time limit of a step."""

    def __init__(self, transport: Transport, limit_s: float) -> None:
        self.transport, self._limit_s = transport, limit_s
        self.close, self.wait_closed = transport.close, transport.wait_closed

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
        return await self.run_inspection(Request(kind="inspect", inputs=inputs))

    async def run_inspection(self, request: Request) -> Inspected:
        """Answer a request without a step.

        Raises:
            RunFailedError: The run cannot continue.
        """
        await self._send(encode_request(request))
        answer = await self._receive(self._limit_s + _GRACE_S)
        if not isinstance(answer, Inspected):
            raise RunFailedError("Protocol error: unexpected response.")
        return answer

    async def set_up(self, setup: Setup) -> None:
        """Send the setup and wait until the code is loaded.

        Raises:
            RunFailedError: It cannot be loaded.
        """
        await self._send(encode_setup(setup))
        answer = await self._receive(_START_LIMIT_S)
        if not isinstance(answer, Ready):
            raise RunFailedError("Protocol error: unexpected first response.")

    async def _send(self, line: bytes) -> None:
        try:
            await self.transport.send(line)
        except ConnectionError as error:
            raise await self._end_error() from error

    async def _receive(self, limit_s: float) -> Response:
        try:
            line = await asyncio.wait_for(self.transport.receive(), limit_s)
            answer = decode_response(line) if line else None
        except TimeoutError:
            place = await self.transport.interrupt()
            self.close()
            subject = f"{place}: " if place else "The code "
            raise RunFailedError(f"{subject}did not end within {limit_s:g} s and was killed") from None
        except (ValueError, ProtocolError) as error:
            self.close()
            raise RunFailedError(f"Protocol error: {error}") from error
        if answer is None:
            raise await self._end_error()
        if isinstance(answer, Failed):
            raise RunFailedError(answer.message, answer.error, tuple(answer.prints))
        return answer

    async def _end_error(self) -> RunFailedError:
        message, prints = await self.transport.explain_end()
        self.close()
        return RunFailedError(message, prints=prints)
