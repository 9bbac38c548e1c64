"""Fuzzy matching: finds the letters of a query in order, preferring word starts and consecutive letters.

The scores are those of fzy (John Hawthorn, https://github.com/jhawthorn/fzy/blob/master/ALGORITHM.md).
"""

import math
import re
from dataclasses import dataclass

_GAP_LEADING, _GAP_INNER, _GAP_TRAILING = -0.005, -0.01, -0.005
_MATCH_CONSECUTIVE, _MATCH_WORD, _MATCH_CAPITAL, _MATCH_DOT = 1.0, 0.8, 0.7, 0.6
_MAX_TEXT_LENGTH = 120


@dataclass(frozen=True, slots=True, kw_only=True)
class Alignment:
    """The score of a match, and the positions of the matched letters."""

    score: float
    positions: tuple[int, ...]


def subsequence_pattern(word: str) -> re.Pattern[str]:
    """A pattern that finds the letters of a word in order in lowercase text, without backtracking."""
    letters = [re.escape(letter) for letter in word]
    return re.compile("".join(f"[^{letter}\n]*{letter}" for letter in letters))


def align(word: str, text: str) -> Alignment | None:
    """The best alignment of a lowercase word with a text; None if its letters do not occur in order."""
    text = text[:_MAX_TEXT_LENGTH]
    low = text.lower()
    if len(low) != len(text) or not subsequence_pattern(word).match(low):
        return None
    bonus = _bonuses(text)
    ends: list[list[float]] = []
    bests: list[list[float]] = []
    for row, letter in enumerate(word):
        gap = _GAP_TRAILING if row == len(word) - 1 else _GAP_INNER
        end, best = _row(letter, low, bonus, (ends[-1], bests[-1]) if ends else None, gap=gap)
        ends.append(end)
        bests.append(best)
    return Alignment(score=bests[-1][-1], positions=_trace_positions(ends, bests))


def _row(
    letter: str, low: str, bonus: list[float], above: tuple[list[float], list[float]] | None, *, gap: float
) -> tuple[list[float], list[float]]:
    """For each position: the best score of a match ending there, and the best score up to there."""
    end, best = [], []
    running = -math.inf
    for index, char in enumerate(low):
        score = -math.inf
        if char == letter:
            if above is None:
                score = index * _GAP_LEADING + bonus[index]
            elif index:
                score = max(above[1][index - 1] + bonus[index], above[0][index - 1] + _MATCH_CONSECUTIVE)
        running = max(score, running + gap)
        end.append(score)
        best.append(running)
    return end, best


def _trace_positions(ends: list[list[float]], bests: list[list[float]]) -> tuple[int, ...]:
    """Trace the best alignment backwards from the last letter."""
    positions: list[int] = []
    position = len(ends[0]) - 1
    must = False
    for row in range(len(ends) - 1, -1, -1):
        while not (ends[row][position] > -math.inf and (must or ends[row][position] == bests[row][position])):
            position -= 1
        # Whether the previous letter must be directly before this one.
        must = row > 0 and position > 0 and bests[row][position] == ends[row - 1][position - 1] + _MATCH_CONSECUTIVE
        positions.append(position)
        position -= 1
    return tuple(reversed(positions))


def _bonuses(text: str) -> list[float]:
    before = "/"
    bonuses = []
    for letter in text:
        if before in "/_- →(:":
            bonuses.append(_MATCH_WORD)
        elif before == ".":
            bonuses.append(_MATCH_DOT)
        elif letter.isupper() and not before.isupper():
            bonuses.append(_MATCH_CAPITAL)
        else:
            bonuses.append(0.0)
        before = letter
    return bonuses
