"""The protocol between the editor and the process that runs a component: one JSON object per line in each direction.

The editor sends a setup, then requests. Each request is answered by any number of iterations and a final response.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from typing import Any, Literal

Inputs = Mapping[str, Mapping[str, Any]]
"""Values by component and output; component "" stands for the parameters of the root component."""

MAX_MESSAGE_BYTES = 4_000_000


class ProtocolError(ValueError):
    """A line that does not follow the protocol."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StubOutput:
    """An output of a stub. `type` is bool, int, float or the name of an enumeration; `value` is the initial value.

    An output that `is_live` changes at once, and not when its component is stepped.
    """

    name: str
    type: str
    value: Any
    is_function: bool = False
    is_live: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Stub:
    """A component whose outputs are set by the user.

    They change when the component is stepped, or at once if `is_live`: the outputs of a generated class need no steps.
    """

    component: str
    outputs: tuple[StubOutput, ...] = ()
    is_live: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Setup:
    """What to run. Classes are named `module:Class`; `functions` are outputs with arguments, by alias.

    `folder` holds only files generated for this run; it is deleted when the editor disconnects.
    """

    component: str
    probes: str
    path: tuple[str, ...]
    stubs: tuple[Stub, ...] = ()
    functions: tuple[tuple[str, tuple[str, ...]], ...] = ()
    parameter_types: tuple[tuple[str, str], ...] = ()
    folder: str = ""
    world: str = ""
    seed: int = 0
    tick_ns: int = 20_000_000
    limit_s: float = 2.0
    memory_bytes: int = 1 << 30


@dataclass(frozen=True, slots=True, kw_only=True)
class StopConditions:
    """When to stop early: on entering states, on transitions, on any state change, on errors."""

    states: tuple[str, ...] = ()
    transitions: tuple[str, ...] = ()
    changes: bool = False
    errors: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Start:
    """A recorded iteration from which a run continues.

    Attributes:
        iteration: Its number.
        time_ns: Its time.
        tree: Its steps.
        values: The latest values of each component.
        worked_ns: When each component worked last.
    """

    iteration: int
    time_ns: int
    tree: list[dict[str, Any]]
    values: dict[str, dict[str, Any]]
    worked_ns: dict[str, int]


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """`run` makes up to `count` iterations, `inspect` only evaluates the guards; both set the inputs first.

    With `suppress_events`, a run reports only its last iteration. A `script` has the inputs before each iteration and
    `times_ns` their times, if they were recorded; `start` is where a recorded run is entered.
    """

    kind: Literal["run", "inspect"]
    inputs: Inputs = field(default_factory=dict)
    count: int = 1
    stops: StopConditions = field(default_factory=StopConditions)
    suppress_events: bool = False
    script: tuple[Inputs, ...] = ()
    times_ns: tuple[int, ...] = ()
    start: Start | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Ready:
    """The component is created."""

    kind: Literal["ready"] = "ready"


@dataclass(frozen=True, slots=True, kw_only=True)
class IterationResult:
    """The record of one iteration as in a trace (docs/traces.md), and what only a simulation knows.

    `finished` is reported by the world. `guards` are those of the active state by decision: `holds` is true, false or
    unknown (None), `parts` the same for each condition, `reads` the values of names. `calls` are calls of functions of
    stubs. `component` is the one that `state` and its neighbors describe, by default the root. `changes` are the state
    changes since the iteration before, if some were missed. `still_done` is None if it was not recorded.
    """

    iteration: int
    time_ns: int
    tree: list[dict[str, Any]]
    errors: list[dict[str, Any]] = field(default_factory=list)
    inputs: dict[str, dict[str, Any]] = field(default_factory=dict)
    world: Any = None
    finished: bool = False
    guards: dict[str, dict[str, Any]] = field(default_factory=dict)
    prints: list[str] = field(default_factory=list)
    omitted_lines: int = 0
    calls: list[dict[str, Any]] = field(default_factory=list)
    component: str = ""
    changes: list[dict[str, Any]] = field(default_factory=list)
    still_done: list[str] | None = None
    kind: Literal["iteration"] = "iteration"

    @property
    def step(self) -> Mapping[str, Any]:
        """The last step of the component; empty if it was not stepped."""
        if not self.component:
            return self.tree[0]
        return next((step for step in reversed(self.tree) if step["component"] == self.component), {})

    def values(self) -> dict[str, dict[str, Any] | None]:
        """The recorded values by component (None: not recorded): its inputs, and then those of each step."""
        found: dict[str, dict[str, Any] | None] = dict(self.inputs)
        for step in self.tree:
            name, known = str(step["component"]), found.get(str(step["component"]))
            found[name] = step.get("values") if known is None else {**known, **(step.get("values") or {})}
        return found

    @property
    def state(self) -> str:
        """The state of the component; "" if it was not stepped."""
        return str(self.step.get("state", ""))

    @property
    def changed_from(self) -> str | None:
        """The state that the component left."""
        return self.step.get("changed_from")

    @property
    def transition(self) -> str | None:
        """The transition that the component took."""
        return self.step.get("transition")

    @property
    def worked(self) -> bool:
        """Whether the period of the component had elapsed."""
        return self.step.get("worked") is True

    @property
    def done(self) -> bool:
        """Whether the component is in a final state."""
        return self.step.get("done") is True


@dataclass(frozen=True, slots=True, kw_only=True)
class Inspected:
    """The current truth values of the guards, evaluated without a step."""

    guards: dict[str, dict[str, Any]]
    kind: Literal["inspected"] = "inspected"


@dataclass(frozen=True, slots=True, kw_only=True)
class Stopped:
    """A run ended after all steps or early: state, transition, change, error, done or finished."""

    reason: str
    kind: Literal["stopped"] = "stopped"


@dataclass(frozen=True, slots=True, kw_only=True)
class Failed:
    """The run cannot continue. `error` is the record with the location in the design, if known."""

    message: str
    error: dict[str, Any] | None = None
    prints: list[str] = field(default_factory=list)
    kind: Literal["failed"] = "failed"


Response = Ready | IterationResult | Inspected | Stopped | Failed
_RESPONSES: dict[str, type[Response]] = {
    "ready": Ready,
    "iteration": IterationResult,
    "inspected": Inspected,
    "stopped": Stopped,
    "failed": Failed,
}
_FIELD_TYPES: dict[str, type | tuple[type, ...]] = {
    "iteration": int,
    "time_ns": int,
    "finished": bool,
    "guards": dict,
    "inputs": dict,
    "prints": list,
    "omitted_lines": int,
    "errors": list,
    "calls": list,
    "component": str,
    "changes": list,
    "still_done": (list, type(None)),
    "reason": str,
    "message": str,
    "error": (dict, type(None)),
}
_STEP_TYPES: dict[str, type | tuple[type, ...]] = {
    "component": str,
    "state": str,
    "changed_from": (str, type(None)),
    "transition": (str, type(None)),
}


def encode_setup(setup: Setup) -> bytes:
    return _line(asdict(setup))


def decode_setup(line: bytes) -> Setup:
    """Decode the first line.

    Raises:
        ProtocolError: It is not a setup.
    """
    plain = _parse(line)
    try:
        stubs = tuple(
            Stub(**{**each, "outputs": tuple(StubOutput(**output) for output in each["outputs"])})
            for each in plain.pop("stubs")
        )
        functions = tuple((alias, tuple(names)) for alias, names in plain.pop("functions"))
        types = tuple((name, type_) for name, type_ in plain.pop("parameter_types"))
        path = tuple(plain.pop("path"))
        return Setup(stubs=stubs, functions=functions, parameter_types=types, path=path, **plain)
    except (KeyError, TypeError, ValueError) as error:
        raise ProtocolError(f"not a setup: {error}") from error


def encode_request(request: Request) -> bytes:
    return _line(asdict(request))


def decode_request(line: bytes) -> Request:
    """Decode a request.

    Raises:
        ProtocolError: It is not a request.
    """
    plain = _parse(line)
    try:
        stops = plain.pop("stops")
        places: dict[str, Any] = {name: tuple(stops.pop(name)) for name in ("states", "transitions")}
        listed: dict[str, Any] = {name: tuple(plain.pop(name)) for name in ("script", "times_ns")}
        begin = plain.pop("start")
        start = None if begin is None else Start(**begin)
        return Request(stops=StopConditions(**places, **stops), start=start, **listed, **plain)
    except (KeyError, TypeError, AttributeError) as error:
        raise ProtocolError(f"not a request: {error}") from error


def encode_response(answer: Response) -> bytes:
    """Encode a response; values that exceed the size limit are omitted."""
    line = _line(asdict(answer))
    if len(line) <= MAX_MESSAGE_BYTES or not isinstance(answer, IterationResult):
        return line[:MAX_MESSAGE_BYTES]
    few = IterationResult(
        iteration=answer.iteration,
        time_ns=answer.time_ns,
        tree=[{**answer.tree[0], "parameters": {}, "values": {}}],
        prints=["(the values of this iteration are too large to show)"],
    )
    return _line(asdict(few))


def decode_response(line: bytes) -> Response:
    """Decode a response.

    Raises:
        ProtocolError: It is not a response; user code may have written to the pipe.
    """
    return _make_response(_parse(line))


def decode_iteration(plain: Mapping[str, Any]) -> IterationResult:
    """Decode the record of an iteration from a trace; unknown fields are ignored.

    Raises:
        ProtocolError: It is not such a record.
    """
    known = {field.name: plain[field.name] for field in fields(IterationResult) if field.name in plain}
    answer = _make_response({**known, "kind": "iteration"})
    assert isinstance(answer, IterationResult)
    return answer


def _make_response(plain: dict[str, Any]) -> Response:
    make = _RESPONSES.get(str(plain.get("kind")))
    if make is None:
        raise ProtocolError(f"not a response: {str(plain)[:80]}")
    wrong = _wrong_field(plain, _FIELD_TYPES)
    if not wrong and make is IterationResult:
        are_calls = all(isinstance(call, dict) for call in plain.get("calls", ()))
        wrong = _wrong_step(plain.get("tree")) if are_calls else "calls"
    if wrong:
        raise ProtocolError(f"wrong type: {wrong}")
    try:
        return make(**plain)
    except TypeError as error:
        raise ProtocolError(f"no {plain['kind']}: {error}") from error


def _wrong_field(plain: Mapping[str, Any], types: Mapping[str, type | tuple[type, ...]]) -> str:
    return next((name for name, value in plain.items() if name in types and not isinstance(value, types[name])), "")


def _wrong_step(tree: object) -> str:
    if not isinstance(tree, list) or not tree or not all(isinstance(step, dict) for step in tree):
        return "tree"
    for step in tree:
        if wrong := _wrong_field({"component": None, "state": None, **step}, _STEP_TYPES):
            return wrong
    return ""


def _line(plain: dict[str, Any]) -> bytes:
    return json.dumps(plain, separators=(",", ":")).encode() + b"\n"


def _parse(line: bytes) -> dict[str, Any]:
    try:
        plain = json.loads(line)
    except (ValueError, RecursionError) as error:
        raise ProtocolError(f"no JSON: {line[:80]!r}") from error
    if not isinstance(plain, dict):
        raise ProtocolError(f"not an object: {line[:80]!r}")
    return plain
