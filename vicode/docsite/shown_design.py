"""Designs with the shown names of their states and components, for diagrams."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from vicode.docsite.site_names import SiteNames
from vicode.model.design import Action, Call, Decision, DecisionGroup, Design, State, Transition
from vicode.model.edits import rename_states_of


@dataclass(frozen=True, slots=True, kw_only=True)
class ShownDesign:
    """A design with shown names; `states` maps them to the names in the design."""

    design: Design
    states: Mapping[str, str]


def with_shown_names(design: Design, names: SiteNames) -> ShownDesign:
    """Rename states and aliases as far as the shown names are unique."""
    states = _unique({each.name: names.state(each) for each in design.states})
    aliases = {use.alias: names.component(use.component) if names.is_xabsl else use.alias for use in design.uses}
    aliases = _unique(aliases)
    is_same = all(old == new for old, new in (*states.items(), *aliases.items()))
    return ShownDesign(
        design=design if is_same else _rename(design, states, aliases),
        states={new: old for old, new in states.items()},
    )


def with_shown_targets(decisions: Sequence[Decision], states: Mapping[str, str]) -> tuple[Decision, ...]:
    """The decisions with the shown names of their targets."""
    return tuple(_decision(each, states) for each in decisions)


def _unique(shown: Mapping[str, str]) -> dict[str, str]:
    return dict(shown) if len(set(shown.values())) == len(shown) else {name: name for name in shown}


def _rename(design: Design, states: Mapping[str, str], aliases: Mapping[str, str]) -> Design:
    common = replace(
        design.common,
        actions=_actions(design.common.actions, aliases),
        transitions=with_shown_targets(design.common.transitions, states),
    )
    return replace(
        design,
        initial=states.get(design.initial, design.initial),
        uses=tuple(replace(use, alias=aliases[use.alias]) for use in design.uses),
        common=common,
        states=tuple(_state(state, states, aliases) for state in design.states),
        properties=tuple(rename_states_of(each, states) for each in design.properties),
        frames=tuple(
            replace(frame, states=tuple(states.get(name, name) for name in frame.states)) for frame in design.frames
        ),
    )


def _state(state: State, states: Mapping[str, str], aliases: Mapping[str, str]) -> State:
    return replace(
        state,
        name=states[state.name],
        requires=tuple(aliases.get(alias, alias) for alias in state.requires),
        modulates=tuple(replace(call, alias=aliases.get(call.alias, call.alias)) for call in state.modulates),
        actions=_actions(state.actions, aliases),
        transitions=with_shown_targets(state.transitions, states),
    )


def _actions(actions: Sequence[Action], aliases: Mapping[str, str]) -> tuple[Action, ...]:
    return tuple(
        replace(each, alias=aliases.get(each.alias, each.alias)) if isinstance(each, Call) else each for each in actions
    )


def _decision(decision: Decision, states: Mapping[str, str]) -> Decision:
    match decision:
        case Transition(to=to):
            return replace(decision, to=states.get(to, to))
        case DecisionGroup(then=then, otherwise=otherwise):
            inner, others = with_shown_targets(then, states), with_shown_targets(otherwise, states)
            return replace(decision, then=inner, otherwise=others)
        case _:
            return decision
