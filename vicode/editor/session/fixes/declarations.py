"""Fixes of declarations: types, ranges, frequencies, unused declarations."""

from collections.abc import Callable
from dataclasses import replace

from vicode.check import build_context
from vicode.check.typed_expressions import literal_value
from vicode.editor.session.fixes.context import DesignEdit, Fix, FixContext
from vicode.findings import DesignPath
from vicode.model.design import Declaration, Design
from vicode.model.edits import set_declarations
from vicode.model.texts import rewrite_text


def fix_unknown_type(case: FixContext) -> list[Fix]:
    if not case.finding.suggestion:
        return []
    name = case.finding.suggestion
    return [
        Fix(label=f"Change the type to {name}", edit=_declaration_edit(case.path, lambda old: replace(old, type=name)))
    ]


def fix_bad_range(case: FixContext) -> list[Fix]:
    declaration = _declaration_at(case.design, case.path)
    if declaration is None or declaration.range is None:
        return []
    low, high = declaration.range
    if high < low:
        swap = _declaration_edit(case.path, lambda old: replace(old, range=(high, low)))
        return [Fix(label=f"Swap the limits: {high:g} to {low:g}", edit=swap)]
    remove = _declaration_edit(case.path, lambda old: replace(old, range=None))
    return [Fix(label="Remove the range", edit=remove)]


def fix_bad_frequency(_case: FixContext) -> list[Fix]:
    return [Fix(label="Run on every step", edit=lambda old: replace(old, frequency_hz=None))]


def fix_unused_declaration(case: FixContext) -> list[Fix]:
    """D424; parameters and outputs of a component used by other designs are kept."""
    section, name = str(case.path[0]), str(case.path[1])
    if section != "variables" and case.is_used_elsewhere():
        return []

    def change(design: Design) -> Design:
        kept = tuple(declaration for declaration in getattr(design, section) if declaration.name != name)
        return set_declarations(design, section, kept)

    return [Fix(label=f"Remove the {section.removesuffix('s')} {name}", edit=change)]


def fix_outside_range(case: FixContext) -> list[Fix]:
    """D427: set the nearer limit of the range."""
    context = build_context(case.project, case.design)
    expression = next((item for item in context.expressions if item.path == case.path), None)
    span = case.finding.subject.span if case.finding.subject else None
    receiver = expression.receiver if expression else None
    value = literal_value(expression.tree, context.scope) if expression else None
    if receiver is None or receiver.range is None or span is None or value is None:
        return []
    low, high = receiver.range
    is_low = value < low
    text = f"{low if is_low else high:g}"

    if context.scope.type_of(receiver) == "int" and not float(text).is_integer():
        return []
    start, end = span

    def change(design: Design) -> Design:
        return rewrite_text(design, case.path, lambda old: old[:start] + text + old[end:])

    return [Fix(label=f"Set it to {text}, the {'minimum' if is_low else 'maximum'}", edit=change)]


def _declaration_at(design: Design, path: DesignPath) -> Declaration | None:
    found = (declaration for section, declaration in design.declarations() if (section, declaration.name) == path[:2])
    declaration = next(found, None)
    if declaration is None or path[2:3] != ("arguments",):
        return declaration
    return next((argument for argument in declaration.arguments or () if argument.name == path[3]), None)


def _declaration_edit(path: DesignPath, change: Callable[[Declaration], Declaration]) -> DesignEdit:
    """An edit of the declaration, or of its argument, on a path."""
    section, name = str(path[0]), path[1]
    argument = path[3] if path[2:3] == ("arguments",) else None

    def changed(declaration: Declaration) -> Declaration:
        if argument is None:
            return change(declaration)
        arguments = (change(item) if item.name == argument else item for item in declaration.arguments or ())
        return replace(declaration, arguments=tuple(arguments))

    def apply(design: Design) -> Design:
        declarations = (changed(item) if item.name == name else item for item in getattr(design, section))
        return set_declarations(design, section, tuple(declarations))

    return apply


FIXERS = {
    "P205": fix_unknown_type,
    "P206": fix_bad_range,
    "D416": fix_bad_frequency,
    "D424": fix_unused_declaration,
    "D427": fix_outside_range,
}
