"""Constants and parameters with other values than in the files."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

from vicode.findings import did_you_mean
from vicode.model.constant_folding import evaluate_constants, evaluate_initial_value
from vicode.model.design import Declaration
from vicode.model.expressions import build_scope, constant_scopes
from vicode.model.project import Project


class ChangedValueError(ValueError):
    """The text names no constant or parameter, or the value does not suit it; the message is one line."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ChangedValue:
    """A value in place of that of a constant (`component` is "") or of the default of a parameter of a design."""

    component: str
    name: str
    text: str

    @property
    def full_name(self) -> str:
        return f"{self.component}.{self.name}" if self.component else self.name

    def text_in(self, project: Project) -> str:
        """The text that the project has instead."""
        return next((each.initial for each in _declared(project, self.component) if each.name == self.name), "")

    def evaluate(self, project: Project) -> Any:
        """The value; an element of an enumeration as its name, None if the text is not one."""
        declared = _declared(project, self.component)
        index = next(index for index, each in enumerate(declared) if each.name == self.name)
        scope = build_scope(project, None) if self.component else list(constant_scopes(project))[index]
        type_ = scope.type_of(declared[index])
        return evaluate_initial_value(self.text, type_, scope, evaluate_constants(project))

    def is_value(self, recorded: Any, project: Project) -> bool:
        """Whether a recorded value is this one."""
        known = self.evaluate(project)
        return bool(recorded == known or (isinstance(recorded, str) and recorded.rpartition(".")[2] == known))


def parse_changed_value(text: str, project: Project) -> ChangedValue:
    """Read `Component.parameter=VALUE` or `constant=VALUE`.

    Raises:
        ChangedValueError: There is no such parameter or constant, or the value does not suit it.
    """
    full_name, equals, value = (part.strip() for part in text.partition("="))
    if not equals or not value:
        raise ChangedValueError("write Component.parameter=VALUE or constant=VALUE")
    component, _dot, name = full_name.rpartition(".")
    changed = ChangedValue(component=component, name=name, text=value)
    if name not in (each.name for each in _declared(project, component)):
        raise ChangedValueError(_explain_unknown(changed, project))
    if changed.evaluate(project) is None:
        declared = next(each for each in _declared(project, component) if each.name == name)
        type_ = build_scope(project, None).type_of(declared)
        raise ChangedValueError(f"'{value}' is no value of {full_name}, which has the type {type_}")
    return changed


def format_value_text(value: Any) -> str:
    """The expression of a value in a design file."""
    return str(value).lower() if isinstance(value, bool) else str(value)


def apply_values(project: Project, values: Iterable[ChangedValue]) -> Project:
    """The project with other values."""
    for each in values:
        if each.component:
            designs = (
                replace(design, parameters=change_text(design.parameters, each.name, each.text))
                if design.component == each.component
                else design
                for design in project.designs
            )
            project = replace(project, designs=tuple(designs))
        else:
            project = replace(project, constants=change_text(project.constants, each.name, each.text))
    return project


def change_text(declared: tuple[Declaration, ...], name: str, text: str) -> tuple[Declaration, ...]:
    """Declarations in which one has another value."""
    return tuple(replace(each, initial=text) if each.name == name else each for each in declared)


def _declared(project: Project, component: str) -> tuple[Declaration, ...]:
    if not component:
        return project.constants
    design = project.design(component)
    return design.parameters if design is not None else ()


def _explain_unknown(changed: ChangedValue, project: Project) -> str:
    design = project.design(changed.component) if changed.component else None
    if changed.component and design is None:
        hint = did_you_mean(changed.component, [each.component for each in project.designs])
        return f"no design of component '{changed.component}'" + (f"; {hint}" if hint else "")
    if design is not None and changed.name in (each.name for each in design.variables):
        return f"{changed.full_name} is a variable; only parameters and constants can be changed"
    kind = f"{changed.component} has no parameter" if changed.component else "the project has no constant"
    hint = did_you_mean(changed.name, [each.name for each in _declared(project, changed.component)])
    if not changed.component:
        hint = hint or "a parameter is written as Component.parameter"
    return f"{kind} '{changed.name}'" + (f"; {hint}" if hint else "")
