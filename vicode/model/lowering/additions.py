"""What all constructs add to a design."""

from dataclasses import replace

from vicode.model.design import Assign, Declaration, Design, Origin, State


def add_variables(design: Design, *variables: Declaration) -> Design:
    return replace(design, variables=(*design.variables, *variables))


def add_first_action(design: Design, action: Assign) -> Design:
    """Add a common action before all others."""
    return replace(design, common=replace(design.common, actions=(action, *design.common.actions)))


def change_state(design: Design, state: State) -> Design:
    """Replace the state with this name."""
    return replace(design, states=tuple(state if each.name == state.name else each for each in design.states))


def reset_at_restart(design: Design, variable: str, value: str, origin: Origin) -> Design:
    """Give a variable its value at each restart: the initial state is entered, and component_time is 0."""
    reset = Assign(values=((variable, f"{value} if component_time <= 0 else {variable}"),), origin=origin)
    initial = design.state(design.initial)
    return design if initial is None else change_state(design, replace(initial, enter=(reset, *initial.enter)))


def elapsed_variable(name: str, origin: Origin) -> Declaration:
    """A variable for a time in the past, at first long ago."""
    return Declaration(name=name, type="float", initial=LONG_AGO, origin=origin)


LONG_AGO = "-1e9"
"""A component_time before each start."""


def names_of(design: Design) -> set[str]:
    return {each.name for _section, each in design.declarations()}


def negated(condition: str) -> str:
    return f"not ({condition})"


def all_of(*conditions: str) -> str:
    """The conjunction of the conditions that are not empty; a single one as it is."""
    given = [each for each in conditions if each]
    return given[0] if len(given) == 1 else " and ".join(f"({each})" for each in given)
