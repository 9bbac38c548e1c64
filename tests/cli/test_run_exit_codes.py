"""How a run ends that does not end by itself as it should: Ctrl-C, and programs that end themselves."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from tests.cli.command_runner import LAMP, lamps, vicode
from vicode.cli.run import PlainTracePrinter
from vicode.runs import foreground
from vicode.runs.foreground import follow_process

__all__ = ["lamps"]

DEAF = "import signal, time; signal.signal(signal.SIGINT, signal.SIG_IGN); print('up', flush=True); time.sleep(60)"
AGAIN = "stopping after this iteration; press Ctrl-C again to stop immediately\n"


class InterruptingPrinter(PlainTracePrinter):
    """Sends Ctrl-C a given number of times when the program prints output."""

    def __init__(self, times: int) -> None:
        self.times = times

    def show_text(self, text: str) -> None:
        del text
        for _ in range(self.times):
            signal.raise_signal(signal.SIGINT)


def follow_unresponsive_program(times: int) -> int:
    child = subprocess.Popen([sys.executable, "-c", DEAF], stdout=subprocess.PIPE, text=True, start_new_session=True)
    return follow_process(child, InterruptingPrinter(times)).exit_code


def test_a_program_that_does_not_answer_is_ended(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(foreground, "_INTERRUPT_TIMEOUT_S", 0.1)
    assert follow_unresponsive_program(1) == 130
    assert capsys.readouterr().err == AGAIN + "the program did not stop and was killed\n"


def test_the_third_interrupt_ends_it_at_once(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(foreground, "_INTERRUPT_TIMEOUT_S", 30.0)
    assert follow_unresponsive_program(3) == 130
    assert "Traceback" not in capsys.readouterr().err


@pytest.fixture
def endless(lamps: Path) -> Path:
    text = LAMP.replace("self.count = 1\n", "print('up', flush=True)\n      while True: pass\n")
    (lamps / "lamp.yaml").write_text(text, encoding="utf-8")
    return lamps


def test_an_endless_loop_of_the_user_ends_without_a_traceback(endless: Path) -> None:
    program = "import sys; from vicode.cli import main; sys.exit(main())"
    child = subprocess.Popen(
        [sys.executable, "-c", program, "run", str(endless / "lamp.yaml")],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=Path(__file__).parents[2],
    )
    assert child.stdout is not None
    assert child.stdout.readline() == "up\n"
    child.send_signal(signal.SIGINT)
    time.sleep(0.2)
    child.send_signal(signal.SIGINT)
    _out, err = child.communicate(timeout=30)
    assert child.returncode == 130
    assert "Traceback" not in err
    assert err.startswith(AGAIN)


@pytest.mark.parametrize(
    ("code", "ending"),
    [
        ("import os; os._exit(0)", "unexpectedly with exit code 0"),
        ("import os; os._exit(2)", "unexpectedly with exit code 2"),
        ("import os; os.kill(os.getpid(), 9)", "by signal SIGKILL"),
    ],
)
def test_a_program_that_ends_itself_is_told(
    lamps: Path, code: str, ending: str, capfd: pytest.CaptureFixture[str]
) -> None:
    (lamps / "lamp.yaml").write_text(LAMP.replace("self.count = 1", code), encoding="utf-8")
    assert vicode("run", "lamps/lamp.yaml", "--ticks", "3") == 1
    assert capfd.readouterr().err.splitlines()[-1] == f"the program ended {ending}"


@pytest.mark.parametrize("code", [0, 5])
def test_exit_in_a_component_is_reported_and_the_run_continues(
    lamps: Path, code: int, capfd: pytest.CaptureFixture[str]
) -> None:
    (lamps / "lamp.yaml").write_text(LAMP.replace("self.count = 1", f"import sys; sys.exit({code})"), encoding="utf-8")
    assert vicode("run", "lamps/lamp.yaml", "--ticks", "3") == 1
    captured = capfd.readouterr()
    assert "stopped: limit" in captured.out
    assert f"Dark.enter, line 1: SystemExit: {code} [" in captured.err


def test_a_mistake_before_the_start_is_one_line(lamps: Path, capfd: pytest.CaptureFixture[str]) -> None:
    text = LAMP.replace("initial: Dark\n", "initial: Dark\nmodule: 1 / 0\n")
    (lamps / "lamp.yaml").write_text(text, encoding="utf-8")
    assert vicode("run", "lamps/lamp.yaml") == 2
    err = capfd.readouterr().err
    assert err.count("\n") == 1
    assert "lamp.yaml, module, line 1: ZeroDivisionError" in err


@pytest.mark.parametrize("arguments", [("--seconds", "nan"), ("--ticks", "-3"), ("--tick-ms", "-5")])
def test_numbers_without_sense_are_refused(lamps: Path, arguments: tuple[str, str]) -> None:
    assert vicode("run", "lamps/lamp.yaml", *arguments) == 2


def test_the_runtimes_own_stops_can_be_asked_for(lamps: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert vicode("run", "lamps/bulb.yaml", "--until-done") == 0
    assert "stopped: done" in capfd.readouterr().out
    (lamps / "lamp.yaml").write_text(LAMP.replace("self.count = 1", "1 / 0"), encoding="utf-8")
    assert vicode("run", "lamps/lamp.yaml", "--on-error", "stop") == 1
    assert "stopped: error" in capfd.readouterr().out


@pytest.mark.parametrize("pace", [(), ("--real-time",)])
@pytest.mark.parametrize("trace", ["/dev/full", "missing/run.jsonl"])
def test_a_trace_that_cannot_be_written_has_its_own_code(
    lamps: Path, trace: str, pace: tuple[str, ...], capfd: pytest.CaptureFixture[str]
) -> None:
    assert vicode("run", "lamps/lamp.yaml", "--seconds", "0.1", "--trace", trace, *pace) == 3
    assert f"error: cannot write the trace {trace}: No " in capfd.readouterr().err


@pytest.mark.parametrize("pace", [(), ("--real-time",)])
def test_a_deployed_program_tells_lost_outputs_from_other_errors(
    lamps: Path, tmp_path: Path, pace: tuple[str, ...]
) -> None:
    assert vicode("deploy", "lamps/lamp.yaml", "--to", "robot", "--python", sys.executable, "--arguments=") == 0
    (tmp_path / "robot/file").touch()

    def start(*arguments: str, **options: Any) -> tuple[int, str]:
        command = [tmp_path / "robot/run", "--ticks", "3", *pace, *arguments]
        done = subprocess.run(command, stderr=subprocess.PIPE, text=True, check=False, timeout=60, **options)
        return done.returncode, done.stderr

    assert start("--trace", "/dev/full")[0] == 3
    assert start("--trace", "missing/run.jsonl")[0] == 3
    assert start("--record", "file/run.jsonl") == (3, "error: cannot write the record file/run.jsonl: File exists\n")
    assert start(env={**os.environ, "VICODE_RECORD": "file/run.jsonl"})[0] == 3
    with Path("/dev/full").open("w") as full:
        lost = (3, "error: cannot write the standard output: No space left on device\n")
        assert start(stdout=full) == lost
    assert start("--world", "nowhere:World")[0] == 2


@pytest.mark.parametrize("words", [("run", "lamps/lamp.yaml", "--seconds", "1"), ("check", "lamps")])
def test_a_full_disk_has_its_own_code(lamps: Path, words: tuple[str, ...]) -> None:
    command = [sys.executable, "-m", "vicode", *words]
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False, timeout=60)
    assert (done.returncode, done.stderr) == (3, "vicode: No space left on device\n")
