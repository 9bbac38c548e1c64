"""The protocol round-trips, and malformed lines are rejected without a traceback."""

import json
from dataclasses import asdict, replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vicode.simulation import (
    Failed,
    Inspected,
    IterationResult,
    ProtocolError,
    Ready,
    Request,
    Setup,
    StopConditions,
    Stopped,
    Stub,
    StubOutput,
    decode_response,
    encode_request,
    encode_setup,
)
from vicode.simulation.messages import MAX_MESSAGE_BYTES, decode_request, decode_setup, encode_response
from vicode.simulation.stop_reasons import stop_reason

SETUP = Setup(
    component="lamps.lamp:Lamp",
    probes="lamps._probes",
    path=("a", "b"),
    stubs=(Stub(component="Eye", outputs=(StubOutput(name="seen", type="bool", value=False),)),),
    functions=(("eye", ("toward",)),),
    parameter_types=(("patience", "float"),),
    world="w:W",
    seed=3,
)


def iteration(number: int, state: str, *, world: object = None, **more: object) -> IterationResult:
    tree = [{"component": "Lamp", "state": state, **more}]
    return IterationResult(iteration=number, time_ns=0, tree=tree, world=world)


MOMENT = replace(iteration(1, "Dark"), prints=["Ä\n"], guards={"Dark/0": {"holds": None}})


def test_setup_and_requests_round_trip() -> None:
    assert decode_setup(encode_setup(SETUP)) == SETUP
    request = Request(
        kind="run", count=3, inputs={"Eye": {"seen": True}}, stops=StopConditions(states=("Lit",), errors=True)
    )
    assert decode_request(encode_request(request)) == request


@pytest.mark.parametrize(
    "answer",
    [
        Ready(),
        MOMENT,
        Inspected(guards={"a": {"holds": True}}),
        Stopped(reason="count"),
        Failed(message="no", error={"line": 3}, prints=["x"]),
    ],
)
def test_responses_round_trip(answer: Ready | IterationResult | Inspected | Stopped | Failed) -> None:
    line = encode_response(answer)
    assert line.count(b"\n") == 1
    assert decode_response(line) == answer


def test_an_iteration_above_the_size_limit_omits_its_values() -> None:
    large = iteration(2, "Lit", world="x" * MAX_MESSAGE_BYTES)
    told = decode_response(encode_response(large))
    assert isinstance(told, IterationResult)
    assert (told.iteration, told.state, told.world) == (2, "Lit", None)
    assert "too large" in told.prints[0]


@pytest.mark.parametrize(
    "line",
    [
        b"",
        b"\xff",
        b"[]",
        b'"ready"',
        b"{}",
        b'{"kind":"nothing"}',
        b'{"kind":"iteration"}',
        b'{"kind":"iteration","iteration":"1","time_ns":0,"tree":[{"component":"Lamp","state":"Dark"}]}',
        b'{"kind":"iteration","iteration":1,"time_ns":0,"tree":[]}',
        b'{"kind":"iteration","iteration":1,"time_ns":0,"tree":[{"component":"Lamp","state":4}]}',
        b'{"kind":"stopped","reason":4}',
        b'{"kind":"ready","more":1}',
        b"[" * 100_000,
    ],
)
def test_malformed_lines_are_rejected(line: bytes) -> None:
    for decode in (decode_response, decode_request, decode_setup):
        with pytest.raises(ProtocolError):
            decode(line)


@pytest.mark.parametrize("name", sorted(asdict(MOMENT).keys() - {"kind", "world"}))
def test_a_value_of_another_type_is_rejected(name: str) -> None:
    with pytest.raises(ProtocolError, match=f"type: {name}"):
        decode_response(json.dumps({**asdict(MOMENT), name: 1.5}).encode())


_JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=8), inner, max_size=4),
    max_leaves=8,
)
_NAMES = st.sampled_from(["kind", "iteration", "time_ns", "state", "tree", "guards", "stops", "stubs", "path"])


@given(st.dictionaries(_NAMES, _JSON | st.sampled_from(["ready", "iteration", "failed"])))
def test_any_line_decodes_or_raises_a_protocol_error(plain: dict[str, object]) -> None:
    line = json.dumps(plain).encode()
    for decode in (decode_response, decode_request, decode_setup):
        try:
            decode(line)
        except ProtocolError:
            continue


def test_stop_reasons_have_priorities() -> None:
    moment = iteration(4, "Lit", changed_from="Dark", transition="Dark/0", done=True)
    every = StopConditions(states=("Lit",), transitions=("Dark/0",), changes=True)
    assert stop_reason(moment, every, was_done=False) == "transition"
    assert stop_reason(moment, StopConditions(states=("Lit",), changes=True), was_done=False) == "state"
    assert stop_reason(moment, StopConditions(changes=True), was_done=False) == "done"
    assert stop_reason(moment, StopConditions(changes=True), was_done=True) == "change"
    assert stop_reason(moment, StopConditions(), was_done=True) == ""
