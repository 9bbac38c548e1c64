"""Suggestions for misspelled names."""

import re
from collections.abc import Iterable
from difflib import get_close_matches


def nearest_name(name: str, known: Iterable[str]) -> str | None:
    """Return the known name most similar to `name` (ignoring case), None if none is similar."""
    by_folded = {candidate.casefold(): candidate for candidate in sorted(known)}
    matches = get_close_matches(name.casefold()[:100], by_folded, n=1, cutoff=0.6)
    return by_folded[matches[0]] if matches else None


def did_you_mean(name: str, known: Iterable[str], fallback: str = "") -> str:
    """Return a fix that suggests the nearest known name, or `fallback` if none is similar."""
    candidate = nearest_name(name, known)
    return f"did you mean '{candidate}'?" if candidate else fallback


def suggested_name(fix: str) -> str:
    """Return the name suggested by `did_you_mean`, empty if there is none."""
    match = re.fullmatch(r"did you mean '(.*)'\?", fix, re.DOTALL)
    return match[1] if match else ""
