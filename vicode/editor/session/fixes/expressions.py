"""Mends of names in expressions: the nearest known name, or the declaration that is missing."""

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
    """E303, E306: in an expression, or as the name that `set` gives a value."""
    thing = case.finding.subject
    if thing is None or thing.span is None:
        return _fix_set(case)
    start, end = thing.span
    text = next((each.text for each in iter_texts(case.design) if each.path == case.path), "")
    guilty = text[start:end]
    fixes = []
    if case.suggested_name:
        # Of `ball.sen` only what follows the dot is wrong.
        head, dot, _tail = guilty.rpartition(".")
        mended = f"{text[:start]}{head}{dot}{case.suggested_name}{text[end:]}"
        label = f"Replace with {head}{dot}{case.suggested_name}"
        fixes.append(Fix(label=label, edit=lambda old: rewrite_text(old, case.path, lambda _text: mended)))
    follows = text[end : end + 1]
    if is_valid_name(guilty) and follows == ".":
        fixes += add_use_fixes(case, guilty)
    elif is_valid_name(guilty) and "is not declared" in case.finding.message:
        fixes += _declare_from_expression(case, guilty, text)
    return fixes


def _fix_set(case: FixContext) -> list[Fix]:
    """E303, E307: a name that cannot be set."""
    if "set" not in case.path:
        return []
    old, fixes = str(case.path[-1]), []
    if case.suggested_name:
        new = case.suggested_name
        fixes.append(Fix(label=f"Set {new} instead", edit=lambda design: _renamed_in_set(design, case.path, new)))
    if case.finding.rule.code == "E303" and is_valid_name(old):
        text = next((each.text for each in iter_expressions(case.design) if each.path == case.path), "")
        parsed = parse_expression(text, build_scope(case.project, case.design))
        type_ = parsed.tree.type if parsed.tree and not parsed.diagnostics else ""
        fixes += _declare(case, old, type_)
    return fixes


def _declare_from_expression(case: FixContext, name: str, text: str) -> list[Fix]:
    """A variable of the first type with which the expression has no mistake any more."""
    scope = build_scope(case.project, case.design)
    expected = next((each.expected for each in iter_expressions(case.design) if each.path == case.path), "")
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
    # Where only constants may stand a variable would be the next mistake.
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
    """The design with another name set at a path that ends in the old name."""
    from_name, where = str(path[-1]), path[:-2]
    placed = next((each for each in iter_actions(design) if each.path == where), None)
    if placed is None or not isinstance(placed.action, Assign):
        return design
    values = tuple((new if name == from_name else name, text) for name, text in placed.action.values)
    return replace_action(design, where, replace(placed.action, values=values))


FIXERS = {"E303": fix_unknown_name, "E306": fix_unknown_name, "E307": fix_unknown_name}
