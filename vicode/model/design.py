"""The design of a component: a state machine as a frozen value."""

from collections.abc import Iterator
from dataclasses import dataclass, field

COMMON = "@common"
"""The source of common transitions, used in place of a state name."""

Point = tuple[float, float]
"""Center on the canvas in pixels, x to the right, y downwards."""

Origin = tuple[str | int, ...]
"""The path of the part of a design that something is derived from, such as ("latches", "near") (`model.lowering`).

Empty for what the file contains; what is derived is not saved.
"""


STATE_COLORS = ("blue", "green", "yellow", "orange", "red", "purple")
"""The colors that a state can have in diagrams."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Code:
    """A block of hand-written code, as pairs of language and text."""

    texts: tuple[tuple[str, str], ...] = ()

    def in_language(self, language: str) -> str | None:
        """Return the code in a language ("python", "cpp", "xabsl"), None if there is none."""
        return dict(self.texts).get(language)


@dataclass(frozen=True, slots=True, kw_only=True)
class Declaration:
    """A name with a type: parameter, output, variable, constant, or an argument of an output.

    `type` is "bool", "int", "float" or the name of an enumeration. If empty, it is inferred from `initial`, else float.
    `initial` is an expression: the default of a parameter, the initial value of a variable or output, or the value of a
    constant. `range` includes both bounds, in `unit`; it is used for documentation and checks only. Parameters
    and constants that are `tunable` get a slider in the live view of robots.
    """

    name: str
    type: str = ""
    initial: str = ""
    unit: str = ""
    range: tuple[float, float] | None = None
    doc: str = ""
    xabsl_name: str = ""
    tunable: bool = False
    arguments: tuple["Declaration", ...] | None = None
    origin: Origin = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Use:
    """A used component and its alias in this design."""

    alias: str
    component: str
    at: Point | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Guard:
    """The condition of a decision: all specified parts must hold. An empty guard always holds.

    `when` is an expression, `after` the minimum time in the state in seconds (a number or a constant),
    `code` the body of a function returning bool.
    """

    when: str = ""
    after: str = ""
    code: Code | None = None

    @property
    def is_empty(self) -> bool:
        return not self.when and not self.after and self.code is None


@dataclass(frozen=True, slots=True, kw_only=True)
class Transition:
    """A transition to another state. A transition to the same state ends the decision without any other effect.

    `label_at` is the manual position of the label: the fraction of the edge length from 0 to 1, and the offset in
    pixels to the right of the edge direction. None means automatic placement.
    """

    to: str
    guard: Guard = field(default_factory=Guard)
    doc: str = ""
    id: str = ""
    disabled: bool = False
    label_at: Point | None = None
    origin: Origin = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Stay:
    """Ends the decision without a state change if the guard holds."""

    guard: Guard = field(default_factory=Guard)
    doc: str = ""
    id: str = ""
    disabled: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class DecisionGroup:
    """A node of a decision tree: `then` is tested if the guard holds, else `otherwise`.

    If no decision in it applies, the next item after the group is tested.
    """

    guard: Guard = field(default_factory=Guard)
    then: tuple["Decision", ...]
    otherwise: tuple["Decision", ...] = ()
    doc: str = ""
    id: str = ""
    disabled: bool = False
    origin: Origin = ()


Decision = Transition | Stay | DecisionGroup


@dataclass(frozen=True, slots=True, kw_only=True)
class Assign:
    """Sets variables and outputs, and variables of used components (`alias.variable`), in order."""

    values: tuple[tuple[str, str], ...]
    origin: Origin = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Call:
    """Sets the parameters of a used component (others take their defaults) and steps it."""

    alias: str
    arguments: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class RunCode:
    """Runs hand-written code."""

    code: Code
    id: str = ""


Action = Assign | Call | RunCode


@dataclass(frozen=True, slots=True, kw_only=True)
class State:
    """A state with its requirements, actions and transitions.

    `id` survives renaming and identifies code regions. `modulates` are calls that run after `actions`.
    A `disabled` state stays in the design, but is not generated (`vicode.model.disabled`).
    `color` is one of STATE_COLORS, "" for none; it has no effect but in diagrams.
    In a final state that is `failed`, the component has ended without success.
    `capacity` is the maximum number of robots in the state, `synchronized` the number that must enter simultaneously.
    """

    name: str
    id: str = ""
    xabsl_name: str = ""
    doc: str = ""
    at: Point | None = None
    color: str = ""
    final: bool = False
    failed: bool = False
    capacity: int | None = None
    synchronized: int | None = None
    disabled: bool = False
    requires: tuple[str, ...] = ()
    modulates: tuple[Call, ...] = ()
    enter: tuple[Action, ...] = ()
    actions: tuple[Action, ...] = ()
    leave: tuple[Action, ...] = ()
    transitions: tuple[Decision, ...] = ()
    origin: Origin = ()

    @property
    def all_actions(self) -> tuple[Action, ...]:
        """The actions of each iteration, including modulations."""
        return self.actions + self.modulates


@dataclass(frozen=True, slots=True, kw_only=True)
class CommonSection:
    """Actions and transitions that precede those of every state."""

    doc: str = ""
    at: Point | None = None
    actions: tuple[Action, ...] = ()
    transitions: tuple[Decision, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Latch:
    """A bool with hysteresis: true when `on` holds, false when `off` holds; it stays so for at least `hold` seconds."""

    name: str
    on: str = ""
    off: str = ""
    hold: str = ""
    doc: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Interrupt:
    """A rule for many states: when `when` holds, the state `do` becomes active, until `until` holds.

    Attributes:
        do: The state that handles it.
        during: Names of states that it interrupts, with `*` as wildcard; all others if empty.
        until: Its end; empty for the end of `when`.
        then: One of INTERRUPT_ENDS, or a state.
        every: The minimum time from the end of one interruption to the next, in seconds.
    """

    do: str
    during: tuple[str, ...] = ()
    when: str = ""
    until: str = ""
    then: str = ""
    every: str = ""
    doc: str = ""


INTERRUPT_ENDS = ("resume", "restart", "skip", "done", "fail")
"""What follows an interrupt: the interrupted state, the initial state, the state after the interrupted one, an end."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CompetenceStep:
    """What a competence does while `when` holds; `retries` limits how often it is begun, None for no limit."""

    name: str
    doc: str = ""
    when: str = ""
    requires: tuple[str, ...] = ()
    modulates: tuple[Call, ...] = ()
    retries: int | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Competence:
    """Steps towards a goal: the first possible one is done, until the goal is reached or none is left."""

    goal: str
    doc: str = ""
    requires: tuple[str, ...] = ()
    steps: tuple[CompetenceStep, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Layer:
    """A layer of a subsumption architecture: all run, the highest one whose `when` holds commands for at least `hold`.

    `requires` are the components that it runs, `modulates` its commands; without commands it inhibits lower layers.
    """

    name: str
    doc: str = ""
    when: str = ""
    hold: str = ""
    requires: tuple[str, ...] = ()
    modulates: tuple[Call, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class DerivedPosition:
    """The position of a state that a competence or layers are lowered to."""

    name: str
    at: Point


@dataclass(frozen=True, slots=True, kw_only=True)
class ReachProperty:
    """Each time that `after` is entered, `reach` becomes active, `within` a time if one is given.

    Without `after`, it becomes active after each start of the component. `within` is written as `Guard.after`.
    """

    reach: str
    after: str = ""
    within: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class NeverProperty:
    """After `after` was entered, or after each start of the component, `never` is not active before `before` was."""

    never: str
    after: str = ""
    before: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class RecoveryProperty:
    """Whatever happened, there is a way back to a state."""

    can_reach: str


@dataclass(frozen=True, slots=True, kw_only=True)
class InvariantProperty:
    """A condition holds after each step of the component."""

    holds: str


Property = ReachProperty | NeverProperty | RecoveryProperty | InvariantProperty
"""What the behavior promises; it has no effect on it."""

STATE_KEYS = ("after", "reach", "never", "before", "can_reach")
"""The fields of properties that name states."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DiagramNote:
    """A text in the diagram, without any effect."""

    name: str
    text: str = ""
    at: Point | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class DiagramFrame:
    """A rectangle around states in the diagram, without any effect; `name` is its title."""

    name: str
    color: str = ""
    states: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Design:
    """The design of one component. Without `frequency_hz` it runs on every step."""

    component: str
    xabsl_name: str = ""
    doc: str = ""
    frequency_hz: float | None = None
    resume: bool = False
    arithmetic: str = ""
    time_unit: str = ""
    uses: tuple[Use, ...] = ()
    parameters: tuple[Declaration, ...] = ()
    outputs: tuple[Declaration, ...] = ()
    variables: tuple[Declaration, ...] = ()
    initial: str = ""
    module: Code = field(default_factory=Code)
    members: Code = field(default_factory=Code)
    common: CommonSection = field(default_factory=CommonSection)
    states: tuple[State, ...] = ()
    latches: tuple[Latch, ...] = ()
    interrupts: tuple[Interrupt, ...] = ()
    competence: Competence | None = None
    layers: tuple[Layer, ...] = ()
    positions: tuple[DerivedPosition, ...] = ()
    properties: tuple[Property, ...] = ()
    frames: tuple[DiagramFrame, ...] = ()
    notes: tuple[DiagramNote, ...] = ()

    def state(self, name: str) -> State | None:
        """Return the first state with this name."""
        return next((state for state in self.states if state.name == name), None)

    def frame(self, name: str) -> DiagramFrame | None:
        return next((frame for frame in self.frames if frame.name == name), None)

    def use(self, alias: str) -> Use | None:
        return next((use for use in self.uses if use.alias == alias), None)

    def declarations(self) -> Iterator[tuple[str, Declaration]]:
        """Yield each declaration with its section: parameters, outputs, variables."""
        for section in ("parameters", "outputs", "variables"):
            for declaration in getattr(self, section):
                yield section, declaration
