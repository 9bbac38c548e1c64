"""The simulation runs over any transport: here, one in memory."""

import asyncio
import json
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from tests.editor.simulation.lamp_project import prepare_lamp, recorded_iterations, write_lamps
from vicode.runs import PreparedRun, RunStatus, Simulation
from vicode.runs.client import RunClient
from vicode.simulation import Failed, Inspected, IterationResult, Ready, Response, Stopped
from vicode.simulation.messages import encode_response

Answer = Callable[[dict[str, object]], Sequence[Response] | None]


class MemoryTransport:
    """Answers each line at once; `None` ends the connection."""

    def __init__(self, answer: Answer) -> None:
        self._answer = answer
        self._lines: asyncio.Queue[bytes] = asyncio.Queue()
        self._iteration = 0
        self.is_closed = False

    async def send(self, line: bytes) -> None:
        if self.is_closed:
            raise ConnectionResetError
        responses = self._answer(json.loads(line))
        for response in (b"",) if responses is None else map(encode_response, responses):
            self._lines.put_nowait(response)

    async def receive(self) -> bytes:
        return await self._lines.get()

    async def interrupt(self) -> str:
        return "lamp, Lit.actions, line 2"

    async def explain_end(self) -> tuple[str, tuple[str, ...]]:
        return "The robot is switched off", ("last words",)

    def close(self) -> None:
        self.is_closed = True

    async def wait_closed(self) -> None:
        assert self.is_closed


def result(state: str) -> IterationResult:
    return IterationResult(iteration=1, time_ns=0, tree=[{"component": "Lamp", "state": state}])


def answer_each(run: Sequence[Response] | None) -> Answer:
    def answer(message: dict[str, object]) -> Sequence[Response] | None:
        kind = message.get("kind")
        return run if kind == "run" else (Inspected(guards={}),) if kind == "inspect" else (Ready(),)

    return answer


def simulated(
    folder: Path, run: Sequence[Response] | None, limit_s: float = 30.0
) -> tuple[Simulation, MemoryTransport]:
    """Make one step over a transport that answers a request to run."""
    transport = MemoryTransport(answer_each(run))

    async def start(prepared: PreparedRun, cwd: Path) -> RunClient:
        client = RunClient(transport, limit_s)
        await client.set_up(prepared.setup)
        return client

    async def act() -> Simulation:
        simulation = Simulation(prepared=prepare_lamp(folder), cwd=folder, start_client=start)
        await simulation.step()
        simulation._close_client()
        await simulation.wait_closed()
        return simulation

    return asyncio.run(act()), transport


@pytest.fixture
def lamps(tmp_path: Path) -> Path:
    return write_lamps(tmp_path / "lamps")


def test_iterations_arrive_over_any_transport(lamps: Path) -> None:
    simulation, transport = simulated(lamps, (result("Lit"), Stopped(reason="count")))
    assert [iteration.state for iteration in recorded_iterations(simulation)] == ["Lit"]
    assert (simulation.status, simulation.stop_reason) == (RunStatus.PAUSED, "count")
    assert transport.is_closed


@pytest.mark.parametrize(
    ("run", "limit_s", "message", "prints"),
    [
        (None, 30.0, "The robot is switched off", ("last words",)),
        ((Failed(message="no memory", prints=["x"]),), 30.0, "no memory", ("x",)),
        ((), -2.9, "lamp, Lit.actions, line 2: did not end within 0.1 s and was killed", ()),
    ],
)
def test_a_failure_closes_the_transport(
    lamps: Path, run: Sequence[Response] | None, limit_s: float, message: str, prints: tuple[str, ...]
) -> None:
    simulation, transport = simulated(lamps, run, limit_s)
    assert simulation.status is RunStatus.FAILED
    assert simulation.failure is not None
    assert (simulation.failure.message, simulation.failure.prints) == (message, prints)
    assert transport.is_closed
