"""Runs designs in C++: generated code with a generated driver, compiled with g++ or clang++."""

import json
import shlex
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path

from vicode.conformance.inputs import ConformanceRun, as_number
from vicode.conformance.traces import TraceIteration, TraceNormalizer
from vicode.generators import GENERATORS, generate
from vicode.generators.cpp.compiler import find_compiler
from vicode.generators.cpp.driver import driver_support, write_driver, write_main
from vicode.model.project import Project
from vicode.output import apply_diffs, compare_files

COMPILER_MISSING = "there is no g++ or clang++ (Debian: sudo apt install g++)"
DEFAULT_FLAGS = "-O2"
_FLAGS = ("-std=c++17", "-w")


@dataclass(frozen=True, slots=True, kw_only=True)
class CppTools:
    """What compiles a program and runs it: commands with their arguments.

    Args:
        compiler: The compiler with its flags.
        emulator: Stands before the program; empty if this machine runs it.
    """

    compiler: tuple[str, ...]
    emulator: tuple[str, ...] = ()


class CompileError(Exception):
    """The generated code does not compile; the message contains that of the compiler."""


class ProgramError(Exception):
    """A compiled program crashed."""


class ToolError(Exception):
    """A compiler or emulator cannot be found."""


def find_tools(compiler: str = "", emulator: str = "") -> CppTools | None:
    """Return the tools that the user names, or the compiler of this machine; None if there is none.

    Args:
        compiler: The compiler with its flags, as in a shell; "": the one that is found, with `DEFAULT_FLAGS`.
        emulator: A command before the program, as in a shell.

    Raises:
        ToolError: A command cannot be found or read.
    """
    default = shlex.join([path, DEFAULT_FLAGS]) if (path := find_compiler()) else ""
    if not compiler and not default:
        return None
    return CppTools(compiler=_split(compiler or default), emulator=_split(emulator) if emulator else ())


def _split(command: str) -> tuple[str, ...]:
    try:
        words = shlex.split(command)
    except ValueError as error:
        raise ToolError(f"{command}: {error}") from error
    if not words or shutil.which(words[0]) is None:
        raise ToolError(f"there is no command {words[0] if words else repr(command)}")
    return tuple(words)


class CppProgram:
    """Programs that contain several runs; each run has its own namespace, a single one that of its project.

    Args:
        runs: Runs by name; the names are valid C++ names and differ.
        folder: An empty folder for code and traces.
        tools: What compiles and runs the programs.
        programs: Number of programs, which are compiled two at a time.

    Raises:
        CompileError: The code does not compile.
        UnsoundDesignError: A design cannot be generated.
    """

    def __init__(self, runs: Mapping[str, ConformanceRun], folder: Path, tools: CppTools, programs: int = 1) -> None:
        self._runs, self._folder, self._tools = runs, folder, tools
        names = list(runs)
        self._groups = [group for group in (names[start::programs] for start in range(programs)) if group]
        for name, run in runs.items():
            self._write(name, run)
        (folder / "cpp" / "driver.hpp").write_text(driver_support(), encoding="utf-8")
        with ThreadPoolExecutor(max_workers=2) as pool:
            list(pool.map(self._compile, range(len(self._groups))))

    def _write(self, name: str, run: ConformanceRun) -> None:
        project = self._named(name)
        files = generate(project, languages=("cpp",), components=(run.root,))
        apply_diffs(compare_files(files, self._folder), self._folder)
        designs = {file.component for file in files if file.component}
        kept = replace(project, designs=tuple(each for each in project.designs if each.component in designs))
        text = write_driver(kept, run.root, [each.key for each in run.inputs], GENERATORS["cpp"]().reserved_modules)
        (self._folder / "cpp" / f"driver_{name}.cpp").write_text(text, encoding="utf-8")

    def _named(self, name: str) -> Project:
        project = self._runs[name].project
        return replace(project, name=name) if len(self._runs) > 1 else project

    def _compile(self, index: int) -> None:
        source, program = self._folder / "cpp" / f"main{index}.cpp", self._folder / f"program{index}"
        source.write_text(
            write_main((f"driver_{name}.cpp", name, self._named(name)) for name in self._groups[index]),
            encoding="utf-8",
        )
        compiler, *flags = self._tools.compiler
        command = [compiler, *_FLAGS, *flags, "-I", str(self._folder / "cpp"), "-o", str(program), str(source)]
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
            command = [*self._tools.emulator, str(self._folder / f"program{index}"), *arguments]
            done = subprocess.run(command, capture_output=True, check=False)
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


def run_cpp(
    runs: Mapping[int, ConformanceRun], folder: Path, tools: CppTools | None
) -> dict[int, list[TraceIteration]]:
    """Compile the design of runs once and run all, which differ in their inputs; see `CppProgram` for errors."""
    assert tools is not None
    program = CppProgram({"compared": next(iter(runs.values()))}, folder, tools)
    return {number: program.run({"compared": run})["compared"] for number, run in runs.items()}


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
