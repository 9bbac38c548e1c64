"""Inputs as text: what can be written, what is refused and where, and that both directions agree."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vicode.model.design import Design, State, Use
from vicode.runs.input_script import (
    InputTextError,
    TimedInput,
    format_input,
    make_script,
    parse_input,
    parse_input_lines,
)
from vicode.runs.inputs import SimulationInput

DESIGN = Design(
    component="Lamp", initial="Dark", states=(State(name="Dark"),), uses=(Use(alias="eye", component="Eye"),)
)
INPUTS = (
    SimulationInput(component="", name="patience", type="float", initial=0.06),
    SimulationInput(component="Eye", name="seen", type="bool", initial=False),
    SimulationInput(component="Eye", name="level", type="float", initial=0.0),
    SimulationInput(component="Bulb", name="level", type="int", initial=0),
    SimulationInput(component="Eye", name="mood", type="", initial="Mood.calm", options=("Mood.calm", "Mood.angry")),
    SimulationInput(component="Eye", name="toward", type="float", initial=0.0, arguments=("x",)),
)


@pytest.mark.parametrize(
    ("text", "time_ns", "key", "value"),
    [
        ("seen=true", 0, ("Eye", "seen"), True),
        (" Eye.seen = false ", 0, ("Eye", "seen"), False),
        ("eye.level=-0.5", 0, ("Eye", "level"), -0.5),
        ("Bulb.level=3", 0, ("Bulb", "level"), 3),
        ("patience=1e-3", 0, ("", "patience"), 0.001),
        ("mood=angry", 0, ("Eye", "mood"), "Mood.angry"),
        ("mood = Mood.angry", 0, ("Eye", "mood"), "Mood.angry"),
        ("2.5 s: seen=true", 2_500_000_000, ("Eye", "seen"), True),
        ("2.5: seen=true", 2_500_000_000, ("Eye", "seen"), True),
        ("20ms:seen=true", 20_000_000, ("Eye", "seen"), True),
        ("0.000000001 s: seen=true", 1, ("Eye", "seen"), True),
        (".1 s: seen=true", 100_000_000, ("Eye", "seen"), True),
        ("toward=2", 0, ("Eye", "toward"), 2.0),
    ],
)
def test_inputs_are_read(text: str, time_ns: int, key: tuple[str, str], value: object) -> None:
    found = parse_input(text, INPUTS, DESIGN)
    assert (found.time_ns, found.input.key, found.value) == (time_ns, key, value)


@pytest.mark.parametrize(
    ("text", "column", "message"),
    [
        ("seen", 1, "'seen' has no '='"),
        ("1 s: seen", 1, "has no '='"),
        ("sen=true", 1, "there is no input 'sen'; there are patience, Eye.seen"),
        ("  sen=true", 3, "there is no input 'sen'"),
        ("Bulb.seen=true", 1, "there is no input 'Bulb.seen'"),
        ("level=1", 1, "'level' may be Eye.level, Bulb.level; write one of them"),
        ("seen=yes", 6, "'yes' is no value of Eye.seen: it must be true or false"),
        ("1 s: Eye.seen = 1", 17, "it must be true or false"),
        ("mood=sad", 6, "it must be calm, angry"),
        ("Eye.level=nan", 11, "it must be a number"),
        ("Eye.level=", 11, "it must be a number"),
        ("Bulb.level=1.5", 12, "it must be an integer"),
        ("-1 s: seen=true", 1, "there is no input '-1 s: seen'"),
    ],
)
def test_what_cannot_be_read_is_refused_at_its_column(text: str, column: int, message: str) -> None:
    with pytest.raises(InputTextError) as caught:
        parse_input(text, INPUTS, DESIGN)
    assert message in str(caught.value)
    assert caught.value.column == column


def test_a_file_names_the_line() -> None:
    assert [each.value for each in parse_input_lines("# start\n\nseen=true\n", INPUTS, DESIGN)] == [True]
    with pytest.raises(InputTextError, match=r"^3:9: 'x' is no value of Eye.seen"):
        parse_input_lines("seen=true\n\n seen = x\n", INPUTS, DESIGN)


def test_the_last_value_of_a_time_counts() -> None:
    lines = "2 s: seen=true\nseen=true\nEye.level=1\n2 s: seen=false\n"
    assert make_script(parse_input_lines(lines, INPUTS, DESIGN)) == [
        (0, {"Eye": {"seen": True, "level": 1.0}}),
        (2_000_000_000, {"Eye": {"seen": False}}),
    ]


@given(
    st.integers(0, 10**13),
    st.one_of(
        st.tuples(st.just(INPUTS[1]), st.booleans()),
        st.tuples(st.just(INPUTS[3]), st.integers(-(10**12), 10**12)),
        st.tuples(st.just(INPUTS[4]), st.sampled_from(INPUTS[4].options)),
        st.tuples(st.just(INPUTS[2]), st.floats(-1e12, 1e12).map(lambda number: float(f"{number:.12g}"))),
    ),
)
def test_what_is_written_is_read_again(time_ns: int, pair: tuple[SimulationInput, object]) -> None:
    timed = TimedInput(time_ns=time_ns, input=pair[0], value=pair[1])
    text = format_input(timed)
    assert text is not None
    assert parse_input(text, INPUTS, DESIGN) == timed
