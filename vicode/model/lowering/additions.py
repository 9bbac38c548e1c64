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


def add_time(design: Design, name: str, origin: Origin) -> Design:
    """Add a variable for a component_time in the future, which is 0 after each restart."""
    return add_variables(design, Declaration(name=name, type="float", origin=origin))


def since_restart(value: str) -> str:
    """A value kept from earlier iterations, but 0 in the iteration of a restart.

    The states of XABSL have no enter actions, which would be the place to reset it.
    """
    return f"0 if component_time <= 0 else {value}"


def names_of(design: Design) -> set[str]:
    return {each.name for _section, each in design.declarations()}


NOW = "component_time + 0.0001"
"""The present as it is compared with a computed time, whose sum may be rounded up."""


def negated(condition: str) -> str:
    return f"not ({condition})"


def all_of(*conditions: str) -> str:
    """The conjunction of the conditions that are not empty; a single one as it is."""
    given = [each for each in conditions if each]
    return given[0] if len(given) == 1 else " and ".join(f"({each})" for each in given)
