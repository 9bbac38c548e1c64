"""Random byte streams, and mutations of what robots send; the same for each seed."""

from collections.abc import Iterator
from random import Random

SESSIONS = (
    b"ROBOT:r1\nBEHAVIOR:follow\nAHEAD: 5.25\nLASER: 1.14,2.55,3.54\nINS:1,2,90\nWHISTLE:\nBUTTON:3\nMODE:fast\n",
    b"TOKEN:secret\r\nAHEAD:0.5\r\nBEHAVIOR:crossing\r\nBEHAVIOR:failing\r\nAHEAD:9\r\n",
    b'{"hello": {"robot": "r2", "pace": "client", "team": "a", "priority": 3}}\n{"AHEAD": 5, "tick": 0}\n',
    b'{"hello": {"pace": "client"}, "LASER": [1, 2.5]}\n{"time": 0.04, "INS": [1, 2], "tick": 0.05}\n{"tick": 1}\n',
    b'{"hello": {"robot": "r1"}}\n{"AHEAD": [0.5], "time": 12.5, "WHISTLE": true, "MODE": "slow"}\n{"BUTTON": 1}\n',
    b"TEAM:red,3\nPACE:message\nACK:0\nTIME:12.5\nAHEAD:5\nACK:1\nTIME:12.55\nAHEAD:0.5\nACK:2\n",
    b'{"hello": {"pace": "message", "wait": false}, "ack": 0}\n{"AHEAD": 5, "ack": 0.0}\n{"ack": 0.05, "AHEAD": 1}\n',
)
FRAGMENTS = (
    *(b"\n", b"\r\n", b":", b",", b"{", b"}", b"[", b'"', b"\\", b"\0", b"\xff", b"\xc3\xa9", b" ", b"-", b"."),
    *(b"nan", b"inf", b"1e999", b"-0", b"9" * 400, b"true", b"null", b"[" * 500, b'{"a":' * 300, b"NaN", b"Infinity"),
    *(
        b"AHEAD:",
        b"AHEAD:1\n",
        b"\\ud800",
        b"ERROR:x\n",
        b'"tick": ',
        b'"hello": ',
        b"\n" * 50,
        b"A" * 2000,
        b"A:1\n" * 200,
    ),
)
LARGE = (b"A" * 70_000, b"AHEAD:1\n" * 5_000, b'{"tick": 1}\n' * 400, b"AHEAD:" + b"1," * 40_000 + b"\n")


def make_stream(random: Random) -> bytes:
    """A stream of bytes: noise, or a session with some mutations."""
    if random.random() < 0.15:
        return random.randbytes(random.randrange(200))
    stream = bytearray(random.choice(SESSIONS))
    for _mutation in range(random.randrange(6)):
        _mutate(stream, random)
    if random.random() < 0.002:
        stream += random.choice(LARGE)
    return bytes(stream)


def split_stream(stream: bytes, random: Random) -> Iterator[bytes]:
    """The stream in pieces, as a network may deliver it."""
    begin = 0
    while begin < len(stream):
        size = random.choice((3, 60, 5_000, len(stream)))
        yield stream[begin : begin + size]
        begin += size


def _mutate(stream: bytearray, random: Random) -> None:
    at = random.randrange(len(stream) + 1)
    end = min(len(stream), at + random.choice((1, 1, 3, 20)))
    match random.randrange(5):
        case 0 if at < len(stream):
            stream[at] ^= 1 << random.randrange(8)
        case 1:
            del stream[at:end]
        case 2:
            stream[at:at] = random.choice(FRAGMENTS)
        case 3:
            stream[at:at] = stream[at:end] * random.choice((1, 2, 30))
        case _:
            stream[at:end] = random.randbytes(end - at)
