"""The results of a sweep: the table of its runs, and a page that compares the values.

Runs with one seed begin in the same situation, so a value is compared with the baseline by a sign test: it only counts
in how many seeds a figure is higher or lower. It assumes no distribution, and holds for scores, and for times that some
runs lack because they ended first.
"""

import csv
import io
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from math import comb, inf, isfinite
from statistics import fmean, median
from typing import Any

from vicode.diagram.palettes import DARK, LIGHT, palette_variables
from vicode.runs.sweep import SECONDS, TAKEN, Combination, Row
from vicode.templating import render

MINIMIZE, MAXIMIZE = -1, 1
SIGNIFICANT = 0.05

Result = tuple[Combination, Sequence[Row]]
"""The runs with one combination of values."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """A figure of the runs with one combination of values; runs with errors are left out.

    Attributes:
        numbers: The figure of each run; infinite if a run lacks a figure that has a goal.
        higher: In how many seeds the figure is higher than that of the baseline.
        lower: In how many it is lower.
        p: The probability of such a difference by chance, corrected for the number of compared values (Bonferroni).
    """

    combination: Combination
    numbers: Sequence[float]
    higher: int
    lower: int
    p: float

    @property
    def finite(self) -> list[float]:
        return [number for number in self.numbers if isfinite(number)]

    @property
    def quartiles(self) -> tuple[float, float, float]:
        """The first quartile, the median and the third quartile; quartiles by nearest rank."""
        ordered, last = sorted(self.numbers), len(self.numbers) - 1
        return ordered[round(0.25 * last)], median(ordered), ordered[round(0.75 * last)]

    @property
    def mean(self) -> float:
        return fmean(self.numbers)

    def __str__(self) -> str:
        values = ", ".join(f"{name}={value}" for name, value in self.combination.values.items())
        mean = f", mean {self.mean:.4g}" if isfinite(self.mean) else ""
        return f"{values}, median {self.quartiles[1]:.4g}{mean}"


@dataclass(frozen=True, slots=True, kw_only=True)
class FigureComparison:
    """A figure with each combination of values that has runs; `best` is one of them if the figure has a goal.

    None is the best if no median is finite.
    """

    figure: str
    outcomes: tuple[Outcome, ...]
    best: Outcome | None

    @property
    def range(self) -> tuple[float, float]:
        """The lowest and the highest number."""
        finite = [number for each in self.outcomes for number in each.finite] or [0.0]
        return min(finite), max(finite)

    def describe_best(self) -> str:
        """Say which value is the best, and how sure that is."""
        if self.best is None:
            if any(each.finite for each in self.outcomes):
                return f"No value is the best: with each, at least half of the runs lack {self.figure}."
            return f"No run has this figure: {self.figure}. Runs with errors are left out."
        if self.best.combination.is_baseline:
            is_one = len(self.best.combination.values) == 1
            origin = "This is the value in the files." if is_one else "These are the values in the files."
            return f"Best {self.figure}: {self.best}. {origin}"
        baseline = next((str(each) for each in self.outcomes if each.combination.is_baseline), "no runs")
        counts = f"Higher in {self.best.higher} and lower in {self.best.lower} of {len(self.best.numbers)} seeds"
        verdict = "significant" if self.best.p < SIGNIFICANT else "may be chance"
        return f"Best {self.figure}: {self.best}. Baseline: {baseline}. {counts}: {verdict}, p = {self.best.p:.2g}."


def list_figures(rows: Sequence[Row]) -> list[str]:
    """The names of the figures; states and transitions come last."""
    names = dict.fromkeys(name for row in rows for name in row if name not in ("values", "seed", "error"))
    return sorted(names, key=lambda name: (name.startswith(TAKEN), name.startswith(SECONDS)))


def format_table(rows: Sequence[Row]) -> str:
    """The runs as CSV, one per line."""
    figures, text = list_figures(rows), io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([*dict.fromkeys(name for row in rows for name in row["values"]), "seed", "error", *figures])
    for row in rows:
        writer.writerow([*row["values"].values(), row["seed"], row["error"], *(_read(row, name) for name in figures)])
    return text.getvalue()


def compare(results: Sequence[Result], figure: str, goal: int = 0) -> FigureComparison:
    """Compare a figure; with a goal, a run that lacks it is worse than all others."""
    found: list[dict[int, float]] = []
    for _combination, rows in results:
        own = {row["seed"]: _read(row, figure) for row in rows if not row["error"]}
        if goal:
            own = {seed: -goal * inf if number is None else number for seed, number in own.items()}
        found.append({seed: number for seed, number in own.items() if isinstance(number, bool | int | float)})
    (baseline,) = (own for own, result in zip(found, results, strict=True) if result[0].is_baseline)
    outcomes = []
    for own, (each, _rows) in zip(found, results, strict=True):
        pairs = [(number, baseline[seed]) for seed, number in own.items() if seed in baseline]
        higher, lower = sum(one > other for one, other in pairs), sum(one < other for one, other in pairs)
        p = min(1.0, sign_test(higher, lower) * (len(results) - 1))
        if own:
            outcomes.append(Outcome(combination=each, numbers=[*own.values()], higher=higher, lower=lower, p=p))
    # The baseline is the best one if others are only as good.
    rated = sorted(
        outcomes, key=lambda each: (-goal * each.quartiles[1], -goal * each.mean, not each.combination.is_baseline)
    )
    best = rated[0] if goal and rated and isfinite(rated[0].quartiles[1]) else None
    return FigureComparison(figure=figure, outcomes=tuple(outcomes), best=best)


def sign_test(higher: int, lower: int) -> float:
    """The probability that differences without a tendency are as unequal as this, in either direction."""
    count = higher + lower
    return min(1.0, 2 * sum(comb(count, number) for number in range(min(higher, lower) + 1)) / (1 << count))


def write_page(title: str, results: Sequence[Result], best: FigureComparison | None = None) -> str:
    """The page; the figure with a goal comes first, those that are the same in all runs are left out."""
    rows = [row for _combination, own in results for row in own]
    names = [name for name in list_figures(rows) if best is None or name != best.figure]
    figures = [each for each in (compare(results, name) for name in names) if each.range[0] < each.range[1]]
    return render(
        "sweep/page.html.jinja",
        title=title,
        best=best,
        ends=[(each, Counter(row.get("stopped", "failed") for row in own)) for each, own in results],
        failed=[row for row in rows if row["error"]],
        significant=SIGNIFICANT,
        main=[*([best] if best else []), *(each for each in figures if not each.figure.startswith((SECONDS, TAKEN)))],
        details=[each for each in figures if each.figure.startswith((SECONDS, TAKEN))],
        light=palette_variables(LIGHT),
        dark=palette_variables(DARK),
    )


def _read(row: Row, figure: str) -> Any:
    """A figure, None if the run lacks it; a state that was not entered has 0 seconds."""
    return row.get(figure, 0 if figure.startswith((SECONDS, TAKEN)) and "stopped" in row else None)
