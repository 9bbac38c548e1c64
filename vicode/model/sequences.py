"""Longest increasing subsequences: the items of a list that did not move."""

from collections.abc import Iterable


def longest_increasing_subsequence(numbers: Iterable[int]) -> set[int]:
    """The members of a longest increasing subsequence of distinct numbers."""
    best: list[list[int]] = []
    for number in numbers:
        chain = next((chain for chain in reversed(best) if chain[-1] < number), [])
        if len(chain) == len(best):
            best.append([*chain, number])
        elif number < best[len(chain)][-1]:
            best[len(chain)] = [*chain, number]
    return set(best[-1]) if best else set()
