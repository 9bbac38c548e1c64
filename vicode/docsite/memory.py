"""What was made before, found again by all that it was made from: an edit makes anew only what it concerns."""

from collections.abc import Callable, Hashable
from hashlib import sha256
from typing import TypeVar, cast

Made = TypeVar("Made")


class Memory:
    """Keeps what the latest building asked for; what it did not ask for is forgotten at its end."""

    def __init__(self) -> None:
        self._kept: dict[Hashable, object] = {}
        self._asked: dict[Hashable, object] = {}

    def recall(self, kind: str, key: Hashable, make: Callable[[], Made]) -> Made:
        """What was made of a key before, or is made now. The key says everything that the making looks at."""
        whole = (kind, key)
        if whole not in self._asked:
            self._asked[whole] = self._kept[whole] if whole in self._kept else make()
        return cast("Made", self._asked[whole])

    def forget_unasked(self) -> None:
        """End a building."""
        self._kept, self._asked = self._asked, {}


def digest_of(*values: object) -> str:
    """A name for frozen values: equal values have one name, different values another, in every process."""
    return sha256("\n".join(map(repr, values)).encode("utf-8", "surrogatepass")).hexdigest()[:32]
