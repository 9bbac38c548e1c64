"""Clients that never finish a request do not lock others out."""

import asyncio
import contextlib
from collections.abc import Awaitable, Callable
from typing import Any

import pytest
import uvicorn

from vicode.editor import connection_limits
from vicode.editor.connection_limits import LimitedHttpProtocol

REQUEST = b"GET / HTTP/1.1\r\nHost: x\r\n\r\n"


async def app(scope: Any, receive: Any, send: Any) -> None:
    """Answer after the whole body was received."""
    assert scope["type"] == "http"
    while (await receive()).get("more_body"):
        pass
    await send({"type": "http.response.start", "status": 200, "headers": [(b"content-length", b"2")]})
    await send({"type": "http.response.body", "body": b"ok"})


def serve(check: Callable[[int], Awaitable[None]]) -> None:
    async def run() -> None:
        server = uvicorn.Server(uvicorn.Config(app, port=0, http=LimitedHttpProtocol, lifespan="off", log_config=None))
        server.config.load()
        server.lifespan = server.config.lifespan_class(server.config)
        await server.startup()
        try:
            await check(server.servers[0].sockets[0].getsockname()[1])
        finally:
            await server.shutdown()

    asyncio.run(run())


async def answer(port: int, *parts: bytes) -> bytes:
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    for part in parts:
        writer.write(part)
        await writer.drain()
        await asyncio.sleep(0.01)
    try:
        return await reader.readuntil(b"ok")
    finally:
        writer.close()


async def is_closed(reader: asyncio.StreamReader) -> bool:
    with contextlib.suppress(ConnectionResetError):
        return await asyncio.wait_for(reader.read(), 30) == b""
    return True


@pytest.mark.parametrize(
    "unfinished", [b"", b"GET / HTTP/1.1\r\nHost: x\r\n", b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 9\r\n\r\nabc"]
)
def test_the_oldest_of_too_many_unfinished_requests_is_closed(
    monkeypatch: pytest.MonkeyPatch, unfinished: bytes
) -> None:
    monkeypatch.setattr(connection_limits, "MAX_UNFINISHED", 5)

    async def check(port: int) -> None:
        waiting = [await asyncio.open_connection("127.0.0.1", port) for _ in range(5)]
        for _reader, writer in waiting:
            writer.write(unfinished)
        await asyncio.sleep(0.05)
        assert b"200 OK" in await answer(port, REQUEST)
        assert sum([reader.at_eof() or reader.exception() is not None for reader, _writer in waiting]) == 1
        for _reader, writer in waiting:
            writer.close()

    serve(check)
    assert not LimitedHttpProtocol.unfinished


def test_an_unfinished_request_is_closed_in_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connection_limits, "REQUEST_TIMEOUT_S", 0.05)

    async def check(port: int) -> None:
        reader, writer = await asyncio.open_connection("127.0.0.1", port)
        writer.write(REQUEST[:-2])
        assert await is_closed(reader)
        writer.close()

    serve(check)


def test_a_slow_body_is_received() -> None:
    async def check(port: int) -> None:
        head = b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 6\r\n\r\n"
        assert b"200 OK" in await answer(port, head, b"abc", b"def")

    serve(check)
    assert not LimitedHttpProtocol.unfinished
