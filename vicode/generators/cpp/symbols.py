"""The names that the code of a component uses, with their types and what they stand for in its design."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from vicode.generators.cpp.expression_printer import ExpressionPrinter
from vicode.generators.cpp.names import GlobalNames, element_name, member_name, state_names
from vicode.generators.plan import ComponentPlan, ProjectPlan
from vicode.model.expressions import BOOL, FLOAT, INT, build_scope


@dataclass(frozen=True, slots=True, kw_only=True)
class CppSymbols:
    """The names of one component, as they stand in its C++ code.

    Attributes:
        class_name: The class.
        texts: The expressions of the design, by name.
        types: The types of these expressions, by name.
        assignable: What the names of variables stand for in `set`; a method that sets one ends with `(`.
        arguments: The names and types of the arguments, by the name of the function; of calls by the name of the
            component.
        defaults: The values of the parameters of used components, by the name of the data member.
        aliases: The used components by the name of the data member.
        states: The states by the element of the enumeration.
    """

    class_name: str
    texts: Mapping[str, str]
    types: Mapping[str, str]
    assignable: Mapping[str, str]
    arguments: Mapping[str, tuple[tuple[str, str], ...]]
    defaults: Mapping[str, tuple[str, ...]]
    aliases: Mapping[str, str]
    states: Mapping[str, str]


def list_symbols(project: ProjectPlan, component: ComponentPlan, class_name: str) -> CppSymbols:
    """List the names that the code of a component may use."""
    values = [value.name for value in (*component.parameters, *component.outputs, *component.variables)]
    used = [use.alias for use in component.uses]
    names = GlobalNames.of_project(project).inside(member_name(name) for name in (*values, *used))
    printer = ExpressionPrinter.of_component(component, names, project.nonzero_constants)
    found = [*_own_names(component), *_declared_names(component, names), *_used_names(component, printer)]
    return CppSymbols(
        class_name=class_name,
        texts={name: text for name, text, _type in found},
        types={name: type_ for name, _text, type_ in found},
        assignable=dict(_assignable(component, printer)),
        arguments=dict(_arguments(component)),
        defaults={
            member_name(use.alias): tuple(printer.print(value.initial).text for value in use.parameters)
            for use in component.uses
        },
        aliases={member_name(alias): alias for alias in used},
        states={name: state for state, name in state_names(component).items()},
    )


_Found = tuple[str, str, str]


def _own_names(component: ComponentPlan) -> Iterator[_Found]:
    for value in (*component.parameters, *component.outputs, *component.variables):
        yield member_name(value.name), value.name, value.type
    yield "action_done()", "action_done", BOOL
    unit = "_in_ms" if component.time_unit == "ms" else ""
    for time in ("state_time", "component_time"):
        yield f"{time}(){unit}", time, FLOAT
        yield f"{time}_ns()", "", INT


def _declared_names(component: ComponentPlan, names: GlobalNames) -> Iterator[_Found]:
    scope = build_scope(component.project, None)
    for constant in component.project.constants:
        yield names.declared(constant.name), constant.name, scope.type_of(constant)
    for enumeration in component.project.enumerations:
        for element, _doc in enumeration.elements:
            name = f"{names.declared(enumeration.name)}::{element_name(element)}"
            yield name, f"{enumeration.name}.{element}", enumeration.name


def _used_names(component: ComponentPlan, printer: ExpressionPrinter) -> Iterator[_Found]:
    scope = build_scope(component.project, None)
    for use in component.uses:
        alias = member_name(use.alias)
        yield f"{alias}.is_done()", f"done({use.alias})", BOOL
        interface = component.project.interfaces()[use.component]
        for each in interface.readable:
            suffix = "()" if (use.alias, each.name) in printer.inputs and each.arguments is None else ""
            yield f"{alias}.{member_name(each.name)}{suffix}", f"{use.alias}.{each.name}", scope.type_of(each)


def _assignable(component: ComponentPlan, printer: ExpressionPrinter) -> Iterator[tuple[str, str]]:
    for value in (*component.outputs, *component.variables):
        yield member_name(value.name), value.name
    for use in component.uses:
        for each in component.project.interfaces()[use.component].variables:
            target, owner = member_name(each.name), member_name(use.alias)
            is_input = (use.alias, each.name) in printer.inputs
            name = f"{owner}.set_{target}(" if is_input else f"{owner}.{target}"
            yield name, f"{use.alias}.{each.name}"


def _arguments(component: ComponentPlan) -> Iterator[tuple[str, tuple[tuple[str, str], ...]]]:
    scope = build_scope(component.project, None)
    for use in component.uses:
        alias = member_name(use.alias)
        yield alias, tuple((value.name, value.type) for value in use.parameters)
        for function in use.functions:
            name = f"{alias}.{member_name(function.result.name)}"
            yield name, tuple((value.name, value.type) for value in function.arguments)
        for each in component.project.interfaces()[use.component].variables:
            yield f"{alias}.set_{member_name(each.name)}", ((each.name, scope.type_of(each)),)
