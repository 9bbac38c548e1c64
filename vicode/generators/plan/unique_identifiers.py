"""Unique snake-case identifiers that are valid in every language."""


class NameAllocator:
    """Allocates names that are unique ignoring case."""

    def __init__(self, taken: frozenset[str] = frozenset()) -> None:
        self._taken = {name.casefold() for name in taken}
        self._numbers: dict[tuple[str, str], int] = {}

    def allocate(self, base: str, separator: str = "_") -> str:
        """Return the base name, or the first free one of base_2, base_3, …"""
        # Names stay taken, so the search continues after the last number.
        key, name = (base.casefold(), separator), base
        number = self._numbers.get(key, 1)
        while name.casefold() in self._taken:
            number += 1
            name = f"{base}{separator}{number}"
        self._numbers[key] = number
        self._taken.add(name.casefold())
        return name
