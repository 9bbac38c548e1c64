"""The known name a user most likely meant."""

import re
from collections.abc import Iterable
from difflib import get_close_matches


def nearest_name(name: str, known: Iterable[str]) -> str | None:
    """The known name most like `name` (case counts little), None when none is near."""
    by_folded = {candidate.casefold(): candidate for candidate in sorted(known)}
    matches = get_close_matches(name.casefold()[:100], by_folded, n=1, cutoff=0.6)
    return by_folded[matches[0]] if matches else None


def did_you_mean(name: str, known: Iterable[str], fallback: str = "") -> str:
    """A mend that names the nearest known name, or `fallback` when none is near."""
    candidate = nearest_name(name, known)
    return f"did you mean '{candidate}'?" if candidate else fallback


def suggested_name(fix: str) -> str:
    """The name that `did_you_mean` wrote into a mend, empty if it wrote none."""
    found = re.fullmatch(r"did you mean '(.*)'\?", fix, re.DOTALL)
    return found[1] if found else ""
