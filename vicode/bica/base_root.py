"""The part of a root that steps components; knows nothing of the live view, records and networks."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from functools import partial
from typing import Any, Literal, Protocol, Self, TypeVar, cast

from .clock import Clock, RealClock, StoppableClock
from .component import Component
from .errors import (
    USER_ERRORS,
    ComponentError,
    CyclicUseError,
    ErrorRecord,
    describe_exception,
    make_error_record,
    print_error,
)
from .team import Team
from .timing import CycleTimes, measure_steps

C = TypeVar("C", bound=Component)
OnError = Literal["continue", "stop"] | Callable[[ErrorRecord], None]


class RootObserver(Protocol):
    """Sees each iteration of a root; see `Observer`."""

    def attach(self, component: Component, /) -> None: ...
    def observe_iteration(self, root: BaseRoot, step: Callable[[], None], /) -> None: ...
    def add_error(self, error: ErrorRecord, /) -> None: ...


class NetworkConnection(Protocol):
    """The connection of a root to other robots; see `Network`."""

    name: str

    @property
    def robots(self) -> Mapping[str, Any]: ...
    def announce(self, address: str, /) -> None: ...
    def run_iteration(self, step: Callable[[], None], /) -> None: ...


class BaseRoot:
    """Creates, steps and closes components; see `Root`."""

    def __init__(
        self,
        component_class: type[Component],
        *,
        clock: Clock | None = None,
        world: Any = None,
        on_error: OnError = "continue",
        observer: RootObserver | None = None,
        **parameters: Any,
    ) -> None:
        self.clock: Clock = clock if clock is not None else RealClock()
        self.world = world
        self.team = Team()
        self.iteration = 0
        self.now_ns = 0
        self.errors: Counter[tuple[str, str, int]] = Counter()
        self.stop_error: ComponentError | None = None
        self._read_clock = self.clock.now_ns
        self._lag_ns = 0
        self._on_error = on_error
        self._has_on_error_failed = False
        self._observers: list[RootObserver] = [] if observer is None else [observer]
        self._error_listeners: list[Callable[[ErrorRecord], None]] = [each.add_error for each in self._observers]
        self.network: NetworkConnection | None = None
        self._components: dict[type[Component], Component] = {}
        self._under_construction: list[type[Component]] = []
        self._cycle_times: dict[str, CycleTimes] | None = None
        self._is_stopping: Callable[[], bool] = bool
        """Whether the run ends after this iteration, so that nothing may hold it up."""
        self._has_lost_output = False
        """Whether a record could not be written."""
        self._is_time_stopped = self._is_closed = False
        self._hold_failures: set[str] = set()
        self.holders: list[Callable[[], None]] = []
        """What components do when the robot is held, as their methods; they never raise."""
        self._closing = ExitStack()
        self._closing.callback(self._close_world)
        try:
            self.main = self.component(component_class)
            if parameters:
                cast("Callable[..., None]", self.main.modulate)(**parameters)
        except BaseException:
            self.close()
            raise
        self._before_reload: list[Callable[[], None]] = []
        self._step_main = self._find_step()
        self._set_step: Callable[[Callable[[], None]], None] = partial(setattr, self, "_step_main")
        self._attach_features()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def components(self) -> tuple[Component, ...]:
        """All components of this root, in the order in which their construction finished."""
        return tuple(self._components.values())

    @property
    def active_states(self) -> tuple[tuple[str, str], ...]:
        """The components with states that were stepped in the last iteration, and their states, the root first."""
        active = (each for each in self.components if each.state and each._stepped_in == self.iteration)
        return tuple((type(each).__name__, each.state) for each in reversed(tuple(active)))

    @property
    def measure(self) -> bool:
        """Whether cycle times are measured; cannot be switched off again."""
        return self._cycle_times is not None

    @measure.setter
    def measure(self, is_enabled: bool) -> None:
        if is_enabled and self._cycle_times is None:
            self._cycle_times = {}
            for component in self.components:
                measure_steps(component, self._cycle_times)
            self._set_step(self._find_step())

    @property
    def cycle_times(self) -> dict[str, CycleTimes]:
        """Cycle times by component name; empty unless `measure` is set."""
        return self._cycle_times or {}

    def component(self, component_class: type[C]) -> C:
        """Return the instance of `component_class`, which the first call creates.

        Raises:
            CyclicUseError: The component uses itself, directly or indirectly.
        """
        known = self._components.get(component_class)
        if known is not None:
            return cast("C", known)
        if component_class in self._under_construction:
            cycle = [*self._under_construction[self._under_construction.index(component_class) :], component_class]
            raise CyclicUseError(tuple(cls.__name__ for cls in cycle))
        self._under_construction.append(component_class)
        try:
            component = component_class(self)
        finally:
            self._under_construction.pop()
        self._components[component_class] = component
        self._closing.callback(self._close_component, component)
        self._instrument(component)
        return component

    def step(self) -> None:
        """Run one iteration; the clock is only read at its start."""
        # CPython calls a local function faster than one that is stored in an attribute.
        read_clock, step_main = self._read_clock, self._step_main
        now_ns = read_clock()
        if now_ns < self.now_ns:
            now_ns = self._continue_time(now_ns)
        self.now_ns = now_ns
        self.iteration += 1
        if self.team._states:
            self.team._begin_iteration()
        step_main()

    def hold(self) -> None:
        """Stop what components command, and call `hold` of the world, if it has one.

        The robot stops moving until a later iteration commands it again.

        An exception in it is printed once and not raised, because the caller stops for another reason.
        """
        for holder in self.holders:
            holder()
        hold = getattr(self.world, "hold", None)
        if callable(hold):
            try:
                hold()
            except USER_ERRORS as error:
                message = f"hold() of the world failed: {describe_exception(error)}"
                if message not in self._hold_failures:
                    self._hold_failures.add(message)
                    print_error(f"{message}; the robot may move (reported once)")

    def close(self) -> None:
        """Hold the robot, then close each component, the last created first, and the world, each once.

        All are called, even if one raises: errors of components are reported, other exceptions are raised at the end.
        """
        if not self._is_closed:
            self._is_closed = True
            self.hold()
        self._closing.close()

    def report(self, record: ErrorRecord) -> None:
        """Count the error of a component and handle it according to `on_error`."""
        self.errors[record.place] += 1
        for listener in self._error_listeners:
            listener(record)
        if callable(self._on_error):
            self._call_on_error(self._on_error, record)
        elif self._on_error == "stop":
            self.stop_error = ComponentError(record)
            raise self.stop_error
        elif self.errors[record.place] == 1:
            print_error(f"{record} (reported once; repetitions are only counted)")

    def observe(self, observer: RootObserver) -> None:
        """Let an observer see the iterations from now on, or from the first one during construction."""
        if hasattr(self, "_step_main"):
            self._add_observer(observer)
        else:
            self._observers.append(observer)
            self._error_listeners.append(observer.add_error)

    @property
    def observers(self) -> tuple[RootObserver, ...]:
        """The observers, in the order in which they were added."""
        return tuple(self._observers)

    def _attach_features(self) -> None:
        """Attach what a subclass offers; called once the root can be stepped."""

    def _call_on_error(self, on_error: Callable[[ErrorRecord], None], record: ErrorRecord) -> None:
        """Call the function; it stops the root with a `ComponentError`, and other exceptions are printed once."""
        try:
            on_error(record)
        except ComponentError as error:
            self.stop_error = error
            raise
        except USER_ERRORS as error:
            if not self._has_on_error_failed:
                self._has_on_error_failed = True
                print_error(f"on_error raised {describe_exception(error)} (reported once)")

    def _continue_time(self, clock_ns: int) -> int:
        """Return the time of the last iteration, from which time continues after the clock was set back."""
        self._skip_time(clock_ns - self.now_ns)
        return self.now_ns

    @contextmanager
    def _stopped_time(self) -> Iterator[None]:
        """Hold the robot, and let no time pass in this context, between two iterations."""
        clock, begin_ns = self.clock, self.clock.now_ns()
        self._is_time_stopped = True
        if isinstance(clock, StoppableClock):
            clock.stop_time()
        self.hold()
        try:
            yield
        finally:
            if isinstance(clock, StoppableClock):
                clock.continue_time()
            else:
                self._skip_time(clock.now_ns() - begin_ns)
            self._is_time_stopped = False

    def _skip_time(self, ns: int) -> None:
        """Leave out a time that passed on the clock."""
        self._lag_ns -= ns
        read_clock, lag_ns = self.clock.now_ns, self._lag_ns
        self._read_clock = lambda: read_clock() + lag_ns

    def _close_component(self, component: Component) -> None:
        try:
            component.close()
        except USER_ERRORS as error:
            self.report(make_error_record(component, error))

    def _close_world(self) -> None:
        close = getattr(self.world, "close", None)
        if callable(close):
            close()

    def _find_step(self) -> Callable[[], None]:
        step = self.main.step
        if self.network is not None:
            step = partial(self.network.run_iteration, step)
        for observer in self._observers:
            step = partial(observer.observe_iteration, self, step)
        return step

    def _add_observer(self, observer: RootObserver) -> None:
        self._observers.append(observer)
        self._error_listeners.append(observer.add_error)
        for component in self.components:
            observer.attach(component)
        self._set_step(self._find_step())

    def _instrument(self, component: Component) -> None:
        for observer in self._observers:
            observer.attach(component)
        if self._cycle_times is not None:
            measure_steps(component, self._cycle_times)
