"""What a user can set during a simulation: outputs of stubs and the parameters of the design, with their types."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from vicode.generators import UnsoundDesignError
from vicode.model.constant_folding import evaluate_constants
from vicode.model.design import Declaration, Design
from vicode.model.expressions import (
    BOOL,
    FLOAT,
    INT,
    Boolean,
    EnumElement,
    Minus,
    Number,
    build_scope,
    parse_expression,
)
from vicode.model.project import MISSING, Project
from vicode.simulation import Stub, StubOutput

PARAMETERS = ""
"""The component name under which the parameters of the simulated design are listed."""
DONE = "is_done"
_MAX_MAGNITUDE = 1e12


@dataclass(frozen=True, slots=True, kw_only=True)
class SimulationInput:
    """One input. `type` is bool, int, float, or "" for an enumeration, whose literals are `options`.

    A function has `arguments`: one value for all arguments, and others for particular ones.
    """

    component: str
    name: str
    type: str
    initial: Any
    unit: str = ""
    range: tuple[float, float] | None = None
    options: tuple[str, ...] = ()
    arguments: tuple[str, ...] | None = None
    doc: str = ""

    @property
    def key(self) -> tuple[str, str]:
        return (self.component, self.name)

    def accept(self, value: Any) -> Any | None:
        """Convert a value from the browser to this input's type; None if it is invalid."""
        match self.type:
            case "bool":
                return value if isinstance(value, bool) else None
            case "int" | "float":
                return self._accept_number(value)
            case _:
                return value if value in self.options else None

    def _accept_number(self, value: Any) -> int | float | None:
        if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            return None
        if abs(value) > _MAX_MAGNITUDE:
            return None
        # Steps of a slider add up to 0.30000000000000004.
        return round(value) if self.type == INT else float(f"{value:.12g}")


def collect_inputs(project: Project, design: Design, stubbed: tuple[str, ...]) -> tuple[SimulationInput, ...]:
    """The outputs of components without an implementation, the parameters of the design, the outputs of other stubs."""
    missing = [each.component for each in project.components if each.implementation == MISSING]
    inputs: list[SimulationInput] = []
    for component in sorted((PARAMETERS, *stubbed), key=lambda name: name not in missing):
        if component == PARAMETERS:
            inputs += [declared_input(project, PARAMETERS, each) for each in design.parameters]
        interface = project.interface(component)
        if interface is None:
            continue
        inputs += [declared_input(project, component, output) for output in interface.readable]
        own = project.design(component)
        if own is not None and any(state.final for state in own.states):
            doc = f"{component} is in a final state."
            inputs.append(SimulationInput(component=component, name=DONE, type=BOOL, initial=False, doc=doc))
    return tuple(inputs)


def collect_tunable(project: Project, design: Design) -> tuple[SimulationInput, ...]:
    """The tunable constants of a project, and the tunable parameters of a design, with their declared values."""
    constants = evaluate_constants(project)
    inputs = []
    for component, declared in ((PARAMETERS, project.constants), (design.component, design.parameters)):
        for each in declared:
            if not each.tunable:
                continue
            try:
                tunable = declared_input(project, component, each)
            except UnsoundDesignError:
                continue
            value = constants.get(each.name) if component == PARAMETERS else None
            if value is not None:
                value = f"{_enumeration(project, tunable)}.{value}" if tunable.options else value
                tunable = replace(tunable, initial=value)
            inputs.append(tunable)
    return tuple(inputs)


def declared_input(project: Project, component: str, declaration: Declaration) -> SimulationInput:
    """A declared value of a component, or a constant, as an input.

    Raises:
        UnsoundDesignError: Its type is unknown.
    """
    scope = build_scope(project, None)
    type_ = scope.type_of(declaration)
    elements = scope.enumerations.get(type_, ())
    options = tuple(f"{type_}.{element}" for element in elements)
    if not options and type_ not in (BOOL, INT, FLOAT):
        raise UnsoundDesignError(f"'{declaration.name}' has an unknown type")
    arguments = declaration.arguments
    return SimulationInput(
        component=component,
        name=declaration.name,
        type="" if options else type_,
        initial=_initial(project, declaration, type_, options),
        unit=declaration.unit,
        range=declaration.range,
        options=options,
        arguments=None if arguments is None else tuple(each.name for each in arguments),
        doc=declaration.doc,
    )


def make_stub(
    project: Project, component: str, inputs: tuple[SimulationInput, ...], types: Mapping[tuple[str, str], str]
) -> Stub:
    outputs = tuple(
        StubOutput(
            name=each.name,
            type=types.get(each.key, each.type),
            value=each.initial,
            is_function=each.arguments is not None,
        )
        for each in inputs
        if each.component == component and each.name != DONE
    )
    interface = project.interface(component)
    is_live = interface is not None and interface.is_generated and project.design(component) is None
    return Stub(component=component, outputs=outputs, is_live=is_live)


def input_types(project: Project, inputs: tuple[SimulationInput, ...]) -> dict[tuple[str, str], str]:
    """The type of each input by its key; an enumeration by its name."""
    return {each.key: each.type or _enumeration(project, each) for each in inputs}


def _initial(project: Project, declaration: Declaration, type_: str, options: tuple[str, ...]) -> Any:
    """The declared initial value if it is a literal, else the value in the range that is nearest to 0."""
    parsed = parse_expression(declaration.initial, build_scope(project, None)) if declaration.initial else None
    value = _literal(parsed.tree) if parsed and parsed.tree and not parsed.diagnostics else None
    if options:
        return value if value in options else options[0]
    if type_ == BOOL:
        return value is True
    number = value if isinstance(value, int | float) and not isinstance(value, bool) else 0
    if declaration.range is not None and value is None:
        low, high = declaration.range
        number = min(max(number, low), high)
    return round(number) if type_ == INT else float(number)


def _literal(node: object) -> Any:
    match node:
        case Number(value=value) | Boolean(value=value):
            return value
        case EnumElement(element=element, type=type_):
            return f"{type_}.{element}"
        case Minus(operand=Number(value=value)):
            return -value
        case _:
            return None


def _enumeration(project: Project, each: SimulationInput) -> str:
    names = {enumeration.name for enumeration in project.enumerations}
    name = each.options[0].partition(".")[0] if each.options else ""
    return name if name in names else ""
