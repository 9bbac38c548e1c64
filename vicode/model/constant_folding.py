"""Evaluation of constants and initial values at generation time."""

from collections.abc import Mapping
from functools import lru_cache
from types import MappingProxyType

from vicode.bica import arithmetic
from vicode.model.expressions import INT, UNKNOWN, Scope, Value, constant_scopes, evaluate, parse_expression
from vicode.model.project import Project

ConstantValue = Value


def evaluate_constants(project: Project) -> Mapping[str, ConstantValue]:
    """Evaluate the constants in order, each using the previous ones. Invalid constants are omitted."""
    return _evaluate_constants(Project(name="", constants=project.constants, enumerations=project.enumerations))


# Constants are evaluated after every edit, but rarely change.
@lru_cache(maxsize=64)
def _evaluate_constants(project: Project) -> Mapping[str, ConstantValue]:
    values: dict[str, ConstantValue] = {}
    for constant, scope in zip(project.constants, constant_scopes(project), strict=True):
        value = evaluate_initial_value(constant.initial, scope.type_of(constant), scope, values)
        if value is not None:
            values[constant.name] = value
    return MappingProxyType(values)


def evaluate_initial_value(
    text: str, type_: str, scope: Scope, constants: Mapping[str, ConstantValue]
) -> ConstantValue | None:
    """Evaluate an expression. Without a value it is false, 0 or the first element. Return None if it is unknown."""
    if not text or text in scope.enumerations:
        return zero_value(type_, scope)
    parsed = parse_expression(text, scope, type_)
    if parsed.tree is None or parsed.diagnostics:
        return None
    value = evaluate(parsed.tree, constants)
    return arithmetic.limit(value) if type_ == INT and isinstance(value, int) else value


def zero_value(type_: str, scope: Scope) -> ConstantValue | None:
    """Return the default value of a type: false, 0 or the first element."""
    if type_ in scope.enumerations:
        return next(iter(scope.enumerations[type_]), None)
    return None if type_ == UNKNOWN else False if type_ == "bool" else 0.0
