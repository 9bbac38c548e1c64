"""Names that fit into every language: snake case, each once."""

import re

from vicode.model.names import snake_case


class NameAllocator:
    """Gives names out, none twice; case does not tell two apart."""

    def __init__(self, taken: frozenset[str] = frozenset()) -> None:
        """Begin with names that nobody gets."""
        self._taken = {name.casefold() for name in taken}

    def allocate(self, wanted: str, separator: str = "_") -> str:
        """The name, or the first of name_2, name_3 … that is free."""
        name, number = wanted, 1
        while name.casefold() in self._taken:
            number += 1
            name = f"{wanted}{separator}{number}"
        self._taken.add(name.casefold())
        return name


def identifier_stem(text: str) -> str:
    """A piece of an identifier from any text."""
    return re.sub(r"[^a-z0-9]+", "_", snake_case(text), flags=re.ASCII).strip("_") or "x"


def package_name(name: str) -> str:
    """The name of a package from a project's name, which may be any text."""
    stem = identifier_stem(name)
    return f"project_{stem}" if stem[0].isdigit() else stem
