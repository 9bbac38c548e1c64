"""Runs designs in C++: generated code with a generated driver, compiled with g++ or clang++."""

import json
import os
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

from vicode.conformance.inputs import ConformanceRun, as_number
from vicode.conformance.traces import TraceIteration, TraceNormalizer
from vicode.generators import GENERATORS, generate
from vicode.generators.cpp.driver import driver_support, write_driver, write_main
from vicode.output import apply_diffs, compare_files

COMPILER_MISSING = "there is no g++ or clang++ (Debian: sudo apt install g++)"
_FLAGS = ("-std=c++17", "-O0", "-ffp-contract=off", "-w")


class CompileError(Exception):
    """The generated code does not compile; the message contains that of the compiler."""


class ProgramError(Exception):
    """A compiled program crashed."""


def find_compiler() -> str | None:
    """The C++ compiler: $CXX, g++ or clang++."""
    return next(
        (path for name in (os.environ.get("CXX", ""), "g++", "clang++") if name and (path := shutil.which(name))), None
    )


class CppProgram:
    """Programs that contain several runs; each run has its own namespace.

    Args:
        runs: Runs by name; the names are valid C++ names and differ.
        folder: An empty folder for code and traces.
        compiler: The command of the compiler.
        programs: Number of programs, which are compiled two at a time.

    Raises:
        CompileError: The code does not compile.
        UnsoundDesignError: A design cannot be generated.
    """

    def __init__(self, runs: Mapping[str, ConformanceRun], folder: Path, compiler: str, programs: int = 1) -> None:
        self._runs, self._folder = runs, folder
        names = list(runs)
        self._groups = [group for group in (names[start::programs] for start in range(programs)) if group]
        for name, run in runs.items():
            self._write(name, run)
        (folder / "cpp" / "driver.hpp").write_text(driver_support(), encoding="utf-8")
        with ThreadPoolExecutor(max_workers=2) as pool:
            list(pool.map(lambda index: self._compile(index, compiler), range(len(self._groups))))

    def _write(self, name: str, run: ConformanceRun) -> None:
        project = replace(run.project, name=name)
        files = generate(project, languages=("cpp",), components=(run.root,))
        apply_diffs(compare_files(files, self._folder), self._folder)
        designs = {file.component for file in files if file.component}
        kept = replace(project, designs=tuple(each for each in project.designs if each.component in designs))
        text = write_driver(kept, run.root, [each.key for each in run.inputs], GENERATORS["cpp"]().reserved_modules)
        (self._folder / "cpp" / f"driver_{name}.cpp").write_text(text, encoding="utf-8")

    def _compile(self, index: int, compiler: str) -> None:
        source, program = self._folder / "cpp" / f"main{index}.cpp", self._folder / f"program{index}"
        source.write_text(write_main((f"driver_{name}.cpp", name) for name in self._groups[index]), encoding="utf-8")
        command = [compiler, *_FLAGS, "-I", str(self._folder / "cpp"), "-o", str(program), str(source)]
        done = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False)
        if done.returncode:
            raise CompileError("\n".join(["the generated C++ does not compile", *done.stderr.splitlines()[:20]]))

    def run(self, others: Mapping[str, ConformanceRun] | None = None) -> dict[str, list[TraceIteration]]:
        """Run everything, or other runs of the same designs; returns the iterations by name.

        Raises:
            ProgramError: A program crashed.
        """
        runs = others or self._runs
        for index, names in enumerate(self._groups):
            arguments: list[str] = []
            for name in names:
                run, inputs = runs[name], self._folder / f"{name}.inputs"
                inputs.write_text(format_inputs(run), encoding="ascii")
                traces = str(self._folder / f"{name}.trace")
                arguments += [name, str(inputs), str(run.team_ticks), str(run.robots), traces]
            done = subprocess.run([self._folder / f"program{index}", *arguments], capture_output=True, check=False)
            if done.returncode:
                message = done.stderr.decode(errors="replace").strip()[-2000:]
                raise ProgramError(f"the program ended with exit code {done.returncode}\n{message}".strip())
        return {name: self._read(name, run) for name, run in runs.items()}

    def _read(self, name: str, run: ConformanceRun) -> list[TraceIteration]:
        normalizer = TraceNormalizer(run.project)
        traces = []
        for robot in range(run.robots):
            lines = (self._folder / f"{name}.trace{robot}").read_text(encoding="utf-8").splitlines()[1:]
            traces.append([normalizer.iteration(json.loads(line), robot) for line in lines])
        return interleave(traces)


def interleave(traces: Sequence[Sequence[TraceIteration]]) -> list[TraceIteration]:
    """The iterations of several robots in one list, ordered by time."""
    return [iteration for iterations in zip(*traces, strict=True) for iteration in iterations]


def format_inputs(run: ConformanceRun) -> str:
    """The lines that the driver reads: initial values, then the inputs and the time of each iteration."""
    numbers = {each.key: (number, each) for number, each in enumerate(run.inputs)}
    lines = [
        f"s {robot} {number} {as_number(each.initial, each.elements)!r}"
        for robot in range(run.robots)
        for number, each in numbers.values()
    ]
    for step in run.steps:
        for robot, values in enumerate(step.inputs):
            for key, value in values.items():
                number, each = numbers[key]
                lines.append(f"s {robot} {number} {as_number(value, each.elements)!r}")
        lines.append(f"t {step.time_ns}")
    return "".join(f"{line}\n" for line in lines)
