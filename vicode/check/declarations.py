"""Rules for declarations: types, ranges and unused declarations."""

from collections.abc import Iterator

from vicode.check.context import RuleContext
from vicode.findings import DesignPath, Finding, did_you_mean
from vicode.model.design import Assign, Declaration
from vicode.model.expressions import BOOL, FLOAT, INT, UNKNOWN, Scope


def find_bad_declarations(context: RuleContext) -> Iterator[Finding]:
    """P205, P206: types and ranges of the design's declarations."""
    for section, declaration in context.design.declarations():
        for code, path, message, fix in validate_declaration(declaration, (section, declaration.name), context.scope):
            yield context.make_finding(code, path, message, fix)


def find_bad_frequency(context: RuleContext) -> Iterator[Finding]:
    """D416: a frequency that is not above 0."""
    hertz = context.design.frequency_hz
    if hertz is not None and not 0 < hertz < float("inf"):
        fix = "use a number above 0, or remove 'frequency' to run on every step"
        yield context.make_finding("D416", ("frequency",), f"{hertz:g} Hz is not a valid frequency", fix)


def validate_declaration(
    declaration: Declaration, path: DesignPath, scope: Scope
) -> Iterator[tuple[str, DesignPath, str, str]]:
    """Yield the code, path, message and fix of each problem of a declaration and its arguments."""
    type_ = scope.type_of(declaration)
    if type_ == UNKNOWN:
        known = (BOOL, INT, FLOAT, *scope.enumerations)
        fix = did_you_mean(declaration.type, known, "use bool, int or float, or declare an enumeration in project.yaml")
        yield "P205", (*path, "type"), f"unknown type '{declaration.type}'", fix
    if declaration.range is not None:
        low, high = declaration.range
        if not low <= high:
            yield (
                "P206",
                (*path, "range"),
                f"the range from {low:g} to {high:g} is empty",
                "write the lower bound first",
            )
        elif type_ not in (INT, FLOAT, UNKNOWN):
            yield (
                "P206",
                (*path, "range"),
                f"'{declaration.name}' has the type {type_}, but only numbers have a range",
                "delete the range",
            )
    for argument in declaration.arguments or ():
        yield from validate_declaration(argument, (*path, "arguments", argument.name), scope)


def validate_range(declaration: Declaration, least: float | None, greatest: float | None = None) -> str:
    """Return a message if a value, or each value between two, is outside the range of a declaration, otherwise ""."""
    greatest = least if greatest is None else greatest
    if least is None or greatest is None or declaration.range is None:
        return ""
    low, high = declaration.range
    if not low <= high or (least <= high and low <= greatest):
        return ""
    value = f"{least:g}" if least == greatest else f"a value from {least:g} to {greatest:g}"
    unit = f" {declaration.unit}" if declaration.unit else ""
    return f"{value} is outside the range of '{declaration.name}' ({low:g} to {high:g}{unit})"


def find_unused_declarations(context: RuleContext) -> Iterator[Finding]:
    """D424, D444, D445: declarations that are never read or never set; hand-written code does both to all it names."""
    read = context.code_identifiers.union(*(expression.analysis.names for expression in context.expressions))
    assigned = find_set_names(context)
    for section, declaration in context.design.declarations():
        name, kind = declaration.name, section.removesuffix("s")
        code, problem, fix = "D424", "", "use it or delete it"
        if kind == "parameter":
            problem = "" if name in read else "never read"
        elif name not in read and name not in assigned:
            problem = "neither read nor set"
        elif name not in assigned:
            code, problem, fix = "D444", "never set: it keeps its initial value", "set it, or use a constant"
        elif kind == "variable" and name not in read:
            code, problem, fix = "D445", "set but never read", "read it, make it an output, or delete it"
        if problem:
            yield context.make_finding(code, (section, name), f"{kind} '{name}' is {problem}", fix, is_key=True)


def find_set_names(context: RuleContext) -> frozenset[str]:
    """The names that actions set, and all that hand-written code contains."""
    actions = (placed.action for placed in context.actions)
    return context.code_identifiers.union(
        name for action in actions if isinstance(action, Assign) for name, _text in action.values
    )


RULES = (find_bad_declarations, find_bad_frequency)
WARNINGS = (find_unused_declarations,)
