"""Pure functions that edit the latches, interrupts, steps and layers of a design (`vicode.model.lowering`).

The path of a list is ("latches",), ("interrupts",), ("competence", "steps") or ("layers",).
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from vicode.findings import DesignPath
from vicode.model.design import Competence, CompetenceStep, Design, Interrupt, Latch, Layer
from vicode.model.edits import remove_states, unique_name
from vicode.model.lowering import COMPETENCE_STATES, derived_variables, lift_design
from vicode.model.names import is_valid_name

Construct = Latch | Interrupt | CompetenceStep | Layer
CONSTRUCT_LISTS: tuple[DesignPath, ...] = (("latches",), ("interrupts",), ("competence", "steps"), ("layers",))


def constructs_at(design: Design, path: DesignPath) -> tuple[Any, ...]:
    """The items of a list."""
    owner = design.competence if path[0] == "competence" else design
    return getattr(owner, str(path[-1]), ())


def has_own_states(design: Design) -> bool:
    """Whether the states are written in the file: then there can be neither a competence nor layers."""
    return bool(lift_design(design).states)


def interrupting_states(design: Design) -> tuple[str, ...]:
    """The states that an additional interrupt can make active."""
    taken = {design.initial, *(each.do for each in design.interrupts)}
    return tuple(each.name for each in design.states if each.name not in taken and not each.final)


def new_construct(design: Design, path: DesignPath, name: str) -> Construct | None:
    """An item for a list, with this name if it is free, or of an interrupt with this state; None if none is possible."""
    match path[-1]:
        case "interrupts":
            states = interrupting_states(design)
            return Interrupt(do=name if name in states else states[0]) if states else None
        case "latches":
            return Latch(name=_free_name(design, name, "latch"))
        case "steps" if design.competence is not None:
            return CompetenceStep(name=_free_name(design, name, "Step"))
        case "layers" if not has_own_states(design) and design.competence is None:
            return Layer(name=_free_name(design, name, "Layer"))
        case _:
            return None


def _free_name(design: Design, wanted: str, base: str) -> str:
    taken = {*COMPETENCE_STATES, *(each.name for each in design.states)}
    taken |= {each.name for _section, each in design.declarations()} | {use.alias for use in design.uses}
    taken |= {name for name, _origin in derived_variables(design)}
    taken |= {each.name for path in CONSTRUCT_LISTS for each in constructs_at(design, path) if hasattr(each, "name")}
    return wanted if is_valid_name(wanted) and wanted not in taken else unique_name(base, taken)


def add_construct(design: Design, path: DesignPath, item: Construct) -> Design:
    return _change_list(design, path, lambda items: (*items, item))


def add_competence(design: Design) -> Design:
    """Add a competence with a goal that is never reached, unless something else defines the states."""
    if has_own_states(design) or design.layers or design.competence is not None:
        return design
    return replace(design, competence=Competence(goal="false"))


def remove_construct(design: Design, path: DesignPath) -> Design:
    """Remove the item at the path of a list and its index; of a step or layer also what refers to its state."""
    items, index = constructs_at(design, path[:-1]), path[-1]
    if not isinstance(index, int) or index >= len(items):
        return design
    state = design.state(getattr(items[index], "name", ""))
    if path[0] in ("competence", "layers") and state is not None and state.origin:
        return remove_states(design, [state.name])
    return _change_list(design, path[:-1], lambda old: (*old[:index], *old[index + 1 :]))


def remove_competence(design: Design) -> Design:
    return replace(design, competence=None)


def move_construct(design: Design, path: DesignPath, by: int) -> Design:
    """Move the item at the path of a list and its index; the order is the priority."""
    index = path[-1]

    def moved(items: tuple[Any, ...]) -> tuple[Any, ...]:
        if not isinstance(index, int) or index >= len(items):
            return items
        rest = [*items[:index], *items[index + 1 :]]
        rest.insert(max(0, index + by), items[index])
        return tuple(rest)

    return _change_list(design, path[:-1], moved)


def _change_list(design: Design, path: DesignPath, change: Callable[[tuple[Any, ...]], tuple[Any, ...]]) -> Design:
    changes: dict[str, Any] = {str(path[-1]): change(constructs_at(design, path))}
    if path[0] != "competence":
        return replace(design, **changes)
    return design if design.competence is None else replace(design, competence=replace(design.competence, **changes))
