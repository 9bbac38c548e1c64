"""A running robot: its description and what was received of it."""

import time
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from vicode.robots import RobotDescription
from vicode.simulation import IterationResult
from vicode.simulation.messages import decode_iteration

if TYPE_CHECKING:
    from vicode.runs import Recording

_MAX_SEEDED = 600
_RATE_WINDOW = 60

Adapt = Callable[[IterationResult], IterationResult]


@dataclass(frozen=True, slots=True, kw_only=True)
class SeenStep:
    """The latest step of a component, and when it arrived."""

    step: Mapping[str, Any]
    iteration: int
    received_s: float


@dataclass(eq=False, kw_only=True)
class WatchedRobot:
    """One robot of a server, and what was received of it."""

    description: RobotDescription
    iteration: IterationResult | None = None
    received_s: float = 0.0
    is_paused: bool = False
    error_count: int = 0
    missed: int = 0
    steps: dict[str, SeenStep] = field(default_factory=dict)
    """The latest step of each component."""
    held: dict[tuple[str, str], Any] = field(default_factory=dict)
    """Values that are held from here, by component and name."""
    tuned: dict[str, Any] = field(default_factory=dict)
    """Constants that were tuned from here."""
    written: dict[tuple[str, str], tuple[str, str]] = field(default_factory=dict)
    """Values that were written into the files from here: the texts before and after, by component and name."""
    frequencies_hz: dict[str, float] = field(default_factory=dict)
    """Frequencies of components that were changed from here."""
    _recordings: dict[str, tuple["Recording", Adapt]] = field(default_factory=dict)
    _times: deque[tuple[int, int]] = field(default_factory=lambda: deque(maxlen=_RATE_WINDOW))

    @property
    def name(self) -> str:
        return self.description.name

    @property
    def root_state(self) -> str:
        seen = self.steps.get(self.description.root)
        return str(seen.step.get("state", "")) if seen else ""

    @property
    def iteration_number(self) -> int:
        return self.iteration.iteration if self.iteration else 0

    @property
    def iteration_hz(self) -> float:
        """Iterations per second in the time of the robot; 0 if unknown."""
        (first, first_ns), (last, last_ns) = (self._times[0], self._times[-1]) if self._times else ((0, 0), (0, 0))
        return (last - first) * 1e9 / (last_ns - first_ns) if last_ns > first_ns else 0.0

    @property
    def longest_recording(self) -> "Recording | None":
        """The recording of the most iterations; which component it is for does not matter for a replay."""
        return max((recording for recording, _adapt in self._recordings.values()), key=len, default=None)

    def recording(self, component: str, adapt: Adapt) -> "Recording":
        """The recording for the view of a component, which begins with what other views have recorded.

        Args:
            component: The component.
            adapt: Makes an iteration describe the component; the latest one given is used.
        """
        # An editor that is not attached starts without the simulation.
        from vicode.runs import Recording  # noqa: PLC0415

        known = self._recordings.get(component)
        recording = known[0] if known else Recording()
        self._recordings[component] = (recording, adapt)
        if known is None and len(self._recordings) > 1:
            source = next(iter(self._recordings.values()))[0]
            for number in range(max(1, len(source) - _MAX_SEEDED), len(source) + 1):
                iteration = source.iteration(number)
                if iteration is not None:
                    recording.add(adapt(iteration), {})
        return recording

    def add(self, message: Mapping[str, Any]) -> None:
        """Add a message with an iteration.

        Raises:
            ProtocolError: It is no iteration.
        """
        iteration = replace(decode_iteration(message), changes=list(message.get("changes", ())))
        before, self.iteration, self.received_s = self.iteration, iteration, time.monotonic()
        self.is_paused = message.get("paused") is True
        self.error_count = int(message.get("errors_total", 0))
        self.missed += int(message.get("missed", 0))
        if before is not None and iteration.iteration == before.iteration:
            return
        if before is not None and iteration.iteration < before.iteration:
            # The robot was started again.
            self._recordings.clear()
            self._times.clear()
            self.steps.clear()
            self.tuned.clear()
            self.written.clear()
            self.frequencies_hz.clear()
        self._times.append((iteration.iteration, iteration.time_ns))
        for step in iteration.tree:
            seen = SeenStep(step=step, iteration=iteration.iteration, received_s=self.received_s)
            self.steps[str(step["component"])] = seen
        for recording, adapt in self._recordings.values():
            recording.make_room()
            recording.add(adapt(iteration), {})

    def values_of(self, component: str) -> dict[str, Any]:
        """The newest values of a component: of its step, or of the inputs; empty if none were received."""
        seen, inputs = self.steps.get(component), self.iteration.inputs if self.iteration else {}
        if component in inputs and not self.is_active(component):
            return inputs[component]
        return (seen.step.get("values") or {}) if seen else {}

    def note_request(self, do: str, fields: Mapping[str, Any]) -> None:
        """Note what a request has changed; the robot does not send it, or not until its next iteration."""
        component, name, value = str(fields.get("component")), str(fields.get("name")), fields.get("value")
        match do:
            case "set":
                values = {**self.values_of(component), name: value}
                self._change_step(component, values=values)
                if self.iteration is not None and component in self.iteration.inputs:
                    self.iteration = replace(self.iteration, inputs={**self.iteration.inputs, component: values})
                self.held |= {(component, name): value} if fields.get("hold") else {}
            case "unset":
                self.held.pop((component, name), None)
            case "enter":
                self._change_step(component, state=fields["state"])
            case "tune":
                self.tuned[name] = value
            case "frequency":
                self.frequencies_hz[component] = fields["hz"]

    def remember_written(self, key: tuple[str, str], before: str, after: str) -> None:
        """Remember that the robot has a value that was written into its file, which had another one."""
        known = self.written.get(key)
        first = known[0] if known is not None and known[1] == before else before
        self.written[key] = (first, after)

    def release_all(self) -> None:
        """Forget the held values: they ended with the connection. Constants of the robot stay as they are."""
        self.written = {key: texts for key, texts in self.written.items() if key not in self.held}
        self.held.clear()

    def frequency_hz(self, component: str) -> float | None:
        """The frequency of a component; None if it works in each iteration."""
        described = self.description.components.get(component)
        return self.frequencies_hz.get(component) or (described.frequency_hz if described else None)

    def is_active(self, component: str) -> bool:
        """Whether the component was stepped in the newest iteration."""
        seen = self.steps.get(component)
        return seen is not None and self.iteration is not None and seen.iteration == self.iteration.iteration

    def _change_step(self, component: str, **changed: Any) -> None:
        if (seen := self.steps.get(component)) is not None:
            self.steps[component] = replace(seen, step={**seen.step, **changed})
