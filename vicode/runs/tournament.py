"""The result of a tournament of two versions of a design, A and B.

The two matches of a seed, with sides exchanged, begin in the same situation and are not independent. A seed therefore
counts once, with the sum of its two goal differences. Equal versions have the sum 0 in each seed.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import sqrt
from statistics import fmean, stdev

from vicode.runs.sweep import Row
from vicode.runs.sweep_page import SIGNIFICANT

SIDES = ("A", "B")
"""The home team in the two matches of a seed."""
_MIN_SEEDS = 5


@dataclass(frozen=True, slots=True, kw_only=True)
class TournamentResult:
    """The figures of the matches without errors, from the view of A.

    Attributes:
        difference: Mean goal difference per match.
        interval: Its 95 % confidence interval; None with fewer than 5 seeds.
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
        if not self.matches:
            return "No seed was played in both matches without an error: nothing is compared."
        better = f"{'A' if self.difference > 0 else 'B'} is better"
        verdict = better if self.p < SIGNIFICANT else "the difference may be chance"
        spread = "" if self.interval is None else " (95 % interval {:+.2f} to {:+.2f})".format(*self.interval)
        return f"Goal difference of A per match: {self.difference:+.2f}{spread}, p = {self.p:.2g}: {verdict}."

    def table(self) -> list[str]:
        """The lines of a table in Markdown."""
        goals = f"{self.goals_a} : {self.goals_b}"
        return [
            "| goals A : B | A won | drawn | A lost |",
            "|------------:|------:|------:|-------:|",
            f"| {goals:>11} | {self.won:5} | {self.drawn:5} | {self.lost:6} |",
        ]


def evaluate(rows: Sequence[Row]) -> TournamentResult:
    """Compare both versions; a seed counts if neither of its matches, which follow each other, has an error."""
    pairs = [pair for pair in zip(rows[::2], rows[1::2], strict=True) if not any(row["error"] for row in pair)]
    played = [row for pair in pairs for row in pair]
    differences = [row["world.goals_a"] - row["world.goals_b"] for row in played]
    outcomes = Counter((each > 0) - (each < 0) for each in differences)
    sums = [sum(pair) for pair in zip(differences[::2], differences[1::2], strict=True)]
    return TournamentResult(
        matches=len(played),
        goals_a=sum(row["world.goals_a"] for row in played),
        goals_b=sum(row["world.goals_b"] for row in played),
        won=outcomes[1],
        drawn=outcomes[0],
        lost=outcomes[-1],
        difference=fmean(sums) / 2 if sums else 0.0,
        interval=confidence_interval([each / 2 for each in sums]) if len(sums) >= _MIN_SEEDS else None,
        p=permutation_test(sums),
    )


def permutation_test(differences: Sequence[int]) -> float:
    """The probability of a sum as far from 0 as this if each difference could as well have the other sign; exact."""
    sums = {0: 1.0}
    for difference in filter(None, differences):
        known, sums = sums, {}
        for total, part in known.items():
            for each in (total + difference, total - difference):
                sums[each] = sums.get(each, 0.0) + part / 2
    return min(1.0, sum(part for total, part in sums.items() if abs(total) >= abs(sum(differences))))


def confidence_interval(values: Sequence[float]) -> tuple[float, float]:
    """The 95 % confidence interval of the mean of 5 or more values."""
    # The quantile of the t distribution: Abramowitz and Stegun, 26.7.5.
    free = len(values) - 1
    t = 1.95996 + 2.37227 / free + 2.82250 / free**2 + 2.55585 / free**3
    mean, half = fmean(values), t * stdev(values) / sqrt(len(values))
    return mean - half, mean + half


def format_page(versions: Mapping[str, str], rows: Sequence[Row], result: TournamentResult) -> str:
    """The result and the matches of each seed as Markdown."""
    names = [f"- {side}: `{version}`" for side, version in versions.items()]
    lines = ["# Tournament", "", *names, "", str(result), "", *result.table(), ""]
    lines += ["| seed | goals A : B, A at home | goals A : B, B at home |", "|-----:|---:|---:|"]
    for pair in zip(rows[::2], rows[1::2], strict=True):
        scores = ("failed" if row["error"] else f"{row['world.goals_a']} : {row['world.goals_b']}" for row in pair)
        lines.append(f"| {pair[0]['seed']} | {' | '.join(scores)} |")
    return "\n".join(lines) + "\n"
