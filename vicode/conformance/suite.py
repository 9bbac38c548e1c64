"""Test suites of a design as files: times and inputs, with the states, outputs and parameters that they give.

A step has only what changes, so that a case reads as a story and a change of the design is a small difference in git.
"""

import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from vicode.conformance.inputs import ConformanceRun, RunInput, RunStep
from vicode.conformance.traces import TraceIteration
from vicode.decoding import decode
from vicode.model.project import Project

VERSION = 1
SUFFIX = ".suite.json"
_KEY = "vicode-suite"

Observation = Mapping[str, Any]
"""The state of each component that is stepped, by its name; its outputs and parameters, by "Component.name"."""


class SuiteError(ValueError):
    """A file is no suite, or does not fit its design; the message says why."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SuiteStep:
    """An iteration.

    Attributes:
        time_ns: Its time.
        set: The inputs that change before it, by "Component.output"; parameters of the design by their name. An output
            with arguments has a list of calls, see `derive_value`.
        expect: What changes in the observation; null for a component that is not stepped any more.
        shows: What it shows, in words.
    """

    time_ns: int
    set: dict[str, Any]
    expect: dict[str, Any]
    shows: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class SuiteCase:
    """A run of the design from its start."""

    name: str
    steps: tuple[SuiteStep, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Suite:
    """The tests of a design.

    Attributes:
        component: Its component.
        design: Its file, relative to the folder of the suite.
        source: What the cases were made from: GENERATED, or the file of a trace, relative to the folder of the suite.
        languages: The languages in which they run.
    """

    component: str
    design: str
    source: str
    languages: tuple[str, ...]
    cases: tuple[SuiteCase, ...]

    @property
    def steps(self) -> int:
        """The number of steps of all cases."""
        return sum(len(case.steps) for case in self.cases)


GENERATED = "vicode test gen"


def read_suite(file: Path) -> Suite:
    """Read a suite.

    Raises:
        OSError: The file cannot be read.
        SuiteError: It is no suite.
    """
    try:
        plain = json.loads(file.read_text(encoding="utf-8"))
        if not isinstance(plain, dict) or plain.pop(_KEY, None) != VERSION:
            raise SuiteError(f'{file}: it has no "{_KEY}": {VERSION}')
        return decode(plain, Suite, "suite")
    except (ValueError, TypeError) as error:
        raise error if isinstance(error, SuiteError) else SuiteError(f"{file}: {error}") from error


def format_suite(suite: Suite) -> str:
    """The text of a suite: one line for each step."""
    head = {_KEY: VERSION, "component": suite.component, "design": suite.design, "source": suite.source}
    lines = [f"  {_text(key)}: {_text(value)}," for key, value in {**head, "languages": suite.languages}.items()]
    cases = []
    for case in suite.cases:
        steps = ",\n".join(f"      {_text(_plain(step))}" for step in case.steps)
        cases.append(f'    {{"name": {_text(case.name)}, "steps": [\n{steps}\n    ]}}')
    return "\n".join(["{", *lines, '  "cases": [', ",\n".join(cases), "  ]", "}", ""])


def _plain(step: SuiteStep) -> dict[str, Any]:
    shows = {"shows": step.shows} if step.shows else {}
    return {"time_ns": step.time_ns, "set": step.set, "expect": step.expect, **shows}


def _text(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False)


def make_run(suite: Suite, case: SuiteCase, project: Project) -> ConformanceRun:
    """The run of a case.

    Raises:
        SuiteError: The design has no such component or input.
    """
    if project.design(suite.component) is None:
        raise SuiteError(f"{suite.design} has no design of {suite.component}")
    empty = ConformanceRun(project=project, root=suite.component, steps=())
    inputs = {input_name(each): each for each in empty.inputs}
    unknown = next((name for step in case.steps for name in step.set if name not in inputs), None)
    if unknown is not None:
        raise SuiteError(f"{suite.component} has no input {unknown}")
    steps = (
        RunStep(
            time_ns=step.time_ns,
            inputs=({inputs[name].key: _value(inputs[name], value) for name, value in step.set.items()},),
        )
        for step in case.steps
    )
    is_recorded = suite.source != GENERATED
    return ConformanceRun(project=project, root=suite.component, steps=tuple(steps), holds_outputs=is_recorded)


def make_case(
    name: str, run: ConformanceRun, observations: Iterable[Observation], shows: Mapping[int, str]
) -> SuiteCase:
    """The case of a run of one robot; `shows` has words by the index of a step."""
    names = {each.key: input_name(each) for each in run.inputs}
    inputs = {each.key: repr(each.initial) for each in run.inputs}
    before: Observation = {}
    steps = []
    for index, (step, now) in enumerate(zip(run.steps, observations, strict=True)):
        given = {key: value for key, value in step.inputs[0].items() if inputs[key] != repr(value)}
        inputs |= {key: repr(value) for key, value in given.items()}
        changed = {key: value for key, value in now.items() if key not in before or before[key] != value}
        ended = {key: None for key in before if key not in now}
        steps.append(
            SuiteStep(
                time_ns=step.time_ns,
                set={names[key]: _plain_value(value) for key, value in given.items()},
                expect={**changed, **ended},
                shows=shows.get(index, ""),
            )
        )
        before = now
    return SuiteCase(name=name, steps=tuple(steps))


def iterate_expected(case: SuiteCase) -> Iterator[Observation]:
    """Yield the whole observation of each step."""
    now: dict[str, Any] = {}
    for step in case.steps:
        now |= step.expect
        now = {key: value for key, value in now.items() if value is not None}
        yield now


def observe(project: Project, iterations: Iterable[TraceIteration]) -> Iterator[Observation]:
    """Yield what a suite compares of each iteration of a robot."""
    outputs = {each.component: {f"values.{output.name}" for output in each.outputs} for each in project.designs}
    for iteration in iterations:
        seen: dict[str, Any] = {}
        for step in iteration.steps:
            fields = step.fields
            is_done = fields.get("done") == "true"
            seen[step.component] = f"{fields.get('state') or 'active'}{' (done)' if is_done else ''}"
            for field, text in fields.items():
                if field.startswith("parameters.") or field in outputs.get(step.component, ()):
                    seen[f"{step.component}.{field.partition('.')[2]}"] = _value_of(text)
        yield seen


def observe_records(project: Project) -> Callable[[Sequence[Mapping[str, Any]]], object]:
    """What a suite compares of the records of one iteration, for the reference interpreter only, as it is faster."""
    outputs = {each.component: {output.name for output in each.outputs} for each in project.designs}

    def observe_iteration(records: Sequence[Mapping[str, Any]]) -> object:
        (record,) = records
        seen = {}
        for step in record["tree"]:
            shown = outputs.get(step["component"], ())
            values = [(name, value) for name, value in step["values"].items() if name in shown]
            seen[step["component"]] = (step["state"], step["done"], step["parameters"], values)
        return repr(seen)

    return observe_iteration


def find_mismatch(expected: Observation, seen: Observation) -> tuple[str, Any, Any] | None:
    """The first name whose values differ, with both; outputs that the suite does not know are left out."""
    for name in dict.fromkeys((*expected, *(each for each in seen if "." not in each))):
        if expected.get(name) != seen.get(name):
            return name, expected.get(name), seen.get(name)
    return None


def input_name(each: RunInput) -> str:
    return f"{each.component}.{each.name}" if each.component else each.name


def list_files(folder: Path) -> Sequence[Path]:
    """The suites of a folder."""
    return sorted(folder.glob(f"*{SUFFIX}"))


def _value_of(text: str) -> Any:
    """The value of a text of a trace; the texts of infinities and nan stay texts."""
    try:
        return json.loads(text)
    except ValueError:
        return text


def _plain_value(value: Any) -> Any:
    """A value as JSON has it; infinities and nan as in traces."""
    if isinstance(value, list):
        return [[arguments, _plain_value(each)] for arguments, each in value]
    return value if not isinstance(value, float) or abs(value) < float("inf") else repr(value)


def _value(each: RunInput, value: Any) -> Any:
    if isinstance(value, list):
        return [[arguments, _value(each, given)] for arguments, given in value]
    return float(value) if isinstance(value, str) and not each.elements else value
