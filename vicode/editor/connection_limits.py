"""Limits on unfinished requests, so that clients that never finish one do not lock others out."""

import asyncio
from typing import Any

from uvicorn.protocols.http.auto import AutoHTTPProtocol

from vicode.platform import limit_resource

REQUEST_TIMEOUT_S = 10.0
MAX_UNFINISHED = 256


class LimitedHttpProtocol(AutoHTTPProtocol):  # type: ignore[misc, valid-type]
    """Closes a connection whose request is not received in time, or the oldest of too many such connections.

    Checked with uvicorn 0.54: `cycle` is the request whose headers were received last.
    """

    unfinished: "dict[LimitedHttpProtocol, asyncio.TimerHandle]" = {}  # noqa: RUF012 - shared by all connections

    def connection_made(self, transport: Any) -> None:
        super().connection_made(transport)
        self._wait()
        if len(self.unfinished) > MAX_UNFINISHED:
            next(iter(self.unfinished))._close()

    def data_received(self, data: bytes) -> None:
        super().data_received(data)
        cycle = self.cycle
        if cycle is not None and not cycle.response_complete and cycle.more_body:
            # A body may take long, but data must arrive.
            self._stop_waiting()
            self._wait()
        elif (cycle is not None and not cycle.response_complete) or self.transport.get_protocol() is not self:
            self._stop_waiting()
        elif self not in self.unfinished:
            self._wait()

    def connection_lost(self, exc: Exception | None) -> None:
        self._stop_waiting()
        super().connection_lost(exc)

    def _wait(self) -> None:
        self.unfinished[self] = self.loop.call_later(REQUEST_TIMEOUT_S, self._close)

    def _stop_waiting(self) -> None:
        timer = self.unfinished.pop(self, None)
        if timer is not None:
            timer.cancel()

    def _close(self) -> None:
        self._stop_waiting()
        self.transport.abort()


def raise_file_limit() -> None:
    """Allow as many open connections as the system permits."""
    limit_resource("RLIMIT_NOFILE")
