"""Runs jobs of the Python adapters: one JSON line per job on standard input, one per result on standard output.

Generated code runs in a process of its own, as it may print, change the process or end it. One process runs all jobs,
as starting Python takes longer than most of them. The modules of each run are imported anew: they may hold values, and
projects may have modules of the same name.
"""

from __future__ import annotations

import importlib
import json
import os
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from enum import Enum
from typing import Any

from vicode.bica import Component, Observer, Root
from vicode.bica.loader import load_component
from vicode.conformance.inputs import InputKind, OutputArgument, RunInput, derive_value, element_of
from vicode.model.names import python_attribute_name
from vicode.simulation.host import RunHost
from vicode.simulation.limits import CapturedOutput
from vicode.simulation.messages import Stub, StubOutput, decode_setup
from vicode.simulation.stubs import STUB_MODULE, StubComponent, convert_value, install_stub_module

Step = tuple[int, int, list[dict[tuple[str, str], Any]]]
"""What the clock shows, the time of the iteration, and the inputs of each robot."""


def main() -> int:
    """Run the jobs; what user code prints goes to standard error."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    for line in sys.stdin:
        job = json.loads(line)
        try:
            result: dict[str, Any] = {"iterations": [_run({**job, **inputs}) for inputs in job["runs"]]}
        except Exception as error:
            result = {"error": f"{type(error).__name__}: {error}"}
        answers.write(f"{json.dumps(result)}\n")
    answers.close()
    return 0


def _run(job: Mapping[str, Any]) -> list[tuple[int, Any]]:
    """Import the code anew for each run: modules may hold values."""
    with _fresh_modules(job["path"]):
        return _RUNNERS[job["kind"]](job)


def _run_python(job: Mapping[str, Any]) -> list[tuple[int, Any]]:
    """Run generated code on the runtime; the world and hand-written components are stubs."""
    inputs = _read_inputs(job)
    install_stub_module(tuple(_read_stub(each) for each in job["stubs"]))
    robots = [_PythonRobot(job, inputs, number) for number in range(job["robots"])]
    iterations: list[tuple[int, Any]] = []
    sent = [robot.root.team.tell() for robot in robots]
    for clock_ns, _time_ns, values in _read_steps(job):
        received = list(sent)
        for number, robot in enumerate(robots):
            robot.set_inputs(values[number])
            if len(robots) > 1:
                robot.root.team.prepare()
            for sender, message in enumerate(received):
                if sender != number:
                    robot.root.team.hear(message)
            iterations.append((number, robot.step(clock_ns)))
            sent[number] = robot.root.team.tell()
    return iterations


class _PythonRobot:
    def __init__(self, job: Mapping[str, Any], inputs: dict[tuple[str, str], RunInput], number: int) -> None:
        self._inputs, self._clock, self._world = inputs, _GivenClock(), _World()
        for name in job["behaviors"]:
            setattr(self._world, name, lambda **_arguments: None)
        self._observer = Observer(values=True)
        main = load_component(job["component"])
        self.root = Root(
            main, clock=self._clock, world=self._world, on_error=lambda _error: None, observer=self._observer
        )
        self.root.team.priority, self.root.team.ticks = number, job["team_ticks"]
        self._components: dict[str, Component] = {type(each).__name__: each for each in self.root.components}
        self._enumerations = _load_enumerations(job["component"])
        for stub in _prepare_stubs(self.root.components, job):
            stub.set_initial_values(self._enumerations)
        self.set_inputs({key: each.initial for key, each in inputs.items()})

    def set_inputs(self, values: Mapping[tuple[str, str], Any]) -> None:
        for key, value in values.items():
            each = self._inputs[key]
            name = python_attribute_name(each.xabsl_name or each.name)
            component = self._components.get(each.component, self.root.main)
            if each.kind is InputKind.WORLD:
                # The world uses the elements' names in XABSL.
                if each.arguments is not None:
                    self._world.__dict__[name] = _plain_function(each, value, self._enumerations)
                else:
                    plain = self._enumerations[each.type][element_of(value)].value if each.elements else value
                    self._world.__dict__[name] = plain
            elif each.arguments is None:
                typed = convert_value(value, each.type, self._enumerations)
                if isinstance(component, StubComponent):
                    component.set_outputs({each.name: value})
                else:
                    setattr(component, each.name, typed)
            else:
                component.__dict__[each.name] = _typed_function(each, value, self._enumerations)

    def step(self, clock_ns: int) -> Any:
        self._clock.time_ns = clock_ns
        for component in self._components.values():
            if isinstance(component, StubComponent):
                component.hold_outputs()
        self.root.step()
        return self._observer.records.pop()


def _run_simulator(job: Mapping[str, Any]) -> list[tuple[int, Any]]:
    """Run the simulation of the editor."""
    inputs = _read_inputs(job)
    host = RunHost(decode_setup(job["setup"].encode()), CapturedOutput())
    enumerations = _load_enumerations(decode_setup(job["setup"].encode()).component)
    stubs = {each.stub.component: each for each in _prepare_stubs(host.main.root.components, job)}
    iterations: list[tuple[int, Any]] = []

    def set_inputs(values: Mapping[tuple[str, str], Any]) -> None:
        plain: dict[str, dict[str, Any]] = {}
        for key, value in values.items():
            each = inputs[key]
            if each.arguments is None:
                plain.setdefault(each.component, {})[each.name] = value
            else:
                stubs[each.component].__dict__[each.name] = _typed_function(each, value, enumerations)
        host.set_inputs(plain)

    set_inputs({key: each.initial for key, each in inputs.items()})
    # Its clock cannot be set back: it gets the times of the iterations.
    for _clock_ns, time_ns, (values,) in _read_steps(job):
        set_inputs(values)
        result = host.step(time_ns)
        record = {name: getattr(result, name) for name in ("iteration", "time_ns", "tree", "inputs", "errors")}
        iterations.append((0, record))
    return iterations


def _prepare_stubs(components: Iterable[Component], job: Mapping[str, Any]) -> list[StubComponent]:
    """The stubs among components; they get the declared frequencies, which hand-written classes have."""
    stubs = [each for each in components if isinstance(each, StubComponent)]
    for stub in stubs:
        stub.set_frequency(job["frequencies"].get(stub.stub.component) or 0)
    return stubs


_RUNNERS: dict[str, Callable[[Mapping[str, Any]], list[tuple[int, Any]]]] = {
    "python": _run_python,
    "simulator": _run_simulator,
}


class _GivenClock:
    """A clock that shows what the inputs say; it may be set back."""

    time_ns = 0

    def now_ns(self) -> int:
        return self.time_ns


class _World:
    """The symbols of the world as attributes."""


def _plain_function(each: RunInput, base: Any, enumerations: Mapping[str, type[Enum]]) -> Callable[..., Any]:
    """An output of the world: names and elements are those of XABSL."""
    arguments = {python_attribute_name(item.xabsl_name or item.name): item for item in each.arguments or ()}

    def read(**plain: Any) -> Any:
        items = [(arguments[name], value) for name, value in plain.items()]
        given = {item.name: enumerations[item.type](value) if item.elements else value for item, value in items}
        value = derive_value(each, base, given)
        return enumerations[each.type][element_of(value)].value if each.elements else value

    return read


def _typed_function(each: RunInput, base: Any, enumerations: Mapping[str, type[Enum]]) -> Callable[..., Any]:
    return lambda **given: convert_value(derive_value(each, base, given), each.type, enumerations)


def _load_enumerations(class_path: str) -> dict[str, type[Enum]]:
    package = class_path.partition(".")[0]
    with suppress(ModuleNotFoundError):
        module = importlib.import_module(f"{package}.declarations")
        return {name: each for name, each in vars(module).items() if isinstance(each, type) and issubclass(each, Enum)}
    return {}


def _read_inputs(job: Mapping[str, Any]) -> dict[tuple[str, str], RunInput]:
    inputs = {}
    for given in job["inputs"]:
        plain = dict(given)
        arguments = plain.pop("arguments")
        each = RunInput(
            **{**plain, "elements": tuple(plain["elements"]), "kind": InputKind(plain["kind"])},
            arguments=None if arguments is None else tuple(OutputArgument(**item) for item in arguments),
        )
        inputs[each.key] = each
    return inputs


def _read_steps(job: Mapping[str, Any]) -> Iterator[Step]:
    for clock_ns, time_ns, robots in job["steps"]:
        yield clock_ns, time_ns, [{(component, name): value for component, name, value in values} for values in robots]


def _read_stub(plain: dict[str, Any]) -> Stub:
    return Stub(**{**plain, "outputs": tuple(StubOutput(**output) for output in plain["outputs"])})


@contextmanager
def _fresh_modules(path: list[str]) -> Iterator[None]:
    """Import from other folders, and forget the modules afterwards: projects may have the same names."""
    known, sys.path[:0] = set(sys.modules), path
    importlib.invalidate_caches()
    try:
        yield
    finally:
        del sys.path[: len(path)]
        for name in [*(name for name in sys.modules if name not in known), STUB_MODULE]:
            file = getattr(sys.modules.get(name), "__file__", None) or ""
            if name == STUB_MODULE or file.startswith(tuple(path)):
                sys.modules.pop(name, None)


if __name__ == "__main__":
    sys.exit(main())
