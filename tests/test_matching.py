"""Matching of lists, against what trying all possibilities finds."""

from itertools import combinations

from hypothesis import given
from hypothesis import strategies as st

from vicode.matching import Match, find_unmoved, match_equal, match_similar


@given(st.permutations(range(7)), st.lists(st.integers(0, 7), max_size=4))
def test_as_many_items_as_possible_are_unmoved(order: list[int], added: list[int]) -> None:
    matches: list[Match] = [*order]
    for place in added:
        matches.insert(place, None)
    unmoved = find_unmoved(matches)
    assert [number for number in order if number in unmoved] == sorted(unmoved)
    longest = max(size for size in range(1, 8) for each in combinations(order, size) if list(each) == sorted(each))
    assert len(unmoved) == longest
    assert find_unmoved([None]) == find_unmoved([]) == set()


@given(st.text("abc", max_size=8), st.text("abc", max_size=8))
def test_equal_items_are_matched_once_each_and_none_is_left(old: str, new: str) -> None:
    matches: list[Match] = [None] * len(new)
    match_equal(old, new, matches)
    pairs = [(old[match], new[index]) for index, match in enumerate(matches) if match is not None]
    assert all(before == after for before, after in pairs)
    assert len({match for match in matches if match is not None}) == len(pairs)
    assert len(pairs) == sum(min(old.count(letter), new.count(letter)) for letter in "abc")


def test_known_matches_stay_and_common_runs_come_first() -> None:
    matches: list[Match] = [2, None, None]
    match_equal("xaa", "axa", matches)
    assert matches == [2, 0, 1]
    matches = [None] * 4
    match_equal("abc", "cabx", matches)
    assert matches == [2, 0, 1, None]


def test_the_most_similar_and_then_the_nearest_items_are_matched() -> None:
    matches: list[Match] = [None, None, None]
    table = {(0, 0): 0.6, (0, 1): 0.9, (1, 0): 0.6, (1, 2): 0.4}
    match_similar(2, matches, lambda before, after: table.get((before, after), 0))
    assert matches == [1, 0, None]
    many: list[Match] = [None] * 150
    match_similar(150, many, lambda _before, _after: 1)
    assert many == [None] * 150
