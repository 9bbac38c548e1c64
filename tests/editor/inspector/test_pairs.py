"""Lines `name = expression`: read, refused with a reason, and never half understood."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vicode.editor.session.forms.pairs import find_error, find_lost_pairs, format_pairs, parse_pairs

NAMES = st.from_regex(r"[a-z_][a-z0-9_]{0,4}(\.[a-z]{1,3})?", fullmatch=True)
VALUES = st.from_regex(r"[a-z0-9(][-a-z0-9 <>+*().=:?]{0,8}[a-z0-9)]", fullmatch=True)
PAIRS = st.lists(st.tuples(NAMES, VALUES), unique_by=lambda pair: pair[0], max_size=4).map(tuple)


@given(PAIRS)
def test_pairs_survive_the_way_through_the_text(pairs: tuple[tuple[str, str], ...]) -> None:
    text = format_pairs(pairs)
    assert find_error(text) == ""
    assert parse_pairs(text) == pairs
    assert find_lost_pairs(pairs) == ""


@pytest.mark.parametrize(
    ("text", "pairs"),
    [
        ("", ()),
        ("\n\n", ()),
        ("speed = 0.5", (("speed", "0.5"),)),
        ("speed: 0.5\n\n  turn=1  ", (("speed", "0.5"), ("turn", "1"))),
        ("near = x == 1", (("near", "x == 1"),)),
        ("near: x == 1", (("near", "x == 1"),)),
        ("lamp.on = a if b else c", (("lamp.on", "a if b else c"),)),
    ],
)
def test_lines_are_read(text: str, pairs: tuple[tuple[str, str], ...]) -> None:
    assert find_error(text) == ""
    assert parse_pairs(text) == pairs


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("= 0.7", "write a name before the sign ="),
        ("speed 0.7", "write speed = followed by an expression"),
        ("speed", "write speed = followed by an expression"),
        ("speed =", "write an expression after speed ="),
        ("speed == 0.7", "write one = between name and expression"),
        ("speed = 1\nturn 2", "line 2: write turn = followed by an expression"),
        ("speed = 1\nspeed = 2", "line 2: speed is set twice: remove one of the lines"),
    ],
)
def test_other_lines_are_refused_with_a_reason(text: str, words: str) -> None:
    assert find_error(text) == words


@pytest.mark.parametrize("pair", [("a=b", "1"), ("a", "1\n+ 2"), ("a\nb", "1")])
def test_pairs_that_lines_cannot_express_are_not_edited_as_text(pair: tuple[str, str]) -> None:
    assert "edit it in the file" in find_lost_pairs((pair,))
