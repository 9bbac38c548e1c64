"""Random edits of imported projects, as the editor makes them."""

import random
from collections.abc import Callable
from dataclasses import dataclass, replace

from vicode.model import edits
from vicode.model.design import (
    COMMON,
    Assign,
    Call,
    Declaration,
    Design,
    Guard,
    State,
    Stay,
    Transition,
)
from vicode.model.project import WORLD, Project
from vicode.model.traversal import iter_decisions


@dataclass(frozen=True)
class Edited:
    """An edited project; `component` and `state` are the edited ones, empty if more than those change."""

    kind: str
    project: Project
    component: str = ""
    state: str = ""


Draw = random.Random


def with_design(project: Project, design: Design) -> Project:
    designs = tuple(design if each.component == design.component else each for each in project.designs)
    return replace(project, designs=designs)


def _guard_text(draw: Draw, design: Design, project: Project) -> str:
    names = [item.name for item in design.parameters if item.type == "float"]
    for use in design.uses:
        interface = project.interface(use.component)
        readable = interface.readable if interface and interface.implementation else ()
        names += [f"{use.alias}.{each.name}" for each in readable if each.type == "float" and each.arguments is None]
    left = draw.choice([*names, "state_time", "component_time"])
    return f"{left} {draw.choice(('<', '>', '<=', '!='))} {draw.choice((1, 25, 1.5, 400))}"


def change_guard(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    found = [each for each in iter_decisions(design) if each.decision.guard.when and each.source != COMMON]
    if not found:
        return None
    place = draw.choice(found)
    old, extra = place.decision.guard.when, _guard_text(draw, design, project)
    new = draw.choice((f"({old}) and {extra}", f"{extra} and ({old})", extra, f"not ({old})", f"({old}) or {extra}"))
    changed = replace(place.decision, guard=replace(place.decision.guard, when=new))
    return edits.replace_decision(design, place.path, changed), place.source


def change_timer(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    found = [each for each in iter_decisions(design) if not each.decision.guard.is_empty and each.source != COMMON]
    if not found:
        return None
    place = draw.choice(found)
    after = draw.choice(("", "250", "1000"))
    guard = replace(place.decision.guard, after=after)
    if guard.is_empty:
        return None
    return edits.replace_decision(design, place.path, replace(place.decision, guard=guard)), place.source


def retarget(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    found = [each for each in iter_decisions(design) if isinstance(each.decision, Transition) and each.source != COMMON]
    if not found:
        return None
    place = draw.choice(found)
    to = draw.choice(design.states).name
    return edits.replace_decision(design, place.path, replace(place.decision, to=to)), place.source


def change_decision_doc(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    found = [each for each in iter_decisions(design) if not each.decision.guard.is_empty and each.source != COMMON]
    if not found:
        return None
    place = draw.choice(found)
    doc = draw.choice(("", "because of this", f"{place.decision.doc} and more".strip()))
    return edits.replace_decision(design, place.path, replace(place.decision, doc=doc)), place.source


def _state(draw: Draw, design: Design) -> State:
    return draw.choice(design.states)


def insert_transition(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    state = _state(draw, design)
    guard = Guard(when=_guard_text(draw, design, project))
    new = draw.choice((Transition(to=draw.choice(design.states).name, guard=guard), Stay(guard=guard)))
    place = draw.randint(0, len(state.transitions))
    items = (*state.transitions[:place], new, *state.transitions[place:])
    if any(item.guard.is_empty for item in items[:-1]):
        items = (new, *state.transitions)
    return edits.update_state(design, state.name, lambda old: replace(old, transitions=items)), state.name


def remove_transition(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    state = _state(draw, design)
    if not state.transitions:
        return None
    place = draw.randrange(len(state.transitions))
    items = state.transitions[:place] + state.transitions[place + 1 :]
    return edits.update_state(design, state.name, lambda old: replace(old, transitions=items)), state.name


def reorder_transitions(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    state = _state(draw, design)
    tests = [item for item in state.transitions if not item.guard.is_empty]
    if len(tests) < 2:
        return None
    rest = state.transitions[len(tests) :]
    draw.shuffle(tests)
    return edits.update_state(design, state.name, lambda old: replace(old, transitions=(*tests, *rest))), state.name


def change_state_doc(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    state = _state(draw, design)
    words = state.doc.split()
    doc = draw.choice((f"{state.doc} now".strip(), " ".join(words[1:]), "another text", f"first {state.doc}".strip()))
    return edits.update_state(design, state.name, lambda old: replace(old, doc=doc)), state.name


def toggle_final(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    state = _state(draw, design)
    return edits.update_state(design, state.name, lambda old: replace(old, final=not old.final)), state.name


def change_action(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    states = [state for state in design.states if state.actions]
    if not states:
        return None
    state = draw.choice(states)
    place = draw.randrange(len(state.actions))
    action = state.actions[place]
    if isinstance(action, Call):
        if not action.arguments:
            return None
        name, value = draw.choice(action.arguments)
        used = design.use(action.alias)
        interface = project.interface(used.component) if used else None
        declared = interface.parameter(name) if interface else None
        if declared is None or declared.type != "float":
            return None
        new = draw.choice(("12", f"{value} + 1", "-3.5"))
        changed: Call | Assign = replace(
            action, arguments=tuple((each, new if each == name else old) for each, old in action.arguments)
        )
    elif isinstance(action, Assign):
        changed = Assign(values=action.values[1:]) if len(action.values) > 1 else action
    else:
        return None
    items = (*state.actions[:place], changed, *state.actions[place + 1 :])
    return edits.update_state(design, state.name, lambda old: replace(old, actions=items)), state.name


def add_action(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    source = [action for state in design.states for action in state.actions if isinstance(action, Call)]
    state = _state(draw, design)
    if not source:
        return None
    place = draw.randint(0, len(state.actions))
    items = (*state.actions[:place], draw.choice(source), *state.actions[place:])
    return edits.update_state(design, state.name, lambda old: replace(old, actions=items)), state.name


def remove_action(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    states = [state for state in design.states if state.actions]
    if not states:
        return None
    state = draw.choice(states)
    items = list(state.actions)
    items.pop(draw.randrange(len(items)))
    return edits.update_state(design, state.name, lambda old: replace(old, actions=tuple(items))), state.name


def reorder_actions(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    states = [state for state in design.states if len(state.actions) > 1]
    if not states:
        return None
    state = draw.choice(states)
    items = list(state.actions)
    draw.shuffle(items)
    return edits.update_state(design, state.name, lambda old: replace(old, actions=tuple(items))), state.name


# Edits of more than one state


def rename_state(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    state = _state(draw, design)
    if state.xabsl_name:
        return None
    return edits.rename_state(design, state.name, f"{state.name}_renamed"), ""


def add_state(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    other = _state(draw, design)
    guard = Guard(when=_guard_text(draw, design, project))
    new = State(
        name="added_state",
        doc=draw.choice(("", "what it does")),
        transitions=(Transition(to=other.name, guard=guard),) * draw.randint(0, 1),
        actions=other.actions,
    )
    place = draw.randint(0, len(design.states))
    return replace(design, states=(*design.states[:place], new, *design.states[place:])), ""


def remove_state(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    state = _state(draw, design)
    if state.name == design.initial or len(design.states) < 2:
        return None
    return edits.remove_states(design, [state.name]), ""


def reorder_states(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    state = _state(draw, design)
    return edits.reorder_state(design, state.name, draw.randrange(len(design.states))), ""


def change_initial(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    return replace(design, initial=_state(draw, design).name), ""


def change_doc(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    return replace(design, doc=draw.choice((f"{design.doc} now".strip(), "", "another text"))), ""


def add_common(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    guard = Guard(when=_guard_text(draw, design, project))
    new = Transition(to=_state(draw, design).name, guard=guard)
    common = replace(design.common, transitions=(*design.common.transitions, new))
    return replace(design, common=common), ""


def remove_common(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    return replace(design, common=replace(design.common, transitions=design.common.transitions[1:])), ""


def add_parameter(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    new = Declaration(name="added_one", type="float", unit="mm", range=(0, 5), doc=draw.choice(("", "how much")))
    place = draw.randint(0, len(design.parameters))
    items = (*design.parameters[:place], new, *design.parameters[place:])
    return replace(design, parameters=items), ""


def change_parameter(draw: Draw, design: Design, project: Project) -> tuple[Design, str] | None:
    if not design.parameters:
        return None
    place = draw.randrange(len(design.parameters))
    old = design.parameters[place]
    unit = "cm" if old.type == "float" else ""
    new = replace(old, doc=draw.choice((f"{old.doc} now".strip(), "another")), unit=draw.choice((old.unit, unit)))
    return replace(design, parameters=(*design.parameters[:place], new, *design.parameters[place + 1 :])), ""


STATE_EDITS: dict[str, Callable[[Draw, Design, Project], tuple[Design, str] | None]] = {
    each.__name__: each
    for each in (
        change_guard,
        change_timer,
        retarget,
        change_decision_doc,
        insert_transition,
        remove_transition,
        reorder_transitions,
        change_state_doc,
        toggle_final,
        change_action,
        add_action,
        remove_action,
        reorder_actions,
    )
}
DESIGN_EDITS: dict[str, Callable[[Draw, Design, Project], tuple[Design, str] | None]] = {
    each.__name__: each
    for each in (
        rename_state,
        add_state,
        remove_state,
        reorder_states,
        change_initial,
        change_doc,
        add_common,
        remove_common,
        add_parameter,
        change_parameter,
    )
}


def change_constant(draw: Draw, project: Project) -> Project | None:
    if not project.constants:
        return None
    place = draw.randrange(len(project.constants))
    new = replace(project.constants[place], initial=draw.choice(("7", "-2.5", "0.25")), doc="a constant")
    return replace(project, constants=(*project.constants[:place], new, *project.constants[place + 1 :]))


def add_constant(draw: Draw, project: Project) -> Project | None:
    place = draw.randint(0, len(project.constants))
    new = Declaration(name="added_constant", type="float", initial="3", unit="m", doc=draw.choice(("", "why")))
    return replace(project, constants=(*project.constants[:place], new, *project.constants[place:]))


def add_output(draw: Draw, project: Project) -> Project | None:
    places = [index for index, item in enumerate(project.components) if item.implementation == WORLD and item.outputs]
    if not places:
        return None
    place = draw.choice(places)
    old = project.components[place]
    arguments = (Declaration(name="x", type="float", initial="0"),) if draw.random() < 0.3 else None
    new = Declaration(name="added_output", type="float", range=(0, 1), arguments=arguments, xabsl_name="added.output")
    index = draw.randint(0, len(old.outputs))
    changed = replace(old, outputs=(*old.outputs[:index], new, *old.outputs[index:]))
    return replace(project, components=(*project.components[:place], changed, *project.components[place + 1 :]))


def change_output_doc(draw: Draw, project: Project) -> Project | None:
    places = [index for index, item in enumerate(project.components) if item.implementation == WORLD and item.outputs]
    if not places:
        return None
    place = draw.choice(places)
    old = project.components[place]
    index = draw.randrange(len(old.outputs))
    was = old.outputs[index]
    now = replace(was, doc=draw.choice(("", f"{was.doc} now".strip(), "another")))
    changed = replace(old, outputs=(*old.outputs[:index], now, *old.outputs[index + 1 :]))
    return replace(project, components=(*project.components[:place], changed, *project.components[place + 1 :]))


def add_element(draw: Draw, project: Project) -> Project | None:
    if not project.enumerations:
        return None
    place = draw.randrange(len(project.enumerations))
    old = project.enumerations[place]
    index = draw.randint(0, len(old.elements))
    changed = replace(old, elements=(*old.elements[:index], ("added_element", ""), *old.elements[index:]))
    return replace(project, enumerations=(*project.enumerations[:place], changed, *project.enumerations[place + 1 :]))


def add_design(draw: Draw, project: Project) -> Project | None:
    copied = draw.choice(project.designs)
    new = replace(copied, component="added_option", xabsl_name="", doc="a new one")
    return replace(project, designs=(*project.designs, new))


def change_agent(draw: Draw, project: Project) -> Project | None:
    place = draw.randrange(len(project.agents))
    changed = replace(project.agents[place], title="Another title", root=draw.choice(project.designs).component)
    return replace(project, agents=(*project.agents[:place], changed, *project.agents[place + 1 :]))


PROJECT_EDITS: dict[str, Callable[[Draw, Project], Project | None]] = {
    each.__name__: each
    for each in (
        change_constant,
        add_constant,
        add_output,
        change_output_doc,
        add_element,
        add_design,
        change_agent,
    )
}


def random_edit(draw: Draw, project: Project) -> Edited | None:
    """Edit a project; None if the drawn edit does not apply."""
    kind = draw.choice([*STATE_EDITS, *STATE_EDITS, *DESIGN_EDITS, *PROJECT_EDITS])
    if kind in PROJECT_EDITS:
        changed = PROJECT_EDITS[kind](draw, project)
        return None if changed is None or changed == project else Edited(kind, changed)
    design = draw.choice(project.designs)
    result = (STATE_EDITS.get(kind) or DESIGN_EDITS[kind])(draw, design, project)
    if result is None or result[0] == design:
        return None
    return Edited(kind, with_design(project, result[0]), design.component, result[1])
