"""Many users on one design: the latency of edits in other windows, lost edits, memory.

Run `python -m benchmarks.collaboration [CLIENTS] [SECONDS]`. The clients are sockets that use the protocol of the
pages, in one separate process: fifty real browsers would measure the machine, not the server. Each client moves its
own state.
"""

import asyncio
import contextlib
import html
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
import uuid
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from typing import Any

import aiohttp
import socketio

ROOT = Path(__file__).parents[1]
PAGE = "design/forward/Player"
PAUSE_S = 2.0
FIRST_MARK = 100_000
# A window that is closed is forgotten after a minute.
FORGET_S = 80.0


@dataclass
class LatencyLog:
    """What was sent when, and how long each edit took to each window."""

    sent_s: dict[int, float] = field(default_factory=dict)
    took_s: list[float] = field(default_factory=list)
    errors: list[str] = field(default_factory=list)
    disconnected: list[str] = field(default_factory=list)
    last_event_s: float = 0.0

    async def wait_until_idle(self, quiet_s: float = 1.5, most_s: float = 120.0) -> None:
        """Wait until nothing has come for a while: opening fifty windows is another thing than working in them."""
        end_s = time.perf_counter() + most_s
        self.last_event_s = time.perf_counter()
        while time.perf_counter() - self.last_event_s < quiet_s and time.perf_counter() < end_s:
            await asyncio.sleep(0.1)

    def next_mark(self) -> int:
        """A number that no other edit has; it travels as a coordinate."""
        number = FIRST_MARK + len(self.sent_s)
        self.sent_s[number] = time.perf_counter()
        return number


@dataclass(frozen=True)
class Result:
    """What came of it; times in milliseconds, memory in megabytes."""

    edits: int
    seen: int
    median_ms: float
    p95_ms: float
    lost: list[str]
    errors: list[str]
    memory_mb: tuple[float, float, float]


class Client:
    """One window without a browser."""

    def __init__(self, url: str, number: int, watch: LatencyLog) -> None:
        self.url, self.name, self.log = url, f"C{number}", watch
        self.socket = socketio.AsyncClient(reconnection=False)
        self.socket.on("*", self._on_event)
        self.socket.on("disconnect", lambda *_reason: watch.disconnected.append(self.name))
        self.scene: dict[str, Any] = {}
        self.last: tuple[int, int] | None = None
        self.loaded = asyncio.Event()
        self.rev = 0

    async def connect(self) -> None:
        """Ask for the page, and connect as its script would."""
        async with aiohttp.ClientSession() as session, session.get(self.url + PAGE) as response:
            text = await response.text()
        found = re.search(r"parseElements\(String\.raw`(.*?)`\)", text, re.DOTALL)
        known = re.search(r"'client_id': '([^']+)'", text)
        assert found
        assert known
        elements = json.loads(html.unescape(found[1]))
        self.client_id = known[1]
        self.canvas, events = next(
            (int(key), each["events"])
            for key, each in elements.items()
            if any(event["type"] == "gesture" for event in each.get("events", ()))
        )
        self.listeners = {event["type"]: event["listener_id"] for event in events}
        query = f"client_id={self.client_id}&next_message_id=0&implicit_handshake=true"
        query += f"&tab_id={uuid.uuid4()}&document_id={uuid.uuid4()}"
        await self.socket.connect(
            f"{self.url}?{query}", transports=["websocket"], socketio_path="/_nicegui_ws/socket.io", wait_timeout=30
        )
        # What is said before the handshake is done is not heard.
        for _attempt in range(20):
            await self._emit("ready", {})
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(self.loaded.wait(), 5)
                return

    async def create_own_state(self) -> None:
        """Create the state that this window moves."""
        await self._gesture({"kind": "create", "x": 0, "y": 0, "name": self.name})

    async def move_state_repeatedly(self, until_s: float) -> None:
        """Move the own state now and then."""
        while time.perf_counter() < until_s:
            await asyncio.sleep(random.uniform(0.5, 1.5) * PAUSE_S)
            x = self.log.next_mark()
            self.last = (x, random.randrange(1000))
            item = {"of": "states", "id": self.name, "x": self.last[0], "y": self.last[1]}
            await self._gesture({"kind": "move", "items": [item], "how": "drag"})

    async def disconnect(self) -> None:
        """Close the window; what it could no longer say does not matter then."""
        with contextlib.suppress(TimeoutError):
            await asyncio.wait_for(self.socket.disconnect(), 5)

    async def _gesture(self, payload: dict[str, Any]) -> None:
        await self._emit("gesture", {**payload, "rev": self.rev, "seq": 0})

    async def _emit(self, event: str, payload: dict[str, Any]) -> None:
        message = {
            "id": self.canvas,
            "client_id": self.client_id,
            "listener_id": self.listeners[event],
            "args": [json.dumps(payload)],
        }
        await self.socket.emit("event", message)

    async def _on_event(self, event: str, data: Any = None) -> None:
        if event != "run_javascript":
            return
        code, now_s = str(data.get("code", "")), time.perf_counter()
        self.log.last_event_s = now_s
        if "presence.show" in code:
            await self._emit("presencePainted", {})
        revs = re.findall(r'"rev":(\d+)', code)
        self.rev = int(revs[-1]) if revs else self.rev
        if '"load"' in code:
            places = re.findall(r'"id":"(C\d+)".*?"x":([\d.]+),"y":([\d.]+)', code)
            self.scene = {name: (float(x), float(y)) for name, x, y in places}
            self.loaded.set()
        if '"apply"' in code:
            for mark in re.findall(r'"x":(\d{6,})', code):
                if int(mark) in self.log.sent_s:
                    self.log.took_s.append(now_s - self.log.sent_s[int(mark)])


async def measure(url: str, pid: int, clients: int, seconds: float, forget_s: float = FORGET_S) -> Result:
    """Let clients work for some time, and look whether all of it is there."""
    watch = LatencyLog()
    before = _memory_mb(pid)
    people = [Client(url, number, watch) for number in range(clients)]
    for client in people:
        await client.connect()
    begun = await asyncio.gather(*(client.create_own_state() for client in people), return_exceptions=True)
    watch.errors += [f"{client.name}: {each!r}" for client, each in zip(people, begun, strict=True) if each is not None]
    people = [client for client, each in zip(people, begun, strict=True) if each is None]
    # A server that builds fifty forms is silent for a while, and not at rest.
    await watch.wait_until_idle(quiet_s=1.5 + clients / 10)
    until_s = time.perf_counter() + seconds
    outcomes = await asyncio.gather(
        *(client.move_state_repeatedly(until_s) for client in people), return_exceptions=True
    )
    watch.errors += [repr(each) for each in outcomes if each is not None]
    await watch.wait_until_idle()
    during = _memory_mb(pid)
    late = Client(url, clients, watch)
    await late.connect()
    await watch.wait_until_idle()
    lost = [client.name for client in people if client.last and late.scene.get(client.name) != client.last]
    watch.errors += [f"{name} lost its connection" for name in watch.disconnected]
    for client in (*people, late):
        await client.disconnect()
    await asyncio.sleep(forget_s)
    took = sorted(watch.took_s)
    return Result(
        edits=len(watch.sent_s),
        seen=len(took),
        median_ms=median(took) * 1000 if took else 0.0,
        p95_ms=took[int(len(took) * 0.95)] * 1000 if took else 0.0,
        lost=lost,
        errors=watch.errors,
        memory_mb=(before, during, _memory_mb(pid)),
    )


@contextmanager
def started_server(log_file: Path) -> Iterator[tuple[str, int]]:
    """An editor on a copy of the forward player; its URL and process. What it says goes into a file."""
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(ROOT / "designs" / "forward", Path(folder) / "designs" / "forward")
        state = {"VICODE_STATE": f"{folder}/state", "NICEGUI_STORAGE_PATH": f"{folder}/storage"}
        # What `vicode edit --host` chooses for many people, and this server for one machine does not.
        state["PYTHONMALLOC"] = os.environ.get("PYTHONMALLOC", "malloc")
        kept = {key: value for key, value in os.environ.items() if not key.startswith(("PYTEST", "NICEGUI"))}
        command = [sys.executable, "-m", "vicode", "edit", f"{folder}/designs", "--no-open", "--port", "0"]
        with log_file.open("w") as log:
            process = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT, env={**kept, **state}, cwd=ROOT)
        try:
            yield _url(log_file), process.pid
        finally:
            process.kill()
            process.wait()


def _url(said: Path) -> str:
    for _attempt in range(600):
        found = re.search(r"http://\S+", said.read_text())
        if found:
            return found[0]
        time.sleep(0.1)
    raise RuntimeError(said.read_text())


def _memory_mb(pid: int) -> float:
    status = Path(f"/proc/{pid}/status").read_text()
    return int(re.search(r"VmRSS:\s+(\d+)", status)[1]) / 1024  # type: ignore[index]


def main(clients: int = 50, seconds: float = 60.0) -> None:
    """Measure once and say what came of it."""
    said = Path(tempfile.mkstemp(suffix=".log")[1])
    with started_server(said) as (url, pid):
        result = asyncio.run(measure(url, pid, clients, seconds))
    complaints = [line for line in said.read_text().splitlines() if "Error" in line or "Traceback" in line]
    print(
        f"{clients} clients for {seconds:g} s: {result.edits} edits, seen {result.seen} times in other windows and own"
    )
    print(f"edit → window: median {result.median_ms:.0f} ms, 95 % within {result.p95_ms:.0f} ms")
    print(f"lost edits: {len(result.lost)} {result.lost[:5]}; errors: {len(result.errors)} {result.errors[:3]}")
    print(f"complaints of the server: {len(complaints)} {complaints[:3]}")
    print("memory of the server before, during, after: " + ", ".join(f"{each:.0f} MB" for each in result.memory_mb))


if __name__ == "__main__":
    main(*(int(each) for each in sys.argv[1:]))
