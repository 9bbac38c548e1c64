"""Failed states: final states in which the derived output `failed` is true.

`done(x)` and `failed(x)` of callers are read from `is_done` and this output (`vicode.model.expressions.calls`).
"""

from dataclasses import replace

from vicode.model.design import Assign, Declaration, Design, State

FAILED = "failed"
"""The derived output of a component with failed states."""


def lower_ends(design: Design) -> Design:
    failed = next((state for state in design.states if state.failed), None)
    if failed is None or any(each.name == FAILED for _section, each in design.declarations()):
        return design
    origin = failed.origin or ("states", failed.name, FAILED)
    output = Declaration(
        name=FAILED, type="bool", initial="false", doc="Whether it ended without success.", origin=origin
    )

    def lower_state(state: State) -> State:
        if not state.final:
            return state
        value = "true" if state.failed else "false"
        return replace(state, actions=(Assign(values=((FAILED, value),), origin=origin), *state.actions))

    return replace(
        design, outputs=(*design.outputs, output), states=tuple(lower_state(state) for state in design.states)
    )
