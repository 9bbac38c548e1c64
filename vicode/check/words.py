"""The words of a text of which more is not known."""

import re

_WORD = re.compile(r"[A-Za-z_]\w*", re.ASCII)


def words_of(text: str) -> frozenset[str]:
    """All names in a text."""
    return frozenset(_WORD.findall(text))
