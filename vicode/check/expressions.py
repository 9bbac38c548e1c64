"""Rules for expressions: names, types, assignments and constant values."""

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
    """E301 to E306: errors found by the expression parser."""
    for expression in context.expressions:
        for diagnostic in expression.analysis.diagnostics:
            yield context.make_finding(
                diagnostic.rule.code, expression.path, diagnostic.message, diagnostic.fix, span=diagnostic.span
            )


def find_nonconstant_initial_values(context: RuleContext) -> Iterator[Finding]:
    """E308: an initial value that is not constant."""
    for expression in context.expressions:
        if expression.site == ExpressionSite.INITIAL_VALUE and expression.tree is not None:
            for message, node in find_nonconstant_nodes(expression.tree):
                fix = "use literals, constants and enumeration elements only"
                yield context.make_finding("E308", expression.path, message, fix, span=node.span)


def find_nonconstant_nodes(tree: Expr) -> Iterator[tuple[str, Expr]]:
    """Yield a message for each node whose value is unknown before the component runs."""
    for node in walk(tree):
        match node:
            case Variable(name=name, kind=kind) if kind != ScopeSymbolKind.CONSTANT:
                yield f"'{name}' is {with_article(kind)} and has no value before the component runs", node
            case ElapsedTime() | StatusFlag() | Done() | OutputRef():
                yield "this has no value before the component runs", node
            case _:
                pass


def find_bad_times(context: RuleContext) -> Iterator[Finding]:
    """E309: a time that is something other than a constant or a non-negative number of seconds."""
    for expression in context.expressions:
        if expression.site == ExpressionSite.AFTER and expression.is_sound:
            problem = _validate_time(expression, context)
            if problem:
                key = expression.path[-1]
                guard = ", or a guard: state_time >= …" if key == "after" else ""
                fix = f"use a number of seconds, such as {key}: 2.5{guard}"
                span = (0, len(expression.text))
                yield context.make_finding("E309", expression.path, problem, fix, span=span)


def _validate_time(expression: TypedExpression, context: RuleContext) -> str:
    match expression.tree:
        case Number() | Minus(operand=Number()):
            pass
        case Variable(kind=ScopeSymbolKind.CONSTANT):
            pass
        case _:
            return f"'{expression.path[-1]}' takes a number or a constant"
    value = literal_value(expression.tree, context.scope)
    if value is not None and not (value >= 0 and math.isfinite(value)):
        return f"{value:g} is not a valid time"
    return ""


def find_wrong_assignments(context: RuleContext) -> Iterator[Finding]:
    """E303, E307: `set` of a name other than a variable, an output, or a variable of a used component."""
    for placed in context.actions:
        if not isinstance(placed.action, Assign):
            continue
        for name, _text in placed.action.values:
            path = (*placed.path, "set", name)
            declaration = context.scope.find_assignable(name)
            if declaration is None:
                code, message, fix = _explain_not_assignable(name, context)
                yield context.make_finding(code, path, message, fix, is_key=True)
            elif declaration.arguments is not None:
                fix = "implement it in 'members'"
                yield context.make_finding(
                    "E307", path, f"'{name}' takes arguments and cannot be set", fix, is_key=True
                )


def _explain_not_assignable(name: str, context: RuleContext) -> tuple[str, str, str]:
    alias, dot, variable = name.partition(".")
    if dot:
        return _explain_not_assignable_in_component(alias, variable, context)
    settable = [declaration.name for declaration in (*context.design.variables, *context.design.outputs)]
    symbol = context.scope.symbols.get(name)
    if symbol is not None:
        fix = did_you_mean(name, settable, "set a variable or output of this component instead")
        return "E307", f"'{name}' is {with_article(symbol.kind)} and cannot be set", fix
    if name in context.scope.uses:
        return "E307", f"'{name}' is a used component and cannot be set", f"use call: {name}"
    fix = did_you_mean(name, settable, f"declare it in 'variables': {{{name}: 0}}")
    return "E303", f"'{name}' is not declared", fix


def _explain_not_assignable_in_component(alias: str, variable: str, context: RuleContext) -> tuple[str, str, str]:
    if alias not in context.scope.uses:
        fix = did_you_mean(alias, context.scope.uses, "declare it in 'uses'")
        return "E303", f"'{alias}' is not a used component", fix
    interface = context.scope.uses[alias]
    known = [declaration.name for declaration in interface.variables] if interface else []
    if interface is not None and interface.output(variable):
        fix = did_you_mean(variable, known, "set a variable or pass a parameter instead")
        return "E307", f"'{alias}.{variable}' is an output and can only be read", fix
    component = interface.component if interface else alias
    fix = did_you_mean(variable, known, f"declare it in 'variables' of {component}")
    return "E303", f"'{component}' has no variable '{variable}'", fix


RULES = (find_expression_errors, find_nonconstant_initial_values, find_bad_times, find_wrong_assignments)
