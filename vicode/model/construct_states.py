"""Renames and removes states in latches, interrupts, competences and layers (`vicode.model.lowering`)."""

from collections.abc import Collection
from dataclasses import replace

from vicode.model.design import INTERRUPT_ENDS, Design
from vicode.model.lowering import fits_pattern


def rename_in_constructs(design: Design, old: str, new: str) -> Design:
    """Rename a state in interrupts, and the step or layer that it is derived from."""

    def named(name: str) -> str:
        return new if name == old else name

    interrupts = (
        replace(
            each,
            do=named(each.do),
            during=_rename_in_patterns(design, each.during, old, new),
            then=each.then if each.then in INTERRUPT_ENDS else named(each.then),
        )
        for each in design.interrupts
    )
    competence = design.competence
    if competence is not None:
        steps = tuple(replace(each, name=named(each.name)) for each in competence.steps)
        competence = replace(competence, steps=steps)
    layers = tuple(replace(each, name=named(each.name)) for each in design.layers)
    positions = tuple(replace(each, name=named(each.name)) for each in design.positions)
    return replace(design, interrupts=tuple(interrupts), competence=competence, layers=layers, positions=positions)


def _rename_in_patterns(design: Design, patterns: tuple[str, ...], old: str, new: str) -> tuple[str, ...]:
    """Patterns that fit the same states as before: the new name may fit another one than the old name did."""
    renamed = tuple(new if each == old else each for each in patterns)
    before, after = (
        any(fits_pattern(name, each) for each in names) for name, names in ((old, patterns), (new, renamed))
    )
    if before and not after:
        names = [state.name for state in design.states if state.name != old]
        return (*(each for each in renamed if any(fits_pattern(name, each) for name in names)), new)
    if before == after:
        return renamed
    names = [state.name for state in design.states if state.name not in (old, new)]
    return tuple(name for name in names if any(fits_pattern(name, each) for each in patterns)) or renamed


def remove_from_constructs(design: Design, names: Collection[str]) -> Design:
    """Remove interrupts that need these states, and the steps and layers that they are derived from."""
    interrupts = (
        replace(each, during=tuple(name for name in each.during if name not in names))
        for each in design.interrupts
        if each.do not in names and each.then not in names and (not each.during or set(each.during) - set(names))
    )
    competence = design.competence
    if competence is not None:
        competence = replace(competence, steps=tuple(each for each in competence.steps if each.name not in names))
    layers = tuple(each for each in design.layers if each.name not in names)
    positions = tuple(each for each in design.positions if each.name not in names)
    return replace(design, interrupts=tuple(interrupts), competence=competence, layers=layers, positions=positions)
