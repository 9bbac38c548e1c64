"""Rules for latches, interrupts, competences, layers and failed states (`vicode.model.lowering`)."""

from collections.abc import Iterable, Iterator

from vicode.check.context import RuleContext
from vicode.findings import DesignPath, Finding, Severity, did_you_mean
from vicode.model.design import INTERRUPT_ENDS, Design
from vicode.model.lowering import (
    COMPETENCE_STATES,
    FAILED,
    derived_variables,
    find_origin,
    find_target,
    fits_pattern,
    interrupted_states,
    is_handled_before,
    lift_design,
)


def merge_derived(design: Design, findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Report each error in what is derived once, and no warnings, as they are not about the text of the design."""
    found = [(each, find_origin(design, each.subject.path) if each.subject else ()) for each in findings]
    said = {(each.rule.code, each.message) for each, origin in found if not origin}
    kept: list[Finding] = []
    for finding, origin in found:
        key = (finding.rule.code, finding.message)
        if not origin or (finding.severity is Severity.ERROR and key not in said):
            kept.append(finding)
            said.add(key)
    return tuple(kept)


def find_bad_interrupts(context: RuleContext) -> Iterator[Finding]:
    """D447: an interrupt that has no effect, or after which it is not certain what follows."""
    design = context.design
    names = [state.name for state in design.states]
    for number, interrupt in enumerate(design.interrupts):
        path: DesignPath = ("interrupts", number)
        if interrupt.do not in names:
            message = f"there is no state '{interrupt.do}'"
            yield context.make_finding("D447", (*path, "do"), message, did_you_mean(interrupt.do, names))
            continue
        if is_handled_before(design, number):
            message = f"'{interrupt.do}' is already the state of another interrupt"
            fix = "combine their conditions with 'or', or add a state"
            yield context.make_finding("D447", (*path, "do"), message, fix)
        if interrupt.do == design.initial:
            message = f"'{interrupt.do}' is the initial state, which no interrupt precedes"
            yield context.make_finding("D447", (*path, "do"), message, "add a state for the interrupt")
        for index, pattern in enumerate(interrupt.during):
            if not any(fits_pattern(name, pattern) for name in names):
                fix = did_you_mean(pattern, names)
                yield context.make_finding("D447", (*path, "while", index), f"no state is named '{pattern}'", fix)
        yield from _check_effect(context, number)
        yield from _check_ends(context, number, names)


def _check_effect(context: RuleContext, number: int) -> Iterator[Finding]:
    """Whether an interrupt interrupts anything, and ends."""
    design, interrupt = context.design, context.design.interrupts[number]
    if design.layers:
        message = "layers decide before interrupts, which have no effect"
        yield context.make_finding("D447", ("interrupts", number), message, "add a layer above the others")
    states = interrupted_states(design, number)
    if interrupt.during and not states and not is_handled_before(design, number):
        message = "no state is interrupted: those of 'while' are disabled, or states of this or an earlier interrupt"
        yield context.make_finding("D447", ("interrupts", number, "while"), message, "name other states")
    if any(find_target(design, interrupt, each) == interrupt.do for each in states):
        message = f"'{interrupt.do}' follows itself, so the interrupt never ends"
        path = ("interrupts", number, *(("then",) if interrupt.then else ()))
        yield context.make_finding("D447", path, message, "name another state")


def _check_ends(context: RuleContext, number: int, names: list[str]) -> Iterator[Finding]:
    design, interrupt = context.design, context.design.interrupts[number]
    where: DesignPath = ("interrupts", number, "then")
    then = interrupt.then or "resume"
    if interrupt.then in INTERRUPT_ENDS and interrupt.then in names:
        message = f"'{then}' is a way to continue, but also a state"
        yield context.make_finding("D447", where, message, "rename the state")
    if then not in INTERRUPT_ENDS and then not in names:
        fix = did_you_mean(then, [*INTERRUPT_ENDS, *names])
        yield context.make_finding("D447", where, f"'{then}' is no state and no way to continue", fix)
        return
    reasons = {
        "skip": "add a transition with 'done' to it, or leave it out of 'while'",
        "done": "mark exactly one state with 'final: true', and not with 'failed'",
        "fail": "mark exactly one final state with 'failed: true'",
    }
    for state in interrupted_states(design, number):
        if not find_target(design, interrupt, state):
            message = f"it is not certain which state follows '{state.name}' with 'then: {then}'"
            yield context.make_finding("D447", where, message, reasons.get(then, ""))


def find_states_twice(context: RuleContext) -> Iterator[Finding]:
    """D448: a competence and layers define the states of a design."""
    design = lift_design(context.design)
    sections = [("competence", design.competence is not None), ("layers", bool(design.layers))]
    given = [name for name, is_given in sections if is_given]
    others = [name for name in ("states", "initial") if getattr(design, name)] + given[1:]
    if given and others:
        message = f"'{given[0]}' defines the states, but there is '{others[0]}' as well"
        yield context.make_finding("D448", (others[0],), message, "move one of them to another design", is_key=True)


def find_taken_names(context: RuleContext) -> Iterator[Finding]:
    """D449: names of variables and states that a construct needs."""
    written = lift_design(context.design)
    taken = {each.name for _section, each in written.declarations()}
    for name, origin in derived_variables(context.design):
        if name in taken:
            yield context.make_finding("D449", origin, f"'{name}' is already declared", "rename one of them")
        taken.add(name)
    failed = [state.name for state in written.states if state.failed]
    if failed and FAILED in {each.name for _section, each in written.declarations()}:
        message = f"'{FAILED}' is the output that failed states set"
        yield context.make_finding("D449", ("states", failed[0], FAILED), message, "rename the declaration")
    for step in written.competence.steps if written.competence else ():
        if step.name in COMPETENCE_STATES:
            path = ("competence", "steps", step.name)
            yield context.make_finding("D449", path, f"'{step.name}' is a state of each competence", "rename the step")


def find_layer_conditions(context: RuleContext) -> Iterator[Finding]:
    """D450: which layer commands must depend on conditions, and never on none."""
    for index, layer in enumerate(context.design.layers):
        path: DesignPath = ("layers", layer.name)
        if not index and layer.when:
            message = f"'{layer.name}' is the lowest layer, which commands if no other does"
            yield context.make_finding("D450", (*path, "when"), message, "remove 'when', or add a layer below")
        if index and not layer.when:
            message = f"'{layer.name}' always commands, and the layers below never do"
            yield context.make_finding("D450", path, message, "add 'when'", is_key=True)


def find_failed_states(context: RuleContext) -> Iterator[Finding]:
    """D451: only a final state can be a failed one."""
    for state in context.design.states:
        if state.failed and not state.final:
            message = f"'{state.name}' is failed, but not final"
            yield context.make_finding("D451", ("states", state.name, "failed"), message, "add 'final: true'")


RULES = (find_failed_states, find_bad_interrupts, find_states_twice, find_taken_names, find_layer_conditions)
