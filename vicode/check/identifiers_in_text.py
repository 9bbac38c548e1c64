"""The words of a text of which more is not known."""

import re

_IDENTIFIER = re.compile(r"[A-Za-z_]\w*", re.ASCII)


def find_identifiers(text: str) -> frozenset[str]:
    """All names in a text."""
    return frozenset(_IDENTIFIER.findall(text))
