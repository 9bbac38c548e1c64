"""Frames: bytes to messages and back, for any chunks and any junk."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vicode.bridge.frames import (
    MAX_LINE_BYTES,
    FrameError,
    LineDecoder,
    decode_json,
    decode_jxi,
    encode_json,
    encode_jxi,
    split_parameters,
)


def test_the_lines_of_the_thesis() -> None:
    target, parameters = decode_jxi(b"LASER: 1.14,2.55,3.54,5.54,2.99,1.44")
    assert target == "LASER"
    assert split_parameters(parameters) == ["1.14", "2.55", "3.54", "5.54", "2.99", "1.44"]
    assert encode_jxi("DIFFERENTIALDRIVE", (5.0, 1)) == b"DIFFERENTIALDRIVE:5,1\n"


@pytest.mark.parametrize(
    ("parameters", "line"),
    [
        ((0.1, -0.0), b"A:0.1,0\n"),
        ((1e300,), b"A:1e+300\n"),
        ((True, False), b"A:true,false\n"),
        (("a,b\nc",), b"A:a b c\n"),
        ((), b"A:\n"),
    ],
)
def test_a_command_as_a_line(parameters: tuple[object, ...], line: bytes) -> None:
    assert encode_jxi("A", parameters) == line


@pytest.mark.parametrize("line", [b"", b"LASER", b":1", b"a b:1", b"1A:1", b"\xff:1", b"A" * 65 + b":1"])
def test_a_line_without_a_target_is_an_error(line: bytes) -> None:
    with pytest.raises(FrameError, match="expected TARGET:p1,p2"):
        decode_jxi(line)


@pytest.mark.parametrize(
    "line", [b"{", b"[]", b"1", b'{"a": NaN}', b"[" * 60_000, b"\xff", b'{"a": ' + b"9" * 5000 + b"}"]
)
def test_a_line_that_is_no_json_object_is_an_error(line: bytes) -> None:
    with pytest.raises(FrameError, match="expected a JSON object"):
        decode_json(line)


def test_json_lines() -> None:
    assert decode_json(b'{"LASER": [1.1, 2.2], "time": 3}') == {"LASER": [1.1, 2.2], "time": 3}
    assert encode_json({"commands": {"WAIT": [1]}}) == b'{"commands":{"WAIT":[1]}}\n'
    with pytest.raises(ValueError):
        encode_json({"a": float("nan")})


def test_a_line_that_is_too_long_is_an_error_and_the_next_one_is_read() -> None:
    decoder = LineDecoder()
    lines = [line for _chunk in range(40) for line in decoder.feed(b"A" * 10_000)]
    lines += decoder.feed(b"A\nLASER:1\n")
    assert [len(line) for line in lines] == [MAX_LINE_BYTES + 1, 7]
    with pytest.raises(FrameError, match="at most 65536 bytes"):
        decode_jxi(lines[0])
    with pytest.raises(FrameError, match="at most 65536 bytes"):
        decode_json(lines[0])


@given(st.binary(max_size=300), st.lists(st.integers(1, 40)))
def test_chunks_do_not_matter(data: bytes, sizes: list[int]) -> None:
    whole = LineDecoder().feed(data)
    decoder, parts, begin = LineDecoder(), list[bytes](), 0
    for size in [*sizes, len(data)]:
        parts += decoder.feed(data[begin : begin + size])
        begin += size
    assert parts == whole == [line for line in (each.rstrip(b"\r") for each in data.split(b"\n")[:-1]) if line]


@given(st.binary(max_size=200))
def test_any_line_is_a_message_or_an_error_of_one_line(line: bytes) -> None:
    for decode in (decode_jxi, decode_json):
        message = ""
        try:
            decode(line)
        except FrameError as error:
            message = str(error)
        assert message.replace("…", "").isascii()
        assert message.isprintable()


@given(st.lists(st.floats(allow_nan=False) | st.integers(-(2**53), 2**53), min_size=1))
def test_numbers_survive(numbers: list[float]) -> None:
    _target, parameters = decode_jxi(encode_jxi("A", numbers).rstrip(b"\n"))
    assert [float(each) for each in split_parameters(parameters)] == numbers
