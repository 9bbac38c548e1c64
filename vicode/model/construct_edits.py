"""New latches, interrupts, steps, layers and competences (`vicode.model.lowering`)."""

from dataclasses import replace

from vicode.findings import DesignPath
from vicode.model.design import Competence, CompetenceStep, Design, Interrupt, Latch, Layer, State
from vicode.model.edits import unique_name
from vicode.model.lowering import COMPETENCE_STATES, derived_variables, lift_design
from vicode.model.names import is_valid_name
from vicode.model.traversal import Construct, iter_constructs


def new_construct(design: Design, path: DesignPath, name: str) -> Construct | None:
    """A new item for the list at a path, or a competence; None if the design can have none.

    It has this name if it is free; an interrupt makes the state of this name active if that is possible.
    """
    has_states = lift_design(design).states and not has_empty_state(design)
    match path[-1]:
        case "latches":
            return Latch(name=_free_name(design, name, "latch"))
        case "interrupts":
            taken = {design.initial, *(each.do for each in design.interrupts)}
            states = [each.name for each in design.states if each.name not in taken and not each.final]
            return Interrupt(do=name if name in states else states[0]) if states else None
        case "steps" if design.competence is not None:
            return CompetenceStep(name=_free_name(design, name, "Step"))
        case "layers" if not has_states and design.competence is None:
            return Layer(name=_free_name(design, name, "Layer"))
        case "competence" if not has_states and design.competence is None and not design.layers:
            return Competence(goal="false")
        case _:
            return None


def has_empty_state(design: Design) -> bool:
    """Whether the only written state is an empty one, as in a new design; a competence or layers may replace it."""
    match lift_design(design).states:
        case (state,):
            return replace(state, at=None) == State(name=state.name) and not design.common.transitions
        case _:
            return False


def _free_name(design: Design, wanted: str, base: str) -> str:
    taken = {*COMPETENCE_STATES, *(state.name for state in design.states), *(use.alias for use in design.uses)}
    taken |= {each.name for _section, each in design.declarations()}
    taken |= {name for name, _origin in derived_variables(design)}
    taken |= {str(path[-1]) for path, _construct in iter_constructs(design)}
    return wanted if is_valid_name(wanted) and wanted not in taken else unique_name(base, taken)
