"""Rules for used components: unknown components and parameters, cycles, unused aliases."""

from collections.abc import Iterator

from vicode.check.context import RuleContext
from vicode.findings import DesignPath, Finding, did_you_mean
from vicode.model.design import Assign, Call


def find_unknown_components(context: RuleContext) -> Iterator[Finding]:
    """P202: an unknown component in `uses`."""
    known = context.project.interfaces()
    for use in context.design.uses:
        if use.component not in known:
            fix = did_you_mean(use.component, known, "add a design with this name, or declare it in project.yaml")
            message = f"unknown component '{use.component}'"
            if file := dict(context.project.unreadable).get(use.component):
                message, fix = f"the design of '{use.component}' cannot be read", f"fix {file} first"
            yield context.make_finding("P202", ("uses", use.alias), message, fix)


def find_unknown_aliases(context: RuleContext) -> Iterator[Finding]:
    """D403: an alias that is not declared in `uses`."""
    known = {use.alias for use in context.design.uses}
    for alias, path, is_key in _referenced_aliases(context):
        if alias not in known:
            fix = did_you_mean(alias, known, f"add {alias or 'alias'}: ComponentName to 'uses'")
            yield context.make_finding("D403", path, f"'{alias}' is not declared in 'uses'", fix, is_key=is_key)


def find_misplaced_calls(context: RuleContext) -> Iterator[Finding]:
    """D410: a call in `enter` or `leave`."""
    for placed in context.actions:
        if isinstance(placed.action, Call) and placed.phase in ("enter", "leave"):
            message = f"'{placed.action.alias}' cannot be called in '{placed.phase}'"
            fix = "move the call to 'actions' or 'modulates', which run in each iteration"
            yield context.make_finding("D410", (*placed.path, "call"), message, fix)


def find_unknown_parameters(context: RuleContext) -> Iterator[Finding]:
    """D409: a call with a parameter that the component does not have."""
    for placed in context.actions:
        if not isinstance(placed.action, Call):
            continue
        interface = context.scope.uses.get(placed.action.alias)
        if interface is None:
            continue
        known = [parameter.name for parameter in interface.parameters]
        middle = () if placed.phase == "modulates" else ("with",)
        for name, _text in placed.action.arguments:
            if name not in known:
                fallback = f"use one of {', '.join(known)}" if known else "declare the parameter in the component"
                message = f"'{interface.component}' has no parameter '{name}'"
                path = (*placed.path, *middle, name)
                yield context.make_finding("D409", path, message, did_you_mean(name, known, fallback), is_key=True)


def find_cycles(context: RuleContext) -> Iterator[Finding]:
    """D408: components that use each other in a cycle."""
    own, graph = context.design.component, context.graphs.uses
    for use in context.design.uses:
        if path := graph.path(use.component, own):
            cycle = [own, *path]
            message = f"components use each other in a cycle: {' → '.join(cycle)}"
            yield context.make_finding("D408", ("uses", use.alias), message, "remove one of these uses")


def find_unused_uses(context: RuleContext) -> Iterator[Finding]:
    """D428: an alias that is never required, called, read or mentioned in code."""
    used = {alias for alias, _path, _is_key in _referenced_aliases(context)}
    assigned = (placed.action.values for placed in context.actions if isinstance(placed.action, Assign))
    used |= {name.partition(".")[0] for values in assigned for name, _text in values if "." in name}
    used.update(*(expression.analysis.aliases for expression in context.expressions), context.code_identifiers)
    for use in context.design.uses:
        if use.alias not in used:
            message = f"'{use.alias}' is never used"
            fix = "use it, or delete it from 'uses'"
            yield context.make_finding("D428", ("uses", use.alias), message, fix, is_key=True)


def _referenced_aliases(context: RuleContext) -> Iterator[tuple[str, DesignPath, bool]]:
    """Yield each required or called alias with its path and whether it is a key."""
    for state in context.design.states:
        for index, alias in enumerate(state.requires):
            yield alias, ("states", state.name, "requires", index), False
    for placed in context.actions:
        if isinstance(placed.action, Call):
            is_key = placed.phase == "modulates"
            yield placed.action.alias, placed.path if is_key else (*placed.path, "call"), is_key


RULES = (
    find_unknown_components,
    find_unknown_aliases,
    find_misplaced_calls,
    find_unknown_parameters,
    find_cycles,
)
WARNINGS = (find_unused_uses,)
