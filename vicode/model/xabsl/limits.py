"""What of a design XABSL cannot say, or would do in another way."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from vicode.findings import Path
from vicode.model.constants import Value, constant_values, first_value, zero_of
from vicode.model.design import COMMON, Call, Declaration, Design, State
from vicode.model.enabling import disabled_states
from vicode.model.expressions import Scope, scope_of
from vicode.model.project import INTERNAL, Interface, Project
from vicode.model.walks import walk_actions
from vicode.model.xabsl.names import agents_of, is_behavior


@dataclass(frozen=True, slots=True, kw_only=True)
class Limit:
    """A thing that cannot be said in XABSL, and what to do."""

    path: Path
    message: str
    mend: str
    of_key: bool = False


def find_limits(project: Project, design: Design) -> Iterator[Limit]:
    """What XABSL cannot say of a design, but for its expressions and code."""
    if design.frequency_hz is not None:
        message = "an option of XABSL works whenever it is called: it has no frequency"
        yield Limit(path=("frequency",), message=message, mend="leave it out, or ask for the time in guards")
    if design.resume:
        message = "an option of XABSL that was not executed begins anew: it cannot resume"
        yield Limit(path=("resume",), message=message, mend="leave it out, or keep where it was in a variable")
    scope, constants = scope_of(project, None), constant_values(project)
    for section in ("outputs", "variables"):
        for each in getattr(design, section):
            yield from _limits_of_symbol(each, (section, each.name), scope, constants)
    off = disabled_states(design)
    for state in design.states:
        if state.name not in off:
            yield from _limits_of_state(project, design, state)
    for placed in walk_actions(design):
        if placed.state not in off and isinstance(placed.action, Call) and placed.phase not in ("enter", "leave"):
            is_key = placed.phase == "modulates"
            path = placed.path if is_key else (*placed.path, "call")
            yield from _limits_of_call(project, design, placed.action.alias, path, of_key=is_key)


def find_project_limits(project: Project) -> Iterator[Limit]:
    """What XABSL cannot say of a project file."""
    scope, constants = scope_of(project, None), constant_values(project)
    for agent in project.agents:
        path: Path = ("agents", agent.name, "root")
        if project.interface(agent.root) is not None and project.design(agent.root) is None:
            message = f"in XABSL an agent begins with an option, and '{agent.root}' has no design"
            yield Limit(path=path, message=message, mend="name a component with a design")
    for interface in project.components:
        if interface.implementation == INTERNAL:
            for section in ("outputs", "variables"):
                for each in getattr(interface, section):
                    yield from _limits_of_symbol(
                        each, ("components", interface.component, section, each.name), scope, constants
                    )
    for constant in project.constants:
        value = constants.get(constant.name, 0.0)
        if isinstance(value, float) and not abs(value) < float("inf"):
            message = f"XABSL has no number for the value of '{constant.name}', which is {value:g}"
            yield Limit(path=("constants", constant.name), message=message, mend="give it a finite value")


def find_root_limits(project: Project, design: Design) -> Iterator[Limit]:
    """What XABSL cannot say of a design that an agent begins with: nobody gives it parameters."""
    if design.component not in {agent.root for agent in agents_of(project)}:
        return
    scope, constants = scope_of(project, None), constant_values(project)
    for each in design.parameters:
        type_ = scope.type_of(each)
        value = first_value(each.initial, type_, scope, constants)
        if value is not None and value != zero_of(type_, scope):
            message = f"an agent begins with this, and XABSL then gives '{each.name}' {_zero_words(type_, scope)}"
            mend = "leave the default out, or begin with a design that calls this one"
            yield Limit(path=("parameters", each.name, "default"), message=message, mend=mend)


def can_ask_done(project: Project, design: Design, state: str, alias: str) -> bool:
    """Whether `done(alias)` in a decision is the same as `action_done`: each state that asks calls just that one.

    `state` is a name, or COMMON for what all states ask.
    """
    components = {use.alias: use.component for use in design.uses}
    off = disabled_states(design)
    asking = (each for each in design.states if each.name not in off and state in (each.name, COMMON))
    return all(_called(project, design, each, components) == {components.get(alias)} for each in asking)


def _called(project: Project, design: Design, state: State, components: Mapping[str, str]) -> set[str]:
    """The designs that a state calls, the common actions included."""
    actions = (*design.common.actions, *state.all_actions)
    called = {components.get(action.alias, "") for action in actions if isinstance(action, Call)}
    return {component for component in called if project.design(component) is not None}


def _limits_of_symbol(
    declaration: Declaration, path: Path, scope: Scope, constants: Mapping[str, Value]
) -> Iterator[Limit]:
    """What the engine itself keeps is 0, false or the first element at first, and no function."""
    if declaration.arguments is not None:
        message = f"'{declaration.name}' takes arguments, and XABSL's engine keeps values only"
        mend = "let a hand-written component offer it"
        yield Limit(path=path, message=message, mend=mend, of_key=True)
        return
    type_ = scope.type_of(declaration)
    value = first_value(declaration.initial, type_, scope, constants)
    if value is not None and value != zero_of(type_, scope):
        message = f"in XABSL '{declaration.name}' begins with {_zero_words(type_, scope)}"
        yield Limit(path=(*path, "initial"), message=message, mend="leave it out, and set the value in a first state")


def _zero_words(type_: str, scope: Scope) -> str:
    return str(zero_of(type_, scope)).lower() if type_ == "bool" else f"{zero_of(type_, scope) or 0}"


def _limits_of_state(project: Project, design: Design, state: State) -> Iterator[Limit]:
    path: Path = ("states", state.name)
    for phase in ("enter", "leave"):
        if getattr(state, phase):
            message = f"a state of XABSL does nothing when it is {'left' if phase == 'leave' else 'entered'}"
            mend = "do it in a state of its own, or in 'actions' if state_time == 0"
            yield Limit(path=(*path, phase), message=message, mend=mend, of_key=True)
    if state.capacity is not None and state.synchronized is not None:
        message = "a state of XABSL has a capacity or is synchronized, not both"
        yield Limit(path=(*path, "synchronized"), message=message, mend="leave one of them out")
    for index, alias in enumerate(state.requires):
        interface = _interface(project, design, alias)
        if interface is None or (interface.readable and project.design(interface.component) is None):
            continue
        message = f"in XABSL '{alias}' works only when it is called, so it cannot be required"
        yield Limit(path=(*path, "requires", index), message=message, mend=f"call it in 'actions': call: {alias}")


def _limits_of_call(project: Project, design: Design, alias: str, path: Path, *, of_key: bool) -> Iterator[Limit]:
    interface = _interface(project, design, alias)
    if interface is None or project.design(interface.component) is not None or is_behavior(interface):
        return
    message = f"'{interface.component}' has symbols only, there is nothing of it to call in XABSL"
    yield Limit(path=path, message=message, mend=f"require it instead: requires: [{alias}]", of_key=of_key)


def _interface(project: Project, design: Design, alias: str) -> Interface | None:
    use = design.use(alias)
    return project.interface(use.component) if use else None
