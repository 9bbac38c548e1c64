"""The protocol between an editor and the process that runs a component: one JSON object a line, each way.

A setup comes first, then requests; every request is answered by any number of moments and an end of its own.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any, Literal

Inputs = Mapping[str, Mapping[str, Any]]
"""Values by component and output; component "" stands for the parameters of the root component."""

MAX_MESSAGE_BYTES = 4_000_000


class ProtocolError(ValueError):
    """A line that is not part of the protocol."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StubOutput:
    """An output of a stand-in; `type` is bool, int, float or an enumeration's name, `value` what it begins with."""

    name: str
    type: str
    value: Any
    is_function: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Stub:
    """A component whose outputs somebody sets by hand."""

    component: str
    outputs: tuple[StubOutput, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Setup:
    """What to run. Classes are named module:Class; `functions` are outputs with arguments, by alias.

    `folder` holds nothing but what was generated for this run; it is removed when the other side has gone.
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
    """Where to rest before all steps are made: on entering states, on transitions, on any change, on errors."""

    states: tuple[str, ...] = ()
    transitions: tuple[str, ...] = ()
    changes: bool = False
    errors: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """`run` makes up to `count` iterations, `look` only tests the guards; both take over inputs first.

    A `suppress_events` run tells its last moment alone.
    """

    kind: Literal["run", "inspect"]
    inputs: Inputs = field(default_factory=dict)
    count: int = 1
    stops: StopConditions = field(default_factory=StopConditions)
    suppress_events: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Ready:
    """The component is made and waits."""

    kind: Literal["ready"] = "ready"


@dataclass(frozen=True, slots=True, kw_only=True)
class IterationResult:
    """What happened in one iteration.

    `finished` says the world. `guards` are those of the active state by decision: `holds` is true, false or unknown
    (None), `parts` the same of each condition, `reads` the values of names. `calls` are calls of stand-ins' functions.
    """

    iteration: int
    time_ns: int
    state: str
    changed_from: str | None = None
    transition: str | None = None
    worked: bool = True
    done: bool = False
    finished: bool = False
    tree: list[dict[str, Any]] = field(default_factory=list)
    guards: dict[str, dict[str, Any]] = field(default_factory=dict)
    prints: list[str] = field(default_factory=list)
    omitted_lines: int = 0
    errors: list[dict[str, Any]] = field(default_factory=list)
    calls: list[dict[str, Any]] = field(default_factory=list)
    world: Any = None
    kind: Literal["iteration"] = "iteration"


@dataclass(frozen=True, slots=True, kw_only=True)
class Inspected:
    """The guards as they are now, without a step."""

    guards: dict[str, dict[str, Any]]
    kind: Literal["inspected"] = "inspected"


@dataclass(frozen=True, slots=True, kw_only=True)
class Stopped:
    """A run came to rest: all steps made, or one of state, transition, change, error, done, finished came before."""

    reason: str
    kind: Literal["stopped"] = "stopped"


@dataclass(frozen=True, slots=True, kw_only=True)
class Failed:
    """It cannot go on; `message` says why in words, `error` is the record of the place in the design, if any."""

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
    "state": str,
    "changed_from": (str, type(None)),
    "transition": (str, type(None)),
    "worked": bool,
    "done": bool,
    "finished": bool,
    "tree": list,
    "guards": dict,
    "prints": list,
    "omitted_lines": int,
    "errors": list,
    "calls": list,
    "reason": str,
    "message": str,
    "error": (dict, type(None)),
}


def encode_setup(setup: Setup) -> bytes:
    """The line that begins a conversation."""
    return _line(asdict(setup))


def decode_setup(line: bytes) -> Setup:
    """Read the first line.

    Raises:
        ProtocolError: It is none.
    """
    plain = _parse(line)
    try:
        stand_ins = tuple(
            Stub(component=each["component"], outputs=tuple(StubOutput(**output) for output in each["outputs"]))
            for each in plain.pop("stubs")
        )
        functions = tuple((alias, tuple(names)) for alias, names in plain.pop("functions"))
        types = tuple((name, type_) for name, type_ in plain.pop("parameter_types"))
        path = tuple(plain.pop("path"))
        return Setup(stubs=stand_ins, functions=functions, parameter_types=types, path=path, **plain)
    except (KeyError, TypeError, ValueError) as error:
        raise ProtocolError(f"no setup: {error}") from error


def encode_request(request: Request) -> bytes:
    """The line of a request."""
    return _line(asdict(request))


def decode_request(line: bytes) -> Request:
    """Read a request.

    Raises:
        ProtocolError: It is none.
    """
    plain = _parse(line)
    try:
        stops = plain.pop("stops")
        places: dict[str, Any] = {name: tuple(stops.pop(name)) for name in ("states", "transitions")}
        return Request(stops=StopConditions(**places, **stops), **plain)
    except (KeyError, TypeError, AttributeError) as error:
        raise ProtocolError(f"no request: {error}") from error


def encode_response(answer: Response) -> bytes:
    """The line of an answer; a moment with too much to tell leaves the values out."""
    line = _line(asdict(answer))
    if len(line) <= MAX_MESSAGE_BYTES or not isinstance(answer, IterationResult):
        return line[:MAX_MESSAGE_BYTES]
    few = IterationResult(
        iteration=answer.iteration,
        time_ns=answer.time_ns,
        state=answer.state,
        changed_from=answer.changed_from,
        transition=answer.transition,
        prints=["(the values of this iteration are too large to be shown)"],
    )
    return _line(asdict(few))


def decode_response(line: bytes) -> Response:
    """Read an answer; what user code may have slipped in between is refused.

    Raises:
        ProtocolError: It is none.
    """
    plain = _parse(line)
    make = _RESPONSES.get(str(plain.get("kind")))
    if make is None:
        raise ProtocolError(f"no answer: {line[:80]!r}")
    wrong = [
        name for name, value in plain.items() if name in _FIELD_TYPES and not isinstance(value, _FIELD_TYPES[name])
    ]
    if wrong:
        raise ProtocolError(f"not of its type: {wrong[0]}")
    try:
        return make(**plain)
    except TypeError as error:
        raise ProtocolError(f"no {plain['kind']}: {error}") from error


def _line(plain: dict[str, Any]) -> bytes:
    return json.dumps(plain, separators=(",", ":")).encode() + b"\n"


def _parse(line: bytes) -> dict[str, Any]:
    try:
        plain = json.loads(line)
    except (ValueError, RecursionError) as error:
        raise ProtocolError(f"no JSON: {line[:80]!r}") from error
    if not isinstance(plain, dict):
        raise ProtocolError(f"no object: {line[:80]!r}")
    return plain
