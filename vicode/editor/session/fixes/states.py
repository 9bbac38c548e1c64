"""Fixes of states: unknown or unreachable states, dead ends, a missing initial state."""

from dataclasses import replace

from vicode.editor.session.fixes.context import DesignEdit, Fix, FixContext
from vicode.model.design import COMMON, Design, State, Transition
from vicode.model.diagram_edits import remove_frames, set_frame_states
from vicode.model.edits import (
    add_state,
    remove_decisions,
    remove_states,
    replace_decision,
    update_state,
)
from vicode.model.names import is_valid_state_name


def fix_no_states(_case: FixContext) -> list[Fix]:
    return [Fix(label="Add the state Start", edit=_with_start)]


def fix_no_initial_state(case: FixContext) -> list[Fix]:
    names = list(dict.fromkeys([case.finding.suggestion or case.design.states[0].name, case.design.states[0].name]))
    return [Fix(label=f"Make {name} the initial state", edit=_initial_state_edit(name)) for name in names]


def fix_disabled_initial_state(case: FixContext) -> list[Fix]:
    name = case.design.initial

    def enable(design: Design) -> Design:
        return update_state(design, name, lambda state: replace(state, disabled=False))

    others = [state.name for state in case.design.states if not state.disabled][:1]
    return [
        Fix(label=f"Enable {name}", edit=enable),
        *(Fix(label=f"Make {other} the initial state", edit=_initial_state_edit(other)) for other in others),
    ]


def fix_unknown_state(case: FixContext) -> list[Fix]:
    located = case.decision()
    if located is None or not isinstance(located.decision, Transition):
        return []
    transition, path = located.decision, located.path
    fixes = []
    if case.finding.suggestion:
        fixed = replace(transition, to=case.finding.suggestion)
        label = f"Change the target to {case.finding.suggestion}"
        fixes.append(Fix(label=label, edit=lambda old: replace_decision(old, path, fixed)))
    if is_valid_state_name(transition.to):
        label = f"Create the state {transition.to}"
        source = located.source
        fixes.append(Fix(label=label, edit=lambda old: add_state(old, _new_state(old, transition.to, source))))
    fixes.append(Fix(label="Remove the transition", edit=lambda old: remove_decisions(old, [path])))
    return fixes


def fix_unreachable_state(case: FixContext) -> list[Fix]:
    name = case.state_name()
    return [Fix(label=f"Remove the state {name}", edit=lambda old: remove_states(old, [name]))]


def fix_dead_end(case: FixContext) -> list[Fix]:
    name = case.state_name()

    def change(design: Design) -> Design:
        return update_state(design, name, lambda state: replace(state, final=True))

    return [Fix(label=f"Mark {name} as final", edit=change)]


def fix_bad_frame(case: FixContext) -> list[Fix]:
    assert case.finding.subject is not None
    _section, title, *rest = case.finding.subject.path
    frame = case.design.frame(str(title))
    if frame is None or not rest:
        return [Fix(label="Remove the frame", edit=lambda old: remove_frames(old, [str(title)]))]
    wrong, suggestion = frame.states[int(rest[-1])], case.finding.suggestion
    left = tuple(name for name in frame.states if name != wrong)
    fixes = [Fix(label="Remove the name from the frame", edit=_frame_edit(frame.name, left))]
    if suggestion and suggestion not in left:
        renamed = tuple(suggestion if name == wrong else name for name in frame.states)
        fixes.insert(0, Fix(label=f"Change the name to {suggestion}", edit=_frame_edit(frame.name, renamed)))
    return fixes


def _frame_edit(title: str, states: tuple[str, ...]) -> DesignEdit:
    return lambda old: set_frame_states(old, title, states) if states else remove_frames(old, [title])


def _with_start(design: Design) -> Design:
    return replace(design, states=(State(name="Start", at=(160, 120)),), initial="Start")


def _initial_state_edit(name: str) -> DesignEdit:
    return lambda design: replace(design, initial=name)


def _new_state(design: Design, name: str, source: str) -> State:
    """A state to the right of its source, if that has a position."""
    state = design.state(source) if source != COMMON else None
    return State(name=name, at=(state.at[0] + 240, state.at[1] + 40) if state and state.at else None)


FIXERS = {
    "D401": fix_no_initial_state,
    "D402": fix_unknown_state,
    "D411": fix_no_states,
    "D418": fix_disabled_initial_state,
    "D421": fix_unreachable_state,
    "D422": fix_dead_end,
    "D431": fix_bad_frame,
}
