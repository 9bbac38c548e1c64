"""User code that fails, hangs, prints too much or exits is reported with its location and cannot affect the editor."""

import json
import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.editor.simulation.lamp_project import LAMP, prepare_lamp, simulate, write_lamps
from vicode.editor.view.activation import code_error_view
from vicode.runs import NotReadyError, RunStatus, Simulation
from vicode.simulation import StopConditions, launcher

DESIGN = """
vicode: 1
component: Lamp
initial: Dark
states:
  Dark:
    enter: |
      import os, sys, time
      {enter}
    transitions: [{{to: Lit, after: 0.02}}]
  Lit:
    actions:
      - code: |
          import os, sys, time
          {code}
"""


def lamp(folder: Path, code: str, enter: str = "pass") -> Path:
    return write_lamps(folder / "lamps", DESIGN.format(code=code, enter=enter))


def failure_words(simulation: Simulation) -> str:
    failure = simulation.failure
    assert failure is not None
    if failure.error is None:
        return failure.message
    return code_error_view(simulation.prepared.design, failure.error).text


def test_an_endless_loop_is_reported_with_its_line(tmp_path: Path) -> None:
    folder = lamp(tmp_path, "while True: pass")

    async def act(simulation: Simulation) -> None:
        assert await simulation.step(5) == ""
        assert simulation.status is RunStatus.FAILED
        assert simulation.cursor == 1
        words = failure_words(simulation)
        assert words.startswith("Lamp, state Lit, Lit.actions, line 2: did not end within 1.5 s")
        # The past is still available, and a step from it fails in the same way.
        simulation.step_back()
        assert await simulation.step(5) == ""
        assert simulation.cursor == 1

    simulate(prepare_lamp(folder, limit_s=1.5), folder, act)


def test_a_loop_that_catches_everything_is_killed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("vicode.runs.client._GRACE_S", 0.5)
    code = "while True:\n              try: time.sleep(9)\n              except BaseException: pass"
    folder = lamp(tmp_path, code)

    async def act(simulation: Simulation) -> None:
        assert await simulation.step(5) == ""
        assert "lamp, Lit.actions, line" in failure_words(simulation)
        assert "did not end within" in failure_words(simulation)

    simulate(prepare_lamp(folder, limit_s=1.5), folder, act)


@pytest.mark.parametrize(
    ("code", "words"),
    [
        ("os._exit(3)", "exited with code 3"),
        ("os.kill(os.getpid(), 11)", "lamp, Lit.actions, line 2: was terminated by SIGSEGV"),
    ],
)
def test_an_exit_of_the_process_is_reported(tmp_path: Path, code: str, words: str) -> None:
    folder = lamp(tmp_path, code)

    async def act(simulation: Simulation) -> None:
        assert await simulation.step(5) == ""
        assert words in failure_words(simulation)

    simulate(prepare_lamp(folder), folder, act)


@pytest.mark.parametrize(
    ("code", "words"),
    [
        ("while True: pass", "did not end within 0.05 s"),
        ("raise SystemExit(0)", "ended the program with SystemExit: 0"),
    ],
)
def test_a_world_that_does_not_return_is_reported(tmp_path: Path, code: str, words: str) -> None:
    folder = write_lamps(tmp_path / "lamps")
    project = folder / "project.yaml"
    project.write_text(project.read_text().replace("project: Lamps", "project: Lamps\nworld: hands:World"))
    with (folder / "hands.py").open("a") as hands:
        hands.write(f"\nclass World:\n    def advance(self, now_ns):\n        {code}\n")

    async def act(simulation: Simulation) -> None:
        assert await simulation.step() == ""
        assert simulation.status is RunStatus.FAILED
        failure = failure_words(simulation)
        assert failure.startswith(f"code outside of all components {words}")
        assert "[hands.py:24]" in failure

    simulate(prepare_lamp(folder, stubbed=frozenset(), limit_s=0.05), folder, act)


@pytest.mark.parametrize(
    ("code", "words"),
    [("1 / 0", "ZeroDivisionError: division by zero"), ("sys.exit(4)", "SystemExit: 4")],
)
def test_an_exception_is_reported_and_the_run_continues(tmp_path: Path, code: str, words: str) -> None:
    folder = lamp(tmp_path, code)

    async def act(simulation: Simulation) -> None:
        assert await simulation.step(9, StopConditions(errors=True)) == "error"
        assert simulation.shown_iteration is not None
        mistake = code_error_view(simulation.prepared.design, simulation.shown_iteration.errors[0])
        assert mistake.text == f"Lamp, state Lit, Lit.actions, line 2: {words}"
        assert mistake.item is not None
        assert (mistake.item.kind, mistake.item.id) == ("states", "Lit")
        assert await simulation.step(3) == "count"

    simulate(prepare_lamp(folder), folder, act)


def test_excessive_output_is_limited(tmp_path: Path) -> None:
    folder = lamp(tmp_path, "for n in range(50000): print('x' * 50)")

    async def act(simulation: Simulation) -> None:
        await simulation.step(2)
        assert simulation.shown_iteration is not None
        assert (len(simulation.shown_iteration.prints), simulation.shown_iteration.omitted_lines) == (200, 49_800)

    simulate(prepare_lamp(folder, limit_s=20.0), folder, act)


def test_writing_past_python_does_not_reach_the_protocol(tmp_path: Path) -> None:
    folder = lamp(tmp_path, """os.write(1, b'{"kind":"failed"}\\n' * 5000); os.write(2, b'y' * 100000)""")

    async def act(simulation: Simulation) -> None:
        assert await simulation.step(4) == "count"
        assert simulation.failure is None

    simulate(prepare_lamp(folder), folder, act)


def test_memory_is_limited(tmp_path: Path) -> None:
    folder = lamp(tmp_path, "self.much = bytearray(2 << 30)")

    async def act(simulation: Simulation) -> None:
        await simulation.step(2)
        assert simulation.shown_iteration is not None
        assert simulation.shown_iteration.errors[0]["message"] == "MemoryError"

    simulate(prepare_lamp(folder, memory_bytes=300 << 20), folder, act)


def test_code_that_cannot_be_loaded_is_reported(tmp_path: Path) -> None:
    folder = write_lamps(tmp_path / "lamps")
    (folder / "hands.py").write_text("from nothing_of_this_name import Bulb, Eye\n")

    async def act(simulation: Simulation) -> None:
        await simulation.start()
        assert simulation.status is RunStatus.FAILED
        assert "No module named 'nothing_of_this_name' [" in failure_words(simulation)
        assert "hands.py:1]" in failure_words(simulation)

    simulate(prepare_lamp(folder, stubbed=frozenset()), folder, act)


def test_a_class_that_differs_from_its_declaration_is_not_started(tmp_path: Path) -> None:
    folder = write_lamps(tmp_path / "lamps")
    file = folder / "hands.py"
    file.write_text(file.read_text().replace("self.light =", "self.bright ="))
    with pytest.raises(NotReadyError, match=r"hands\.py, line 5: 'Eye' has no attribute 'light'. Fix it"):
        prepare_lamp(folder, stubbed=frozenset())
    prepare_lamp(folder)


def test_a_design_with_errors_is_not_started(tmp_path: Path) -> None:
    states = "{Dark: {transitions: [{to: Dark, when: nobody}]}}"
    folder = write_lamps(tmp_path / "lamps", f"vicode: 1\ncomponent: Lamp\ninitial: Dark\nstates: {states}\n")
    with pytest.raises(NotReadyError, match=r"Lamp: .*nobody.* Fix it, then restart"):
        prepare_lamp(folder)


def test_code_that_reads_the_real_time_is_detected(tmp_path: Path) -> None:
    folder = lamp(tmp_path, "self.noise = time.time_ns()")

    async def act(simulation: Simulation) -> None:
        await simulation.step(5)
        simulation.step_back()
        simulation.truncate()
        await simulation.step()
        assert simulation.warning.startswith("The replay gave a different result")

    simulate(prepare_lamp(folder), folder, act)


def test_inputs_before_a_failure_are_not_lost(tmp_path: Path) -> None:
    folder = write_lamps(tmp_path / "lamps", LAMP.replace('print("lit", self.turns)', '"while True: pass"'))

    async def act(simulation: Simulation) -> None:
        await simulation.step()
        await simulation.set_input(("Eye", "seen"), True)
        for _again in range(2):
            assert await simulation.step() == ""
            assert "Lamp, state Lit" in failure_words(simulation)
            assert simulation.inputs["Eye"]["seen"] is True
        await simulation.set_input(("Eye", "seen"), False)
        assert simulation.failure is None
        assert await simulation.step() == "count"

    simulate(prepare_lamp(folder, limit_s=1.5), folder, act)


def test_the_process_ends_when_the_editor_is_killed(tmp_path: Path) -> None:
    folder = lamp(tmp_path, "while True:\n              try: time.sleep(9)\n              except BaseException: pass")
    program = f"""
import asyncio
from pathlib import Path
from tests.editor.simulation.lamp_project import prepare_lamp
from vicode.runs import Simulation

async def main():
    folder = Path({str(folder)!r})
    simulation = Simulation(prepared=prepare_lamp(folder, limit_s=60.0), cwd=folder)
    await simulation.start()
    transport = simulation._client.transport
    print(transport.process.pid, transport.folder, flush=True)
    await simulation.step(100)

asyncio.run(main())
"""
    command = [sys.executable, "-c", program]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=Path(__file__).parents[3]) as editor:
        assert editor.stdout is not None
        number, generated = editor.stdout.readline().split()
        editor.kill()
    pid = int(number)
    end = time.monotonic() + 20
    while Path(f"/proc/{pid}").exists() and "Z" not in state_of(pid) and time.monotonic() < end:
        time.sleep(0.05)
    assert not Path(f"/proc/{pid}").exists() or "Z" in state_of(pid)
    assert not Path(generated).exists()


def test_a_signal_while_the_launcher_ends_leaves_no_files(tmp_path: Path) -> None:
    """The program can see the end of its pipe before the launcher is told that the editor has ended."""
    modules, files = tmp_path / "modules", tmp_path / "files"
    modules.mkdir()
    (files / "below").mkdir(parents=True)
    (modules / "fnmatch.py").write_text(
        "import os, signal, sys\n"
        "os.kill(os.getpid(), signal.SIGTERM)\n"
        f"sys.path.remove({str(modules)!r})\n"
        "del sys.modules['fnmatch']\n"
        "import fnmatch\n",
        encoding="utf-8",
    )
    config = {"command": ["/bin/true"], "is_isolated": False, "readable": [], "writable": [], "root": ""}
    command = [sys.executable, launcher.__file__, json.dumps(config | {"temporary": str(files)})]
    environment = os.environ | {"PYTHONPATH": str(modules)}
    ended = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60, check=False)
    assert (ended.returncode, ended.stderr) == (0, "")
    assert not files.exists()


def state_of(pid: int) -> str:
    """The state letter of a process; Z is a zombie."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return "Z"
