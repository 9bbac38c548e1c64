"""What all generators read: names, orders and typed trees of a project, decided once as frozen values."""

from collections.abc import Mapping
from dataclasses import dataclass

from vicode.findings import DesignPath
from vicode.model.design import Code, Design
from vicode.model.expressions import Expr
from vicode.model.project import Enumeration, Project


@dataclass(frozen=True, slots=True, kw_only=True)
class ValuePlan:
    """A declared name with its type and first value, which is already of that type."""

    name: str
    type: str
    initial: Expr
    unit: str = ""
    range: tuple[float, float] | None = None
    doc: str = ""
    xabsl_name: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class FunctionPlan:
    """An output with arguments; `result` tells its type, the arguments have defaults."""

    result: ValuePlan
    arguments: tuple[ValuePlan, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class UsedComponent:
    """A component by its alias: what vicode writes has a `module`, what is hand-written an `implementation`.

    `functions` are its outputs with arguments.
    """

    alias: str
    component: str
    module: str = ""
    implementation: str = ""
    functions: tuple[FunctionPlan, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class InterfacePlan:
    """A component that vicode writes without a design: it hands on to the world, or keeps variables (`is_internal`).

    `is_behavior`: it is told its parameters and then does something.
    """

    component: str
    xabsl_name: str
    doc: str
    is_internal: bool
    is_behavior: bool
    parameters: tuple[ValuePlan, ...]
    outputs: tuple[ValuePlan, ...]
    functions: tuple[FunctionPlan, ...]
    variables: tuple[ValuePlan, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class CodePlan:
    """Hand-written code: the id of its region, a stem for the name of its function, and what it is for."""

    region_id: str
    stem: str
    code: Code
    doc: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class TimerCondition:
    """The time in the state is `time` or more, in the component's unit; `ns` if that is known now."""

    time: Expr
    ns: int | None


@dataclass(frozen=True, slots=True, kw_only=True)
class ExpressionCondition:
    """An expression of type bool."""

    expression: Expr


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeCondition:
    """Code that returns a bool."""

    code: CodePlan


Condition = ExpressionCondition | TimerCondition | CodeCondition


@dataclass(frozen=True, slots=True, kw_only=True)
class StateChange:
    """Ends the decision: to another state, by the transition of this id (empty: it has none)."""

    state: str
    transition: str


@dataclass(frozen=True, slots=True, kw_only=True)
class NoChange:
    """Ends the decision without a change."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Branch:
    """Decides further; a side that is exhausted falls through to what follows, one that `ends` never does."""

    then: "tuple[DecisionPlan, ...]"
    otherwise: "tuple[DecisionPlan, ...]"
    then_always_ends: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class DecisionPlan:
    """If all conditions hold, tested in order (none: always), the outcome is taken.

    `id` if it was given one; `path` leads to the decision in the design as it works, which has nothing disabled in it.
    """

    conditions: tuple[Condition, ...]
    outcome: StateChange | NoChange | Branch
    doc: str = ""
    id: str = ""
    path: DesignPath = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class AssignStep:
    """Give an own variable or output a value, or with `alias` a variable of a used component."""

    name: str
    value: Expr
    alias: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class CallStep:
    """Set the parameters of a used component, and step it; `defaults` are those that the call leaves out.

    A design's own component knows its defaults, so that only hand-written ones are told them.
    """

    alias: str
    arguments: tuple[tuple[str, Expr], ...]
    defaults: tuple[tuple[str, Expr], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeStep:
    """Run hand-written code."""

    code: CodePlan


ActionStep = AssignStep | CallStep | CodeStep


@dataclass(frozen=True, slots=True, kw_only=True)
class StatePlan:
    """A state; `stem` is its name for functions. `modulates` are already at the end of `act`.

    `calls` are the aliases of designs that it calls, the common actions included.
    """

    name: str
    stem: str
    doc: str
    final: bool
    requires: tuple[str, ...]
    enter: tuple[ActionStep, ...]
    actions: tuple[ActionStep, ...]
    leave: tuple[ActionStep, ...]
    decisions: tuple[DecisionPlan, ...]
    calls: tuple[str, ...] = ()
    capacity: int | None = None
    synchronized: int | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentPlan:
    """One component: the initial state first. `source` is the design's file, `module` the stem of what is written.

    `time_unit` is "s" or "ms": what times in expressions count. `arithmetic` is "" or "xabsl". `uses_action_done` is set
    where an expression says `action_done`. `design` is what works of the design, in its `project`.
    """

    project: Project
    design: Design
    component: str
    module: str
    source: str
    doc: str
    frequency_hz: float | None
    resume: bool
    time_unit: str
    arithmetic: str
    uses_action_done: bool
    uses: tuple[UsedComponent, ...]
    parameters: tuple[ValuePlan, ...]
    outputs: tuple[ValuePlan, ...]
    variables: tuple[ValuePlan, ...]
    module_code: CodePlan | None
    members: CodePlan | None
    common_decisions: tuple[DecisionPlan, ...]
    common_actions: tuple[ActionStep, ...]
    states: tuple[StatePlan, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class PackagePlan:
    """Names of what is written for a project: the package, and in it a module for every design, by component.

    `interfaces` are the components that one module more holds, since vicode writes them without a design.
    """

    project: Project
    name: str
    modules: Mapping[str, str]
    has_declarations: bool
    interfaces: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True, kw_only=True)
class ProjectPlan:
    """All that is to be written; `components` are those asked for.

    A constant in `nonzero_constants` may stand below a line without care.
    """

    project: Project
    name: str
    doc: str
    package: PackagePlan
    enumerations: tuple[Enumeration, ...]
    constants: tuple[ValuePlan, ...]
    nonzero_constants: frozenset[str]
    components: tuple[ComponentPlan, ...]
    interfaces: tuple[InterfacePlan, ...] = ()
