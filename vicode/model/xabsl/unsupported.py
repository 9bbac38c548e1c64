"""What of a design XABSL cannot say, or would do in another way."""

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
    """A thing that cannot be said in XABSL, and what to do."""

    path: DesignPath
    message: str
    fix: str
    is_key: bool = False


def find_unsupported_in_design(project: Project, design: Design) -> Iterator[UnsupportedFeature]:
    """What XABSL cannot say of a design, but for its expressions and code."""
    if design.frequency_hz is not None:
        message = "an option of XABSL works whenever it is called: it has no frequency"
        yield UnsupportedFeature(
            path=("frequency",), message=message, fix="leave it out, or ask for the time in guards"
        )
    if design.resume:
        message = "an option of XABSL that was not executed begins anew: it cannot resume"
        yield UnsupportedFeature(
            path=("resume",), message=message, fix="leave it out, or keep where it was in a variable"
        )
    scope, constants = build_scope(project, None), evaluate_constants(project)
    for section in ("outputs", "variables"):
        for each in getattr(design, section):
            yield from _check_symbol(each, (section, each.name), scope, constants)
    off = disabled_states(design)
    for state in design.states:
        if state.name not in off:
            yield from _check_state(project, design, state)
    for placed in iter_actions(design):
        if placed.state not in off and isinstance(placed.action, Call) and placed.phase not in ("enter", "leave"):
            is_key = placed.phase == "modulates"
            path = placed.path if is_key else (*placed.path, "call")
            yield from _check_call(project, design, placed.action.alias, path, of_key=is_key)


def find_unsupported_in_project(project: Project) -> Iterator[UnsupportedFeature]:
    """What XABSL cannot say of a project file."""
    scope, constants = build_scope(project, None), evaluate_constants(project)
    for agent in project.agents:
        path: DesignPath = ("agents", agent.name, "root")
        if project.interface(agent.root) is not None and project.design(agent.root) is None:
            message = f"in XABSL an agent begins with an option, and '{agent.root}' has no design"
            yield UnsupportedFeature(path=path, message=message, fix="name a component with a design")
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
            message = f"XABSL has no number for the value of '{constant.name}', which is {value:g}"
            yield UnsupportedFeature(path=("constants", constant.name), message=message, fix="give it a finite value")


def find_unsupported_in_root(project: Project, design: Design) -> Iterator[UnsupportedFeature]:
    """What XABSL cannot say of a design that an agent begins with: nobody gives it parameters."""
    if design.component not in {agent.root for agent in effective_agents(project)}:
        return
    scope, constants = build_scope(project, None), evaluate_constants(project)
    for each in design.parameters:
        type_ = scope.type_of(each)
        value = evaluate_initial_value(each.initial, type_, scope, constants)
        if value is not None and value != zero_value(type_, scope):
            message = f"an agent begins with this, and XABSL then gives '{each.name}' {_format_zero(type_, scope)}"
            mend = "leave the default out, or begin with a design that calls this one"
            yield UnsupportedFeature(path=("parameters", each.name, "default"), message=message, fix=mend)


def is_done_expressible(project: Project, design: Design, state: str, alias: str) -> bool:
    """Whether `done(alias)` in a decision is the same as `action_done`: each state that asks calls just that one.

    `state` is a name, or COMMON for what all states ask.
    """
    components = {use.alias: use.component for use in design.uses}
    off = disabled_states(design)
    asking = (each for each in design.states if each.name not in off and state in (each.name, COMMON))
    return all(_called_components(project, design, each, components) == {components.get(alias)} for each in asking)


def _called_components(project: Project, design: Design, state: State, components: Mapping[str, str]) -> set[str]:
    """The designs that a state calls, the common actions included."""
    actions = (*design.common.actions, *state.all_actions)
    called = {components.get(action.alias, "") for action in actions if isinstance(action, Call)}
    return {component for component in called if project.design(component) is not None}


def _check_symbol(
    declaration: Declaration, path: DesignPath, scope: Scope, constants: Mapping[str, ConstantValue]
) -> Iterator[UnsupportedFeature]:
    """What the engine itself keeps is 0, false or the first element at first, and no function."""
    if declaration.arguments is not None:
        message = f"'{declaration.name}' takes arguments, and XABSL's engine keeps values only"
        mend = "let a hand-written component offer it"
        yield UnsupportedFeature(path=path, message=message, fix=mend, is_key=True)
        return
    type_ = scope.type_of(declaration)
    value = evaluate_initial_value(declaration.initial, type_, scope, constants)
    if value is not None and value != zero_value(type_, scope):
        message = f"in XABSL '{declaration.name}' begins with {_format_zero(type_, scope)}"
        yield UnsupportedFeature(
            path=(*path, "initial"), message=message, fix="leave it out, and set the value in a first state"
        )


def _format_zero(type_: str, scope: Scope) -> str:
    return str(zero_value(type_, scope)).lower() if type_ == "bool" else f"{zero_value(type_, scope) or 0}"


def _check_state(project: Project, design: Design, state: State) -> Iterator[UnsupportedFeature]:
    path: DesignPath = ("states", state.name)
    for phase in ("enter", "leave"):
        if getattr(state, phase):
            message = f"a state of XABSL does nothing when it is {'left' if phase == 'leave' else 'entered'}"
            mend = "do it in a state of its own, or in 'actions' if state_time == 0"
            yield UnsupportedFeature(path=(*path, phase), message=message, fix=mend, is_key=True)
    if state.capacity is not None and state.synchronized is not None:
        message = "a state of XABSL has a capacity or is synchronized, not both"
        yield UnsupportedFeature(path=(*path, "synchronized"), message=message, fix="leave one of them out")
    for index, alias in enumerate(state.requires):
        interface = _interface(project, design, alias)
        if interface is None or (interface.readable and project.design(interface.component) is None):
            continue
        message = f"in XABSL '{alias}' works only when it is called, so it cannot be required"
        yield UnsupportedFeature(
            path=(*path, "requires", index), message=message, fix=f"call it in 'actions': call: {alias}"
        )


def _check_call(
    project: Project, design: Design, alias: str, path: DesignPath, *, of_key: bool
) -> Iterator[UnsupportedFeature]:
    interface = _interface(project, design, alias)
    if interface is None or project.design(interface.component) is not None or is_basic_behavior(interface):
        return
    message = f"'{interface.component}' has symbols only, there is nothing of it to call in XABSL"
    yield UnsupportedFeature(path=path, message=message, fix=f"require it instead: requires: [{alias}]", is_key=of_key)


def _interface(project: Project, design: Design, alias: str) -> Interface | None:
    use = design.use(alias)
    return project.interface(use.component) if use else None
