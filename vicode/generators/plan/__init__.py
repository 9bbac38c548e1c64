"""The language-neutral plan of a project: names, order and typed expression trees."""

from vicode.generators.plan.component import INTERFACES_MODULE, plan_component
from vicode.generators.plan.int_ranges import IntRanges
from vicode.generators.plan.interfaces import plan_interface
from vicode.generators.plan.plan_types import (
    ActionStep,
    AssignStep,
    Branch,
    CallStep,
    CodeCondition,
    CodePlan,
    CodeStep,
    ComponentPlan,
    Condition,
    DecisionPlan,
    ExpressionCondition,
    FunctionPlan,
    InterfacePlan,
    NoChange,
    PackagePlan,
    ProjectPlan,
    StateChange,
    StatePlan,
    TimerCondition,
    UsedComponent,
    ValuePlan,
)
from vicode.generators.plan.project import collect_components, plan_package, plan_project
from vicode.generators.plan.typed_expressions import UnsoundDesignError, literal_value, typed_tree

__all__ = [
    "INTERFACES_MODULE",
    "ActionStep",
    "AssignStep",
    "Branch",
    "CallStep",
    "CodeCondition",
    "CodePlan",
    "CodeStep",
    "ComponentPlan",
    "Condition",
    "DecisionPlan",
    "ExpressionCondition",
    "FunctionPlan",
    "IntRanges",
    "InterfacePlan",
    "NoChange",
    "PackagePlan",
    "ProjectPlan",
    "StateChange",
    "StatePlan",
    "TimerCondition",
    "UnsoundDesignError",
    "UsedComponent",
    "ValuePlan",
    "collect_components",
    "literal_value",
    "plan_component",
    "plan_interface",
    "plan_package",
    "plan_project",
    "typed_tree",
]
