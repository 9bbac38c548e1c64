"""Rules about used components: known ones, their parameters, circles, uses without a use."""

from collections.abc import Iterator

from vicode.check.context import RuleContext
from vicode.check.graphs import find_path
from vicode.findings import DesignPath, Finding, did_you_mean
from vicode.model.design import Assign, Call


def find_unknown_components(context: RuleContext) -> Iterator[Finding]:
    """P202: a use of a component that nothing in the project declares."""
    known = context.project.interfaces()
    for use in context.design.uses:
        if use.component not in known:
            mend = did_you_mean(use.component, known, "add its design, or declare it in project.yaml")
            message = f"there is no component '{use.component}'"
            if file := dict(context.project.unreadable).get(use.component):
                message, mend = f"the design of '{use.component}' cannot be read", f"mend {file} first"
            yield context.make_finding("P202", ("uses", use.alias), message, mend)


def find_unknown_aliases(context: RuleContext) -> Iterator[Finding]:
    """D403: requiring or calling something that is not in `uses`."""
    known = {use.alias for use in context.design.uses}
    for alias, path, of_key in _referenced_aliases(context):
        if alias not in known:
            mend = did_you_mean(alias, known, f"add it to 'uses', as {alias or 'alias'}: ComponentName")
            yield context.make_finding("D403", path, f"'{alias}' is not in 'uses'", mend, is_key=of_key)


def find_misplaced_calls(context: RuleContext) -> Iterator[Finding]:
    """D410: a call in `enter` or `leave`, which happen once, while a component works iteration by iteration."""
    for placed in context.actions:
        if isinstance(placed.action, Call) and placed.phase in ("enter", "leave"):
            message = f"'{placed.action.alias}' cannot be called in '{placed.phase}', only in 'actions'"
            mend = "move the call to 'actions' or 'modulates', where it is made at each iteration"
            yield context.make_finding("D410", (*placed.path, "call"), message, mend)


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
                otherwise = f"it has {', '.join(known)}" if known else "it has none; declare it there"
                message = f"'{interface.component}' has no parameter '{name}'"
                path = (*placed.path, *middle, name)
                yield context.make_finding("D409", path, message, did_you_mean(name, known, otherwise), is_key=True)


def find_cycles(context: RuleContext) -> Iterator[Finding]:
    """D408: components that use each other in a circle; the whole circle is named."""
    own, graph = context.design.component, context.graphs.uses
    for use in context.design.uses:
        if path := find_path(graph, use.component, own):
            circle = [own, *path]
            message = f"components use each other in a circle: {' → '.join(circle)}"
            yield context.make_finding("D408", ("uses", use.alias), message, "let one of them do without the next")


def find_unused_uses(context: RuleContext) -> Iterator[Finding]:
    """D428: an alias that no state requires, calls, reads or mentions in code."""
    used = {alias for alias, _path, _of_key in _referenced_aliases(context)}
    assigned = (placed.action.values for placed in context.actions if isinstance(placed.action, Assign))
    used |= {name.partition(".")[0] for values in assigned for name, _text in values if "." in name}
    used.update(*(expression.analysis.aliases for expression in context.expressions), context.code_identifiers)
    for use in context.design.uses:
        if use.alias not in used:
            message = f"'{use.alias}' is used by no state"
            mend = "require, call or read it, or delete it from 'uses'"
            yield context.make_finding("D428", ("uses", use.alias), message, mend, is_key=True)


def _referenced_aliases(context: RuleContext) -> Iterator[tuple[str, DesignPath, bool]]:
    """Every alias that is required or called, with its path and whether it is a key there."""
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
    find_unused_uses,
)
