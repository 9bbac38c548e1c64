"""What was made before, found again by all that it was made from: an edit makes anew only what it concerns."""

from collections.abc import Callable, Hashable
from hashlib import sha256
from typing import TypeVar, cast

CachedValue = TypeVar("CachedValue")


class _HashedKey:
    """A value whose hash is found once: that of a design takes long."""

    __slots__ = ("_hash", "_value")

    def __init__(self, value: Hashable) -> None:
        self._value, self._hash = value, hash(value)

    def __hash__(self) -> int:
        return self._hash

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _HashedKey) and self._hash == other._hash and self._value == other._value


class BuildCache:
    """Keeps what the latest building asked for; what it did not ask for is forgotten at its end."""

    def __init__(self) -> None:
        self._previous: dict[_HashedKey, object] = {}
        self._current: dict[_HashedKey, object] = {}

    def get_or_create(self, kind: str, key: Hashable, make: Callable[[], CachedValue]) -> CachedValue:
        """What was made of a key before, or is made now. The key says everything that the making looks at."""
        whole = _HashedKey((kind, key))
        if whole not in self._current:
            self._current[whole] = self._previous[whole] if whole in self._previous else make()
        return cast("CachedValue", self._current[whole])

    def evict_unused(self) -> None:
        """End a building."""
        self._previous, self._current = self._current, {}


def compute_digest(*values: object) -> str:
    """A name for frozen values: equal values have one name, different values another, in every process."""
    return sha256("\n".join(map(repr, values)).encode("utf-8", "surrogatepass")).hexdigest()[:32]
