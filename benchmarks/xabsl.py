"""XABSL: CPU time to compile a behavior in a new process, and cycles per second of the engine.

Run `python -m benchmarks.xabsl [AGENTS.xabsl]`; the default is the largest behavior of the tests. The compiler is
compared with the original if `VICODE_XABSL_ORIGINAL` is a command that takes `-i OUTPUT AGENTS`, such as
"ruby -I folder folder/xabsl.rb". The engine is compared with a loop that calls one function per active option.
"""

import os
import random
import shlex
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from statistics import median

from vicode.xabsl.compiler import compile_source, declared_symbols
from vicode.xabsl.engine.replay import ReplayRobot
from vicode.xabsl.engine.symbols import RobotSymbol
from vicode.xabsl.source_loader import load_source

ROOT = Path(__file__).parents[1]
LARGEST = ROOT / "tests" / "xabsl" / "cases" / "programs" / "p11" / "agents.xabsl"
ROUNDS = 7
CYCLES = 20_000


def cpu_s(command: Sequence[str]) -> float:
    """The CPU time of a process with its children, in seconds."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _pid, status, usage = os.wait4(process.pid, 0)
    if status:
        raise RuntimeError(f"{shlex.join(command)} ended with {status}")
    return usage.ru_utime + usage.ru_stime


def measure_compilers(agents: Path) -> None:
    """Run both compilers alternately."""
    original = shlex.split(os.environ.get("VICODE_XABSL_ORIGINAL", ""))
    with tempfile.TemporaryDirectory() as folder:
        own = [sys.executable, "-m", "vicode", "xabsl", "compile", str(agents), "-o", f"{folder}/own.dat"]
        own_s, original_s = [], []
        for _ in range(ROUNDS):
            own_s.append(cpu_s(own))
            if original:
                original_s.append(cpu_s([*original, "-i", f"{folder}/original.dat", str(agents)]))
    print(f"compile: {median(own_s):.2f} s of CPU")
    if original:
        ratios = [theirs / ours for theirs, ours in zip(original_s, own_s, strict=True)]
        print(f"the original: {median(original_s):.2f} s, {median(ratios):.1f} × as long")


def random_number(rng: random.Random, symbol: RobotSymbol) -> float:
    """A value for a column of inputs."""
    if symbol.kind == "d":
        return rng.uniform(-1000, 1000)
    return rng.randrange(8 if symbol.kind == "e" else 2)


def noop(now: int, cycle: int) -> None:
    """The function that the comparison loop calls."""


def measure_engine(agents: Path) -> None:
    """Run the engine with all agents; some inputs change before every cycle."""
    compiled = compile_source(load_source(agents))
    if compiled.program is None:
        raise SystemExit(f"{agents} has errors: vicode xabsl check {agents}")
    symbols = declared_symbols(compiled.table)
    robot, rng = ReplayRobot(compiled.program, symbols, traced=False), random.Random(1)
    inputs = [symbol for symbol in symbols.symbols if symbol.role == "input"]
    rates, ratios, active = [], [], 0
    for _ in range(ROUNDS):
        spent_s = loop_s = 0.0
        for cycle in range(CYCLES):
            if cycle % 50 == 0:
                robot.engine.select(rng.choice(compiled.program.agents)[0])
                count = len(robot.engine.active_options)
                active += count
            for symbol in rng.sample(inputs, min(4, len(inputs))):
                robot.world.set_input(symbol.name, random_number(rng, symbol))
            robot.now += rng.randrange(10, 100)
            start_s = time.perf_counter()
            robot.engine.execute()
            end_s = time.perf_counter()
            for _option in range(count):
                noop(robot.now, cycle)
            spent_s += end_s - start_s
            loop_s += time.perf_counter() - end_s
        rates.append(CYCLES / spent_s)
        ratios.append(spent_s / loop_s)
    options = active / (ROUNDS * CYCLES / 50)
    print(f"engine: {median(rates):.0f} cycles/s with {options:.1f} active options per cycle,")
    print(f"{median(ratios):.1f} × as long as a loop with one function call per active option")


def main() -> None:
    agents = Path(sys.argv[1]) if len(sys.argv) > 1 else LARGEST
    measure_compilers(agents)
    measure_engine(agents)


if __name__ == "__main__":
    main()
