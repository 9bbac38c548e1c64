"""Output of `vicode run`: other encodings, a trace on standard output, a closed pipe, a narrow terminal."""

import json
import logging
import os
import shlex
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.command_runner import lamps
from vicode.editor.malformed_messages import shorten_record
from vicode.traces.descriptions import describe_summary

__all__ = ["lamps"]

COMMAND = [sys.executable, "-m", "vicode", "run", "lamps/lamp.yaml", "--seconds", "1"]
SUMMARY = {"time_ns": 0, "iterations": 0, "stopped": "limit", "state": "", "errors": 0}


def _environment(**more: str) -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2]), "PYTHONIOENCODING": "utf-8", **more}


@pytest.mark.usefixtures("lamps")
@pytest.mark.parametrize("encoding", ["cp1252", "latin-1", "ascii"])
def test_arrows_are_replaced_where_the_encoding_has_none(encoding: str) -> None:
    done = subprocess.run(COMMAND, capture_output=True, env=_environment(PYTHONIOENCODING=encoding), check=False)
    assert (done.returncode, done.stderr) == (0, b"")
    assert b"Lamp: Dark -> Lit" in done.stdout


@pytest.mark.usefixtures("lamps")
def test_a_trace_is_appended_to_standard_output(tmp_path: Path) -> None:
    with Path("out").open("wb") as out:
        out.write(b"before\n")
        out.flush()
        done = subprocess.run(
            [*COMMAND, "--trace", "-"], stdout=out, stderr=subprocess.PIPE, env=_environment(), check=False
        )
    before, *lines = Path("out").read_text().splitlines()
    assert (done.returncode, before) == (0, "before")
    assert "Dark → Lit" in done.stderr.decode()
    assert next(iter(json.loads(lines[0]))) == "vicode-trace"
    assert "summary" in json.loads(lines[-1])
    assert not (tmp_path / "-").exists()


@pytest.mark.usefixtures("lamps")
def test_a_closed_pipe_is_not_a_failure_to_run() -> None:
    command = [*COMMAND[:-1], "100000"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=_environment())
    assert process.stdout is not None
    process.stdout.readline()
    process.stdout.close()
    assert process.stderr is not None
    errors = process.stderr.read()
    process.stderr.close()
    assert (process.wait(), errors) == (128 + signal.SIGPIPE, b"")


@pytest.mark.usefixtures("lamps")
@pytest.mark.parametrize("closed", [">&-", "2>&-", "<&-", "<&- >&- 2>&-"])
@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        ("check lamps", 0),
        ("check nowhere", 2),
        ("gen lamps", 0),
        ("schema", 0),
        ("export lamps/lamp.yaml --out -", 0),
        ("run lamps/lamp.yaml --ticks 2", 0),
        ("run lamps/lamp.yaml --ticks 2 --trace -", 0),
        ("diff lamps/lamp.yaml lamps/lamp.yaml", 0),
        ("", 2),
    ],
)
def test_a_closed_standard_stream_is_like_the_null_device(arguments: str, code: int, closed: str) -> None:
    command = f"{shlex.quote(sys.executable)} -m vicode {arguments} {closed}"
    done = subprocess.run(["sh", "-c", command], capture_output=True, env=_environment(), check=False)
    assert b"Traceback" not in done.stdout + done.stderr
    assert done.returncode == code


def test_the_world_line_is_wrapped_at_a_width() -> None:
    world = {f"value{number}": number for number in range(20)}
    assert max(map(len, describe_summary({**SUMMARY, "world": world}).splitlines())) > 100
    lines = describe_summary({**SUMMARY, "world": world}, 60).splitlines()
    assert max(map(len, lines)) <= 60
    assert "value19" in lines[-2]


def test_the_second_ctrl_c_logs_no_traceback() -> None:
    record = logging.LogRecord("uvicorn.error", logging.ERROR, "", 0, "Traceback…\nKeyboardInterrupt\n", (), None)
    assert not shorten_record(record)
