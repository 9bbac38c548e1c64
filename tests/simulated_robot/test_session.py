"""A simulated robot that a bridge drives: lock step, real time, the lines of JXI, and refusals."""

import asyncio
import ssl
from pathlib import Path

import pytest

from tests.bridge.certificates import make_certificate
from tests.simulated_robot.fake_bridge import fake_bridge
from vicode.simulated_robot.arena import Arena
from vicode.simulated_robot.client import BridgeError
from vicode.simulated_robot.session import BridgeAddress, SimulationSession
from vicode.simulated_robot.world_map import WorldMap


def drive(*, is_lock_step: bool = True, is_jxi: bool = False, seed: int = 1, robots: int = 1, seconds: float = 30.0):
    async def run() -> SimulationSession:
        async with fake_bridge() as port:
            session = SimulationSession(
                Arena(WorldMap(), robots=robots, seed=seed), BridgeAddress(port=port, is_jxi=is_jxi)
            )
            if is_lock_step:
                await session.run_lock_step(
                    seconds, is_over=lambda: all(each.state == "stop" for each in session.tracks)
                )
            else:
                await session.run_real_time(seconds)
            return session

    return asyncio.run(run())


def test_in_lock_step_a_circle_takes_its_time_in_the_simulation() -> None:
    session = drive()
    (track,) = session.tracks
    assert 360 <= track.robot.turned <= 365
    assert 11 < session.arena.now_s < 14
    assert track.state_changes == 1
    assert len(track.points) == round(session.arena.now_s / 0.05)


def test_the_same_seed_gives_the_same_run() -> None:
    first, second, other = (drive(seed=seed).tracks[0].points for seed in (1, 1, 2))
    assert first == second
    assert first != other


def test_several_robots_have_a_connection_each() -> None:
    session = drive(robots=3)
    assert [track.robot.number for track in session.tracks] == [1, 2, 3]
    assert all(track.robot.turned >= 360 for track in session.tracks)


@pytest.mark.parametrize("is_jxi", [False, True])
def test_in_real_time_commands_are_followed_when_they_come(is_jxi: bool) -> None:
    session = drive(is_lock_step=False, is_jxi=is_jxi, seconds=0.5)
    (track,) = session.tracks
    assert track.robot.turned > 1
    assert track.robot.driven_m > 0
    assert session.arena.now_s == pytest.approx(0.5, abs=0.05)
    assert (track.age_ms is None) is is_jxi


def test_a_server_that_is_no_bridge_is_named() -> None:
    async def run() -> None:
        async with fake_bridge(greeting=b"220 mail ready\n") as port:
            await SimulationSession(Arena(WorldMap()), BridgeAddress(port=port)).run_lock_step(1)

    with pytest.raises(BridgeError, match="the server is no bridge: it greets with b'220 mail ready"):
        asyncio.run(run())


def test_an_error_in_the_lines_of_jxi_is_passed_on() -> None:
    async def run() -> None:
        async with fake_bridge(error="choose a behavior: a, b") as port:
            await SimulationSession(Arena(WorldMap()), BridgeAddress(port=port, is_jxi=True)).run_real_time(5)

    with pytest.raises(BridgeError, match="the bridge reports: choose a behavior: a, b"):
        asyncio.run(run())


def test_each_command_is_acknowledged() -> None:
    for is_jxi in (False, True):
        messages: list[str] = []

        async def run(is_jxi: bool = is_jxi, messages: list[str] = messages) -> None:
            async with fake_bridge(received=messages) as port:
                await SimulationSession(Arena(WorldMap()), BridgeAddress(port=port, is_jxi=is_jxi)).run_real_time(0.3)

        asyncio.run(run())
        acknowledged = [each for each in messages if "ack" in each.lower()]
        assert acknowledged[:3] == (["ACK:0", "ACK:1", "ACK:2"] if is_jxi else ['{"ack":1}', '{"ack":2}', '{"ack":3}'])


def test_a_bridge_with_tls_is_named(tmp_path: Path) -> None:
    certificate = make_certificate(tmp_path)
    if certificate is None:
        return  # nothing here can make a certificate
    context = ssl.create_default_context(ssl.Purpose.CLIENT_AUTH)
    context.load_cert_chain(certificate)

    async def drive(port: int, tls: ssl.SSLContext | None) -> None:
        await SimulationSession(Arena(WorldMap()), BridgeAddress(port=port, tls=tls)).run_lock_step(0.2)

    async def run() -> None:
        async with fake_bridge(tls=context) as port:
            await drive(port, ssl.create_default_context(cafile=certificate))
            with pytest.raises(BridgeError, match="without a greeting; if it has a certificate, add --tls or --ca"):
                await drive(port, None)
            with pytest.raises(BridgeError, match="the certificate of the bridge is not trusted: self-signed"):
                await drive(port, ssl.create_default_context())
        async with fake_bridge() as port:
            with pytest.raises(BridgeError, match="the bridge does not use TLS; leave out --tls and --ca"):
                await drive(port, ssl.create_default_context())

    asyncio.run(run())


def test_a_refusal_of_the_bridge_is_passed_on() -> None:
    async def run() -> None:
        async with fake_bridge(error="no behavior 'dance'") as port:
            await SimulationSession(Arena(WorldMap()), BridgeAddress(port=port)).run_lock_step(1)

    with pytest.raises(BridgeError, match="the bridge reports: no behavior 'dance'"):
        asyncio.run(run())


@pytest.mark.parametrize("is_lock_step", [True, False])
def test_a_bridge_that_leaves_ends_the_session(is_lock_step: bool) -> None:
    async def run() -> None:
        async with fake_bridge(messages=5) as port:
            session = SimulationSession(Arena(WorldMap()), BridgeAddress(port=port))
            await (session.run_lock_step if is_lock_step else session.run_real_time)(60)

    with pytest.raises(BridgeError, match="the bridge closed the connection"):
        asyncio.run(run())
