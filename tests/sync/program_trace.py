"""Runs the text of a generated module on random inputs; knows the runtime, but nothing of sync.

Every component that the module imports is replaced by one whose outputs are random, and which records what it is asked.
"""

import ast
import builtins
import logging
import random
import re
import types
import zlib
from collections.abc import Mapping
from typing import Any, ClassVar

from vicode.bica import Component, Root
from vicode.model.project import Project

_NUMBERS = (0, 1, 2, 3, -1, 0.4, 2.5, 10.5, 35, 300, -40.5)
_REAL_MODULES = ("vicode", "typing", "__future__", "math", "enum", "contextlib")
_MAX_LOOPS = 1000
"""Ends a program with an endless loop."""
_Types = Mapping[str, Mapping[str, str]]
Event = tuple[object, ...]


class _Clock:
    """A clock that advances by another amount in each iteration."""

    def __init__(self) -> None:
        self._now_ns = 0

    def now_ns(self) -> int:
        self._now_ns += 130_000_000 + self._now_ns % 7 * 50_000_000
        return self._now_ns


class _EndlessError(BaseException):
    """A loop of the program does not end; no program catches it."""


class _CountedLoops(ast.NodeTransformer):
    """Counts the iterations of each `while`."""

    def visit_While(self, node: ast.While) -> ast.While:
        self.generic_visit(node)
        node.body[:0] = ast.parse("_count_loop()").body
        return node


class _Run:
    """Random inputs and what happened."""

    def __init__(self, seed: int, types_: _Types, declared: Mapping[str, Any]) -> None:
        self.seed, self.types, self.declared = seed, types_, declared
        self.iteration = self.loops = 0
        self.events: list[Event] = []
        self.classes: dict[str, type[Component]] = {}

    def count_loop(self) -> None:
        self.loops += 1
        if self.loops > _MAX_LOOPS:
            raise _EndlessError

    def value(self, component: str, name: str) -> object:
        chance = random.Random(zlib.crc32(f"{self.seed} {self.iteration // 2} {component} {name}".encode()))
        kind = self.types.get(component, {}).get(name, "float")
        if kind == "bool":
            return chance.random() < 0.5
        if kind == "int":
            return chance.randrange(-2, 5)
        return chance.choice(list(self.declared[kind])) if kind in self.declared else chance.choice(_NUMBERS)

    def stub(self, name: str) -> type[Component]:
        """Return the component with random outputs that stands for a class."""
        run = self

        class Stub(Component):
            owner: ClassVar[str] = name

            def __getattr__(self, attribute: str) -> object:
                if attribute.startswith("__"):
                    raise AttributeError(attribute)
                if run.types.get(name, {}).get(attribute) == "function":
                    return lambda **values: run.value(name, f"{attribute} {sorted(values.items())}")
                return run.value(name, attribute)

            @property
            def is_done(self) -> bool:
                return bool(run.value(name, "seen done") > 0.5)  # type: ignore[operator]

            def step(self) -> None:
                run.events.append(("step", name))

            def modulate(self, **values: object) -> None:
                run.events.append(("modulate", name, sorted(values.items())))

        return self.classes.setdefault(name, Stub)

    def imported(self, module: str, names: tuple[str, ...]) -> types.ModuleType:
        """Return a module with these names."""
        found = types.ModuleType(module)
        for name in names:
            value = self.declared[name] if name in self.declared else self.stub(name)
            setattr(found, name, value)
        return found


def trace_program(text: str, project: Project, declarations: str, *, seed: int, iterations: int = 40) -> list[object]:
    """Return the states, values and events of each iteration, or what prevents a run; it ends at an endless loop.

    Args:
        text: The module.
        project: Its project, which declares the types of outputs.
        declarations: The generated module with constants and enumerations.
        seed: Gives the inputs.
        iterations: The number of iterations.
    """
    shared: dict[str, Any] = {"__name__": "declarations"}
    exec(compile(declarations, "declarations", "exec"), shared)
    run = _Run(seed, _output_types(project), {name: value for name, value in shared.items() if name[0] != "_"})
    module = {"__name__": "traced", "__builtins__": _builtins(run)}
    try:
        tree = ast.fix_missing_locations(_CountedLoops().visit(ast.parse(text)))
        exec(compile(tree, "traced", "exec"), module)
        owner = next(value for value in reversed(module.values()) if _is_own(value))
        root = Root(owner, clock=_Clock(), world=types.SimpleNamespace(), on_error=lambda record: _report(run, record))
    except Exception as error:
        return [("cannot run", type(error).__name__, str(error))]
    except _EndlessError:
        return ["endless loop"]
    return _iterate(run, root, iterations)


def _iterate(run: _Run, root: Root, iterations: int) -> list[object]:
    trace: list[object] = []
    for _iteration in range(iterations):
        run.iteration += 1
        run.events.clear()
        try:
            root.step()
            if run.iteration % 4 == 0:
                _jump(root.main, run)
        except _EndlessError:
            return [*trace, "endless loop"]
        trace.append((root.main.state, _values(root.main), tuple(map(_shown, run.events))))
    return trace


def _jump(component: Component, run: _Run) -> None:
    """Change to another state, so that each is reached."""
    names = sorted(component._states)
    try:
        component._change_to(names[zlib.crc32(f"{run.seed} {run.iteration}".encode()) % len(names)])
    except Exception as error:
        run.events.append(("error", str(error)))


def _is_own(value: object) -> bool:
    return isinstance(value, type) and issubclass(value, Component) and value.__module__ == "traced"


def _report(run: _Run, record: Any) -> None:
    run.events.append(("error", record.message))


def _values(component: Component) -> str:
    values = {name: value for name, value in vars(component).items() if not isinstance(value, Component)}
    return _shown(sorted(values.items()))


def _shown(value: object) -> str:
    """The text of values in which numbers are equal by value: 4 and 4.0."""
    return re.sub(r"(?<![\w.])(\d+)\.0\b(?!e)", r"\1", repr(value))


def _builtins(run: _Run) -> dict[str, Any]:
    def load(name: str, *rest: Any) -> Any:
        names, level = rest[2] if len(rest) > 2 else (), rest[3] if len(rest) > 3 else 0
        if name == "logging":
            return _logging(run)
        is_real = level == 0 and name.split(".", maxsplit=1)[0] in (
            "vicode",
            "typing",
            "__future__",
            "math",
            "enum",
            "contextlib",
        )
        return builtins.__import__(name, *rest) if is_real else run.imported(name, names or ())

    own = dict(vars(builtins))
    own |= {"__import__": load, "print": lambda *values: run.events.append(("print", *values))}
    own["_count_loop"] = run.count_loop
    return own


def _logging(run: _Run) -> Any:
    def record(level: str) -> Any:
        return lambda *values: run.events.append((level, *values))

    logger = types.SimpleNamespace(**{level: record(level) for level in ("debug", "info", "warning", "exception")})
    return types.SimpleNamespace(getLogger=lambda _name="": logger, INFO=logging.INFO)


def _output_types(project: Project) -> dict[str, dict[str, str]]:
    """The types of outputs by class and name."""
    found: dict[str, dict[str, str]] = {}
    for component in project.components:
        names = (component.component, component.implementation.rpartition(":")[2])
        for name in names:
            found[name] = {
                output.name: "function" if output.arguments is not None else output.type or "float"
                for output in component.outputs
            }
    for design in project.designs:
        found[design.component] = {
            output.name: output.type or ("bool" if output.initial in ("true", "false") else "float")
            for output in design.outputs
        }
    return found
