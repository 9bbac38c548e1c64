"""Latches: a variable, and an assignment before all other actions. Guards see its value from the next iteration on."""

from vicode.model.design import Assign, Declaration, Design, Latch
from vicode.model.lowering.additions import (
    LONG_AGO,
    add_first_action,
    add_variables,
    elapsed_variable,
    names_of,
    reset_at_restart,
)


def lower_latches(design: Design) -> Design:
    # Each is added before those that follow it, so that these can read it.
    for latch in reversed(design.latches):
        if latch.on and not names_of(design) & set(latch_names(latch)):
            design = _lower_latch(design, latch)
    return design


def latch_names(latch: Latch) -> tuple[str, ...]:
    """The names of its variables."""
    more = (f"{latch.name}_changes", f"{latch.name}_since") if latch.hold else ()
    return (latch.name, *more)


def _lower_latch(design: Design, latch: Latch) -> Design:
    name, origin = latch.name, ("latches", latch.name)
    off = latch.off or f"not ({latch.on})"
    state = Declaration(name=name, type="bool", initial="false", doc=latch.doc, origin=origin)
    design = add_variables(design, state)
    if not latch.hold:
        value = f"({latch.on}) or {name} and not ({off})" if latch.off else latch.on
        return add_first_action(design, Assign(values=((name, value),), origin=origin))
    _name, changes, since = latch_names(latch)
    values = (
        (
            changes,
            f"component_time - {since} >= {latch.hold} and (({off}) and not ({latch.on}) if {name} else ({latch.on}))",
        ),
        (name, f"{name} != {changes}"),
        (since, f"component_time if {changes} else {since}"),
    )
    flag = Declaration(name=changes, type="bool", initial="false", origin=origin)
    design = add_variables(design, flag, elapsed_variable(since, origin))
    design = add_first_action(design, Assign(values=values, origin=origin))
    return reset_at_restart(design, since, LONG_AGO, origin)
