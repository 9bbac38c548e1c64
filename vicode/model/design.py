"""A design as a frozen value: one component drawn as a state machine."""

from collections.abc import Iterator
from dataclasses import dataclass, field

COMMON = "@common"
"""Stands for the source of common transitions where a state's name would stand."""

Point = tuple[float, float]
"""Centre on the canvas in pixels, x to the right, y downwards."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Code:
    """One piece of hand-written code, a text a language."""

    texts: tuple[tuple[str, str], ...] = ()

    def in_language(self, language: str) -> str | None:
        """The text in a language ("python", "cpp", "xabsl"), None when it is not written in it."""
        return dict(self.texts).get(language)


@dataclass(frozen=True, slots=True, kw_only=True)
class Declaration:
    """A name with a type: parameter, output, variable, constant, or an argument of an output.

    `type` is "bool", "int", "float" or an enumeration's name; empty means: as `initial`, else float.
    `initial` is an expression's text: a parameter's default, a variable's or output's first value, a constant's value.
    `range` is documentation and a hint for checks, both ends included, in `unit`.
    """

    name: str
    type: str = ""
    initial: str = ""
    unit: str = ""
    range: tuple[float, float] | None = None
    doc: str = ""
    xabsl_name: str = ""
    arguments: tuple["Declaration", ...] | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Use:
    """A component under the name (`alias`) that code, guards and links of this design use."""

    alias: str
    component: str
    at: Point | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Guard:
    """The condition of a decision: every part that is given must hold; an empty guard always holds.

    `when` is an expression's text, `after` seconds in the state (a number or a constant),
    `code` the body of a function returning bool.
    """

    when: str = ""
    after: str = ""
    code: Code | None = None

    @property
    def is_empty(self) -> bool:
        """Nothing to test: it always holds."""
        return not self.when and not self.after and self.code is None


@dataclass(frozen=True, slots=True, kw_only=True)
class Transition:
    """To another state when the guard holds; to the state itself it ends the decision and changes nothing.

    `label_at` is where its label was put by hand: the part of the way from 0 to 1, and the pixels beside it, to the
    right of who walks along it; None: wherever there is room.
    """

    to: str
    guard: Guard = field(default_factory=Guard)
    doc: str = ""
    id: str = ""
    disabled: bool = False
    label_at: Point | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Stay:
    """Ends the decision without a change when the guard holds."""

    guard: Guard = field(default_factory=Guard)
    doc: str = ""
    id: str = ""
    disabled: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class DecisionGroup:
    """A node of a decision tree: `then` is tested when the guard holds, else `otherwise`.

    When all of them are exhausted the next item after the group is tested.
    """

    guard: Guard = field(default_factory=Guard)
    then: tuple["Decision", ...]
    otherwise: tuple["Decision", ...] = ()
    doc: str = ""
    id: str = ""
    disabled: bool = False


Decision = Transition | Stay | DecisionGroup


@dataclass(frozen=True, slots=True, kw_only=True)
class Assign:
    """Set own variables and outputs, and variables of used components (`alias.variable`), in order."""

    values: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Call:
    """Set the parameters of a used component (those left out take their defaults) and step it there."""

    alias: str
    arguments: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class RunCode:
    """Run hand-written code."""

    code: Code
    id: str = ""


Action = Assign | Call | RunCode


@dataclass(frozen=True, slots=True, kw_only=True)
class State:
    """A state: what it requires, does at each iteration, and where it may go.

    `id` outlives a new name, so that code regions follow it. `modulates` are calls done after `actions`.
    A `disabled` state is kept, and works as if it were not there (`vicode.model.disabled`).
    `capacity` is the number of robots that may be in it, `synchronized` how many must enter at once.
    """

    name: str
    id: str = ""
    xabsl_name: str = ""
    doc: str = ""
    at: Point | None = None
    final: bool = False
    capacity: int | None = None
    synchronized: int | None = None
    disabled: bool = False
    requires: tuple[str, ...] = ()
    modulates: tuple[Call, ...] = ()
    enter: tuple[Action, ...] = ()
    actions: tuple[Action, ...] = ()
    leave: tuple[Action, ...] = ()
    transitions: tuple[Decision, ...] = ()

    @property
    def all_actions(self) -> tuple[Action, ...]:
        """What the state does at each iteration, modulations at the end."""
        return self.actions + self.modulates


@dataclass(frozen=True, slots=True, kw_only=True)
class CommonSection:
    """Tested before and done before those of every state."""

    doc: str = ""
    at: Point | None = None
    actions: tuple[Action, ...] = ()
    transitions: tuple[Decision, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Design:
    """One component as drawn. `frequency_hz` None: it works at every step it is given."""

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

    def state(self, name: str) -> State | None:
        """The state of this name (the first, should there be two)."""
        return next((state for state in self.states if state.name == name), None)

    def use(self, alias: str) -> Use | None:
        """The use of this alias."""
        return next((use for use in self.uses if use.alias == alias), None)

    def declarations(self) -> Iterator[tuple[str, Declaration]]:
        """Every own declaration with the section it stands in: parameters, outputs, variables."""
        for section in ("parameters", "outputs", "variables"):
            for declaration in getattr(self, section):
                yield section, declaration
