"""Sweeps: runs of a design for combinations of values and seeds.

Each run is a process of its own: no run sees what another one left in a module. A thread waits for it; a pool of Python
processes would start two for each run.
"""

import json
import os
import re
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, replace
from decimal import Context, Decimal
from itertools import product
from pathlib import Path
from typing import Any

from vicode.model.project import Project
from vicode.platform import session_options
from vicode.runs.changed_values import ChangedValue, ChangedValueError, parse_changed_value
from vicode.runs.foreground import kill_group
from vicode.simulation import IterationResult
from vicode.simulation.environment import fresh_environment
from vicode.traces.statistics import read_history, sum_states

SECONDS, TAKEN = "seconds.", "taken."
"""Prefixes of the time in a state, and of how often a transition was taken."""

MAX_RUNS = 100_000

ORIGIN_KEY = "vicode-sweep"
"""The first key of a file of runs."""

Row = Mapping[str, Any]
"""A finished run: its `values`, `seed`, `error` ("" if there was none), and the figures that are known."""

_RANGE = re.compile(r"\s*(-?\d*\.?\d+)\.\.(-?\d*\.?\d+):([2-9]|[1-9]\d+)\s*")
_NUMBERS = (bool, int, float)
_REMEDY = "move it, or choose another --out"
_ERROR, _REPEATED = "error: ", " (reported once; repetitions are only counted)"


class OtherRunsError(OSError):
    """A file has runs that cannot be continued; the message is one line."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Combination:
    """A value of each swept name; `is_baseline`: these are the values of the files."""

    changes: tuple[ChangedValue, ...]
    values: Mapping[str, Any]
    is_baseline: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class SweepRun:
    """A run to do; `code` is the folder of its generated code, `arguments` are those of the runtime.

    A match (`module`) also has folders of the second version, below that of all generated code.
    """

    values: Mapping[str, Any]
    seed: int
    code: str
    arguments: tuple[str, ...]
    module: str = "vicode.bica"
    second: tuple[str, ...] = ()


Submit = Callable[[SweepRun], "Future[Row]"]


def parse_values(text: str, project: Project) -> tuple[ChangedValue, ...]:
    """Read `NAME=FIRST..LAST:COUNT`, which are values at equal distances, or `NAME=VALUE,VALUE`.

    Raises:
        ChangedValueError: There is no such parameter or constant, a value does not suit it, or there are more than
            MAX_RUNS values.
    """
    name, _equals, values = text.partition("=")
    texts = values.split(",")
    if found := _RANGE.fullmatch(values):
        first, last = Decimal(found[1]), Decimal(found[2])
        if Decimal(found[3]) > MAX_RUNS:
            raise ChangedValueError(f"{found[3]} values are too many: a sweep has at most {MAX_RUNS} runs")
        count = int(found[3])
        steps = (first + (last - first) * number / (count - 1) for number in range(count))
        texts = [f"{Context(prec=6).plus(each).normalize():f}" for each in steps]
    elif ".." in values:
        raise ChangedValueError("write a range as FIRST..LAST:COUNT, such as 0.2..0.6:5")
    return tuple(parse_changed_value(f"{name}={each}", project) for each in texts)


def combine(axes: Sequence[tuple[ChangedValue, ...]], project: Project) -> list[Combination]:
    """All combinations of the values, in order; those of the files are always among them."""
    names = [axis[0].full_name for axis in axes]
    if twice := [name for name in names if names.count(name) > 1]:
        raise ChangedValueError(f"{twice[0]} is set twice; separate its values by commas")
    baseline = tuple(replace(axis[0], text=axis[0].text_in(project)) for axis in axes)
    found: dict[tuple[Any, ...], Combination] = {}
    for changes in (baseline, *product(*axes)):
        key = tuple(_shorten(change.evaluate(project)) for change in changes)
        values = dict(zip(names, key, strict=True))
        found.setdefault(key, Combination(changes=changes, values=values, is_baseline=not found))
    return [found[key] for key in sorted(found)]


def _shorten(value: Any) -> Any:
    """2 instead of 2.0: the value of a float may be written as either."""
    return int(value) if isinstance(value, float) and value.is_integer() else value


def check_folder(runs: Path, results: Sequence[Path]) -> None:
    """Check that results may be written: they are those of a sweep if their folder has a file of runs.

    Raises:
        OtherRunsError: There are no runs, but a file with the name of a result.
    """
    if runs.exists() and runs.stat().st_size:
        return
    if foreign := next((file for file in results if file.exists()), None):
        raise OtherRunsError(f"{foreign} is not replaced, as there is no {runs.name} of a sweep beside it; {_REMEDY}")


@contextmanager
def open_runs(path: Path, origin: Row, *, is_new: bool) -> Iterator[tuple[list[Row], Callable[[Row], object]]]:
    """Open a file of finished runs: yield those that it has, and a function that appends one.

    Each line is a JSON object, the first one the origin. A last line that was cut off is removed.

    Args:
        path: The file; it is created if needed.
        origin: What all runs have in common, such as a hash of the design.
        is_new: Whether to remove the runs that it has.

    Raises:
        OtherRunsError: The file has runs of another origin, or other contents; these are not removed.
        OSError: The file cannot be read or written.
    """
    with path.open("a+b", buffering=0) as stream:

        def append(row: Row) -> None:
            stream.write(json.dumps(row).encode() + b"\n")

        stream.seek(0)
        content, start = stream.read(), f'{{"{ORIGIN_KEY}": '.encode()
        # The first line may have been cut off.
        if not start.startswith(content[: len(start)]):
            raise OtherRunsError(f"{path} is not replaced, as 'vicode sweep' did not write it; {_REMEDY}")
        whole = b"" if is_new else content.rpartition(b"\n")[0]
        try:
            known, *rows = [json.loads(line) for line in whole.splitlines()] or [origin]
        except ValueError:
            known, rows = {}, []
        if changed := [name for name in origin if known.get(name) != origin[name]]:
            remedy = "choose another --out, or remove these runs with --again"
            raise OtherRunsError(f"{path} has runs with another {changed[0]}; {remedy}")
        stream.truncate(len(whole) + 1 if whole else 0)
        if not whole:
            append(origin)
        yield rows, append


@contextmanager
def local_runs(jobs: int, code: Path, project: Path) -> Iterator[Submit]:
    """Execute `jobs` runs at a time on this machine; at the end of the context, unfinished ones are killed."""
    children: list[subprocess.Popen[str]] = []
    has_ended = threading.Event()

    def keep(child: "subprocess.Popen[str]") -> None:
        children.append(child)
        if has_ended.is_set():
            kill_group(child)

    pool = ThreadPoolExecutor(jobs)
    try:
        yield lambda run: pool.submit(execute, run, code, project, keep)
    finally:
        has_ended.set()
        pool.shutdown(wait=False, cancel_futures=True)
        for child in children:
            kill_group(child)
        pool.shutdown()


def execute(
    run: SweepRun, code: Path, project: Path, on_start: Callable[["subprocess.Popen[str]"], None] = lambda _child: None
) -> Row:
    """Execute a run; whatever happens in it, there is a row.

    Args:
        run: The run.
        code: The folder with the folders of generated code.
        project: The folder of the project.
        on_start: Called with the process.
    """
    paths = [str(code / run.code / "python"), str(project), *(str(code / folder) for folder in run.second)]
    # -P: files in the current folder must not shadow modules.
    command = [sys.executable, "-P", "-m", run.module, *run.arguments, "--seed", str(run.seed)]
    child = subprocess.Popen(
        [*command, *(word for path in paths for word in ("--path", path))],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        stdin=subprocess.DEVNULL,
        encoding="utf-8",
        errors="replace",
        # Sets of texts have the same order in each run.
        env=fresh_environment(PYTHONHASHSEED="0"),
        **session_options(),
    )
    on_start(child)
    out, err = child.communicate()
    records = [record for record in map(_parse, out.splitlines()) if record.keys() & {"tree", "summary"}]
    figures = _read_figures(records[:-1], records[-1]["summary"]) if records and "summary" in records[-1] else {}
    error, lines = "", err.splitlines()
    if child.returncode or not figures or records[-1]["summary"]["errors"]:
        reported = [line.removeprefix(_ERROR).removesuffix(_REPEATED) for line in lines if line.startswith(_ERROR)]
        error = (reported or [": ".join([f"the program ended with exit code {child.returncode}", *lines[-1:]])])[0]
    for path in paths:
        error = error.replace(f"{path}{os.sep}", "")
    return {"values": run.values, "seed": run.seed, "error": error, **figures}


def _parse(line: str) -> dict[str, Any]:
    """A record; empty for what the code of the design printed."""
    try:
        record = json.loads(line)
    except ValueError:
        return {}
    return record if isinstance(record, dict) else {}


def _read_figures(records: list[dict[str, Any]], summary: Mapping[str, Any]) -> dict[str, Any]:
    """The figures of a run, from its iterations with changes and its summary."""
    world = summary["world"] if isinstance(summary["world"], dict) else {}
    numbers = {f"world.{name}": each for name, each in world.items() if each is None or isinstance(each, _NUMBERS)}
    done_ns = next((record["time_ns"] for record in records if record["tree"][0]["done"]), None)
    figures = {"stopped": summary["stopped"], "state": summary["state"], "time_s": _seconds(summary["time_ns"])}
    figures |= {"done_s": None if done_ns is None else _seconds(done_ns), **numbers}
    last = [{**step, "changed_from": None} for step in records[-1]["tree"]] if records else []
    times = [*((record["time_ns"], record["tree"]) for record in records), (summary["time_ns"], last)]
    history = read_history(IterationResult(iteration=0, time_ns=time_ns, tree=tree) for time_ns, tree in times)
    for component, states in sum_states([history]).items():
        figures |= {f"{SECONDS}{component}.{state}": _seconds(each.total_ns) for state, each in states.items()}
    for (component, source, target, _id), count in history.transitions.items():
        name = f"{TAKEN}{component}.{source}->{target}"
        figures[name] = figures.get(name, 0) + count
    return figures


def _seconds(ns: int) -> float:
    return round(ns / 1e9, 6)
