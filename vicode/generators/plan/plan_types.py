"""The types of the plan, which every generator reads."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from vicode.findings import DesignPath
from vicode.generators.plan.int_ranges import IntRanges
from vicode.model.design import Code, Design
from vicode.model.expressions import Expr
from vicode.model.project import WORLD, Elsewhere, Enumeration, Project


@dataclass(frozen=True, slots=True, kw_only=True)
class ValuePlan:
    """A declared value; `initial` has the declared type."""

    name: str
    type: str
    initial: Expr
    unit: str = ""
    range: tuple[float, float] | None = None
    doc: str = ""
    xabsl_name: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class FunctionPlan:
    """An output with arguments; every argument has a default."""

    result: ValuePlan
    arguments: tuple[ValuePlan, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class UsedComponent:
    """A used component; a generated one has a `module`, a hand-written one an `implementation`.

    `functions` are its outputs with arguments, `inputs` its other outputs if the world provides them.
    """

    alias: str
    component: str
    module: str = ""
    implementation: str = ""
    parameters: tuple[ValuePlan, ...] = ()
    functions: tuple[FunctionPlan, ...] = ()
    inputs: tuple[ValuePlan, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class InterfacePlan:
    """A generated component without a design.

    Attributes:
        implementation: WORLD, INTERNAL, MISSING, REMOTE or TOPIC.
        is_behavior: It is a basic behavior: each step passes its parameters to a method of the world.
    """

    component: str
    xabsl_name: str
    doc: str
    implementation: str
    is_behavior: bool
    parameters: tuple[ValuePlan, ...]
    outputs: tuple[ValuePlan, ...]
    functions: tuple[FunctionPlan, ...]
    variables: tuple[ValuePlan, ...]
    remote: Elsewhere | None = None
    tunable: tuple[ValuePlan, ...] = ()

    @property
    def stored_values(self) -> tuple[ValuePlan, ...]:
        """The values that the component holds itself; the world holds the others."""
        if self.implementation == WORLD:
            return self.parameters
        return (*self.parameters, *self.outputs, *self.variables)


@dataclass(frozen=True, slots=True, kw_only=True)
class CodePlan:
    """Hand-written code with its path, its region id, the stem of its function name and its description."""

    path: DesignPath
    region_id: str
    stem: str
    code: Code
    doc: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class TimerCondition:
    """The time in the state is at least `time` (in the time unit of the component); `ns` if `time` is a literal."""

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
    """Ends the decision with a change to `state`; `transition` is the id of the transition or empty."""

    state: str
    transition: str


@dataclass(frozen=True, slots=True, kw_only=True)
class NoChange:
    """Ends the decision without a state change."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Branch:
    """Nested decisions; a side in which none applies falls through to the next decision."""

    then: "tuple[DecisionPlan, ...]"
    otherwise: "tuple[DecisionPlan, ...]"
    then_always_ends: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class DecisionPlan:
    """Takes the outcome if all conditions hold; they are tested in order.

    `path` is the path of the decision in the design without disabled elements.
    """

    conditions: tuple[Condition, ...]
    outcome: StateChange | NoChange | Branch
    doc: str = ""
    id: str = ""
    path: DesignPath = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class AssignStep:
    """Sets a variable or output of the component, or with `alias` a variable of a used component."""

    name: str
    value: Expr
    alias: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class CallStep:
    """Sets the parameters of a used component and steps it.

    `defaults` are the omitted parameters of a hand-written component. A generated component supplies its own defaults.
    """

    alias: str
    arguments: tuple[tuple[str, Expr], ...]
    defaults: tuple[tuple[str, Expr], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeStep:
    """Runs hand-written code."""

    code: CodePlan


ActionStep = AssignStep | CallStep | CodeStep


@dataclass(frozen=True, slots=True, kw_only=True)
class StatePlan:
    """A state.

    Attributes:
        stem: The part of method names that identifies the state.
        actions: Includes the actions that `modulates` stands for.
        calls: Aliases of the designs that the state calls, including calls in common actions.
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

    @property
    def is_cooperative(self) -> bool:
        return self.capacity is not None or self.synchronized is not None


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentPlan:
    """One component.

    Attributes:
        design: The design without disabled elements.
        module: The module name without suffix.
        source: The design file, relative to the project folder; may be empty.
        time_unit: The unit of times in expressions, "s" or "ms".
        arithmetic: "" or "xabsl".
        uses_action_done: Whether an expression contains `action_done`.
        states: The initial state first.
        ranges: The ranges of its ints.
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
    ranges: IntRanges = field(default_factory=IntRanges)

    @property
    def action_lists(self) -> tuple[tuple[ActionStep, ...], ...]:
        """The common actions, then those of each state."""
        return (
            self.common_actions,
            *(part for state in self.states for part in (state.enter, state.actions, state.leave)),
        )

    @property
    def action_code(self) -> Iterator[CodePlan]:
        return (step.code for part in self.action_lists for step in part if isinstance(step, CodeStep))

    @property
    def guard_code(self) -> Iterator[CodePlan]:
        for decisions in (self.common_decisions, *(state.decisions for state in self.states)):
            yield from iter_guard_code(decisions)


def iter_guard_code(decisions: Iterable[DecisionPlan]) -> Iterator[CodePlan]:
    """Yield the code of guards, also inside branches."""
    for decision in decisions:
        yield from (condition.code for condition in decision.conditions if isinstance(condition, CodeCondition))
        if isinstance(decision.outcome, Branch):
            yield from iter_guard_code((*decision.outcome.then, *decision.outcome.otherwise))


@dataclass(frozen=True, slots=True, kw_only=True)
class PackagePlan:
    """The package of a project and its modules by component.

    `interfaces` are the generated components without a design; they share one module.
    """

    project: Project
    name: str
    modules: Mapping[str, str]
    has_declarations: bool
    interfaces: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True, kw_only=True)
class ProjectPlan:
    """The plan of a project; `components` holds the requested components.

    `nonzero_constants` are constants with a nonzero literal value, which are safe divisors; `ranges` are those of int
    constants.
    """

    project: Project
    name: str
    doc: str
    package: PackagePlan
    enumerations: tuple[Enumeration, ...]
    constants: tuple[ValuePlan, ...]
    nonzero_constants: frozenset[str]
    ranges: IntRanges
    components: tuple[ComponentPlan, ...]
    interfaces: tuple[InterfacePlan, ...] = ()
