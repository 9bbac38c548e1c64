"""What was made before, found again by all that it was made from: an edit makes anew only what it concerns."""

from collections.abc import Callable, Hashable
from hashlib import sha256
from typing import TypeVar, cast

Made = TypeVar("Made")


class _Key:
    """A value whose hash is found once: that of a design takes long."""

    __slots__ = ("_hash", "_value")

    def __init__(self, value: Hashable) -> None:
        self._value, self._hash = value, hash(value)

    def __hash__(self) -> int:
        return self._hash

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Key) and self._hash == other._hash and self._value == other._value


class Memory:
    """Keeps what the latest building asked for; what it did not ask for is forgotten at its end."""

    def __init__(self) -> None:
        self._kept: dict[_Key, object] = {}
        self._asked: dict[_Key, object] = {}

    def recall(self, kind: str, key: Hashable, make: Callable[[], Made]) -> Made:
        """What was made of a key before, or is made now. The key says everything that the making looks at."""
        whole = _Key((kind, key))
        if whole not in self._asked:
            self._asked[whole] = self._kept[whole] if whole in self._kept else make()
        return cast("Made", self._asked[whole])

    def forget_unasked(self) -> None:
        """End a building."""
        self._kept, self._asked = self._asked, {}


def digest_of(*values: object) -> str:
    """A name for frozen values: equal values have one name, different values another, in every process."""
    return sha256("\n".join(map(repr, values)).encode("utf-8", "surrogatepass")).hexdigest()[:32]
