"""The result of comparing a design in several languages."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class AbsentLanguage:
    """A language that was not compared; `component` and `path` name the cause in the design, if there is one."""

    language: str
    reason: str
    component: str = ""
    path: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceCell:
    """A line of a trace; that of a step of a component has its state."""

    text: str
    component: str = ""
    state: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class IterationInput:
    """The value of an input in an iteration, and whether it changed before it."""

    name: str
    value: str
    is_changed: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class LanguageDifference:
    """The first difference of two languages.

    Attributes:
        run: The number of the run, from 0.
        iteration: The number of the iteration; 0 if one trace ends early.
        values: What each language has in `field`, "" for nothing.
        rows: Both traces around the iteration, side by side.
    """

    languages: tuple[str, str]
    run: int
    iteration: int
    time_ns: int
    component: str
    field: str
    values: tuple[str, str]
    inputs: tuple[IterationInput, ...]
    rows: tuple[tuple[TraceCell, TraceCell], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class CoverageCount:
    """How many parts of a kind the inputs reached, such as 9 of 10 `transitions`."""

    kind: str
    seen: int
    total: int


@dataclass(frozen=True, slots=True, kw_only=True)
class NeverSeen:
    """A part of a design in words, and what did not happen to it; `component` and `path` name it in the design."""

    text: str
    outcome: str
    component: str
    path: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class InputCoverage:
    """What the inputs reached in the reference interpreter."""

    counts: tuple[CoverageCount, ...]
    never: tuple[NeverSeen, ...]

    @property
    def summary(self) -> str:
        """The counts as text."""
        return ", ".join(f"{each.seen} of {each.total} {each.kind}" for each in self.counts)


@dataclass(frozen=True, slots=True, kw_only=True)
class LanguageComparison:
    """The languages that were compared, those that were not, and the differences from the baseline.

    Attributes:
        partial: The languages that could not run all inputs.
        coverage: What the inputs reached; None if the reference interpreter cannot run the design.
        failed: The languages whose code does not compile, cannot be loaded or crashed.
        limited: The languages that differ by their nature from some iteration on, and are compared before it.
        iterations: The number of iterations of all runs.
    """

    languages: tuple[str, ...]
    absent: tuple[AbsentLanguage, ...]
    partial: tuple[AbsentLanguage, ...]
    failed: tuple[AbsentLanguage, ...]
    differences: tuple[LanguageDifference, ...]
    coverage: InputCoverage | None
    iterations: int
    runs: int
    limited: tuple[AbsentLanguage, ...] = ()

    @property
    def baseline(self) -> str:
        """The language with which the others are compared; "" without one."""
        return find_baseline(self.languages)


def as_design_path(texts: Sequence[str]) -> tuple[str | int, ...]:
    """Return the path of a part of a design; its numbers were sent as texts."""
    return tuple(int(part) if at > 1 and part.isdecimal() else part for at, part in enumerate(texts))


def find_baseline(languages: Collection[str]) -> str:
    return next((each for each in ("reference", "python") if each in languages), "")


LANGUAGE_TITLES = {
    "reference": "reference",
    "python": "Python",
    "cpp": "C++",
    "xabsl": "XABSL",
    "javascript": "JavaScript",
    "simulator": "simulator",
}


def verdict(comparison: LanguageComparison) -> str:
    """One sentence: which languages agree."""
    titles = [LANGUAGE_TITLES.get(language, language) for language in comparison.languages]
    names = f"{', '.join(titles[:-1])} and {titles[-1]}" if len(titles) > 1 else titles[0] if titles else "No language"
    if comparison.differences:
        return f"{names}: the traces differ"
    if len(titles) < 2:
        return f"Only {titles[0]} ran: there is nothing to compare it with" if titles else "There is nothing to compare"
    runs = f" of {comparison.runs} runs" if comparison.runs > 1 else ""
    return f"{names} agree in {comparison.iterations} iterations{runs}"
