"""The result of comparing a design in several languages, which the editor receives from another process."""

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
class LanguageComparison:
    """The languages that were compared, those that were not, and the differences from Python.

    Attributes:
        failed: The languages whose code does not compile, cannot be loaded or crashed.
        iterations: The number of iterations of all runs.
    """

    languages: tuple[str, ...]
    absent: tuple[AbsentLanguage, ...]
    failed: tuple[AbsentLanguage, ...]
    differences: tuple[LanguageDifference, ...]
    iterations: int
    runs: int


LANGUAGE_TITLES = {"python": "Python", "cpp": "C++", "xabsl": "XABSL", "simulator": "simulator"}


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
