"""Unique snake-case identifiers that are valid in every language."""

import re

from vicode.model.names import snake_case


class NameAllocator:
    """Allocates names that are unique ignoring case."""

    def __init__(self, taken: frozenset[str] = frozenset()) -> None:
        self._taken = {name.casefold() for name in taken}

    def allocate(self, base: str, separator: str = "_") -> str:
        """Return the base name, or the first free one of base_2, base_3, …"""
        name, number = base, 1
        while name.casefold() in self._taken:
            number += 1
            name = f"{base}{separator}{number}"
        self._taken.add(name.casefold())
        return name


def identifier_stem(text: str) -> str:
    """Convert any text to a part of an identifier."""
    return re.sub(r"[^a-z0-9]+", "_", snake_case(text), flags=re.ASCII).strip("_") or "x"


def package_name(name: str) -> str:
    """Convert a project name, which may be any text, to a package name."""
    stem = identifier_stem(name)
    return f"project_{stem}" if stem[0].isdigit() else stem
