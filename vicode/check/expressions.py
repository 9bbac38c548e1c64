"""Rules about expressions: names, types, what may be set, what must be known before the component runs."""

import math
from collections.abc import Iterator

from vicode.check.context import RuleContext
from vicode.check.identifiers import with_article
from vicode.check.typed_expressions import ExpressionSite, TypedExpression, literal_value
from vicode.findings import Finding, did_you_mean
from vicode.model.design import Assign
from vicode.model.expressions import (
    Done,
    ElapsedTime,
    Expr,
    Minus,
    Number,
    OutputRef,
    ScopeSymbolKind,
    StatusFlag,
    Variable,
    walk,
)


def find_expression_errors(context: RuleContext) -> Iterator[Finding]:
    """E301 to E306: what the parser finds wrong with an expression."""
    for expression in context.expressions:
        for mistake in expression.analysis.diagnostics:
            yield context.make_finding(
                mistake.rule.code, expression.path, mistake.message, mistake.fix, span=mistake.span
            )


def find_nonconstant_initial_values(context: RuleContext) -> Iterator[Finding]:
    """E308: a first value that is not made of literals, constants and elements."""
    for expression in context.expressions:
        if expression.site == ExpressionSite.INITIAL_VALUE and expression.tree is not None:
            for message, node in find_nonconstant_nodes(expression.tree):
                mend = "a first value is made of numbers, constants and enumeration elements"
                yield context.make_finding("E308", expression.path, message, mend, span=node.span)


def find_nonconstant_nodes(tree: Expr) -> Iterator[tuple[str, Expr]]:
    """What in an expression is not known before the component runs, each with a message."""
    for node in walk(tree):
        match node:
            case Variable(name=name, kind=kind) if kind != ScopeSymbolKind.CONSTANT:
                yield f"'{name}' is {with_article(kind)}: it has no value yet", node
            case ElapsedTime() | StatusFlag() | Done() | OutputRef():
                yield "this is known only while the component runs", node
            case _:
                pass


def find_bad_times(context: RuleContext) -> Iterator[Finding]:
    """E309: `after` with something else than seconds from 0 up."""
    mend = "write seconds, such as after: 2.5; anything else is a guard: state_time >= …"
    for expression in context.expressions:
        if expression.site == ExpressionSite.AFTER and expression.is_sound:
            problem = _validate_time(expression, context)
            if problem:
                span = (0, len(expression.text))
                yield context.make_finding("E309", expression.path, problem, mend, span=span)


def _validate_time(expression: TypedExpression, context: RuleContext) -> str:
    match expression.tree:
        case Number() | Minus(operand=Number()):
            pass
        case Variable(kind=ScopeSymbolKind.CONSTANT):
            pass
        case _:
            return "'after' takes a number or a constant"
    value = literal_value(expression.tree, context.scope)
    if value is not None and not (value >= 0 and math.isfinite(value)):
        return f"{value:g} is not a time"
    return ""


def find_wrong_assignments(context: RuleContext) -> Iterator[Finding]:
    """E303, E307: `set` of something that is no own variable or output, nor a variable of a used component."""
    for placed in context.actions:
        if not isinstance(placed.action, Assign):
            continue
        for name, _text in placed.action.values:
            path = (*placed.path, "set", name)
            declaration = context.scope.find_assignable(name)
            if declaration is None:
                code, message, mend = _explain_not_assignable(name, context)
                yield context.make_finding(code, path, message, mend, is_key=True)
            elif declaration.arguments is not None:
                mend = "write its code in 'members'"
                yield context.make_finding(
                    "E307", path, f"'{name}' takes arguments, so it cannot be set", mend, is_key=True
                )


def _explain_not_assignable(name: str, context: RuleContext) -> tuple[str, str, str]:
    alias, dot, variable = name.partition(".")
    if dot:
        return _explain_not_assignable_in_component(alias, variable, context)
    settable = [each.name for each in (*context.design.variables, *context.design.outputs)]
    symbol = context.scope.symbols.get(name)
    if symbol is not None:
        mend = did_you_mean(name, settable, "only own variables and outputs are set; declare one")
        return "E307", f"'{name}' is {with_article(symbol.kind)}, it cannot be set", mend
    if name in context.scope.uses:
        return "E307", f"'{name}' is a used component, it cannot be set", f"call it: call: {name}"
    mend = did_you_mean(name, settable, f"declare it: variables: {{{name}: 0}}")
    return "E303", f"'{name}' is not declared", mend


def _explain_not_assignable_in_component(alias: str, variable: str, context: RuleContext) -> tuple[str, str, str]:
    if alias not in context.scope.uses:
        mend = did_you_mean(alias, context.scope.uses, "declare it in 'uses'")
        return "E303", f"'{alias}' is not a used component", mend
    interface = context.scope.uses[alias]
    known = [each.name for each in interface.variables] if interface else []
    if interface is not None and interface.output(variable):
        mend = did_you_mean(variable, known, "what it may be told are its variables and parameters")
        return "E307", f"'{alias}.{variable}' is an output, it can only be read", mend
    component = interface.component if interface else alias
    mend = did_you_mean(variable, known, f"declare it in 'variables' of {component}")
    return "E303", f"'{component}' has no variable '{variable}'", mend


RULES = (find_expression_errors, find_nonconstant_initial_values, find_bad_times, find_wrong_assignments)
