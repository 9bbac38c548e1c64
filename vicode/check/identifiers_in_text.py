"""Identifiers in text that is not parsed."""

import re

_IDENTIFIER = re.compile(r"[A-Za-z_]\w*", re.ASCII)


def find_identifiers(text: str) -> frozenset[str]:
    return frozenset(_IDENTIFIER.findall(text))
