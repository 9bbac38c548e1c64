"""What a component assigns to its int variables, in actions and in hand-written code."""

import re
from collections.abc import Collection, Iterable, Iterator

from vicode.generators.plan.plan_types import (
    AssignStep,
    CodePlan,
    CodeStep,
    ComponentPlan,
)
from vicode.generators.plan.typed_expressions import typed_tree
from vicode.model.expressions import INT, Expr, Scope, ScopeSymbolKind, Variable
from vicode.model.portable_code import PortableAssign, PortableIf, PortableStatement, Role, parse_portable

IntAssignment = tuple[str, Expr]
"""The name of a variable and what it is set to."""

_ANY = Variable(name="", kind=ScopeSymbolKind.PARAMETER, type=INT, span=(0, 0))
"""Any value that can be stored."""
_SET = re.compile(
    r"""(?P<before>\+\+|--)? (?:\w+(?:\.|->))* \b(?P<name>\w+) \s*
        (?: (?P<after>\+\+|--) | (?P<operator>[-+]?)=\s*(?P<literal>\d+)\s*(?:;|$)
          | (?P<other>(?:[-+*/%&|^]|<<|>>|//|\*\*)?=(?!=)) )?""",
    re.VERBOSE | re.MULTILINE,
)
"""A name in Python or C++, and how it is set."""


def find_assignments(component: ComponentPlan, scope: Scope, names: Collection[str]) -> Iterator[IntAssignment]:
    """Find what a component assigns to variables of these names; code outside the portable subset is read roughly."""
    for steps in component.action_lists:
        for step in steps:
            match step:
                case AssignStep(alias="", name=name, value=value) if name in names:
                    yield name, value
                case CodeStep(code=code):
                    yield from _in_code(code, "action", scope, names)
    for code in component.guard_code:
        yield from _in_code(code, "predicate", scope, names)
    for section in (component.module_code, component.members):
        for language in ("python", "cpp"):
            yield from _in_text((section.code.in_language(language) if section else "") or "", scope, names)


def _in_code(code: CodePlan, role: Role, scope: Scope, names: Collection[str]) -> Iterator[IntAssignment]:
    python = code.code.in_language("python") or ""
    read = parse_portable(python, role, scope)
    yield from _in_statements(read, scope, names) if isinstance(read, tuple) else _in_text(python, scope, names)
    yield from _in_text(code.code.in_language("cpp") or "", scope, names)


def _in_statements(
    statements: Iterable[PortableStatement], scope: Scope, names: Collection[str]
) -> Iterator[IntAssignment]:
    for statement in statements:
        match statement:
            case PortableAssign(target=target, value=value) if target in names:
                yield target, typed_tree(value, scope, INT)
            case PortableIf(then=then, otherwise=otherwise):
                yield from _in_statements((*then, *otherwise), scope, names)


def _in_text(text: str, scope: Scope, names: Collection[str]) -> Iterator[IntAssignment]:
    for found in _SET.finditer(text):
        # A name that C++ reserves has an underscore at its end.
        name = found["name"] if found["name"] in names else found["name"].rstrip("_")
        step, literal, operator = found["before"] or found["after"], found["literal"], found["operator"]
        if name not in names:
            continue
        if step:
            yield name, typed_tree(f"{name} {step[0]} 1", scope, INT)
        elif literal is not None:
            is_small = len(literal) < 16
            yield (
                name,
                typed_tree(f"{name} {operator} {literal}" if operator else literal, scope, INT) if is_small else _ANY,
            )
        elif found["other"]:
            yield name, _ANY
