"""Suggestions for misspelled names."""

from collections.abc import Iterable
from difflib import get_close_matches


class Suggestion(str):
    """The text of a fix that proposes a name in place of another."""

    __slots__ = ("name",)
    name: str

    def __new__(cls, name: str, message: str = "") -> "Suggestion":
        text = super().__new__(cls, message or f"did you mean '{name}'?")
        text.name = name
        return text


def write_instead(name: str) -> Suggestion:
    """Return a fix that gives the correct spelling of a name."""
    return Suggestion(name, f"write {name}")


def nearest_name(name: str, known: Iterable[str]) -> str | None:
    """Return the known name most similar to `name` (ignoring case), None if none is similar."""
    by_folded = {candidate.casefold(): candidate for candidate in sorted(known)}
    matches = get_close_matches(name.casefold()[:100], by_folded, n=1, cutoff=0.6)
    return by_folded[matches[0]] if matches else None


def did_you_mean(name: str, known: Iterable[str], fallback: str = "") -> str:
    """Return a fix that suggests the nearest known name, or `fallback` if none is similar."""
    candidate = nearest_name(name, known)
    return Suggestion(candidate) if candidate else fallback
