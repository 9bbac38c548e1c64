"""Layers: a state for each, named after it. The state of the highest layer that wants to command is active.

All components of all layers are required in each state, so lower layers keep running while they are suppressed.
"""

from dataclasses import replace

from vicode.model.design import Assign, Design, Guard, Layer, State, Transition
from vicode.model.lowering.additions import (
    NOW,
    add_first_action,
    add_time,
    names_of,
    since_restart,
)
from vicode.model.names import snake_case


def lower_layers(design: Design) -> Design:
    if not design.layers or design.states or design.initial or design.competence is not None:
        return design
    requires = tuple(dict.fromkeys(alias for layer in design.layers for alias in layer.requires))
    states = tuple(
        State(
            name=layer.name, doc=layer.doc, requires=requires, modulates=layer.modulates, origin=("layers", layer.name)
        )
        for layer in design.layers
    )
    ways = tuple(_way_to(layer, is_lowest=layer is design.layers[0]) for layer in reversed(design.layers))
    common = replace(design.common, transitions=(*design.common.transitions, *ways))
    design = replace(design, states=states, initial=design.layers[0].name, common=common)
    for layer in design.layers[1:]:
        name = until_name(layer)
        if layer.hold and layer.when and name not in names_of(design):
            origin = ("layers", layer.name)
            value = f"component_time + {layer.hold} if ({layer.when}) else {since_restart(name)}"
            design = add_first_action(design, Assign(values=((name, value),), origin=origin))
            design = add_time(design, name, origin)
    return design


def until_name(layer: Layer) -> str:
    """The variable for the time until which a layer commands."""
    return f"{snake_case(layer.name)}_until"


def _way_to(layer: Layer, *, is_lowest: bool) -> Transition:
    when = "" if is_lowest else layer.when
    if when and layer.hold:
        when = f"({when}) or component_time > 0 and {NOW} < {until_name(layer)}"
    return Transition(to=layer.name, guard=Guard(when=when), origin=("layers", layer.name))
