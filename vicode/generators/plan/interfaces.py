"""From a declared component without a class of its own to what is written for it."""

from vicode.generators.plan.component import plan_values
from vicode.generators.plan.expressions import initial_of
from vicode.generators.plan.values import Function, InterfacePlan, Value
from vicode.model.design import Declaration
from vicode.model.expressions import Scope, scope_of
from vicode.model.project import INTERNAL, Interface, Project


def plan_interface(project: Project, interface: Interface) -> InterfacePlan:
    """What a component hands on to the world, or keeps."""
    scope = scope_of(project, None)
    functions = (each for each in interface.readable if each.arguments is not None)
    is_silent = not interface.readable
    return InterfacePlan(
        component=interface.component,
        xabsl_name=interface.xabsl_name,
        doc=interface.doc or interface.title,
        is_internal=interface.implementation == INTERNAL,
        acts=bool(interface.parameters) or is_silent,
        parameters=plan_values(interface.parameters, scope),
        outputs=plan_values(interface.outputs, scope),
        functions=tuple(_plan_function(each, scope) for each in functions),
        variables=plan_values(interface.variables, scope),
    )


def _plan_function(declaration: Declaration, scope: Scope) -> Function:
    result = Value(
        name=declaration.name,
        type=scope.type_of(declaration),
        initial=initial_of(declaration, scope),
        unit=declaration.unit,
        range=declaration.range,
        doc=declaration.doc,
        xabsl_name=declaration.xabsl_name,
    )
    return Function(result=result, arguments=plan_values(declaration.arguments or (), scope))
