"""What all generators read: names, orders and typed trees of a project, decided once as frozen values."""

from collections.abc import Mapping
from dataclasses import dataclass

from vicode.findings import Path
from vicode.model.design import Code, Design
from vicode.model.expressions import Node
from vicode.model.project import Enumeration, Project


@dataclass(frozen=True, slots=True, kw_only=True)
class Value:
    """A declared name with its type and first value, which is already of that type."""

    name: str
    type: str
    initial: Node
    unit: str = ""
    range: tuple[float, float] | None = None
    doc: str = ""
    xabsl_name: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Function:
    """An output with arguments; `result` tells its type, the arguments have defaults."""

    result: Value
    arguments: tuple[Value, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class UsedComponent:
    """A component by its alias: what vicode writes has a `module`, what is hand-written an `implementation`.

    `functions` are its outputs with arguments.
    """

    alias: str
    component: str
    module: str = ""
    implementation: str = ""
    functions: tuple[Function, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class InterfacePlan:
    """A component that vicode writes without a design: it hands on to the world, or keeps variables (`is_internal`).

    `acts`: it is told its parameters and then does something.
    """

    component: str
    xabsl_name: str
    doc: str
    is_internal: bool
    acts: bool
    parameters: tuple[Value, ...]
    outputs: tuple[Value, ...]
    functions: tuple[Function, ...]
    variables: tuple[Value, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Body:
    """Hand-written code: the id of its region, a stem for the name of its function, and what it is for."""

    region: str
    stem: str
    code: Code
    doc: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class After:
    """The time in the state is `time` or more, in the component's unit; `ns` if that is known now."""

    time: Node
    ns: int | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Holds:
    """An expression of type bool."""

    expression: Node


@dataclass(frozen=True, slots=True, kw_only=True)
class Predicate:
    """Code that returns a bool."""

    body: Body


Condition = Holds | After | Predicate


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """Ends the decision: to another state, by the transition of this id (empty: it has none)."""

    state: str
    transition: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Keep:
    """Ends the decision without a change."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Branch:
    """Decides further; a side that is exhausted falls through to what follows, one that `ends` never does."""

    then: "tuple[Alternative, ...]"
    otherwise: "tuple[Alternative, ...]"
    then_ends: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class Alternative:
    """If all conditions hold, tested in order (none: always), the outcome is taken.

    `id` if it was given one; `path` leads to the decision in the design as it works, which has nothing disabled in it.
    """

    conditions: tuple[Condition, ...]
    outcome: Change | Keep | Branch
    doc: str = ""
    id: str = ""
    path: Path = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Set:
    """Give an own variable or output a value, or with `alias` a variable of a used component."""

    name: str
    value: Node
    alias: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class CallComponent:
    """Set the parameters of a used component, and step it; `defaults` are those that the call leaves out.

    A design's own component knows its defaults, so that only hand-written ones are told them.
    """

    alias: str
    arguments: tuple[tuple[str, Node], ...]
    defaults: tuple[tuple[str, Node], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Run:
    """Run hand-written code."""

    body: Body


Step = Set | CallComponent | Run


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
    enter: tuple[Step, ...]
    act: tuple[Step, ...]
    leave: tuple[Step, ...]
    decisions: tuple[Alternative, ...]
    calls: tuple[str, ...] = ()
    capacity: int | None = None
    synchronized: int | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentPlan:
    """One component: the initial state first. `source` is the design's file, `module` the stem of what is written.

    `time_unit` is "s" or "ms": what times in expressions count. `arithmetic` is "" or "xabsl". `asks_done` is set
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
    asks_done: bool
    uses: tuple[UsedComponent, ...]
    parameters: tuple[Value, ...]
    outputs: tuple[Value, ...]
    variables: tuple[Value, ...]
    module_code: Body | None
    members: Body | None
    decide_first: tuple[Alternative, ...]
    act_first: tuple[Step, ...]
    states: tuple[StatePlan, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class PackagePlan:
    """Names of what is written for a project: the package, and in it a module for every design, by component.

    `interfaces` are the components that one module more holds, since vicode writes them without a design.
    """

    project: Project
    package: str
    modules: Mapping[str, str]
    has_declarations: bool
    interfaces: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True, kw_only=True)
class ProjectPlan:
    """All that is to be written; `components` are those asked for.

    A constant in `never_zero` may stand below a line without care.
    """

    project: Project
    name: str
    doc: str
    package: PackagePlan
    enumerations: tuple[Enumeration, ...]
    constants: tuple[Value, ...]
    never_zero: frozenset[str]
    components: tuple[ComponentPlan, ...]
    interfaces: tuple[InterfacePlan, ...] = ()
