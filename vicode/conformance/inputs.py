"""What a run gives to a design: the inputs of each iteration, and the values of outputs with arguments."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from enum import Enum, StrEnum
from typing import Any

from vicode.bica import arithmetic
from vicode.generators import collect_components
from vicode.model.constant_folding import evaluate_constants, evaluate_initial_value
from vicode.model.design import Declaration
from vicode.model.expressions import BOOL, FLOAT, INT, build_scope
from vicode.model.project import INTERNAL, MISSING, WORLD, Interface, Project
from vicode.semantics import RobotMemory, TeamMemory

PARAMETERS = ""
"""The component under which the parameters of the root component are listed."""


class InputKind(StrEnum):
    """What provides a value."""

    PARAMETER = "parameter"
    WORLD = "world"
    MISSING = "missing"
    STUB = "stub"


InputKey = tuple[str, str]
Inputs = Mapping[InputKey, Any]
"""Values by component and name, in the form of traces: elements of enumerations are written `Type.element`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class OutputArgument:
    """An argument of an output, with its default."""

    name: str
    type: str
    default: Any
    elements: tuple[str, ...] = ()
    xabsl_name: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class RunInput:
    """A value that a run sets. An output with `arguments` has a base value, from which `derive_value` computes it.

    Attributes:
        elements: The elements of an enumeration.
        initial: The value before the first one is set.
        xabsl_name: The name in XABSL, if it differs.
    """

    component: str
    name: str
    kind: InputKind
    type: str
    initial: Any
    elements: tuple[str, ...] = ()
    arguments: tuple[OutputArgument, ...] | None = None
    range: tuple[float, float] | None = None
    xabsl_name: str = ""

    @property
    def key(self) -> InputKey:
        return (self.component, self.name)


@dataclass(frozen=True, slots=True, kw_only=True)
class RunStep:
    """One iteration: its time, and for each robot the inputs that change before it."""

    time_ns: int
    inputs: tuple[Inputs, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ConformanceRun:
    """A root component of a project with its inputs.

    Attributes:
        team_ticks: `team.ticks` of each robot.
        holds_outputs: Whether an output of a hand-written component changes when it is stepped, as on a robot, and not
            before the iteration; only in Python and the reference interpreter.
    """

    project: Project
    root: str
    steps: tuple[RunStep, ...]
    robots: int = 1
    team_ticks: int = 0
    holds_outputs: bool = False
    inputs: tuple[RunInput, ...] = field(init=False)

    def __post_init__(self) -> None:
        """List the inputs once."""
        object.__setattr__(self, "inputs", tuple(list_inputs(self.project, self.root)))


def iteration_times(run: ConformanceRun) -> Iterator[int]:
    """The times of the iterations, which do not decrease if the clock is set back."""
    memory = RobotMemory(components={}, team=TeamMemory())
    for step in run.steps:
        memory.begin_iteration(step.time_ns)
        yield memory.now_ns


def list_inputs(project: Project, root: str) -> Iterator[RunInput]:
    """The parameters of the root component, and what components without a design provide."""
    design = project.design(root)
    for parameter in design.parameters if design else ():
        yield _input(project, PARAMETERS, InputKind.PARAMETER, parameter)
    for interface in used_interfaces(project, root):
        if interface.implementation == INTERNAL:
            continue
        kind = _KINDS.get(interface.implementation, InputKind.STUB)
        for output in interface.readable:
            # The class of a component that is not implemented yet returns the declared value.
            if kind is not InputKind.MISSING or output.arguments is None:
                yield _input(project, interface.component, kind, output)


def used_interfaces(project: Project, root: str) -> tuple[Interface, ...]:
    """The components without a design that a component uses, directly or not."""
    designs = collect_components(project, (root,))
    used = {use.component for design in project.designs if design.component in designs for use in design.uses}
    return tuple(item for item in project.components if item.component in used and item.component not in designs)


def derive_value(of: RunInput, base: Any, given: Mapping[str, Any]) -> Any:
    """The value of an output with arguments, as the XABSL engine's tool computes it from a table.

    Instead of a base, there may be a list of calls, each with some arguments and the value; the first one also stands
    for all others.

    S is the sum of i × number i, 0.5 j × bool j and 0.25 k × number of element k. A number is base + S, a bool changes
    if floor |S| is odd, an element is the one floor |S| places after the base.
    """
    if isinstance(base, list):
        return next((value for arguments, value in base if _is_call(arguments, given)), base[0][1])
    groups: dict[float, list[float]] = {1.0: [], 0.5: [], 0.25: []}
    for argument in of.arguments or ():
        value = given.get(argument.name, argument.default)
        groups[_WEIGHTS.get(argument.type, 0.25)].append(as_number(value, argument.elements))
    total = sum(weight * (index + 1) * value for weight, group in groups.items() for index, value in enumerate(group))
    if of.type == FLOAT:
        return float(base) + total
    if of.type == INT:
        return arithmetic.to_int(float(base) + total)
    steps = arithmetic.floor(abs(total)) if abs(total) < arithmetic.MAX_INT else 0
    if of.type == BOOL:
        return bool(base) != (steps % 2 == 1)
    return f"{of.type}.{of.elements[(of.elements.index(element_of(base)) + steps) % len(of.elements)]}"


def _is_call(arguments: Mapping[str, Any], given: Mapping[str, Any]) -> bool:
    return all(
        element_of(value) == element_of(given.get(name)) if isinstance(value, str) else value == given.get(name)
        for name, value in arguments.items()
    )


_WEIGHTS = {INT: 1.0, FLOAT: 1.0, BOOL: 0.5}
_KINDS = {WORLD: InputKind.WORLD, MISSING: InputKind.MISSING}


def element_of(value: object) -> str:
    """The name of an element without its enumeration."""
    return value.name if isinstance(value, Enum) else str(value).rpartition(".")[2]


def as_number(value: Any, elements: tuple[str, ...]) -> float:
    """A value as a number: elements of enumerations by their position."""
    return float(elements.index(element_of(value))) if elements else float(value)


def _input(project: Project, component: str, kind: InputKind, declaration: Declaration) -> RunInput:
    scope = build_scope(project, None)
    type_ = scope.type_of(declaration)
    arguments = None
    if declaration.arguments is not None:
        arguments = tuple(
            OutputArgument(
                name=each.name,
                type=scope.type_of(each),
                default=_initial(project, each),
                elements=tuple(scope.enumerations.get(scope.type_of(each), ())),
                xabsl_name=each.xabsl_name,
            )
            for each in declaration.arguments
        )
    return RunInput(
        component=component,
        name=declaration.name,
        kind=kind,
        type=type_,
        initial=_initial(project, declaration),
        elements=tuple(scope.enumerations.get(type_, ())),
        arguments=arguments,
        range=declaration.range,
        xabsl_name=declaration.xabsl_name,
    )


def _initial(project: Project, declaration: Declaration) -> Any:
    scope = build_scope(project, None)
    type_ = scope.type_of(declaration)
    value = evaluate_initial_value(declaration.initial, type_, scope, evaluate_constants(project))
    if type_ in scope.enumerations:
        return f"{type_}.{value}"
    return value if value is None or type_ == BOOL else int(value) if type_ == INT else float(value)
