"""A bridge in a few lines: turns each robot once around, in lock step, by the clock, or with the lines of JXI."""

import asyncio
import contextlib
import json
import ssl
import threading
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager, contextmanager


@asynccontextmanager
async def fake_bridge(
    *,
    greeting: bytes = b"Robot connection accepted\n",
    error: str = "",
    messages: float = float("inf"),
    received: list[str] | None = None,
    tls: ssl.SSLContext | None = None,
) -> AsyncIterator[int]:
    """Yield the port of a bridge that ends with the block; it closes connections after a number of messages."""
    tasks = []
    lines = [] if received is None else received

    async def serve(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        tasks.append(asyncio.current_task())
        with contextlib.suppress(ConnectionError):
            writer.write(greeting)
            await _drive(_Reader(reader, lines), writer, error, messages)
        with contextlib.suppress(ConnectionError):
            writer.close()
            await writer.wait_closed()

    server = await asyncio.start_server(serve, "127.0.0.1", 0, ssl=tls)
    try:
        yield server.sockets[0].getsockname()[1]
    finally:
        server.close()
        await asyncio.gather(*filter(None, tasks), return_exceptions=True)


@contextmanager
def fake_bridge_thread(received: list[str] | None = None) -> Iterator[int]:
    """Yield the port of a bridge that runs in a thread."""
    ports: list[int] = []
    started, ended = threading.Event(), asyncio.Event()
    loop = asyncio.new_event_loop()

    async def run() -> None:
        async with fake_bridge(received=received) as port:
            ports.append(port)
            started.set()
            await ended.wait()

    thread = threading.Thread(target=loop.run_until_complete, args=(run(),))
    thread.start()
    started.wait()
    try:
        yield ports[0]
    finally:
        loop.call_soon_threadsafe(ended.set)
        thread.join()
        loop.close()


class _Reader:
    """Reads lines and keeps them."""

    def __init__(self, reader: asyncio.StreamReader, lines: list[str]) -> None:
        self._reader, self._lines = reader, lines

    async def readline(self) -> bytes:
        line = await self._reader.readline()
        self._lines.append(line.decode().strip())
        return line


async def _drive(reader: _Reader, writer: asyncio.StreamWriter, error: str, messages: float) -> None:
    turned, yaw, drive, number = 0.0, None, None, 0
    while (line := await reader.readline()) and messages > 0:
        messages -= 1
        is_json = line.startswith(b"{")
        message = json.loads(line) if is_json else _read_jxi(line)
        if error and not is_json:
            writer.write(f"ERROR: {error}\n".encode())
        if "hello" in message:
            writer.write(_json({"error": error} if error else {"welcome": {"robot": message["hello"]["robot"]}}))
        if "INS" not in message:
            continue
        new = float(message["INS"][2])
        turned += 0.0 if yaw is None else (new - yaw + 180) % 360 - 180
        yaw, before, drive = new, drive, [0.1, 30] if turned < 360 else [0, 0]
        state = {"active": [["drive_circle", "turn" if drive[1] else "stop"]]}
        commands = {"DIFFERENTIALDRIVE": drive} if drive != before else {}
        if "tick" in message:
            writer.write(_json({"tick": message["tick"], "commands": commands, "state": state, "age_ms": 0}))
        elif is_json:
            number += 1
            writer.write(_json({"time": number, "commands": commands, "state": state, "age_ms": 1.5}))
        elif commands:
            writer.write(f"DIFFERENTIALDRIVE:{drive[0]},{drive[1]}\nUNKNOWN:?\n".encode())


def _json(message: object) -> bytes:
    return json.dumps(message).encode() + b"\n"


def _read_jxi(line: bytes) -> dict[str, list[str]]:
    target, _colon, values = line.decode().partition(":")
    return {target: values.split(",")}
