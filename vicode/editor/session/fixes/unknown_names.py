"""Fixes of unknown names in expressions: the nearest known name, an output, a new input, or a new variable."""

from collections.abc import Mapping
from dataclasses import replace

from vicode.check import build_context
from vicode.check.typed_expressions import ExpressionSite
from vicode.editor.session.fixes.context import DesignEdit, Fix, FixContext
from vicode.editor.session.fixes.uses import add_use_fixes
from vicode.editor.session.project.interface_edits import place_input
from vicode.findings import DesignPath
from vicode.model.design import Assign, Declaration, Design
from vicode.model.edits import replace_action
from vicode.model.expressions import (
    BOOL,
    FLOAT,
    INT,
    UNKNOWN,
    ExpressionDiagnostic,
    Scope,
    ScopeSymbol,
    ScopeSymbolKind,
    build_scope,
    parse_expression,
)
from vicode.model.names import is_valid_name
from vicode.model.texts import iter_texts, rewrite_text
from vicode.model.traversal import iter_actions, iter_expressions


def fix_unknown_name(case: FixContext) -> list[Fix]:
    """E303, E306 in an expression, or in a name that `set` assigns."""
    subject = case.finding.subject
    if subject is None or subject.span is None:
        return _fix_set(case)
    start, end = subject.span
    text = next((located.text for located in iter_texts(case.design) if located.path == case.path), "")
    name = text[start:end]
    fixes = []
    if case.finding.suggestion:
        # In `ball.sen` only the part after the dot is wrong.
        head, dot, _tail = name.rpartition(".")
        fixed = f"{text[:start]}{head}{dot}{case.finding.suggestion}{text[end:]}"
        label = f"Replace with {head}{dot}{case.finding.suggestion}"
        fixes.append(Fix(label=label, edit=lambda old: rewrite_text(old, case.path, lambda _text: fixed)))
    follows = text[end : end + 1]
    if is_valid_name(name) and follows == ".":
        fixes += add_use_fixes(case, name)
    elif is_valid_name(name) and not _is_constant(case.path):
        fixes += _add_undeclared(case, name)
    return fixes


def _fix_set(case: FixContext) -> list[Fix]:
    """E303, E307 in a name that `set` assigns."""
    if "set" not in case.path:
        return []
    old, fixes = str(case.path[-1]), []
    if case.finding.suggestion:
        new = case.finding.suggestion
        fixes.append(Fix(label=f"Set {new} instead", edit=lambda design: _renamed_in_set(design, case.path, new)))
    if case.finding.rule.code == "E303" and is_valid_name(old):
        text = next((located.text for located in iter_expressions(case.design) if located.path == case.path), "")
        parsed = parse_expression(text, build_scope(case.project, case.design))
        type_ = parsed.tree.type if parsed.tree and not parsed.diagnostics else ""
        fixes += _declare(case, old, type_)
    return fixes


def _add_undeclared(case: FixContext, name: str) -> list[Fix]:
    """Read an output of this name, or declare an input or a variable with the type that the expression requires."""
    fixes = [
        Fix(label=f"Use {use.alias}.{name}", edit=_qualified_name_edit(case, name, use.alias))
        for use in case.design.uses
        if (interface := case.project.interface(use.component)) and interface.output(name)
    ]
    type_ = _infer_type(case, name)
    if type_ is None:
        return fixes
    if not fixes:
        fixes.append(_create_input(case, name, type_))
    return fixes + _declare(case, name, type_)


def _create_input(case: FixContext, name: str, type_: str) -> Fix:
    place = place_input(case.project, case.design)
    qualify = _qualified_name_edit(case, name, place.alias)
    return Fix(
        label=f"Create input {name} ({type_})",
        edit=lambda old: place.add_use(qualify(old)),
        edit_project=lambda old: place.add_output(old, Declaration(name=name, type=type_)),
    )


def _qualified_name_edit(case: FixContext, name: str, alias: str) -> DesignEdit:
    """Put an alias before each use of an undeclared name in the design, except where only constants are allowed."""
    scope = build_scope(case.project, case.design)

    def qualify(text: str) -> str:
        starts = {item.span[0] for item in parse_expression(text, scope).diagnostics if _is_undeclared(item, text)}
        for start in sorted((at for at in starts if text.startswith(name, at)), reverse=True):
            text = f"{text[:start]}{alias}.{text[start:]}"
        return text

    def _is_undeclared(item: ExpressionDiagnostic, text: str) -> bool:
        return item.rule.code == "E303" and text[slice(*item.span)] == name

    def change(design: Design) -> Design:
        for located in iter_expressions(design):
            if name in located.text and not _is_constant(located.path):
                design = rewrite_text(design, located.path, qualify)
        return design

    return change


def _infer_type(case: FixContext, name: str) -> str | None:
    """The first type for which the expression has only the errors that it has with any type."""
    context = build_context(case.project, case.design)
    expression = next((item for item in context.expressions if item.path == case.path), None)
    if expression is None:
        return None
    expected = context.scope.type_of(expression.receiver) if expression.receiver else None
    if expression.site is ExpressionSite.GUARD:
        expected = BOOL
    others = [expression.text[slice(*item.span)] for item in expression.analysis.diagnostics]

    def errors(type_: str) -> tuple[ExpressionDiagnostic, ...]:
        types = {**{other: UNKNOWN for other in others if is_valid_name(other)}, name: type_}
        return parse_expression(expression.text, _with_variables(context.scope, types), expected).diagnostics

    types = (FLOAT, BOOL, INT, *context.scope.enumerations)
    return next((type_ for type_ in types if errors(type_) == errors(UNKNOWN)), None)


def _with_variables(scope: Scope, types: Mapping[str, str]) -> Scope:
    added = {
        name: ScopeSymbol(kind=ScopeSymbolKind.VARIABLE, type=type_, declaration=Declaration(name=name))
        for name, type_ in types.items()
    }
    return Scope(symbols={**added, **scope.symbols}, uses=scope.uses, enumerations=scope.enumerations)


def _is_constant(path: DesignPath) -> bool:
    """Whether an expression accepts constants only."""
    return path[0] in ("parameters", "outputs", "variables") or path[-1] == "after"


def _declare(case: FixContext, name: str, type_: str) -> list[Fix]:
    elements = build_scope(case.project, case.design).enumerations
    first = {BOOL: "False", INT: "0", FLOAT: "0.0"}.get(type_)
    if first is None:
        first = f"{type_}.{elements[type_][0]}" if elements.get(type_) else None
    if first is None or _is_constant(case.path):
        return []
    declaration = Declaration(name=name, initial=first)
    return [
        Fix(
            label=f"Declare the variable {name}: {first}",
            edit=lambda old: replace(old, variables=(*old.variables, declaration)),
        )
    ]


def _renamed_in_set(design: Design, path: DesignPath, new: str) -> Design:
    """Rename the assigned variable at a path that ends in the old name."""
    from_name, where = str(path[-1]), path[:-2]
    located = next((located for located in iter_actions(design) if located.path == where), None)
    if located is None or not isinstance(located.action, Assign):
        return design
    values = tuple((new if name == from_name else name, text) for name, text in located.action.values)
    return replace_action(design, where, replace(located.action, values=values))


FIXERS = {"E303": fix_unknown_name, "E306": fix_unknown_name, "E307": fix_unknown_name}
