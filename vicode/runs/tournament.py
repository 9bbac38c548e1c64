"""The result of a tournament of two versions of a design, A and B.

The two matches of a seed, with sides exchanged, begin in the same situation and are not independent. A seed therefore
counts once, with the sum of its two goal differences. Equal versions have the sum 0 in each seed.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from math import sqrt
from statistics import NormalDist, fmean, stdev
from typing import Any

from vicode.runs.sweep import Row

SIGNIFICANT = 0.05
SIDES = ("A", "B")
"""The version that is the home team, in the order of the two matches of a seed."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TournamentResult:
    """The figures of the matches without errors, from the view of A.

    Attributes:
        difference: Mean goal difference per match.
        interval: Its 95 % confidence interval; None with fewer than two seeds.
        p: Probability that equal versions differ by this or more.
    """

    matches: int
    goals_a: int
    goals_b: int
    won: int
    drawn: int
    lost: int
    difference: float
    interval: tuple[float, float] | None
    p: float

    def __str__(self) -> str:
        verdict = "the difference may be chance"
        if self.p < SIGNIFICANT:
            verdict = f"{'A' if self.difference > 0 else 'B'} is better"
        spread = "" if self.interval is None else "95 % interval {:+.2f} to {:+.2f}, ".format(*self.interval)
        return f"A wins by {self.difference:+.2f} goals per match on average, {spread}p = {self.p:.2g}: {verdict}."

    def as_plain(self) -> dict[str, Any]:
        return asdict(self)


def evaluate(rows: Sequence[Row]) -> TournamentResult:
    """Compare both versions; a seed counts if neither of its matches has an error."""
    pairs = [pair for pair in _pair(rows).values() if len(pair) == len(SIDES)]
    differences = [sum(_difference(row) for row in pair.values()) for pair in pairs]
    played = [row for pair in pairs for row in pair.values()]
    signs = Counter((_difference(row) > 0) - (_difference(row) < 0) for row in played)
    means = [difference / len(SIDES) for difference in differences]
    return TournamentResult(
        matches=len(played),
        goals_a=sum(row["world.goals_a"] for row in played),
        goals_b=sum(row["world.goals_b"] for row in played),
        won=signs[1],
        drawn=signs[0],
        lost=signs[-1],
        difference=fmean(means) if means else 0.0,
        interval=confidence_interval(means) if len(means) > 1 else None,
        p=permutation_test(differences),
    )


def permutation_test(differences: Sequence[int]) -> float:
    """The probability of a sum as far from 0 as this if each difference could as well have the other sign; exact."""
    sums = {0: 1.0}
    for difference in filter(None, differences):
        halves = [(total + each, part / 2) for total, part in sums.items() for each in (difference, -difference)]
        sums = {}
        for total, part in halves:
            sums[total] = sums.get(total, 0.0) + part
    return min(1.0, sum(part for total, part in sums.items() if abs(total) >= abs(sum(differences))))


def confidence_interval(values: Sequence[float], level: float = 0.95) -> tuple[float, float]:
    """The confidence interval of a mean, by the t distribution."""
    free, z = len(values) - 1, NormalDist().inv_cdf((1 + level) / 2)
    t = {1: 12.706, 2: 4.303, 3: 3.182}.get(free) if level == 0.95 else None
    if t is None:
        # Abramowitz and Stegun, 26.7.5.
        terms = (z, (z**3 + z) / 4, (5 * z**5 + 16 * z**3 + 3 * z) / 96, (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / 384)
        t = sum(term / free**power for power, term in enumerate(terms))
    mean, half = fmean(values), t * stdev(values) / sqrt(len(values))
    return mean - half, mean + half


def format_page(versions: Mapping[str, str], seconds: float, rows: Sequence[Row], result: TournamentResult) -> str:
    """The result and all matches as Markdown."""
    lines = ["# Tournament", "", *(f"- {side}: `{version}`" for side, version in versions.items()), "", str(result), ""]
    lines += [*format_result(result), "", f"Matches end when the world is finished, or after {seconds:g} s.", ""]
    lines += ["| seed | A : B, A at home | A : B, B at home | sum for A |", "|--:|--:|--:|--:|"]
    for seed, pair in _pair(rows).items():
        scores = [_score(pair[side]) if side in pair else "failed" for side in SIDES]
        total = sum(_difference(row) for row in pair.values()) if len(pair) == len(SIDES) else None
        lines.append(f"| {seed} | {scores[0]} | {scores[1]} | {'' if total is None else f'{total:+d}'} |")
    return "\n".join(lines) + "\n"


def format_result(result: TournamentResult) -> list[str]:
    """The table of both versions, as lines of Markdown."""
    outcomes = ((result.goals_a, result.won, result.drawn, result.lost), (result.goals_b, result.lost, result.drawn, result.won))
    lines = [f"| {side} | {' | '.join(f'{number:5}' for number in each)} |" for side, each in zip(SIDES, outcomes, strict=True)]
    return ["|   | goals |   won | drawn |  lost |", "|---|------:|------:|------:|------:|", *lines]


def _pair(rows: Sequence[Row]) -> dict[int, dict[str, Row]]:
    """The matches without errors by seed and home team."""
    pairs: dict[int, dict[str, Row]] = {row["seed"]: {} for row in rows}
    for row in rows:
        if not row["error"]:
            pairs[row["seed"]][row["values"]["home"]] = row
    return pairs


def _difference(row: Row) -> int:
    return int(row["world.goals_a"] - row["world.goals_b"])


def _score(row: Row) -> str:
    return f"{row['world.goals_a']} : {row['world.goals_b']}"
