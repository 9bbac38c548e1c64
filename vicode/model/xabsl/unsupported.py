"""Features of designs that XABSL does not support."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from vicode.findings import DesignPath
from vicode.model.constant_folding import ConstantValue, evaluate_constants, evaluate_initial_value, zero_value
from vicode.model.design import COMMON, Call, Declaration, Design, State
from vicode.model.disabled import disabled_states
from vicode.model.expressions import Scope, build_scope
from vicode.model.project import INTERNAL, Interface, Project
from vicode.model.traversal import iter_actions
from vicode.model.xabsl.names import effective_agents, is_basic_behavior


@dataclass(frozen=True, slots=True, kw_only=True)
class UnsupportedFeature:
    """An unsupported feature with message and fix."""

    path: DesignPath
    message: str
    fix: str
    is_key: bool = False


def find_unsupported_in_design(project: Project, design: Design) -> Iterator[UnsupportedFeature]:
    """Yield the unsupported features of a design, except in expressions and code."""
    if design.frequency_hz is not None:
        message = "XABSL options have no frequency: they run on every call"
        yield UnsupportedFeature(
            path=("frequency",), message=message, fix="remove it, or use time conditions in guards"
        )
    if design.resume:
        message = "XABSL options cannot resume: they restart if they were not executed"
        yield UnsupportedFeature(path=("resume",), message=message, fix="remove it, or store the state in a variable")
    scope, constants = build_scope(project, None), evaluate_constants(project)
    for section in ("outputs", "variables"):
        for each in getattr(design, section):
            yield from _check_symbol(each, (section, each.name), scope, constants)
    disabled = disabled_states(design)
    for state in design.states:
        if state.name not in disabled:
            yield from _check_state(project, design, state)
    for placed in iter_actions(design):
        if placed.state not in disabled and isinstance(placed.action, Call) and placed.phase not in ("enter", "leave"):
            is_key = placed.phase == "modulates"
            path = placed.path if is_key else (*placed.path, "call")
            yield from _check_call(project, design, placed.action.alias, path, is_key=is_key)


def find_unsupported_in_project(project: Project) -> Iterator[UnsupportedFeature]:
    scope, constants = build_scope(project, None), evaluate_constants(project)
    for agent in project.agents:
        path: DesignPath = ("agents", agent.name, "root")
        if project.interface(agent.root) is not None and project.design(agent.root) is None:
            message = f"the root of an XABSL agent is an option, but '{agent.root}' has no design"
            yield UnsupportedFeature(path=path, message=message, fix="choose a component with a design")
    for interface in project.components:
        if interface.implementation == INTERNAL:
            for section in ("outputs", "variables"):
                for each in getattr(interface, section):
                    yield from _check_symbol(
                        each, ("components", interface.component, section, each.name), scope, constants
                    )
    for constant in project.constants:
        value = constants.get(constant.name, 0.0)
        if isinstance(value, float) and not abs(value) < float("inf"):
            message = f"XABSL does not support the value {value:g} of '{constant.name}'"
            yield UnsupportedFeature(path=("constants", constant.name), message=message, fix="use a finite value")


def find_unsupported_in_root(project: Project, design: Design) -> Iterator[UnsupportedFeature]:
    """Yield the unsupported features of a root design, whose parameters cannot be set."""
    if design.component not in {agent.root for agent in effective_agents(project)}:
        return
    scope, constants = build_scope(project, None), evaluate_constants(project)
    for each in design.parameters:
        type_ = scope.type_of(each)
        value = evaluate_initial_value(each.initial, type_, scope, constants)
        if value is not None and value != zero_value(type_, scope):
            message = f"in an XABSL root option '{each.name}' is always {_format_zero(type_, scope)}"
            fix = "remove the default, or use a root design that calls this one"
            yield UnsupportedFeature(path=("parameters", each.name, "default"), message=message, fix=fix)


def is_done_expressible(project: Project, design: Design, state: str, alias: str) -> bool:
    """Return whether `done(alias)` is equivalent to `action_done`: each evaluating state calls only this component.

    `state` is a name, or COMMON for decisions that all states evaluate.
    """
    components = {use.alias: use.component for use in design.uses}
    disabled = disabled_states(design)
    evaluating = (each for each in design.states if each.name not in disabled and state in (each.name, COMMON))
    return all(_called_components(project, design, each, components) == {components.get(alias)} for each in evaluating)


def _called_components(project: Project, design: Design, state: State, components: Mapping[str, str]) -> set[str]:
    """Return the designs that a state calls, including common actions."""
    actions = (*design.common.actions, *state.all_actions)
    called = {components.get(action.alias, "") for action in actions if isinstance(action, Call)}
    return {component for component in called if project.design(component) is not None}


def _check_symbol(
    declaration: Declaration, path: DesignPath, scope: Scope, constants: Mapping[str, ConstantValue]
) -> Iterator[UnsupportedFeature]:
    """Check a symbol stored in the engine: it has no arguments and no initial value other than 0."""
    if declaration.arguments is not None:
        message = f"'{declaration.name}' takes arguments, but the XABSL engine stores only values"
        fix = "move it to a hand-written component"
        yield UnsupportedFeature(path=path, message=message, fix=fix, is_key=True)
        return
    type_ = scope.type_of(declaration)
    value = evaluate_initial_value(declaration.initial, type_, scope, constants)
    if value is not None and value != zero_value(type_, scope):
        message = f"the initial value of '{declaration.name}' in XABSL is {_format_zero(type_, scope)}"
        yield UnsupportedFeature(
            path=(*path, "initial"), message=message, fix="remove it, and set the value in an additional initial state"
        )


def _format_zero(type_: str, scope: Scope) -> str:
    return str(zero_value(type_, scope)).lower() if type_ == "bool" else f"{zero_value(type_, scope) or 0}"


def _check_state(project: Project, design: Design, state: State) -> Iterator[UnsupportedFeature]:
    path: DesignPath = ("states", state.name)
    for phase in ("enter", "leave"):
        if getattr(state, phase):
            message = f"XABSL states have no {phase} actions"
            fix = "use a separate state, or 'actions' if state_time == 0"
            yield UnsupportedFeature(path=(*path, phase), message=message, fix=fix, is_key=True)
    if state.capacity is not None and state.synchronized is not None:
        message = "an XABSL state cannot have both a capacity and synchronization"
        yield UnsupportedFeature(path=(*path, "synchronized"), message=message, fix="remove one of them")
    for index, alias in enumerate(state.requires):
        interface = _interface(project, design, alias)
        if interface is None or (interface.readable and project.design(interface.component) is None):
            continue
        message = f"'{alias}' cannot be required in XABSL, where it runs only if it is called"
        yield UnsupportedFeature(
            path=(*path, "requires", index), message=message, fix=f"call it in 'actions': call: {alias}"
        )


def _check_call(
    project: Project, design: Design, alias: str, path: DesignPath, *, is_key: bool
) -> Iterator[UnsupportedFeature]:
    interface = _interface(project, design, alias)
    if interface is None or project.design(interface.component) is not None or is_basic_behavior(interface):
        return
    message = f"'{interface.component}' has only symbols and cannot be called in XABSL"
    yield UnsupportedFeature(path=path, message=message, fix=f"use requires: [{alias}] instead", is_key=is_key)


def _interface(project: Project, design: Design, alias: str) -> Interface | None:
    use = design.use(alias)
    return project.interface(use.component) if use else None
