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

LONGEST_LINE = 4_000_000


class ProtocolError(ValueError):
    """A line that is not part of the protocol."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StandInOutput:
    """An output of a stand-in; `type` is bool, int, float or an enumeration's name, `value` what it begins with."""

    name: str
    type: str
    value: Any
    is_function: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class StandIn:
    """A component whose outputs somebody sets by hand."""

    component: str
    outputs: tuple[StandInOutput, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Setup:
    """What to run. Classes are named module:Class; `functions` are outputs with arguments, by alias.

    `folder` holds nothing but what was generated for this run; it is removed when the other side has gone.
    """

    component: str
    probes: str
    path: tuple[str, ...]
    stand_ins: tuple[StandIn, ...] = ()
    functions: tuple[tuple[str, tuple[str, ...]], ...] = ()
    parameter_types: tuple[tuple[str, str], ...] = ()
    folder: str = ""
    world: str = ""
    seed: int = 0
    tick_ns: int = 20_000_000
    limit_s: float = 2.0
    memory_bytes: int = 1 << 30


@dataclass(frozen=True, slots=True, kw_only=True)
class Stops:
    """Where to rest before all steps are made: on entering states, on transitions, on any change, on errors."""

    states: tuple[str, ...] = ()
    transitions: tuple[str, ...] = ()
    changes: bool = False
    errors: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """`run` makes up to `count` iterations, `look` only tests the guards; both take over inputs first.

    A `quiet` run tells its last moment alone.
    """

    do: Literal["run", "look"]
    inputs: Inputs = field(default_factory=dict)
    count: int = 1
    stops: Stops = field(default_factory=Stops)
    quiet: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Ready:
    """The component is made and waits."""

    kind: Literal["ready"] = "ready"


@dataclass(frozen=True, slots=True, kw_only=True)
class Moment:
    """What happened in one iteration.

    `finished` says the world. `guards` are those of the active state by decision: `holds` is true, false or unknown
    (None), `parts` the same of each condition, `reads` the values of names. `asked` are calls of stand-ins' functions.
    """

    iteration: int
    time_ns: int
    state: str
    came_from: str | None = None
    transition: str | None = None
    worked: bool = True
    done: bool = False
    finished: bool = False
    tree: list[dict[str, Any]] = field(default_factory=list)
    guards: dict[str, dict[str, Any]] = field(default_factory=dict)
    prints: list[str] = field(default_factory=list)
    unprinted: int = 0
    errors: list[dict[str, Any]] = field(default_factory=list)
    asked: list[dict[str, Any]] = field(default_factory=list)
    world: Any = None
    kind: Literal["moment"] = "moment"


@dataclass(frozen=True, slots=True, kw_only=True)
class Looked:
    """The guards as they are now, without a step."""

    guards: dict[str, dict[str, Any]]
    kind: Literal["looked"] = "looked"


@dataclass(frozen=True, slots=True, kw_only=True)
class Rested:
    """A run came to rest: all steps made, or one of state, transition, change, error, done, finished came before."""

    reason: str
    kind: Literal["rested"] = "rested"


@dataclass(frozen=True, slots=True, kw_only=True)
class Failed:
    """It cannot go on; `message` says why in words, `error` is the record of the place in the design, if any."""

    message: str
    error: dict[str, Any] | None = None
    prints: list[str] = field(default_factory=list)
    kind: Literal["failed"] = "failed"


Answer = Ready | Moment | Looked | Rested | Failed
_ANSWERS: dict[str, type[Answer]] = {
    "ready": Ready,
    "moment": Moment,
    "looked": Looked,
    "rested": Rested,
    "failed": Failed,
}
_SHAPES: dict[str, type | tuple[type, ...]] = {
    "iteration": int,
    "time_ns": int,
    "state": str,
    "came_from": (str, type(None)),
    "transition": (str, type(None)),
    "worked": bool,
    "done": bool,
    "finished": bool,
    "tree": list,
    "guards": dict,
    "prints": list,
    "unprinted": int,
    "errors": list,
    "asked": list,
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
            StandIn(component=each["component"], outputs=tuple(StandInOutput(**output) for output in each["outputs"]))
            for each in plain.pop("stand_ins")
        )
        functions = tuple((alias, tuple(names)) for alias, names in plain.pop("functions"))
        types = tuple((name, type_) for name, type_ in plain.pop("parameter_types"))
        path = tuple(plain.pop("path"))
        return Setup(stand_ins=stand_ins, functions=functions, parameter_types=types, path=path, **plain)
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
        return Request(stops=Stops(**places, **stops), **plain)
    except (KeyError, TypeError, AttributeError) as error:
        raise ProtocolError(f"no request: {error}") from error


def encode_answer(answer: Answer) -> bytes:
    """The line of an answer; a moment with too much to tell leaves the values out."""
    line = _line(asdict(answer))
    if len(line) <= LONGEST_LINE or not isinstance(answer, Moment):
        return line[:LONGEST_LINE]
    few = Moment(
        iteration=answer.iteration,
        time_ns=answer.time_ns,
        state=answer.state,
        came_from=answer.came_from,
        transition=answer.transition,
        prints=["(the values of this iteration are too large to be shown)"],
    )
    return _line(asdict(few))


def decode_answer(line: bytes) -> Answer:
    """Read an answer; what user code may have slipped in between is refused.

    Raises:
        ProtocolError: It is none.
    """
    plain = _parse(line)
    make = _ANSWERS.get(str(plain.get("kind")))
    if make is None:
        raise ProtocolError(f"no answer: {line[:80]!r}")
    wrong = [name for name, value in plain.items() if name in _SHAPES and not isinstance(value, _SHAPES[name])]
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
