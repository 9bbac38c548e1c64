"""Cost of the live view in C++: an iteration without it, open without viewers, with viewers, and with a record.

Run it with `python -m benchmarks.cpp_live`; it needs g++. Times are of the thread of the robot.
"""

from __future__ import annotations

import argparse
import re
import statistics
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

from benchmarks.cpp import _FLAGS
from benchmarks.live import VIEWER
from benchmarks.sample_machines import make_machine, make_project
from vicode.generators import generate

_MAIN = """
#include <ctime>
#include <random>
#include "bench/live.hpp"

static double thread_ns() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e9 + static_cast<double>(now.tv_nsec);
}

int main(int count, char** words) {
    bica::Root root;
    bench::Components components(root);
    bica::LiveOptions options(count, words);
    std::unique_ptr<bica::Live> live;
    if (count > 1) {
        live = std::make_unique<bica::Live>(root, components.measured, bench::live_project(components), options);
    }
    std::mt19937_64 chance(1);
    std::uniform_real_distribution<double> draw(0.0, 1.0);
    std::vector<double> inputs(3000);
    for (double& each : inputs) {
        each = draw(chance);
    }
    std::getchar();
    bica::Nanoseconds now = 0;
    const int ticks = TICKS;
    for (int part = 0; part < 9; ++part) {
        const double begin = thread_ns();
        for (int tick = 0; tick < ticks; ++tick) {
            const std::size_t first = static_cast<std::size_t>(tick) % 1000 * 3;
            components.senses.a = inputs[first];
            components.senses.b = inputs[first + 1];
            components.senses.c = inputs[first + 2];
            root.step(components.measured, now += 20'000'000);
        }
        std::printf("%g\\n", (thread_ns() - begin) / ticks);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return 0;
}
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--ticks", type=int, default=200_000)
    options = parser.parse_args()
    kinds = {
        "without": (0, ()),
        "open, no viewer": (0, ("--watch", "0")),
        "1 viewer": (1, ("--watch", "0")),
        "10 viewers": (10, ("--watch", "0")),
    }
    with tempfile.TemporaryDirectory() as folder:
        program = build(Path(folder), options.ticks)
        kinds["recording"] = (0, ("--record", f"{folder}/run.jsonl"))
        times: dict[str, list[float]] = {kind: [] for kind in kinds}
        for _round in range(options.rounds):
            for kind, (viewers, arguments) in kinds.items():
                times[kind].append(measure(program, viewers, arguments))
    plain_ns = statistics.median(times["without"])
    for kind, values in times.items():
        print(f"  {kind:20} {statistics.median(values):8.1f} ns  {statistics.median(values) / plain_ns:6.1f} x")


def build(folder: Path, ticks: int) -> Path:
    project = make_project(make_machine(6, 2, acts=False), senses="", counts=True)
    for file in generate(replace(project, live=True), languages=["cpp"]):
        target = folder / file.path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(file.text, encoding="utf-8")
    (folder / "main.cpp").write_text(_MAIN.replace("TICKS", str(ticks)), encoding="utf-8")
    sources = [str(path) for path in (folder / "cpp").glob("*/*.cpp")]
    command = ["g++", *_FLAGS, "-DBICA_LIVE", f"-I{folder}/cpp", *sources, f"{folder}/main.cpp", "-pthread"]
    subprocess.run([*command, "-o", f"{folder}/robot"], check=True)
    return folder / "robot"


def measure(program: Path, viewers: int, arguments: tuple[str, ...]) -> float:
    """Median time of an iteration in ns, over parts of the run."""
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen([program, *arguments], text=True, **pipes) as robot:  # type: ignore[call-overload]
        processes = []
        if "--watch" in arguments:
            found = re.search(r"attach (\S+):(\d+) --token (\w+)", robot.stderr.readline())
            assert found is not None
            for _viewer in range(viewers):
                command = [sys.executable, "-c", VIEWER, *found.groups(), "0"]
                processes.append(subprocess.Popen(command, stdout=subprocess.PIPE))
                assert processes[-1].stdout is not None
                processes[-1].stdout.readline()
        printed, _errors = robot.communicate("\n")
        for process in processes:
            process.kill()
            process.communicate()
    return statistics.median(map(float, printed.split()))


if __name__ == "__main__":
    main()
