"""A cache of build results, keyed by their inputs, so that an edit rebuilds only what depends on it."""

from collections.abc import Callable, Hashable
from hashlib import sha256
from typing import TypeVar, cast

CachedValue = TypeVar("CachedValue")


class _HashedKey:
    """A value with a cached hash: hashing a design is slow."""

    __slots__ = ("_hash", "_value")

    def __init__(self, value: Hashable) -> None:
        self._value, self._hash = value, hash(value)

    def __hash__(self) -> int:
        return self._hash

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _HashedKey) and self._hash == other._hash and self._value == other._value


class BuildCache:
    """Keeps the results used in the latest build."""

    def __init__(self) -> None:
        self._previous: dict[_HashedKey, object] = {}
        self._current: dict[_HashedKey, object] = {}

    def get_or_create(self, kind: str, key: Hashable, make: Callable[[], CachedValue]) -> CachedValue:
        """Return the cached value of a key, or create it. The key must contain all inputs of `make`."""
        whole = _HashedKey((kind, key))
        if whole not in self._current:
            self._current[whole] = self._previous[whole] if whole in self._previous else make()
        return cast("CachedValue", self._current[whole])

    def evict_unused(self) -> None:
        """Drop the values that the current build did not use. Call it after each build."""
        self._previous, self._current = self._current, {}


def compute_digest(*values: object) -> str:
    """Return a digest of frozen values that is the same in every process."""
    return sha256("\n".join(map(repr, values)).encode("utf-8", "surrogatepass")).hexdigest()[:32]
