"""Cycles per second of an XABSL behavior as C++: imported, generated, compiled, and run on random inputs.

Run `python -m benchmarks.cpp_behavior [AGENTS.xabsl] [--agent NAME]`; it needs g++. All inputs are written before each
cycle, which is also measured alone. Another engine is measured in turns with `--engine COMMAND`: a program that takes
the symbol list, the intermediate code, the names of the inputs, the inputs, the agent and the number of passes, and
prints two numbers, the ns per cycle of writing inputs alone and of both. The inputs are lines as in vicode/conformance:
`s 0 INPUT VALUE` sets an input before the cycle of the next line `t NANOSECONDS`.
"""

from __future__ import annotations

import argparse
import shlex
import shutil
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path
from statistics import median

from benchmarks.xabsl import LARGEST
from vicode.conformance.cpp import format_inputs
from vicode.conformance.inputs import ConformanceRun
from vicode.conformance.random_inputs import random_run
from vicode.conformance.xabsl import input_symbol
from vicode.generators import GENERATORS, generate
from vicode.generators.cpp.driver import driver_support, write_driver
from vicode.importers import import_behavior
from vicode.output import apply_diffs, compare_files
from vicode.xabsl.compiler import compile_source, declared_symbols
from vicode.xabsl.engine.code_writer import write_code
from vicode.xabsl.engine.symbols import write_symbols
from vicode.xabsl.source_loader import load_source

CYCLES, PASSES = 1000, 20
_FLAGS = ("-std=c++17", "-O2", "-ffp-contract=off", "-w", "-I.")
_MAIN = """
#include <cstdlib>
#include <utility>
#include "driver_measured.cpp"

using Robot = conformance_measured::Robot;
constexpr unsigned count = INPUTS;

/// One statement per input, as a robot program has them.
template <unsigned... Number>
__attribute__((flatten)) void write(Robot& robot, const double* row, std::integer_sequence<unsigned, Number...>) {
    (robot.set(Number, row[Number]), ...);
}

class StepCounter final : public bica::Observer {
public:
    void begin_step(const bica::Component&, bool, bool) override { ++steps; }
    void end_step(const bica::Component&) override {}
    void error(const bica::Component&, const char*) override {}

    double steps = 0.0;
};

int main(int, char** words) {
    std::FILE* file = std::fopen(words[1], "r");
    std::vector<double> row(count);
    std::vector<double> rows;
    std::vector<bica::Nanoseconds> times;
    unsigned number = 0;
    double value = 0.0;
    for (char kind = ' '; std::fscanf(file, " %c", &kind) == 1;) {
        long long time = 0;
        if (kind == 's' && std::fscanf(file, "%*u %u %lf", &number, &value) == 2) {
            row[number] = value;
        } else if (kind == 't' && std::fscanf(file, "%lld", &time) == 1) {
            rows.insert(rows.end(), row.begin(), row.end());
            times.push_back(time);
        }
    }
    Robot robot;
    StepCounter counter;
    const int passes = std::atoi(words[2]);
    bica::Nanoseconds start = 0;
    const auto measure = [&](bool steps, int repeated) {
        const bica::Nanoseconds begin = bica::clock_ns();
        for (int pass = 0; pass < repeated; ++pass) {
            for (std::size_t cycle = 0; cycle < times.size(); ++cycle) {
                write(robot, &rows[cycle * count], std::make_integer_sequence<unsigned, count>{});
                if (steps) {
                    robot.step(start + times[cycle]);
                }
            }
            start += steps ? times.back() + 20'000'000 : 0;
        }
        return static_cast<double>(bica::clock_ns() - begin) / repeated / static_cast<double>(times.size());
    };
    robot.root.observer = &counter;
    measure(true, 1);
    robot.root.observer = nullptr;
    const double writes = measure(false, passes);
    const double both = measure(true, passes);
    std::printf("%f %f %f\\n", writes, both, counter.steps / static_cast<double>(times.size()));
    return 0;
}
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("agents", type=Path, nargs="?", default=LARGEST, help="file with the agents (one of the tests)")
    parser.add_argument("--agent", help="the agent (the first one)")
    parser.add_argument("--rounds", type=int, default=11, help="medians of so many rounds are shown (11)")
    parser.add_argument("--engine", metavar="COMMAND", help="another engine")
    options = parser.parse_args()
    compiler = shutil.which("g++")
    if compiler is None:
        sys.exit("this benchmark needs g++: sudo apt install g++")
    with tempfile.TemporaryDirectory() as folder:
        agent = write_files(options.agents, options.agent, Path(folder))
        programs = {kind: compile_program(compiler, Path(folder), kind) for kind in ("one unit", "separate")}
        commands = {kind: [str(program), "inputs", str(PASSES)] for kind, program in programs.items()}
        if options.engine:
            files = [*shlex.split(options.engine), "symbols", "code", "names", "inputs", agent, str(PASSES)]
            commands["engine"] = files
        show(agent, measure(commands, Path(folder), options.rounds))


def write_files(agents: Path, name: str | None, folder: Path) -> str:
    """Write the C++ of an agent, its inputs, and what another engine needs; return the name of the agent."""
    source = load_source(agents)
    compiled = compile_source(source)
    if compiled.program is None:
        sys.exit(f"{agents} has errors: vicode xabsl check {agents}")
    project = import_behavior(source, compiled, "measured").project
    agent = next((each for each in project.agents if each.name == name), project.agents[0])
    run = random_run(project, agent.root, iterations=CYCLES, seed=1)
    write_cpp(run, folder)
    (folder / "inputs").write_text(format_inputs(run), encoding="ascii")
    (folder / "names").write_text("".join(f"{input_symbol(each)}\n" for each in run.inputs), encoding="ascii")
    (folder / "code").write_text(write_code(compiled.program), encoding="utf-8")
    (folder / "symbols").write_text(write_symbols(declared_symbols(compiled.table)), encoding="utf-8")
    return agent.name


def write_cpp(run: ConformanceRun, folder: Path) -> None:
    """Write the sources; `separate` is the driver without those of the components."""
    files = generate(run.project, languages=["cpp"], components=(run.root,))
    apply_diffs(compare_files(files, folder), folder)
    designs = {file.component for file in files if file.component}
    kept = replace(run.project, designs=tuple(each for each in run.project.designs if each.component in designs))
    reserved = GENERATORS["cpp"]().reserved_modules
    driver = write_driver(kept, run.root, [each.key for each in run.inputs], reserved)
    main = _MAIN.replace("INPUTS", str(len(run.inputs)))
    lines = [line for line in driver.splitlines() if not line.endswith('.cpp"')]
    texts = {"driver.hpp": driver_support(), "driver_measured.cpp": driver, "one unit.cpp": main}
    texts |= {
        "driver_separate.cpp": "\n".join(lines),
        "separate.cpp": main.replace("driver_measured", "driver_separate"),
    }
    for name, text in texts.items():
        (folder / "cpp" / name).write_text(text, encoding="utf-8")


def compile_program(compiler: str, folder: Path, kind: str) -> Path:
    """Compile everything together, or each component by itself as the generated CMakeLists.txt does."""
    cpp, sources = folder / "cpp", [f"{kind}.cpp"]
    if kind == "separate":
        sources += sorted(str(path.relative_to(cpp)) for path in cpp.glob("measured/*.cpp"))
    subprocess.run([compiler, *_FLAGS, *sources, "-o", str(folder / kind)], cwd=cpp, check=True)
    return folder / kind


def measure(commands: dict[str, list[str]], folder: Path, rounds: int) -> dict[str, list[list[float]]]:
    """Run the programs in turns; the numbers that each printed in each round."""
    measured: dict[str, list[list[float]]] = {kind: [] for kind in commands}
    for _round in range(rounds):
        for kind, command in commands.items():
            done = subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True)
            measured[kind].append([float(word) for word in done.stdout.split()])
    return measured


def show(agent: str, measured: dict[str, list[list[float]]]) -> None:
    steps = measured["one unit"][0][2]
    print(f"{agent}: {steps:.1f} components in a cycle; ns per cycle, medians of {len(measured['one unit'])} rounds")
    print(f"{'':12}{'inputs':>8}{'behavior':>10}{'cycles/s':>12}{'with inputs':>13}{'ratio':>8}")
    first = [both - writes for writes, both, *_steps in measured["one unit"]]
    for kind, rounds in measured.items():
        behavior = [both - writes for writes, both, *_steps in rounds]
        ratio = median(own / other for own, other in zip(behavior, first, strict=True))
        writes, both = median(each[0] for each in rounds), median(each[1] for each in rounds)
        rates = f"{1e9 / median(behavior):>12,.0f}{1e9 / both:>13,.0f}"
        print(f"{kind:12}{writes:>8.0f}{median(behavior):>10.0f}{rates}{ratio:>8.2f}")


if __name__ == "__main__":
    main()
