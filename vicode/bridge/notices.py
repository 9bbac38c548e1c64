"""Notices of one robot: messages for both sides; frequent ones are counted instead of repeated."""

_PERIOD_NS = 1_000_000_000


class Notices:
    """Counts notices; each text is given out at most once per second, with its number since the last time."""

    __slots__ = ("_due_ns", "_numbers")

    def __init__(self) -> None:
        self._numbers: dict[str, int] = {}
        self._due_ns: dict[str, int] = {}

    def add(self, text: str) -> None:
        self._numbers[text] = self._numbers.get(text, 0) + 1

    def take(self, now_ns: int) -> list[str]:
        """The notices that are due; times are of any clock that never goes back."""
        if not self._numbers:
            return []
        due = [text for text in self._numbers if now_ns >= self._due_ns.get(text, now_ns)]
        self._due_ns |= dict.fromkeys(due, now_ns + _PERIOD_NS)
        return [_describe(text, self._numbers.pop(text)) for text in due]


def _describe(text: str, number: int) -> str:
    return text if number == 1 else f"{text} ({number} times)"
