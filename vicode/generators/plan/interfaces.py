"""Plan declared components that have neither a design nor a hand-written class."""

from vicode.generators.plan.component import plan_functions, plan_values
from vicode.generators.plan.plan_types import InterfacePlan
from vicode.model.expressions import build_scope
from vicode.model.project import Interface, Project
from vicode.model.xabsl.names import is_basic_behavior


def plan_interface(project: Project, interface: Interface) -> InterfacePlan:
    scope = build_scope(project, None)
    return InterfacePlan(
        component=interface.component,
        xabsl_name=interface.xabsl_name,
        doc=interface.doc or interface.title,
        implementation=interface.implementation,
        is_behavior=is_basic_behavior(interface),
        parameters=plan_values(interface.parameters, scope),
        outputs=plan_values(interface.outputs, scope),
        functions=plan_functions(interface.readable, scope),
        variables=plan_values(interface.variables, scope),
        remote=interface.remote,
        tunable=plan_values(interface.tunable, scope),
    )
