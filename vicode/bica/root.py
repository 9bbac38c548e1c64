"""Root: creates each component once and steps the root component in each iteration."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any, Literal, Self, TypeVar, cast

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

if TYPE_CHECKING:
    from .live_server import LiveServer
    from .network import Network
    from .observer import Observer
    from .recorder import Recorder

C = TypeVar("C", bound=Component)
OnError = Literal["continue", "stop"] | Callable[[ErrorRecord], None]


class Root:
    """Creates each component once, and steps the root component in each iteration; a context manager that closes them.

    Args:
        component_class: The class of the root component.
        clock: Read once at the start of each iteration; default: real time.
        world: The `world` of hand-written components, which they sense and act on.
        on_error: `continue` prints each error location once, `stop` raises `ComponentError`; a function is called
            with the `ErrorRecord`, and may raise `ComponentError(record)` to stop.
        observer: Records the activation tree of each iteration.
        parameters: Passed once to `modulate` of the root component.

    Attributes:
        main: The root component.
        clock: The clock.
        world: The world, or None.
        now_ns: The time of the iteration in nanoseconds.
        iteration: The number of the iteration, from 1; 0 before the first step.
        team: The states that the robots of a team coordinate.
        errors: How often each error occurred, by component, method and line.
        network: The connection to other robots, after `connect`, or else None.
    """

    def __init__(
        self,
        component_class: type[Component],
        *,
        clock: Clock | None = None,
        world: Any = None,
        on_error: OnError = "continue",
        observer: Observer | None = None,
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
        self._observers: list[Observer] = [] if observer is None else [observer]
        self._error_listeners: list[Callable[[ErrorRecord], None]] = [each.add_error for each in self._observers]
        self.network: Network | None = None
        self._components: dict[type[Component], Component] = {}
        self._under_construction: list[type[Component]] = []
        self._cycle_times: dict[str, CycleTimes] | None = None
        self._is_stopping: Callable[[], bool] = bool
        """Whether the run ends after this iteration, so that nothing may hold it up."""
        self._has_lost_output = False
        """Whether a record could not be written."""
        self._is_time_stopped = self._is_closed = False
        self._hold_failures: set[str] = set()
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
        self._read_environment()

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

    def watch(
        self,
        address: str | int = 0,
        *,
        token: str = "",
        control: bool = False,
        without_hold: bool = False,
        name: str = "",
    ) -> LiveServer:
        """Let viewers connect (`vicode attach`); the robot never waits for them.

        Args:
            address: A port on 127.0.0.1, "HOST:PORT", or "unix:PATH"; 0 selects a free port. Roots of one process with
                the same address share a server.
            token: What viewers must know, by default a random text, which is printed; a Unix socket needs none.
            control: Whether viewers may pause the robot and change values and states.
            without_hold: Whether they may also if the world has no `hold`, so that a paused robot keeps moving.
            name: The name of the robot, by default that in the network, or else that of its main component.

        Raises:
            OSError: The address is in use or invalid, the root is watched already, or the world has no `hold`.
        """
        from .live import watch_root  # noqa: PLC0415 - off by default

        return watch_root(self, address, token=token, control=control, without_hold=without_hold, name=name)

    def record(
        self,
        path: str | os.PathLike[str],
        *,
        minutes: float = 5.0,
        values: bool = True,
        design: str = "",
        revision: str = "",
    ) -> Recorder:
        """Keep the last minutes of the run in files next to `path`, until the root is closed; call it before `step`.

        The robot never waits for the disk.

        Args:
            path: The name of the record: `run.jsonl` is written as `run.1.000001.jsonl` and so on.
            minutes: How much is kept, in the time of the root.
            values: Whether to record outputs, variables and parameters, which a replay needs.
            design: The hash of the design, for the header.
            revision: The git revision of the design, for the header.

        Raises:
            OSError: No file can be created there.
        """
        from .recorder import record_root  # noqa: PLC0415 - off by default

        return record_root(self, path, minutes=minutes, values=values, design=design, revision=revision)

    def connect(
        self, name: str, *, team: str = "", fields: Sequence[str] | None = None, on_call: bool = False
    ) -> Network:
        """Connect to other robots, which read and call the components of this one; needs `vicode[net]`.

        Without the variable VICODE_NET_CONFIG, only programs of this machine are found.

        Args:
            name: The name of the robot.
            team: The team, whose robots coordinate their states and share values.
            fields: Attributes of the world to share, by default those that its `team_fields` names.
            on_call: Whether the main component is only stepped while other robots call it.

        Raises:
            NetworkError: zenoh is not installed, a name is invalid, or there is no network.
        """
        from .network import connect_root  # noqa: PLC0415 - off by default

        return connect_root(self, name, team=team, fields=fields, on_call=on_call)

    def hold(self) -> None:
        """Call `hold` of the world, if it has one: the robot stops moving until a later iteration commands it again.

        An exception in it is printed once and not raised, because the caller stops for another reason.
        """
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

    def _read_environment(self) -> None:
        if "VICODE_RECORD" in os.environ:
            from .recorder import record_from_environment  # noqa: PLC0415 - off by default

            record_from_environment(self)
        if "VICODE_NET" in os.environ:
            from .network import connect_from_environment  # noqa: PLC0415 - off by default

            connect_from_environment(self)
        if "VICODE_WATCH" in os.environ:
            from .live import watch_from_environment  # noqa: PLC0415 - off by default

            watch_from_environment(self)

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

    def _add_observer(self, observer: Observer) -> None:
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
