"""`vicode mcp`, asked by the client of the package mcp: a session of an agent, and what it must not do."""

import asyncio
import json
import shutil
import subprocess
import sys
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

import pytest
from mcp import Client
from mcp.client.stdio import StdioServerParameters
from mcp.types import CallToolResult

from vicode.samples import copy_sample

PROJECT = Path(__file__).parents[2]
Call = Callable[..., Awaitable[CallToolResult]]


@pytest.fixture(scope="module")
def sample(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("mcp") / "player"
    copy_sample("forward", folder)
    return folder


@pytest.fixture
def folder(sample: Path, tmp_path: Path) -> Path:
    shutil.copytree(sample, tmp_path / "player")
    return tmp_path / "player"


def talk(folder: Path, *options: str, session: Callable[[Any, Call], Awaitable[None]]) -> None:
    """Hold a session with a server in a process of its own."""

    async def hold() -> None:
        arguments = ["-P", "-m", "vicode", "mcp", str(folder), *options]
        server = StdioServerParameters(command=sys.executable, args=arguments, env={"PYTHONPATH": str(PROJECT)})
        async with Client(server) as client:
            await session(client, lambda name, **named: client.call_tool(name, named))

    asyncio.run(hold())


def text_of(result: CallToolResult) -> str:
    assert not result.is_error, result.content
    return "\n".join(getattr(each, "text", "") for each in result.content)


def error_of(result: CallToolResult) -> str:
    assert result.is_error, result.content
    return "\n".join(getattr(each, "text", "") for each in result.content)


def test_an_agent_reads_edits_generates_and_runs(folder: Path) -> None:
    async def session(client: Any, call: Call) -> None:
        listed = (await call("list_designs")).structured_content["result"]
        design = next(each for each in listed if each["component"] == "FollowBall")
        assert (design["path"], design["states"], design["findings"]) == ("follow_ball.yaml", ["Approach", "Align"], 0)
        state = text_of(await call("explain", path="follow_ball.yaml", state="Approach"))
        assert "The ball is ahead." in state
        assert "`if abs(perception.neck_pan) > pan_threshold` – the ball is not ahead" in state
        assert "Align" in text_of(await call("render", path="follow_ball.yaml"))
        (picture,) = (await call("render", path="follow_ball.yaml", format="png")).content
        assert (picture.type, picture.mime_type) == ("image", "image/png")

        text = text_of(await call("read", path="follow_ball.yaml"))
        proposed = json.loads(
            text_of(await call("propose_edit", path="follow_ball.yaml", text=text.replace("< 6", "< 36")))
        )
        assert (
            "guard Align → Approach: abs(perception.neck_pan) < 6 → abs(perception.neck_pan) < 36"
            in proposed["changes"]
        )
        assert proposed["new_findings"] == []
        assert (folder / "follow_ball.yaml").read_text(encoding="utf-8") == text
        assert text_of(await call("apply_edit", id=proposed["id"])) == "wrote follow_ball.yaml"
        assert (folder / "follow_ball.yaml").read_text(encoding="utf-8") == text.replace("< 6", "< 36")
        assert "wrote" in text_of(await call("generate"))
        assert "< 36" in (folder / "generated/python/forward/follow_ball.py").read_text(encoding="utf-8")

        inputs = ["Perception.ball_seen=true", "2 s: Perception.fallen=true"]
        run = json.loads(text_of(await call("run", path="player.yaml", seconds=3, inputs=inputs)))
        changes = [line.split("  (")[0].split() for line in run["printed"].splitlines() if "Player: " in line]
        assert changes[0][-3:] == ["LookForBall", "→", "FollowBall"]
        assert (changes[1][0], changes[1][-1]) == ("2.00", "GetUp")
        assert run["iterations"][-1]["tree"][0]["state"] == "GetUp"

    talk(folder, "--allow-edit", "--allow-run", session=session)


def test_without_options_nothing_is_written_or_run(folder: Path) -> None:
    before = {file: file.read_bytes() for file in folder.rglob("*") if file.is_file()}

    async def session(client: Any, call: Call) -> None:
        names = {tool.name: tool.annotations.read_only_hint for tool in (await client.list_tools()).tools}
        assert names == dict.fromkeys(("list_designs", "read", "check", "explain", "render", "propose_edit"), True)
        text = (folder / "follow_ball.yaml").read_text(encoding="utf-8")
        await call("propose_edit", path="follow_ball.yaml", text=text.replace("Approach", "Walk"))
        await call("propose_edit", path="new.yaml", text="vicode: 1\ncomponent: New\n")
        await call("check", deep=True)

    talk(folder, session=session)
    assert {file: file.read_bytes() for file in folder.rglob("*") if file.is_file()} == before


def test_an_edit_with_new_errors_or_of_a_changed_file_is_refused(folder: Path) -> None:
    file = folder / "follow_ball.yaml"
    text = file.read_text(encoding="utf-8")

    async def session(client: Any, call: Call) -> None:
        wrong = json.loads(
            text_of(await call("propose_edit", path=file.name, text=text.replace("neck_pan)", "neck_pann)")))
        )
        assert {each["severity"] for each in wrong["new_findings"]} == {"error"}
        assert "neck_pan" in wrong["new_findings"][0]["fix"]
        assert "causes new errors" in error_of(await call("apply_edit", id=wrong["id"]))
        right = json.loads(text_of(await call("propose_edit", path=file.name, text=text.replace("< 6", "< 7"))))
        file.write_text(text + "# mine\n", encoding="utf-8")
        assert "changed" in error_of(await call("apply_edit", id=right["id"]))
        assert file.read_text(encoding="utf-8") == text + "# mine\n"

    talk(folder, "--allow-edit", session=session)


def test_an_agent_stays_in_the_folder(folder: Path) -> None:
    (folder.parent / "secret.yaml").write_text("vicode: 1\ncomponent: Secret\n", encoding="utf-8")
    (folder / "link.yaml").symlink_to(folder.parent / "secret.yaml")
    (folder / ".git").mkdir()

    async def session(client: Any, call: Call) -> None:
        for path in ("../secret.yaml", "link.yaml", str(folder.parent / "secret.yaml"), "--help", ".git/config.yaml"):
            for tool in ("read", "explain", "run"):
                assert "Secret" not in error_of(await call(tool, path=path))
            text = "vicode: 1\ncomponent: Secret\nstates: {A: {}}\n"
            assert error_of(await call("propose_edit", path=path, text=text))
        assert error_of(await call("check", path=".."))
        assert error_of(await call("render", path="../secret.yaml"))
        assert error_of(await call("read", path="field/world.py"))
        assert error_of(await call("propose_edit", path="field.yaml", text="import os"))

    talk(folder, "--allow-edit", "--allow-run", session=session)


def test_a_wrong_folder_is_one_line(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "vicode", "mcp", str(tmp_path / "none")], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (2, f"vicode: {tmp_path / 'none'} is no folder\n")
