"""Competences: a state for each step, one that chooses the next step, and two ends.

`Choose` and each step go to the first possible step that is more urgent than their own. A step whose component is done
goes back to `Choose`, so that the component restarts if the step is begun again.
"""

from dataclasses import replace

from vicode.model.design import Assign, CompetenceStep, Decision, Declaration, Design, Guard, State, Transition
from vicode.model.lowering.additions import add_first_action, add_variables, all_of, names_of, negated, since_restart
from vicode.model.names import snake_case

CHOOSE, DONE, FAILED_STATE = COMPETENCE_STATES = ("Choose", "Done", "Failed")
"""The states of a competence besides those of its steps."""
LATEST = "latest_step"
"""A variable of competences that limit how often a step is begun."""


def lower_competence(design: Design) -> Design:
    competence = design.competence
    if competence is None or design.states or design.initial or not competence.goal:
        return design
    steps = [each for each in competence.steps if each.name not in COMPETENCE_STATES]
    origin = ("competence",)
    goal = Transition(to=DONE, guard=Guard(when=competence.goal), origin=origin)
    choose = State(
        name=CHOOSE,
        requires=competence.requires,
        transitions=(goal, *map(_way_to, steps), Transition(to=FAILED_STATE, origin=origin)),
        doc=competence.doc,
        origin=origin,
    )
    states = [choose]
    for index, step in enumerate(steps):
        states.append(_step_state(design, step, (goal, *map(_way_to, steps[:index]))))
    states += [
        State(name=DONE, final=True, origin=origin),
        State(name=FAILED_STATE, final=True, failed=True, origin=origin),
    ]
    design = replace(design, states=tuple(states), initial=CHOOSE)
    return _add_counters(design, steps)


def _add_counters(design: Design, steps: list[CompetenceStep]) -> Design:
    """Count how often each step with a limit was begun; `LATEST` is the number of the latest state."""
    counted = [each for each in steps if each.retries is not None]
    if not counted or LATEST in names_of(design):
        return design
    origin = ("competence",)
    names = [LATEST, *map(tries_name, counted)]
    reset = Assign(values=tuple((name, since_restart(name)) for name in names), origin=origin)
    variables = (Declaration(name=name, type="int", initial="0", origin=origin) for name in names)
    design = add_first_action(add_variables(design, *variables), reset)

    def count(number: int, state: State) -> State:
        values = [(LATEST, str(number))]
        for step in counted:
            if step.name == state.name:
                name = tries_name(step)
                values.insert(0, (name, f"{name} if {LATEST} == {number} else {name} + 1"))
        return replace(state, actions=(Assign(values=tuple(values), origin=origin),))

    return replace(design, states=tuple(count(number, each) for number, each in enumerate(design.states)))


def tries_name(step: CompetenceStep) -> str:
    """The variable that counts how often a step was begun."""
    return f"{snake_case(step.name)}_tries"


def _way_to(step: CompetenceStep) -> Transition:
    limit = "" if step.retries is None else f"component_time <= 0 or {tries_name(step)} < {step.retries}"
    limit = "false" if step.retries == 0 else limit
    return Transition(
        to=step.name, guard=Guard(when=all_of(step.when, limit)), origin=("competence", "steps", step.name)
    )


def _step_state(design: Design, step: CompetenceStep, urgent: tuple[Decision, ...]) -> State:
    assert design.competence is not None
    origin = ("competence", "steps", step.name)
    ends = [Transition(to=CHOOSE, guard=Guard(when="action_done"), origin=origin)] if step.modulates else []
    ends += [Transition(to=CHOOSE, guard=Guard(when=negated(step.when)), origin=origin)] if step.when else []
    return State(
        name=step.name,
        doc=step.doc,
        requires=tuple(dict.fromkeys((*design.competence.requires, *step.requires))),
        modulates=step.modulates,
        transitions=(*urgent, *ends),
        origin=origin,
    )
