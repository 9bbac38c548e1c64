"""Fixes of unknown names in expressions: the nearest known name, or a new declaration."""

from dataclasses import replace

from vicode.editor.session.fixes.context import Fix, FixContext
from vicode.editor.session.fixes.uses import add_use_fixes
from vicode.findings import DesignPath
from vicode.model.design import Assign, Declaration, Design
from vicode.model.edits import replace_action
from vicode.model.expressions import (
    BOOL,
    FLOAT,
    INT,
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
    if case.suggested_name:
        # In `ball.sen` only the part after the dot is wrong.
        head, dot, _tail = name.rpartition(".")
        fixed = f"{text[:start]}{head}{dot}{case.suggested_name}{text[end:]}"
        label = f"Replace with {head}{dot}{case.suggested_name}"
        fixes.append(Fix(label=label, edit=lambda old: rewrite_text(old, case.path, lambda _text: fixed)))
    follows = text[end : end + 1]
    if is_valid_name(name) and follows == ".":
        fixes += add_use_fixes(case, name)
    elif is_valid_name(name) and "is not declared" in case.finding.message:
        fixes += _declare_from_expression(case, name, text)
    return fixes


def _fix_set(case: FixContext) -> list[Fix]:
    """E303, E307 in a name that `set` assigns."""
    if "set" not in case.path:
        return []
    old, fixes = str(case.path[-1]), []
    if case.suggested_name:
        new = case.suggested_name
        fixes.append(Fix(label=f"Set {new} instead", edit=lambda design: _renamed_in_set(design, case.path, new)))
    if case.finding.rule.code == "E303" and is_valid_name(old):
        text = next((located.text for located in iter_expressions(case.design) if located.path == case.path), "")
        parsed = parse_expression(text, build_scope(case.project, case.design))
        type_ = parsed.tree.type if parsed.tree and not parsed.diagnostics else ""
        fixes += _declare(case, old, type_)
    return fixes


def _declare_from_expression(case: FixContext, name: str, text: str) -> list[Fix]:
    """Declare a variable of the first type for which the expression has no error."""
    scope = build_scope(case.project, case.design)
    expected = next((located.expected for located in iter_expressions(case.design) if located.path == case.path), "")
    for type_ in (FLOAT, BOOL, INT, *scope.enumerations):
        symbol = ScopeSymbol(kind=ScopeSymbolKind.VARIABLE, type=type_, declaration=Declaration(name=name))
        wider = Scope(symbols={**scope.symbols, name: symbol}, uses=scope.uses, enumerations=scope.enumerations)
        if not parse_expression(text, wider, expected or None).diagnostics:
            return _declare(case, name, type_)
    return []


def _declare(case: FixContext, name: str, type_: str) -> list[Fix]:
    elements = build_scope(case.project, case.design).enumerations
    first = {BOOL: "False", INT: "0", FLOAT: "0.0"}.get(type_)
    if first is None:
        first = f"{type_}.{elements[type_][0]}" if elements.get(type_) else None
    # These places accept constants only.
    if first is None or case.path[0] in ("parameters", "outputs", "variables") or case.path[-1] == "after":
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
