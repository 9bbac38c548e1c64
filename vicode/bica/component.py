"""Component, the unit of the BICA architecture, and the algorithm that steps it (docs/semantics.md)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from .errors import USER_ERRORS, make_error_record

if TYPE_CHECKING:
    from .base_root import BaseRoot
    from .team import CooperativeState

# All other names without a leading underscore are available to designs: aliases, parameters, outputs and variables.
RESERVED_NAMES = frozenset(
    {
        "action_done",
        "close",
        "component_time",
        "conflict",
        "design_file",
        "frequency_hz",
        "is_done",
        "modulate",
        "restart",
        "resume",
        "root",
        "set_frequency",
        "state",
        "state_time",
        "step",
        "work",
        "world",
    }
)


@dataclass(frozen=True, slots=True)
class State:
    """One state of a component, as generated classes declare it.

    Args:
        name: The name of the state.
        run: Takes a transition, then runs the actions; `run(False)` only runs the actions.
        requires: Components that are stepped before the component works in this state.
        enter: Called when the state is entered.
        leave: Called when the state is left.
        final: Whether the component is done in this state.
        calls: Called components whose `is_done` the component reads.
        capacity: Maximum number of robots of a team that are in the state at the same time.
        synchronized: Minimum number of robots of a team that enter the state together.
    """

    name: str
    run: Callable[..., None]
    requires: tuple[Component, ...] = ()
    enter: Callable[[], None] | None = None
    leave: Callable[[], None] | None = None
    final: bool = False
    calls: tuple[Component, ...] = ()
    capacity: int | None = None
    synchronized: int | None = None


class Component:
    """A unit of behavior that works while other components step it.

    A hand-written component overrides `work`, and `restart`, `modulate` and `close` if needed. Its outputs are plain
    attributes, or methods if they have arguments. Generated classes declare their states in the constructor.

    Attributes:
        root: The root that steps the component.
        world: The world of the root, or None.
        state: The name of the active state; "" without states.
        frequency_hz: Maximum frequency of `work`, set in the class; None means on each step.
        resume: Whether a new activation continues in the last state, set in the class.
        design_file: The file of the design, set in generated classes.
    """

    design_file: ClassVar[str] = ""
    frequency_hz: ClassVar[float | None] = None
    resume: ClassVar[bool] = False

    # Slots are faster, and they keep the attributes of the runtime out of `__dict__`, which holds those of the design.
    __slots__ = (
        "__dict__",
        "_called",
        "_cooperative_states",
        "_current",
        "_entered_ns",
        "_initial",
        "_left",
        "_period_ns",
        "_reads_action_done",
        "_started_ns",
        "_states",
        "_stepped_in",
        "_transition",
        "_worked_ns",
        "root",
        "state",
        "world",
    )

    def __init__(self, root: BaseRoot) -> None:
        self.root = root
        self.world: Any = root.world
        self.state = ""
        self._period_ns = round(1e9 / self.frequency_hz) if self.frequency_hz else 0
        self._states: dict[str, State] = {}
        self._initial = self._current = State("", self.work)
        self._called: list[tuple[Component, dict[str, Any]]] = []
        self._left: State | None = None
        self._cooperative_states: dict[str, CooperativeState] = {}
        self._reads_action_done = False
        self._transition: str | None = None
        # An XabslComponent sets it two iterations back, which may be -1.
        self._stepped_in = -2
        self._started_ns = self._entered_ns = self._worked_ns = 0

    def step(self) -> None:
        """Activate the component: restart it if it was inactive, then work if its period has elapsed."""
        root = self.root
        try:
            iteration = root.iteration
            missed = iteration - self._stepped_in
            self._stepped_in = iteration
            if missed > 1:
                self._start(is_first=missed > iteration + 1)
            current = self._current
            if current.requires:
                for component in current.requires:
                    component.step()
            now_ns = root.now_ns
            period_ns = self._period_ns
            if not period_ns or now_ns - self._worked_ns >= period_ns:
                self._worked_ns = now_ns
                if self._called:
                    self._called = []
                # CPython calls a local function faster than one that is stored in an attribute.
                run = current.run
                run()
            elif self._called:
                self._repeat_calls()
        except USER_ERRORS as error:
            if error is root.stop_error:
                raise
            root.report(make_error_record(self, error))

    def work(self) -> None:
        """Run one iteration of the component; hand-written components override it."""

    def restart(self) -> None:
        """Prepare a new activation; called before the initial state is entered."""

    def modulate(self) -> None:
        """Set the parameters; components with parameters override it with keyword-only arguments that have defaults."""

    def close(self) -> None:
        """Release what the component holds, such as motors; called once, at the end of the run."""

    def set_frequency(self, hertz: float) -> None:
        """Work at another frequency than `frequency_hz` from now on; 0 means in each iteration."""
        self._period_ns = round(1e9 / hertz) if hertz else 0

    @property
    def is_done(self) -> bool:
        """Whether the component was in a final state after its last step, in this or the previous iteration."""
        return self._current.final and self.root.iteration - self._stepped_in <= 1

    @property
    def action_done(self) -> bool:
        """Whether any component called by the active state is done."""
        return any(component.is_done for component in self._current.calls)

    @property
    def conflict(self) -> bool:
        """Whether other robots already fill the capacity of the active state."""
        cooperative_state = self._cooperative_states.get(self.state)
        return cooperative_state is not None and cooperative_state.is_full

    @property
    def state_time(self) -> float:
        """Seconds since the active state was entered."""
        return (self.root.now_ns - self._entered_ns) / 1e9

    @property
    def component_time(self) -> float:
        """Seconds since the component was last restarted."""
        return (self.root.now_ns - self._started_ns) / 1e9

    def _set_states(self, *states: State) -> None:
        """Declare the states; the first is the initial one."""
        self._states = {state.name: state for state in states}
        self._reads_action_done = any(state.calls for state in states)
        self._initial = self._current = states[0]
        self.state = states[0].name
        for state in states:
            if state.capacity is not None or state.synchronized is not None:
                join = self.root.team.join
                number = state.synchronized or 0
                self._cooperative_states[state.name] = join(
                    self, state.name, capacity=state.capacity, synchronized=number
                )

    def _change_to(self, name: str, transition: str | None = None) -> None:
        """Leave the active state, enter another one and run its actions; a self transition only runs the actions."""
        old, new = self._current, self._states[name]
        if self._cooperative_states and not self._may_enter(name):
            new = old
        run = new.run
        if new is not old:
            leave, enter = old.leave, new.enter
            if leave is not None:
                leave()
            self._left = old
            self._transition = transition
            self._current = new
            self.state = name
            self._entered_ns = self.root.now_ns
            if enter is not None:
                enter()
            if new.requires and new.requires != old.requires:
                for component in new.requires:
                    if component not in old.requires:
                        component.step()
        run(False)

    def _may_enter(self, name: str) -> bool:
        cooperative_state = self._cooperative_states.get(name)
        return cooperative_state is None or cooperative_state.may_enter()

    def _stay(self) -> None:
        """End the decision without a transition and run the actions of the active state."""
        if self._cooperative_states:
            # The result does not matter: the call announces to the team that this robot uses the state.
            self._may_enter(self.state)
        self._current.run(False)

    def _call(self, component: Component, /, **parameters: Any) -> None:
        """Modulate and step `component`; `step` repeats the call until the component works again."""
        # Modulated before it is stored, so that invalid parameters are reported once and not in each repetition.
        _modulate(component, parameters)
        if self._period_ns:
            self._called.append((component, parameters))
        component.step()

    def _repeat_calls(self) -> None:
        for component, parameters in self._called:
            # Another component may have modulated it in between, so the parameters are set again.
            _modulate(component, parameters)
            component.step()

    def _start(self, *, is_first: bool) -> None:
        if self.resume and not is_first:
            return
        now_ns = self.root.now_ns
        self._started_ns = self._entered_ns = now_ns
        self._worked_ns = now_ns - self._period_ns
        self._called = []
        self._current = initial = self._initial
        if self._states:
            self.state = initial.name
        self.restart()
        if initial.enter is not None:
            initial.enter()


def _modulate(component: Component, parameters: dict[str, Any]) -> None:
    modulate: Callable[..., None] = component.modulate
    modulate(**parameters)
