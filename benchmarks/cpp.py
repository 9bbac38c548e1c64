"""Time of one iteration in C++: the generated component compared with a hand-written switch, in one program.

Run it with `python -m benchmarks.cpp`; it needs g++. Both get the same inputs and must pass through the same states.
It also shows the size of the object code of designs/forward.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from benchmarks.sample_machines import TIMER_NS, Machine, make_machine, make_project
from vicode.generators import generate
from vicode.output import apply_diffs, compare_files
from vicode.store import open_project

FORWARD = Path(__file__).parents[1] / "designs" / "forward"
_FLAGS = ("-std=c++17", "-O2", "-ffp-contract=off")

_MAIN = """
#include <algorithm>
#include <array>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "bench/components.hpp"
#include "hand_written.hpp"

namespace {

constexpr bica::Nanoseconds tick_ns = 20'000'000;
using Input = std::array<double, 3>;

template <class Step>
double measure(bench::Senses& senses, const std::vector<Input>& inputs, bica::Nanoseconds& now, Step step) {
    const bica::Nanoseconds begin = bica::clock_ns();
    for (const Input& input : inputs) {
        senses.a = input[0];
        senses.b = input[1];
        senses.c = input[2];
        now += tick_ns;
        step(now);
    }
    return static_cast<double>(bica::clock_ns() - begin) / static_cast<double>(inputs.size());
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

}  // namespace

int main(int, char** words) {
    std::mt19937_64 chance(1);
    std::uniform_real_distribution<double> draw(0.0, 1.0);
    std::vector<Input> inputs(100'000);
    for (Input& input : inputs) {
        input = {draw(chance), draw(chance), draw(chance)};
    }
    bica::Root root;
    bench::Components components(root);
    HandWritten hand(components.senses);
    bica::Nanoseconds ours = 0;
    bica::Nanoseconds theirs = 0;
    std::int64_t iteration = 0;
    std::vector<double> generated;
    std::vector<double> written;
    std::vector<double> ratios;
    for (int round = 0; round < std::stoi(words[1]); ++round) {
        const auto step_hand = [&](bica::Nanoseconds now) { hand.step(now, ++iteration); };
        const auto step_ours = [&](bica::Nanoseconds now) { root.step(components.measured, now); };
        written.push_back(measure(components.senses, inputs, theirs, step_hand));
        generated.push_back(measure(components.senses, inputs, ours, step_ours));
        ratios.push_back(generated.back() / written.back());
        if (hand.state_name() != components.measured.state_name() || hand.changes != components.measured.changes) {
            std::printf("the two pass through other states\\n");
            return 1;
        }
    }
    std::printf("%8.2f %8.2f %8.2f\\n", median(written), median(generated), median(ratios));
    return 0;
}
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=15, help="the median of so many is shown (15)")
    options = parser.parse_args()
    compiler = shutil.which("g++")
    if compiler is None:
        sys.exit("this benchmark needs g++: sudo apt install g++")
    print(f"ns per tick of 100,000 ticks, median of {options.rounds}; {' '.join(_FLAGS)}")
    print(f"{'':32}{'switch':>8} {'ours':>8} {'ratio':>8}")
    for title, machine in (
        ("6 states, 12 transitions", make_machine(6, 2, acts=True)),
        ("200 states x 3", make_machine(200, 3, acts=True)),
    ):
        with tempfile.TemporaryDirectory() as folder:
            print(f"{title:32}{measure_machine(compiler, machine, Path(folder), options.rounds)}")
    with tempfile.TemporaryDirectory() as folder:
        print(f"\nobject code of designs/forward, -Os: {measure_size(compiler, Path(folder))}")


def measure_machine(compiler: str, machine: Machine, folder: Path, rounds: int) -> str:
    """Compile both, run them, and return the times."""
    project = make_project(machine, senses="", counts=True)
    apply_diffs(compare_files(generate(project, languages=["cpp"]), folder), folder)
    sources = folder / "cpp"
    (sources / "main.cpp").write_text(_MAIN, encoding="utf-8")
    (sources / "hand_written.hpp").write_text(write_class(machine), encoding="utf-8")
    (sources / "hand_written.cpp").write_text(write_switch(machine), encoding="utf-8")
    command = [compiler, *_FLAGS, "-I.", "main.cpp", "hand_written.cpp", "bench/measured.cpp", "-o", "bench.out"]
    subprocess.run(command, cwd=sources, check=True)
    return subprocess.run(
        [str(sources / "bench.out"), str(rounds)], check=True, capture_output=True, text=True
    ).stdout.rstrip()


def measure_size(compiler: str, folder: Path) -> str:
    project = open_project(FORWARD).project
    apply_diffs(compare_files(generate(project, languages=["cpp"]), folder), folder)
    sources = folder / "cpp"
    total = 0
    for source in sorted((sources / "forward").glob("*.cpp")):
        flags = [*_FLAGS, "-Os", "-fno-exceptions", "-fno-rtti", "-I."]
        subprocess.run([compiler, *flags, "-c", str(source), "-o", f"{source.stem}.o"], cwd=sources, check=True)
        sizes = subprocess.run(
            ["size", f"{source.stem}.o"], cwd=sources, check=True, capture_output=True, text=True
        ).stdout
        total += sum(map(int, sizes.splitlines()[1].split()[:3]))
    return f"{total:,} bytes of text, data and bss"


def write_class(machine: Machine) -> str:
    """The hand-written class that the generated one is compared with."""
    states = ", ".join(f"S{number}" for number in range(len(machine.edges)))
    return f"""#pragma once
#include "bench/interfaces.hpp"

class HandWritten {{
public:
    enum class State : unsigned char {{ {states} }};

    explicit HandWritten(const bench::Senses& senses) : senses_(senses) {{}}
    /// Restarts if it was not stepped in the iteration before, as the generated component does.
    void step(bica::Nanoseconds now, std::int64_t iteration);
    std::string state_name() const {{ return "S" + std::to_string(static_cast<int>(state_)); }}

    std::int64_t speed = 0;
    std::int64_t changes = 0;

private:
    void change_to(State next, bica::Nanoseconds now) {{
        state_ = next;
        entered_ = now;
        ++changes;
    }}

    const bench::Senses& senses_;
    State state_ = State::S0;
    std::int64_t stepped_in_ = -1;
    bica::Nanoseconds started_ = 0;
    bica::Nanoseconds entered_ = 0;
    bica::Nanoseconds worked_ = 0;
}};
"""


def write_switch(machine: Machine) -> str:
    """Decide in one switch, act in another, at 50 Hz."""
    lines = ["#include <string>", '#include "hand_written.hpp"', ""]
    lines += ["void HandWritten::step(bica::Nanoseconds now, std::int64_t iteration) {"]
    lines += ["    if (iteration - stepped_in_ > 1) {", "        state_ = State::S0;"]
    lines += ["        started_ = entered_ = now;", "        worked_ = now - 20'000'000;", "    }"]
    lines += ["    stepped_in_ = iteration;"]
    lines += ["    if (now - worked_ < 20'000'000) {", "        return;", "    }", "    worked_ = now;"]
    lines += ["    switch (state_) {"]
    for number, edges in enumerate(machine.edges):
        lines.append(f"        case State::S{number}:")
        for index, edge in enumerate(edges):
            test = f"senses_.{edge.sense} > 0.9" if edge.sense else f"now - entered_ >= {TIMER_NS}"
            lines.append(f"            {'} else ' if index else ''}if ({test}) {{")
            lines.append(f"                change_to(State::S{edge.target}, now);")
        lines += ["            }", "            break;"]
    lines += ["    }", "    switch (state_) {"]
    for number in range(len(machine.edges)):
        lines += [f"        case State::S{number}:", f"            speed = {number};", "            break;"]
    return "\n".join([*lines, "    }", "}", ""])


if __name__ == "__main__":
    main()
