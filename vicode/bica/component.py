"""Component, the unit of the BICA architecture, and the one algorithm that steps it (docs/semantics.md)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from .errors import ComponentError, make_error_record

if TYPE_CHECKING:
    from .root import Root
    from .team import CooperativeState

# All other names without a leading underscore belong to the design: aliases, parameters, outputs and variables.
RESERVED_NAMES = frozenset(
    {
        "action_done",
        "component_time",
        "conflict",
        "design_file",
        "frequency_hz",
        "is_done",
        "modulate",
        "restart",
        "resume",
        "root",
        "state",
        "state_time",
        "step",
        "work",
        "world",
    }
)


@dataclass(frozen=True, slots=True)
class State:
    """One state of a component.

    Args:
        run: decides and then acts; called with `False` it only acts.
        requires: stepped before the component works in this state.
        final: the component is done in this state.
        calls: components that it calls, when the component asks whether they are done.
        capacity: so many robots of a team may be in it at once.
        synchronized: so many robots of a team enter it at once.
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
    """A unit of functionality that works iteratively while others step it (BICA paper, section IV).

    A hand-written component overrides `work`, may override `restart` and `modulate`, and offers its outputs as plain
    attributes, or as methods when they take arguments. A component with states calls `_set_states` in its constructor.
    """

    design_file: ClassVar[str] = ""
    frequency_hz: ClassVar[float | None] = None
    resume: ClassVar[bool] = False

    # Slots keep the runtime's own attributes out of the instance's dictionary, which is the design's, and quick.
    __slots__ = (
        "__dict__",
        "_called",
        "_cooperative_states",
        "_current",
        "_entered_ns",
        "_initial",
        "_left",
        "_period_ns",
        "_started_ns",
        "_states",
        "_stepped_in",
        "_transition",
        "_worked_ns",
        "root",
        "state",
        "world",
    )

    def __init__(self, root: Root) -> None:
        self.root = root
        self.world: Any = root.world
        self.state = ""
        self._period_ns = round(1e9 / self.frequency_hz) if self.frequency_hz else 0
        self._states: dict[str, State] = {}
        self._initial = self._current = State("", self.work)
        self._called: list[tuple[Component, dict[str, Any]]] = []
        self._left: State | None = None
        self._cooperative_states: dict[str, CooperativeState] = {}
        self._transition: str | None = None
        self._stepped_in = -1
        self._started_ns = self._entered_ns = self._worked_ns = 0

    def step(self) -> None:
        """Be active in this iteration: restart if it was not in the last one, then work if it is time to."""
        root = self.root
        try:
            iteration = root.iteration
            missed = iteration - self._stepped_in
            self._stepped_in = iteration
            if missed > 1:
                self._start(is_first=missed > iteration)
            current = self._current
            if current.requires:
                for component in current.requires:
                    component.step()
            now_ns = root.now_ns
            if now_ns - self._worked_ns >= self._period_ns:
                self._worked_ns = now_ns
                if self._called:
                    self._called = []
                # CPython calls a local quicker than an attribute that holds a function.
                run = current.run
                run()
            elif self._called:
                self._repeat_calls()
        except ComponentError:
            raise
        except Exception as error:
            root.report(make_error_record(self, error))

    def work(self) -> None:
        """Do what the component is for; overridden by hand-written components."""

    def restart(self) -> None:
        """Get ready for a new activation; called before the initial state is entered."""

    def modulate(self) -> None:
        """Take the parameters of an activation: keyword-only, with defaults; overridden by components that have any."""

    @property
    def is_done(self) -> bool:
        """Whether it ended in a final state when last stepped, which was in this or the previous iteration."""
        return self._current.final and self.root.iteration - self._stepped_in <= 1

    @property
    def action_done(self) -> bool:
        """Whether a component that the active state calls is done."""
        return any(component.is_done for component in self._current.calls)

    @property
    def conflict(self) -> bool:
        """Whether as many other robots are in the active state as may be in it."""
        together = self._cooperative_states.get(self.state)
        return together is not None and together.is_full

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
        """Leave the active state for another, enter that and act in it; a change to the active state only acts."""
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
        together = self._cooperative_states.get(name)
        return together is None or together.may_enter()

    def _stay(self) -> None:
        """End the decision without a change: act in the active state."""
        if self._cooperative_states:
            # The others are asked for leave to stay too; only what they are told by it counts.
            self._may_enter(self.state)
        self._current.run(False)

    def _call(self, component: Component, /, **parameters: Any) -> None:
        """Modulate `component` and step it; remembered until the next work, to step it when it is not time to work."""
        # Parameters that cannot be set now could not be set again either: the mistake is told once, here.
        _modulate(component, parameters)
        if self._period_ns:
            self._called.append((component, parameters))
        component.step()

    def _repeat_calls(self) -> None:
        for component, parameters in self._called:
            # Another component may have modulated it since, so the parameters are set again.
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
