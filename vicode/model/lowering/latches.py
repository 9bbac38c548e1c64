"""Latches: a variable, and an assignment before all other actions. Guards see its value from the next iteration on."""

from vicode.model.design import Assign, Declaration, Design, Latch
from vicode.model.lowering.additions import (
    NOW,
    add_first_action,
    add_time,
    add_variables,
    names_of,
    since_restart,
)


def lower_latches(design: Design) -> Design:
    # Each is added before those that follow it, so that these can read it.
    for latch in reversed(design.latches):
        if not names_of(design) & set(latch_names(latch)):
            design = _lower_latch(design, latch)
    return design


def latch_names(latch: Latch) -> tuple[str, ...]:
    """The names of its variables."""
    more = (f"{latch.name}_changes", f"{latch.name}_until") if latch.hold else ()
    return (latch.name, *more)


def _lower_latch(design: Design, latch: Latch) -> Design:
    name, origin = latch.name, ("latches", latch.name)
    # Without `on`, which is an error, expressions still find the variable.
    on = latch.on or "false"
    off = latch.off or f"not ({on})"
    state = Declaration(name=name, type="bool", initial="false", doc=latch.doc, origin=origin)
    design = add_variables(design, state)
    if not latch.hold:
        value = f"({on}) or {name} and not ({off})" if latch.off else on
        return add_first_action(design, Assign(values=((name, value),), origin=origin))
    _name, changes, until = latch_names(latch)
    differs = f"{name} and ({off}) and not ({on}) or not {name} and ({on})"
    values = (
        (changes, f"(component_time <= 0 or {NOW} >= {until}) and ({differs})"),
        (name, f"{name} and not {changes} or not {name} and {changes}"),
        (until, f"component_time + {latch.hold} if {changes} else {since_restart(until)}"),
    )
    flag = Declaration(name=changes, type="bool", initial="false", origin=origin)
    design = add_time(add_variables(design, flag), until, origin)
    return add_first_action(design, Assign(values=values, origin=origin))
