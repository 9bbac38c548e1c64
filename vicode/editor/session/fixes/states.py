"""Mends of what is wrong with states: missing, unreachable, without a way out, no initial one."""

from dataclasses import replace

from vicode.editor.session.fixes.case import Case, Change, Fix
from vicode.model.design import COMMON, Design, State, Transition
from vicode.model.edits import add_state, remove_decisions, remove_states, replace_decision, update_state
from vicode.model.names import is_state_name


def fix_no_states(_case: Case) -> list[Fix]:
    """D411."""
    return [Fix(label="Add a state Start", change=_with_start)]


def fix_no_initial_state(case: Case) -> list[Fix]:
    """D401."""
    names = list(dict.fromkeys([case.meant or case.design.states[0].name, case.design.states[0].name]))
    return [Fix(label=f"Start in {name}", change=_starter(name)) for name in names]


def fix_disabled_initial_state(case: Case) -> list[Fix]:
    """D418."""
    name = case.design.initial

    def enable(design: Design) -> Design:
        return update_state(design, name, lambda state: replace(state, disabled=False))

    others = [state.name for state in case.design.states if not state.disabled][:1]
    return [
        Fix(label=f"Enable {name}", change=enable),
        *(Fix(label=f"Start in {other}", change=_starter(other)) for other in others),
    ]


def fix_unknown_state(case: Case) -> list[Fix]:
    """D402."""
    located = case.decision()
    if located is None or not isinstance(located.decision, Transition):
        return []
    transition, path = located.decision, located.path
    fixes = []
    if case.meant:
        mended = replace(transition, to=case.meant)
        fixes.append(Fix(label=f"Lead to {case.meant}", change=lambda old: replace_decision(old, path, mended)))
    if is_state_name(transition.to):
        label = f"Create the state {transition.to}"
        beside = located.source
        fixes.append(Fix(label=label, change=lambda old: add_state(old, _new_state(old, transition.to, beside))))
    fixes.append(Fix(label="Remove the transition", change=lambda old: remove_decisions(old, [path])))
    return fixes


def fix_unreachable_state(case: Case) -> list[Fix]:
    """D421."""
    name = case.state()
    return [Fix(label=f"Remove the state {name}", change=lambda old: remove_states(old, [name]))]


def fix_trap(case: Case) -> list[Fix]:
    """D422."""
    name = case.state()

    def change(design: Design) -> Design:
        return update_state(design, name, lambda state: replace(state, final=True))

    return [Fix(label=f"Mark {name} as final", change=change)]


def _with_start(design: Design) -> Design:
    return replace(design, states=(State(name="Start", at=(160, 120)),), initial="Start")


def _starter(name: str) -> Change:
    return lambda design: replace(design, initial=name)


def _new_state(design: Design, name: str, beside: str) -> State:
    """A state to the right of the one that leads to it, if that has a place."""
    source = design.state(beside) if beside != COMMON else None
    return State(name=name, at=(source.at[0] + 240, source.at[1] + 40) if source and source.at else None)


FIXERS = {
    "D401": fix_no_initial_state,
    "D402": fix_unknown_state,
    "D411": fix_no_states,
    "D418": fix_disabled_initial_state,
    "D421": fix_unreachable_state,
    "D422": fix_trap,
}
