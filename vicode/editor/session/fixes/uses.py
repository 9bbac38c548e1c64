"""Fixes of used components: unknown or unused components, wrong or misplaced calls."""

from dataclasses import replace
from functools import reduce

from vicode.check.graphs import iter_steps
from vicode.editor.session.fixes.context import Fix, FixContext
from vicode.findings import DesignPath
from vicode.model.design import Call, Design, State, Use
from vicode.model.edits import add_requirement, remove_uses, replace_action, update_actions, update_state
from vicode.model.names import is_valid_name, snake_case
from vicode.model.traversal import iter_actions


def fix_unknown_component(case: FixContext) -> list[Fix]:
    """P202 for a use."""
    alias, meant = str(case.path[1]), case.finding.suggestion
    fixes = []
    # A component cannot use itself.
    if meant and meant != case.design.component:
        label = f"Use the component {meant}"
        fixes.append(Fix(label=label, edit=lambda old: _with_component(old, alias, meant)))
    return fixes


def fix_unknown_alias(case: FixContext) -> list[Fix]:
    """D403 for a requirement, a call or a modulation."""
    alias, meant = _alias_at(case), case.finding.suggestion
    fixes = []
    if meant:
        fixes.append(Fix(label=f"Use {meant} instead", edit=lambda old: _with_alias(old, case.path, meant)))
    fixes += add_use_fixes(case, alias)
    fixes.append(Fix(label=f"Remove {alias} here", edit=lambda old: _without_link(old, case.path)))
    return fixes


def add_use_fixes(case: FixContext, alias: str) -> list[Fix]:
    """Add a use of the component whose name corresponds to an unknown alias."""
    own = case.design.component
    known = [name for name in case.project.interfaces() if snake_case(name) == alias and name != own]
    if len(known) != 1 or not is_valid_name(alias) or case.design.use(alias):
        return []
    use = Use(alias=alias, component=known[0])
    label = f"Use the component {known[0]} as {alias}"
    return [Fix(label=label, edit=lambda old: replace(old, uses=(*old.uses, use)))]


def fix_unknown_parameter(case: FixContext) -> list[Fix]:
    name, meant = str(case.path[-1]), case.finding.suggestion
    fixes = []
    if meant:
        fixes.append(
            Fix(label=f"Rename the argument to {meant}", edit=lambda old: _with_parameter(old, case.path, meant))
        )
    fixes.append(Fix(label=f"Remove the argument {name}", edit=lambda old: _with_parameter(old, case.path, "")))
    return fixes


def fix_misplaced_call(case: FixContext) -> list[Fix]:
    where = case.path[:-1]
    name = case.state_name()
    call = next((located.action for located in iter_actions(case.design) if located.path == where), None)
    if not isinstance(call, Call):
        return []

    def move(design: Design) -> Design:
        return update_actions(replace_action(design, where), ("states", name, "actions"), lambda old: (*old, call))

    return [
        Fix(label=f"Call {call.alias} in the actions of {name}", edit=move),
        Fix(label="Remove the call", edit=lambda old: replace_action(old, where)),
    ]


def fix_missing_requirement(case: FixContext) -> list[Fix]:
    """D426: the state requires the component that it reads; for a common guard, all states that do not step it."""
    name, alias = case.state_name(), case.finding.name
    if name:
        return [Fix(label=f"Require {alias} in {name}", edit=lambda old: add_requirement(old, name, alias))]
    stepping = {step.state for step in iter_steps(case.design) if step.alias == alias}
    idle = [state.name for state in case.design.states if state.name not in stepping and not state.disabled]

    def require(design: Design) -> Design:
        return reduce(lambda changed, state: add_requirement(changed, state, alias), idle, design)

    return [Fix(label=f"Require {alias} in all states", edit=require)]


def fix_unused_use(case: FixContext) -> list[Fix]:
    alias = str(case.path[1])
    return [Fix(label=f"Stop using {alias}", edit=lambda old: remove_uses(old, [alias]))]


def _with_component(design: Design, alias: str, component: str) -> Design:
    uses = (replace(use, component=component) if use.alias == alias else use for use in design.uses)
    return replace(design, uses=tuple(uses))


def _alias_at(case: FixContext) -> str:
    match case.path:
        case ("states", str(name), "requires", int(index)):
            state = case.design.state(name)
            return state.requires[index] if state else ""
        case ("states", _, "modulates", str(alias)):
            return alias
        case _:
            found = (located.action for located in iter_actions(case.design) if located.path == case.path[:-1])
            return next((action.alias for action in found if isinstance(action, Call)), "")


def _with_alias(design: Design, path: DesignPath, alias: str) -> Design:
    """Replace the alias at a path; the result contains no alias twice."""
    match path:
        case ("states", str(name), "requires", int(index)):

            def required(state: State) -> State:
                aliases = (alias if at == index else other for at, other in enumerate(state.requires))
                return replace(state, requires=tuple(dict.fromkeys(aliases)))

            return update_state(design, name, required)
        case ("states", str(name), "modulates", str(old)):

            def modulated(state: State) -> State:
                has_it = any(call.alias == alias for call in state.modulates)
                calls = (replace(call, alias=alias) if call.alias == old else call for call in state.modulates)
                kept = tuple(call for call in state.modulates if call.alias != old)
                return replace(state, modulates=kept if has_it else tuple(calls))

            return update_state(design, name, modulated)
        case _:
            return _with_call(design, path[:-1], alias)


def _with_call(design: Design, where: DesignPath, alias: str) -> Design:
    call = next((located.action for located in iter_actions(design) if located.path == where), None)
    return replace_action(design, where, replace(call, alias=alias)) if isinstance(call, Call) else design


def _without_link(design: Design, path: DesignPath) -> Design:
    match path:
        case ("states", str(name), "requires", int(index)):
            return update_state(
                design,
                name,
                lambda state: replace(state, requires=state.requires[:index] + state.requires[index + 1 :]),
            )
        case ("states", str(name), "modulates", str(alias)):
            return update_state(
                design,
                name,
                lambda state: replace(state, modulates=tuple(call for call in state.modulates if call.alias != alias)),
            )
        case _:
            return replace_action(design, path[:-1])


def _with_parameter(design: Design, path: DesignPath, new: str) -> Design:
    """Rename the argument at a path; an empty or already present name removes it."""
    old = str(path[-1])

    def changed(call: Call) -> Call:
        given = {name for name, _text in call.arguments}
        pairs = ((new if name == old else name, text) for name, text in call.arguments)
        taken = not new or new in given
        kept = tuple(pair for pair in call.arguments if pair[0] != old) if taken else tuple(pairs)
        return replace(call, arguments=kept)

    if path[2:3] == ("modulates",):

        def modulated(state: State) -> State:
            return replace(
                state, modulates=tuple(changed(call) if call.alias == path[3] else call for call in state.modulates)
            )

        return update_state(design, str(path[1]), modulated)
    where = path[:-2]
    call = next((located.action for located in iter_actions(design) if located.path == where), None)
    return replace_action(design, where, changed(call)) if isinstance(call, Call) else design


FIXERS = {
    "P202": fix_unknown_component,
    "D403": fix_unknown_alias,
    "D409": fix_unknown_parameter,
    "D410": fix_misplaced_call,
    "D426": fix_missing_requirement,
    "D428": fix_unused_use,
}
